# SPDX-License-Identifier: GPL-2.0-or-later
"""A batch over n, the sharpness of the knee of the hysteretic law.

	scripts/yade-mpm-batch --job-threads=1 scripts/examples/batch_n.table scripts/examples/batch_n.py

A steel cantilever, 1 x 0.1 x 0.05 m, 4 points through the depth, 5 % hardening, damping 0.02. The tip load
rises to 28 kN in 20 ms and falls in 20 ms, which is fast, not static. yade-batch runs one job per line of the
table, in parallel if there are cores. Each job adds its curve to out/batch_n (or the folder in MPM_OUT); the
last one draws all of them, batch_n.png. Without a table (scripts/yade-mpm -n -x scripts/examples/batch_n.py)
the script runs n = 10.
"""
import glob
import os

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm, plot, utils
from yade import *

readParamsFromTable(noTableOk=True, n=10., load=28e3, duration=.02)
from yade.params import table  # as readParamsFromTable has filled it

out = os.path.join(os.environ.get('MPM_OUT', 'out'), 'batch_n')
os.makedirs(out, exist_ok=True)

spacing = .1/4
O.materials.append(BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05, n=table.n))
beam = mpm.fill(((0, 0), (1, .1)), spacing=spacing, thickness=.05, material='steel')
tip = [i for i in beam if O.bodies[i].state.pos[0] > 1 - spacing]
times = np.linspace(0, 2*table.duration, 81)
loads = table.load*.5*(1 - np.cos(np.pi*times/table.duration))


def record():
	plot.addData(displacement=-np.mean([O.bodies[i].state.displ()[1] for i in tip]), load=np.interp(O.time, times, loads))


O.engines = [
	ForceResetter(),
	InterpolatingDirectedForceEngine(ids=tip, times=list(times), magnitudes=list(loads/len(tip)), direction=(0, -1, 0)),
	MpmEngine(cellSize=2*spacing, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')], damping=.02),
	PyRunner(iterPeriod=20, initRun=True, command='record()'),
]
O.dt = .7*mpm.criticalTimeStep()
plot.plots = {'displacement': ('load',)}
O.run(int(2*table.duration/O.dt), True)
plot.saveDataTxt(os.path.join(out, 'n=%g.txt' % table.n), vars=('displacement', 'load'))

figure, axes = plt.subplots(figsize=(6, 4))
for file in sorted(glob.glob(os.path.join(out, 'n=*.txt')), key=lambda f: float(os.path.basename(f)[2:-4])):
	displacement, load = np.loadtxt(file).T
	axes.plot(1e3*displacement, load/1e3, label=os.path.basename(file)[:-4])
axes.set(xlabel='tip displacement [mm]', ylabel='tip load [kN]')
axes.grid(alpha=.3)
axes.legend()
figure.savefig(os.path.join(out, 'batch_n.%d.png' % os.getpid()), dpi=120, bbox_inches='tight')
os.replace(os.path.join(out, 'batch_n.%d.png' % os.getpid()), os.path.join(out, 'batch_n.png'))  # two jobs may draw at once
print('n = %g: residual displacement %.3f mm; results in %s' % (table.n, 1e3*plot.data['displacement'][-1], os.path.abspath(out)))
