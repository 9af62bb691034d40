# SPDX-License-Identifier: GPL-2.0-or-later
"""The 3D view under a virtual display: points coloured by stress, seen in a screenshot.

Started without a display this script starts itself again in one:  scripts/yade-mpm -n -x tests/mpm/view.py
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import shutil
import subprocess
import tempfile

from common import *

script = os.path.realpath(sys.argv[0])
if len(sys.argv) < 2:
	with tempfile.TemporaryDirectory() as folder:
		command = ['xvfb-run', '-a', '-s', '-screen 0 1024x768x24', os.path.join(root, 'scripts', 'yade-mpm'), '-x', script, folder]
		done = subprocess.run(command, env=dict(os.environ, LIBGL_ALWAYS_SOFTWARE='1', OMP_WAIT_POLICY='passive'), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=120)
		picture = os.path.join(folder, 'view.png')
		check('a screenshot', os.path.exists(picture), done.stdout)
		if os.path.exists(picture):
			import matplotlib.image
			pixels = matplotlib.image.imread(picture)[:, :, :3]
			spread = pixels.max(axis=2) - pixels.min(axis=2)
			coloured = pixels[spread > .25]
			check('points fill a part of it', .01 < len(coloured)/spread.size < .8, len(coloured)/spread.size)
			red, green, blue = coloured.T
			check('blue where the stress is least, red where it is greatest', ((blue > 1.3*red) & (blue > green)).sum() > 50 and ((red > 1.3*blue) & (red > green)).sum() > 50)
			if os.environ.get('MPM_KEEP_PICTURE'): shutil.copy(picture, os.environ['MPM_KEEP_PICTURE'])
	finish()

from yade import qt

beam, grid = block(region=((0, 0), (1, .3)), spacing=1/40., thickness=.05, material=elastic(young=1e9), cellSize=1/20., walls=[MpmWall(normal=(1, 0, 0))], gravity=(0, -4e3, 0))
O.run(100, True)
mpm.color('vonMises', colormap='coolwarm')
view = qt.View()
view.axes = False
view.grid = (False, False, False)
view.viewDir, view.upVector = (0, 0, -1), (0, 1, 0)
view.center()
O.engines = O.engines + [qt.SnapshotEngine(iterPeriod=1, fileBase=os.path.join(sys.argv[1], 'view-'), format='PNG')]
from PyQt5.QtWidgets import QApplication
O.run(2)
while O.running: QApplication.processEvents()  # the view is drawn by this thread
shots = sorted(name for name in os.listdir(sys.argv[1]) if name.startswith('view-'))
if shots: os.rename(os.path.join(sys.argv[1], shots[-1]), os.path.join(sys.argv[1], 'view.png'))
sys.stdout.flush()
os._exit(0 if shots else 1)
