# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of material points and grains: far grains, collider, saving, erasing and adding, time step, energies.

Grains that touch no material point go bit for bit as without MPM. A saved scene goes on bit for bit, from either format and in
another process: with loopOnSortedInteractions whatever touches what, without while no body has more than two contacts.
With three or more the order in which YADE adds their forces depends on when its collider has last run, with or without
material points, and the last bits with it.

With arguments this script is that other process: contactscene.py <scene> <steps> <file for the arrays>.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

g = 9.81


def engines(after=(), verletDist=.02, ordered=False):
	return [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=verletDist),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()],
			loopOnSortedInteractions=ordered)] + list(after)


def material(): O.materials.append(FrictMat(young=1e7, poisson=.3, density=1000, frictionAngle=.5, label='m'))


def scene(balls=(), velocity=(0, 0, 0), gravity=(0, 0, -g), walls=True, stepper=None, safety=0, **arguments):
	"""A block 1 x 1 x 0.5 m of 256 points, spheres (position, velocity, radius), and the engines."""
	O.reset()
	material()
	ids = mpm.fill(((0, 0, 0), (1, 1, .5)), spacing=.125, material='m', velocity=velocity)
	grid = MpmEngine(cellSize=.25, analysis='3d', gravity=gravity, walls=[MpmWall(normal=(0, 0, 1))] if walls else [], timeStepSafety=safety)
	O.engines = engines(([stepper] if stepper else []) + [grid, NewtonIntegrator(damping=0, gravity=gravity)], **arguments)
	return ids, [add(*ball) for ball in balls], grid


def add(position, velocity, radius):
	ball = O.bodies.append(sphere(position, radius, material='m'))
	O.bodies[ball].state.vel = velocity
	return ball


def motion(ids): return numpy.array([list(s.pos) + list(s.vel) + list(s.angVel) + list(s.ori) for s in (O.bodies[i].state for i in ids)])


def everything(): return dict(state(), bodies=motion([b.id for b in O.bodies]))


def touching(ids=None): return [(i.id1, i.id2) for i in O.interactions if i.isReal and (ids is None or i.id1 in ids or i.id2 in ids)]


if len(sys.argv) > 1:
	O.load(sys.argv[1])
	O.run(int(sys.argv[2]), True)
	numpy.savez(sys.argv[3], **everything())
	finish()

# ---- two spheres far from the block ---------------------------------------------------------------------------------
pair = [((5, 5, 5), (.3, 0, 0), .2), ((5.45, 5.1, 5.02), (-.5, .1, 0), .2)]
ids, balls, grid = scene(pair, velocity=(1, 0, 0))
O.dt = .2*mpm.criticalTimeStep()
dt = O.dt
O.run(400, True)
with_points = motion(balls)
O.reset()
material()
balls = [add(*ball) for ball in pair]
O.engines = engines([NewtonIntegrator(damping=0, gravity=(0, 0, -g))])
O.dt = dt
O.run(400, True)
same('two spheres far from the block go as without it', with_points, motion(balls))
check('and have hit each other', O.bodies[balls[0]].state.vel[0] < 0 and O.bodies[balls[0]].state.angVel.norm() > .01, O.bodies[balls[0]].state.vel)

# ---- the collider hears of points that move, and of those that move far ----------------------------------------------
for verletDist in 0, .005, .1, -.2:
	ids, (ball, ), grid = scene([((3, .55, .3), (0, 0, 0), .3)], velocity=(4, 0, 0), gravity=(0, 0, 0), walls=False, verletDist=verletDist)
	O.dt = .1*mpm.criticalTimeStep()
	depth = []
	each_step(lambda: depth.extend(i.geom.penetrationDepth for i in O.interactions if i.isReal and i.iterMadeReal == O.iter))
	O.stopAtTime = .6
	O.run()
	O.wait()
	check('verletDist = %g: a block that flies two metres hits the grain' % verletDist, depth and O.bodies[ball].state.vel[0] > 1, O.bodies[ball].state.vel)
	# a contact made late would begin deeper than the way of a step
	check('verletDist = %g: contacts begin at the surface' % verletDist, depth and max(depth) < 2*4*O.dt, (max(depth or [0]), 4*O.dt))

