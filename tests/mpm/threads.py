# SPDX-License-Identifier: GPL-2.0-or-later
"""Results do not depend on the number of threads: bit for bit the same with -j1 and -j2, and with MpmEngine(ompThreads=1).

Two hysteretic blocks of together 2600 points that hit walls, slide on one with friction and are sorted anew as they cross cells;
200 steps. Threads share points out by tiles of the grid, and every sum over tiles has a fixed order, so there is nothing to tolerate.

With arguments this script is one of those runs: threads.py <ompThreads> <file for the arrays>.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

if len(sys.argv) > 1:
	ids, grid = block(region=((0, 0), (1, 1)), spacing=1/50., velocity=(5, -5, 0), gravity=(0, -10, 0), damping=.01,
		material=BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=2e4, tangentRatio=.05, n=10), ompThreads=int(sys.argv[1]),
		walls=[MpmWall(normal=(0, 1, 0), kind='friction', friction=.2, origin=(0, -.02, 0)), MpmWall(normal=(-1, 0, 0), kind='fixed', origin=(2, 0, 0))])
	mpm.fill(((1.5, 0), (1.9, .06)), spacing=1/50., thickness=.1, material=0, bodies=False)
	mpm.fill(((1.5, .2), (1.7, .4)), spacing=1/50., thickness=.1, material=0, velocity=(-10, 0, 0))
	O.dt = .4*mpm.criticalTimeStep()
	O.run(200, True)
	numpy.savez(sys.argv[2], threads=O.numThreads, forces=[list(w.force) for w in grid.walls], iter=O.iter, **state())
	finish()

with tempfile.TemporaryDirectory() as folder:
	results = {}
	for name, threads, own in ('-j1', 1, 0), ('-j2', 2, 0), ('-j2, ompThreads=1', 2, 1), ('-j1, ompThreads=2', 1, 2):
		file = os.path.join(folder, 'run.npz')
		check('%s runs' % name, another(os.path.realpath(sys.argv[0]), own, file, threads=threads))
		if os.path.exists(file):
			with numpy.load(file) as data: results[name] = {k: data[k] for k in data.files}
			os.remove(file)
			equal('%s had its threads' % name, int(results[name].pop('threads')), threads)
	first = results['-j1']
	equal('all steps were done', int(first['iter']), 200)
	check('points yield and move', first['plasticStrain'].max() > 1e-3 and abs(first['velocity']).max() > 1 and abs(first['forces'])[0, :2].min() > 0, abs(first['forces']))
	for name in results:
		for quantity in first:
			if name != '-j1': same('%s: %s as with -j1' % (name, quantity), results[name][quantity], first[quantity])

finish()
