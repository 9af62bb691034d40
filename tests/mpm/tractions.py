# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads on faces: uniform stress under them in every analysis, resultants, histories, work, faces that move and turn, saving, bad input.

Bodies at Gauss places whose faces lie on nodes: the load is consistent with the quadrature and the stress at rest is uniform.
"""
import math
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

folder = tempfile.mkdtemp()


def path(name): return os.path.join(folder, name)


def says(what, call, kind, *parts):
	try: call()
	except kind as fault: check(what, all(str(part) in str(fault) for part in parts), str(fault))
	else: check(what, False, 'no %s' % kind.__name__)


def scene(analysis, upper, cell=.25, points=2, placement='gauss', thickness=.1, walls=(), origin=None, **engine):
	"""A block at the origin, on slip walls at x = 0, y = 0 and z = 0."""
	O.reset()
	elastic(young=1e7)
	plane = analysis != '3d'
	mpm.fill((tuple(0 for _ in upper), upper), placement=placement, cellSize=cell, points=points, material='elastic', thickness=thickness if plane and analysis != 'axisymmetric' else None,
		axisymmetric=analysis == 'axisymmetric', origin=origin)
	slip = [MpmWall(normal=[float(d == e) for e in range(3)], kind='slip') for d in range(len(upper)) if not (analysis == 'axisymmetric' and d == 0)]
	O.engines = [ForceResetter(), MpmEngine(cellSize=cell, analysis=analysis, walls=slip + list(walls), **dict(dict(damping=.2, flip=.7), **engine))]  # PIC settles it, and takes nothing at rest
	O.dt = .5*mpm.criticalTimeStep()


def rest(steps=1500):
	O.run(steps, True)
	check('at rest', abs(mpm.array('velocity')).max() < 1e-5, abs(mpm.array('velocity')).max())


# ---- uniform stress ---------------------------------------------------------------------------------------------------

for analysis, size, faces, wanted in (
	('planeStress', (1, .5), [(((1, 0), (1, .5)), dict(traction=(2e3, 0, 0)))], numpy.diag((2e3, 0, 0))),
	('planeStress', (1, .5), [(((1, .5), (1, 0)), dict(pressure=2e3)), (((0, .5), (1, .5)), dict(pressure=1e3))], -numpy.diag((2e3, 1e3, 0))),
	('planeStrain', (1, .5), [(((1, .5), (1, 0)), dict(pressure=2e3)), (((0, .5), (1, .5)), dict(pressure=1e3))], -numpy.diag((2e3, 1e3, .9e3))),
	('planeStress', (1, .5), [(((1, 0), (1, .5)), dict(traction=(0, 1e3, 0))), (((0, .5), (1, .5)), dict(traction=(1e3, 0, 0)))], None),
	('axisymmetric', (.5, 1), [(((.5, 0), (.5, 1)), dict(pressure=2e3)), (((0, 1), (.5, 1)), dict(pressure=1e3))], -numpy.diag((2e3, 1e3, 2e3))),
	('3d', (.5, .5, .5), [(((.5, 0, 0), (.5, .5, .5)), dict(pressure=1e3)), (((0, .5, 0), (.5, .5, .5)), dict(traction=(0, -2e3, 0))),
		(((0, 0, .5), (.5, 0, .5), (.5, .5, .5)), dict(pressure=3e3))], -numpy.diag((1e3, 2e3, 3e3))),
):
	for shape in ('cubic', 'quadratic') if wanted is not None else ():
		# the knots of cubic splines are the cells' boundaries, those of quadratic ones lie at mid-cells; the radius raises the degree by one
		scene(analysis, size, shape=shape, points=3 if analysis == 'axisymmetric' else 2, origin=None if shape == 'cubic' else [.125]*len(size))
		plane = dict(thickness=.1) if analysis.startswith('plane') else dict(axisymmetric=True) if analysis == 'axisymmetric' else {}
		loads = [mpm.traction(face, cellSize=.125, **dict(plane, **load)) for face, load in faces]  # pieces between the knots of either
		rest()
		scale = abs(wanted).max()
		near('%s, %s: uniform stress' % (analysis, shape), mpm.array('stress')/scale, numpy.tile(wanted/scale, (len(mpm.array('id')), 1, 1)), 2e-3)
		if analysis == '3d': near('resultants', [load.force for load in loads], [(-250, 0, 0), (0, -500, 0), (0, 0, -750)], 1)
		if analysis == 'axisymmetric': near('resultant of a ring', loads[1].force, (0, -1e3*math.pi*.25, 0), 1)
		if analysis == 'axisymmetric': near('its weights', [sum(load.weights) for load in loads], [math.pi, math.pi*.25], 1e-12)
		if analysis == 'axisymmetric': near('its area', [load.area for load in loads], [math.pi, math.pi*.25], 1e-12)

# uniform places: far less accurate than Gauss places, as the docstring says
error = {}
for placement in 'gauss', 'uniform':
	scene('3d', (1, .5, .5), placement=placement)
	for face, load in ((((1, 0, 0), (1, .5, .5)), 1e3), (((0, .5, 0), (1, .5, .5)), 1e3), (((0, 0, .5), (1, .5, .5)), 1e3)): mpm.traction(face, pressure=load, cellSize=.25)
	rest() if placement == 'gauss' else O.run(1500, True)
	off = abs(mpm.array('stress') + 1e3*numpy.eye(3)).max(axis=(1, 2))/1e3
	x = mpm.array('position')
	inside = ((x[:, 0] < .75) & (x[:, 1] < .25) & (x[:, 2] < .25))
	error[placement] = off[inside].max(), off.max()
	print('three free faces, %s places: error of the stress inside and anywhere %.4f, %.4f' % ((placement,) + error[placement]))
check('Gauss places: within 1 % inside, 5 % at edges', error['gauss'][0] < .01 and error['gauss'][1] < .05, error)
check('uniform places: no more than doc/points.md says', error['uniform'][0] < .1 and error['uniform'][1] < .25, error)

# ---- resultants, moments, momentum ------------------------------------------------------------------------------------

# a free body: momentum is the impulse of the load wherever the face lies in its cell, and the body does not turn about its centre
for shape in 'linear', 'gimp', 'quadratic', 'cubic':
	for shift in 0, .37:
		for scheme in 'USF', 'USL', 'MUSL':
			O.reset()
			elastic(young=1e6)
			mpm.fill(((shift*.25, 0), (shift*.25 + 1, 1)), spacing=.125, thickness=.1, material='elastic')
			load = mpm.traction(((shift*.25 + 1, 0), (shift*.25 + 1, 1)), traction=(300., 200, 0), thickness=.1)
			O.engines = [ForceResetter(), MpmEngine(cellSize=.25, shape=shape, scheme=scheme)]
			O.dt = .3*mpm.criticalTimeStep()
			O.run(200, True)
			near('%s, %s, shifted by %g cells: momentum' % (shape, scheme, shift), momentum()/(200*O.dt), (30., 20, 0), 1e-9)
			near('resultant', load.force, (30., 20, 0), 1e-9)

# loads that differ from place to place
scene('3d', (.5, .5, .5))
twist = mpm.traction(((.5, 0, 0), (.5, .5, .5)), traction=lambda x: (0, -(x[2] - .25), x[1] - .25), cellSize=.25)
water = mpm.traction(((0, .5, 0), (.5, .5, .5)), pressure=lambda x: 1e3*(1 - x[2]), cellSize=.25, times=[0, 10*O.dt], factors=[0, 1])
O.run(1, True)
near('a history of a pressure field', water.force, (0, 0, 0), 1e-12)
O.run(10, True)
near('a traction field: no resultant', twist.force, (0, 0, 0), 1e-12)
near('a pressure field: resultant', water.force[1], -1e3*.75*.25, .1)
water.pressure = 50.
O.run(1, True)
near('and a uniform one', water.force[1], -1e3*.75*.25 - 50*.25, .2)

# ---- histories --------------------------------------------------------------------------------------------------------

scene('planeStress', (1, .5))
load = mpm.traction(((1, 0), (1, .5)), traction=(1e3, 0, 0), thickness=.1, times=[3*O.dt, 7*O.dt], factors=[1, 3])
seen = []
each_step(lambda: seen.append(load.force[0]))
O.run(10, True)
near('a history: linear between times, constant outside', numpy.array(seen)/50, [1, 1, 1, 1, 1.5, 2, 2.5, 3, 3, 3], 1e-12)
load.dead = True
O.run(1, True)
equal('dead: no load', tuple(load.force), (0, 0, 0))
load.dead, load.times, load.factors, load.traction = False, [], [], (0, 7e2, 0)
O.run(1, True)
near('attributes may be changed', load.force, (0, 35, 0), 1e-12)

# ---- work and energy ---------------------------------------------------------------------------------------------------

for full in False, True:
	scene('planeStress', (1, .5), damping=0, flip=1, fullMass=full)
	O.trackEnergy = True
	O.dt *= .5
	load = mpm.traction(((1, 0), (1, .5)), traction=(1e4, 0, 0), thickness=.1, times=[0, 1500*O.dt], factors=[0, 1])
	path_ = []
	each_step(lambda: path_.append((load.force[0], load.displacement[0])))
	O.run(1500, True)
	force, moved = numpy.array(path_).T
	work = (.5*(force[1:] + force[:-1]))@numpy.diff(moved)
	near('fullMass=%s: work is the integral of force times displacement' % full, -O.energy['mpmExternal']/work, 1, .02)
	near('the energies add up to nothing', O.energy.total()/work, 0, 2e-3)

# ---- a face that moves and turns --------------------------------------------------------------------------------------

# a body that turns: the pressure turns with it, the dead load does not, and its area stays
O.reset()
elastic(young=1e6)
ids = mpm.fill(((-.5, -.5), (.5, .5)), spacing=.125, thickness=.1, material='elastic')
for i in ids:
	x = O.bodies[i].state.pos
	O.bodies[i].state.vel = (-x[1], x[0], 0)
pressing, dead = (mpm.traction(((.5, -.5), (.5, .5)), thickness=.1, **load) for load in (dict(pressure=1e-3), dict(traction=(1e-3, 0, 0))))
O.engines = [ForceResetter(), MpmEngine(cellSize=.25)]
O.dt = .3*mpm.criticalTimeStep()
O.run(int(.5/O.dt), True)
angle = numpy.arctan2(*(numpy.array(pressing.position).mean(axis=0)[1::-1]))
check('it has turned', .3 < angle < .6, angle)
near('a pressure stays normal to the face', numpy.array(pressing.force)[:2]/1e-4, (-math.cos(angle), -math.sin(angle)), .05)
near('a dead load keeps its direction', numpy.array(dead.force)/1e-4, (1, 0, 0), 1e-12)
near('the face moves with the body', numpy.linalg.norm(numpy.array(pressing.position).mean(axis=0)), .5, .02)

# stretched to one and a half: a pressure acts on the current area
O.reset()
elastic(young=1e7, poisson=0)
mpm.fill(((0, 0), (1, 1)), spacing=.125, thickness=.1, material='elastic')
for i in mpm.array('id').tolist(): O.bodies[i].state.vel, O.bodies[i].state.blockedDOFs = (O.bodies[i].state.pos[0], 0, 0), 'xy'
load = mpm.traction(((0, 1), (1, 1)), pressure=1e3, thickness=.1)
O.engines = [ForceResetter(), MpmEngine(cellSize=.25)]
O.dt = .2*mpm.criticalTimeStep()
O.run(int(.4/O.dt), True)
stretch = numpy.array(load.position)[:, 0]
near('the force grows with the area', load.force[1]/-100, mpm.array('F')[:, 0, 0].mean(), .02)
check('by a lot', load.force[1] < -125, load.force)

# ---- saving and loading ------------------------------------------------------------------------------------------------

def swing():
	scene('planeStress', (1, .5), damping=0, flip=1)
	mpm.traction(((1, 0), (1, .5)), traction=(0, 1e4, 0), thickness=.1, times=[0, .02], factors=[0, 1])
	mpm.traction(((1, .5), (0, .5)), pressure=1e3, thickness=.1)


swing()
O.run(60, True)
O.save(path('half.yade.gz'))
O.run(60, True)
whole = state()
O.reset()
O.load(path('half.yade.gz'))
loads = [item for item in O.miscParams if isinstance(item, MpmPoints)][0].tractions
equal('loads are saved', [tuple(load.traction) for load in loads], [(0, 1e4, 0), (0, 0, 0)])
O.run(60, True)
for name, values in state().items(): same('saved half-way: %s' % name, values, whole[name])

# ---- bad input ----------------------------------------------------------------------------------------------------------

face, nan = ((1, 0), (1, .5)), float('nan')
for arguments, parts in (
	(dict(face=face), ('traction = None', 'one of the two')),
	(dict(face=face, traction=(1, 0, 0), pressure=1), ('one of the two', )),
	(dict(face=face, traction=(1, nan, 0)), ('traction', 'finite')),
	(dict(face=face, traction=3), ('traction = 3', 'three finite components')),
	(dict(face=face, traction=(0, 0, 1)), ('along z', )),
	(dict(face=face, pressure=nan), ('pressure = nan', )),
	(dict(face=face, pressure='high'), ("pressure = 'high'", )),
	(dict(face=face, pressure=1, thickness=0), ('thickness = 0', )),
	(dict(face=((1, 0), (1, 0)), pressure=1), ('no area', )),
	(dict(face=((1, 0, 0), (1, 1, 0)), pressure=1), ('two ends of a segment', )),
	(dict(face=7, pressure=1), ('face = 7', )),
	(dict(face=((3, 0), (3, 1)), pressure=1), ('no material point', 'surface')),
	(dict(face=face, pressure=1, points=0), ('points = 0', )),
	(dict(face=face, pressure=1, cellSize=-1), ('cellSize = -1', )),
	(dict(face=face, traction=lambda x: (1, 0)), ('traction at', 'three finite')),
	(dict(face=face, traction=lambda x: (0, 0, 1)), ('traction at', 'along z')),
	(dict(face=face, pressure=lambda x: nan), ('pressure at', 'nan')),
	(dict(face=face, pressure=1, times=[0, 1]), ('give both', )),
	(dict(face=face, pressure=1, times=[0, 1], factors=[1]), ('2 times and 1 factors', )),
	(dict(face=face, pressure=1, times=[0, 0], factors=[1, 2]), ('times[1]', 'increase')),
	(dict(face=face, pressure=1, times=[0, nan], factors=[1, 2]), ('times[1] = nan', )),
	(dict(face=face, pressure=1, times='now', factors=[1]), ('times', )),
	(dict(face=face, pressure=1, axisymmetric=True), ('rings have none', )),
):
	scene('planeStress', (1, .5))
	says('mpm.traction(%s)' % ', '.join('%s=%s' % item for item in arguments.items()), lambda: mpm.traction(**dict(dict(thickness=.1), **arguments)), ValueError, 'mpm.traction', *parts)
O.reset()
says('without points', lambda: mpm.traction(face, pressure=1, thickness=.1), ValueError, 'no material points')
scene('3d', (.5, .5, .5))
says('two corners of a slanted rectangle', lambda: mpm.traction(((.5, 0, 0), (.4, .5, .5)), pressure=1), ValueError, 'share exactly one coordinate')
scene('planeStress', (1, .5))
mpm.traction(face, pressure=1, axisymmetric=True)
says('rings in plane stress', lambda: O.run(1, True), RuntimeError, 'MpmTraction 0', 'thickness=...')
for attribute, value, part in ('traction', (nan, 0, 0), 'traction'), ('pressure', nan, 'pressure = nan'), ('times', [0., 1], 'factors'), ('traction', (0, 0, 1), 'along z'):
	scene('planeStress', (1, .5))
	load = mpm.traction(face, pressure=1, thickness=.1)
	setattr(load, attribute, value)
	says('MpmTraction.%s = %s' % (attribute, value), lambda: O.run(1, True), RuntimeError, 'MpmTraction 0', part)

finish()