ids, (ball, ), grid = scene([((5, .5, .25), (0, 0, 0), .2)], gravity=(0, 0, 0), walls=False)
O.dt = .1*mpm.criticalTimeStep()
O.run(20, True)
for i in ids: O.bodies[i].state.pos += Vector3(3.85, 0, 0)
O.run(3, True)
check('points that a script has moved to a grain touch it', len(touching([ball])) > 0)
equal('points do not touch each other', [c for c in touching() if c[0] in ids and c[1] in ids], [])

# ---- a script gives a touching point another velocity: the change acts once, however often the scene is looked at ------
ends = []
for looks in 0, 1, 3:
	ids, (ball, ), grid = scene([((.1875, .5625, .5 + .1 - .001), (0, 0, -.1), .1)])
	O.dt = .2*mpm.criticalTimeStep()
	O.run(3, True)
	hit = [c[0] if c[0] in ids else c[1] for c in touching([ball])][0]
	O.bodies[hit].state.vel += Vector3(.5, 0, -.25)
	for _ in range(looks): mpm.criticalTimeStep()
	O.run(5, True)
	ends.append(everything())
check('the change is seen', abs(ends[0]['velocity'][:, 0]).max() > .01)
for end in ends[1:]:
	for name in end: same('looks between the change of a velocity and the step: ' + name, end[name], ends[0][name])

# ---- erasing and adding in mid-run ------------------------------------------------------------------------------------
row = [((.1875 + .25*k, .5625, .5 + .1 - .001), (0, 0, -.1), .1) for k in range(3)]
ids, balls, grid = scene(row)
O.dt = .2*mpm.criticalTimeStep()
O.run(3, True)
live = touching(balls)
check('all grains touch the block', all(any(b in c for c in live) for b in balls), live)
gone_ball, gone_point = balls[0], [c[0] if c[0] in ids else c[1] for c in live if balls[1] in c][0]
O.bodies.erase(gone_ball)
O.bodies.erase(gone_point)
O.run(50, True)
equal('erased while touching: the point is gone', (gone_point in mpm.array('id'), len(mpm.array('id'))), (False, len(ids) - 1))
equal('and no contact is left of either', touching([gone_ball, gone_point]), [])
late = add((.2, .2, .75), (0, 0, -3), .1)
new = mpm.fill(((2, 2, 0), (2.25, 2.25, .25)), spacing=.125, material='m', velocity=(0, 0, -1))
below = add((2.125, 2.125, -.25), (0, 0, 0), .15)
O.bodies[below].state.blockedDOFs = 'xyzXYZ'
grid.walls = []
met = set()
each_step(lambda: met.update(touching([late, below])))
O.run(200, True)
check('a grain added in mid-run lands on the block', any(late in c and (c[0] in ids or c[1] in ids) for c in met), sorted(met))
check('points added in mid-run land on a grain', any(below in c and (c[0] in new or c[1] in new) for c in met), sorted(met))
check('the scene is finite', numpy.isfinite(motion([b.id for b in O.bodies])).all())

# O.bodies.clear() leaves the contacts of the bodies, on which YADE's next step may crash
scene(row)
O.dt = .2*mpm.criticalTimeStep()
O.run(3, True)
check('the scene has contacts', len(touching()) > 0)
O.interactions.clear()
O.bodies.clear()
again = mpm.fill(((0, 0, 0), (.5, .5, .25)), spacing=.125, material='m')
O.run(5, True)
equal('a scene that was emptied is filled again', (len(mpm.array('id')), len(again), len(O.bodies)), (32, 32, 32))

# ---- saved with contacts, loaded, continued ---------------------------------------------------------------------------
# each grain above one point; a facet beside the block that a second block hits
ids, balls, grid = scene([((.1875 + .25*k, .5625, .5 + .11), (.2*(-1)**k, .1, -1), .1) for k in range(3)])
O.bodies.append(facet([(-4, -9, -.4), (9, -9, -.4), (0, 20, -.4)], material='m'))
O.dt = .2*mpm.criticalTimeStep()
while len(touching(balls)) < 3 and O.iter < 50: O.run(1, True)
live = touching(balls)
check('the grains touch the block when the scene is saved', len(live) >= 3, live)
steps = 60
with tempfile.TemporaryDirectory() as folder:
	path = lambda name: os.path.join(folder, name)
	for ending in '.xml', '.yade.bz2': O.save(path('half' + ending))
	O.run(steps, True)
	whole = everything()
	for ending in '.xml', '.yade.bz2':
		O.load(path('half' + ending))
		equal('%s: the contacts are as saved' % ending, sorted(touching(balls)), sorted(live))
		O.run(steps, True)
		here = everything()
		for name in whole: same('%s, same process: %s' % (ending, name), here[name], whole[name])
		check('%s: another process goes on' % ending, another(os.path.realpath(sys.argv[0]), path('half' + ending), steps, path('other.npz')))
		with numpy.load(path('other.npz')) as other:
			for name in whole: same('%s, another process: %s' % (ending, name), other[name], whole[name])

