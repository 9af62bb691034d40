# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that is saved half-way, loaded in a new process and continued ends as if it had never been interrupted.

A hysteretic cantilever, loaded beyond first yield, swinging, with a moving wall, damping, the full mass, the filter and points with and without bodies:
every attribute and every array after 700 steps, the last 300 of them in another process. YADE writes floating-point numbers to 17 digits,
which is exact, so the comparison is bit for bit, for XML and binary files, compressed or not.

With arguments this script is that other process: saveload.py <scene> <steps> <file for the arrays>.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *


def attributes():
	grid = [e for e in O.engines if isinstance(e, MpmEngine)][0]
	walls = [dict(w.dict()) for w in grid.walls]
	engine = {k: v for k, v in grid.dict().items() if k != 'walls'}
	return repr((engine, walls, [m.dict() for m in O.materials], O.iter, O.time, O.dt,
		[(b.id, b.groupMask, b.mat.label, b.state.blockedDOFs, tuple(b.state.pos), tuple(b.state.vel), b.state.mass, tuple(b.state.refPos)) for b in O.bodies]))


def write(file):
	numpy.savez(file, attributes=attributes(), **state())


def arrays(file):
	with numpy.load(file) as data:
		return {name: data[name] for name in data.files}


if len(sys.argv) > 1:
	O.load(sys.argv[1])
	first = state()  # looking at a loaded scene before its first step
	O.run(int(sys.argv[2]), True)
	write(sys.argv[3])
	same('ids', state()['id'], first['id'])
	finish()

steel = BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05, n=7, beta=.4, gamma=.6, tolerance=2e-5)
beam, grid = block(region=((0, 0), (1, .1)), spacing=1/40., thickness=.05, material=steel, courant=.6, cellSize=1/20., damping=.02, flip=.999, fullMass=True, filterTime=2e-4, gravity=(0, -9.81, 0),
	walls=[MpmWall(normal=(1, 0, 0), kind='fixed'), MpmWall(normal=(0, 1, 0), origin=(0, -.5, 0), velocity=(0, .1, 0), kind='friction', friction=.3)], label='grid')
tip = [i for i in beam if O.bodies[i].state.pos[0] > 1 - 1/40.]
engines = O.engines
engines.insert(1, InterpolatingDirectedForceEngine(ids=tip, times=[0, 1e-3], magnitudes=[60e3/len(tip)]*2, direction=(0, -1, 0)))
O.engines = engines
O.bodies[beam[30]].state.blockedDOFs = 'x'
rubber = FrictMat(label='rubber', young=1e9, poisson=.45, density=1000)
O.materials.append(rubber)
loose = mpm.fill(((.2, .25), (.4, .35)), spacing=1/40., thickness=.05, material='rubber', velocity=(0, -5, 0), bodies=False)
O.dt = .6*mpm.criticalTimeStep()
O.run(100, True)
O.bodies.erase(beam[-30])
O.run(300, True)

with tempfile.TemporaryDirectory() as folder:
	path = lambda name: os.path.join(folder, name)
	formats = '.xml', '.xml.bz2', '.yade', '.yade.bz2'
	for ending in formats: O.save(path('half' + ending))
	saved, described = state(), attributes()
	O.saveTmp('half')
	O.run(300, True)
	whole, after = state(), attributes()
	write(path('whole.npz'))
	check('the beam yields, before and after', 1e-5 < saved['plasticStrain'].max() < whole['plasticStrain'].max(), (saved['plasticStrain'].max(), whole['plasticStrain'].max()))
	check('points without bodies and bodies without points are among it', (whole['id'] < 0).sum() == len(loose) and beam[-30] not in whole['id'])
	check('the walls are pressed', abs(grid.walls[0].force[0]) > 1 and grid.walls[1].origin[1] > -.5)
	saved_whole = arrays(path('whole.npz'))
	for ending in formats:
		check('%s: another process goes on' % ending, another(os.path.realpath(sys.argv[0]), path('half' + ending), 300, path('other.npz')))
		if not os.path.exists(path('other.npz')): continue
		other = arrays(path('other.npz'))
		for name in whole: same('%s: %s' % (ending, name), other[name], whole[name])
		equal('%s: attributes of engine, walls, materials, bodies' % ending, str(other['attributes']), str(saved_whole['attributes']))
		os.remove(path('other.npz'))
	for what, load in ('O.loadTmp', lambda: O.loadTmp('half')), ('O.load in the same process', lambda: O.load(path('half.xml'))):
		load()
		now = state()
		for name in now: same('%s: %s as saved' % (what, name), now[name], saved[name])
		equal('%s: attributes as saved' % what, attributes(), described)
		O.run(300, True)
		now = state()
		for name in now: same('%s: %s at the end' % (what, name), now[name], whole[name])
		equal('%s: attributes at the end' % what, attributes(), after)
	new = mpm.fill(((.6, .3), (.7, .4)), spacing=1/40., thickness=.05, material='rubber', bodies=False)
	check('ids of points without bodies go on where they were', max(new) < min(loose), (new[0], loose[-1]))

finish()