# ---- the same with a heap, in which a grain touches four others and the block, and interactions in the order of their ids --------
ids, balls, grid = scene([((.18 + .1598*i, .18 + .1598*j, .5798 + .1598*k), (.01*j, .01*i, -.02*k), .08) for k in range(2) for j in range(5) for i in range(5)], ordered=True)
O.dt = .2*mpm.criticalTimeStep()
O.run(3, True)
live = touching()
most = max(sum(b in c for c in live) for b in balls)
check('grains of the heap have more than two contacts', most > 3, most)
O.saveTmp('heap')
O.run(150, True)
whole = everything()
O.loadTmp('heap')
O.run(150, True)
here = everything()
for name in whole: same('loopOnSortedInteractions, a heap: %s' % name, here[name], whole[name])

# ---- the time step: GlobalStiffnessTimeStepper knows contacts, MpmEngine the grid -----------------------------------
stepper = lambda: GlobalStiffnessTimeStepper(timestepSafetyCoefficient=.5)
ids, (ball, ), grid = scene([((.5625, .5625, .598), (0, 0, -.1), .1)], stepper=stepper(), safety=.3)
limit = mpm.criticalTimeStep()
used = []
each_step(lambda: used.append(O.dt))
O.run(40, True)
check('both: the step is never above either', max(used) <= .3*limit*1.001 and min(used) > 0, (used[:3], .3*limit))
O.materials[0].young = 1e5 # the grid gets soft, the contact that exists stays stiff
O.run(2, True)
check('a stiff contact on a soft block: the stepper rules', O.dt < .2*.3*mpm.criticalTimeStep(), (O.dt, mpm.criticalTimeStep()))

ids, balls, grid = scene([((.5625, .5625, .598), (0, 0, -.1), .1)], stepper=GlobalStiffnessTimeStepper(timestepSafetyCoefficient=50))
raises('a stepper beyond the limit of the grid', RuntimeError, 'set MpmEngine.timeStepSafety', lambda: O.run(40, True))
for what, order, part in (('Newton before an MpmEngine that sets O.dt', lambda e, s, m, n: e + [s, n, m], 'put MpmEngine before NewtonIntegrator'),
		('a stepper between the two', lambda e, s, m, n: e + [m, s, n], 'between MpmEngine'),
		('a stepper after both', lambda e, s, m, n: e + [m, n, s], 'in the order InteractionLoop')):
	ids, balls, grid = scene(safety=.3)
	e, m, n = O.engines[:3], O.engines[3], O.engines[4]
	O.engines = order(e, stepper(), m, n)
	raises(what, RuntimeError, part, lambda: O.run(1, True))
ids, balls, grid = scene(safety=.3)
e, m, n = O.engines[:3], O.engines[3], O.engines[4]
idle = stepper()
idle.active = False
O.engines = e + [m, idle, n]
O.run(2, True)
idle.active = True
raises('a stepper between the two that is switched on later', RuntimeError, 'between MpmEngine', lambda: O.run(1, True))

# ---- O.trackEnergy with contacts: mpmExternal holds the contacts' work too -------------------------------------------
ids, (ball, ), grid = scene([((.5, .5, .701), (0, 0, -1), .2)], gravity=(0, 0, 0), walls=False)
O.trackEnergy = True
O.dt = .1*mpm.criticalTimeStep()
start = .5*O.bodies[ball].state.mass
O.run(int(.1/O.dt), True)
e = dict(O.energy.items())
points = e['mpmKinetic'] + e['mpmElastic']
near('mpmExternal is minus the work of the contacts on the points', (points + e['mpmExternal'])/start, 0, 2e-3)
near('YADE and MPM report the same step: the kinetic energy of the sphere', e['kinetic']/(.5*O.bodies[ball].state.mass*O.bodies[ball].state.vel.squaredNorm()), 1, .05)
check('it has lost energy to the points', e['kinetic'] < .7*start and points > .3*start, e)

finish()
