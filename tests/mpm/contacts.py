# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres, facets, boxes and walls of YADE touch material points through YADE's own engines.

Momentum: contact forces are equal and opposite and grid shape functions sum to one, so that sphere and block together keep
theirs to rounding. Energy: what the sphere and the contact lose, the block has, but for the time integration's error: without friction
of second order in O.dt, with friction below 0.3 % at a tenth of the stable step. Restitution: the waves that an impact leaves in the block vanish with the ratio of its stiffness to the contact's. Statics
and Coulomb's law are exact. Points of a scene without MPM are compared bit for bit.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

g = 9.81
FUNCTORS = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()]
LAWS = {
	'Cundall': lambda: ([Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	'Hertz-Mindlin': lambda: ([Ip2_FrictMat_FrictMat_MindlinPhys()], [Law2_ScGeom_MindlinPhys_Mindlin()]),
	'viscous Hertz-Mindlin': lambda: ([Ip2_FrictMat_FrictMat_MindlinPhys(en=.3, es=.3)], [Law2_ScGeom_MindlinPhys_Mindlin()]),
	'viscoelastic': lambda: ([Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
}


def scene(courant=.2, law='Cundall', region=((0, 0, 0), (1, 1, .5)), spacing=.125, velocity=(0, 0, 0), friction=.5, soft=1e7, hard=1e7, first='Newton',
		damping=0, gravity=(0, 0, 0), verletDist=.02, kind=FrictMat, **grid):
	"""A block of points and the engines of a scene with grains. Materials 'block' and 'grain'."""
	O.reset()
	extra = dict(en=.3, et=.3, tc=.02) if kind is ViscElMat else {}
	O.materials.append(kind(young=soft, poisson=.3, density=1000, frictionAngle=friction, label='block', **extra))
	O.materials.append(kind(young=hard, poisson=.3, density=1000, frictionAngle=friction, label='grain', **extra))
	ids = mpm.fill(region, spacing=spacing, material='block', velocity=velocity)
	engine = MpmEngine(cellSize=2*spacing, analysis='3d', gravity=gravity, **grid)
	newton = NewtonIntegrator(damping=damping, gravity=gravity)
	O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Box_Aabb(), Bo1_Wall_Aabb()], verletDist=verletDist),
		InteractionLoop(FUNCTORS, *LAWS[law]())] + ([newton, engine] if first == 'Newton' else [engine, newton])
	O.dt = courant*mpm.criticalTimeStep()
	return ids, engine


def grain(position, velocity=(0, 0, 0), radius=.2):
	ball = O.bodies.append(sphere(position, radius, material='grain'))
	O.bodies[ball].state.vel = velocity
	return O.bodies[ball]


def contacts(ids=None): return [i for i in O.interactions if i.isReal and (ids is None or i.id1 in ids or i.id2 in ids)]


def all_momentum(*balls): return momentum() + sum(b.state.mass*numpy.array(list(b.state.vel)) for b in balls)


# ---- momentum, with every law and either order of the two integrators ------------------------------------------------
for law in LAWS:
	kind = ViscElMat if law == 'viscoelastic' else FrictMat
	runs = []
	for first in 'Newton', 'grid':
		ids, engine = scene(law=law, first=first, kind=kind)
		ball = grain((.45, .55, .701), (.3, -.2, -1))
		start, worst, touched = all_momentum(ball), [], []
		each_step(lambda: (worst.append(abs(all_momentum(ball) - start).max()), touched.append(len(contacts()))))
		O.run(150, True)
		near('%s, %s first: momentum of sphere and block' % (law, first), max(worst)/numpy.linalg.norm(start), 0, 1e-12)
		check('%s, %s first: they have met and parted' % (law, first), max(touched) > 0 and touched[-1] == 0 and ball.state.vel[2] > 0, (max(touched), ball.state.vel))
		runs.append((list(ball.state.vel) + list(ball.state.angVel), ball.state.vel[2]))
	equal('%s: the order of NewtonIntegrator and MpmEngine does not matter' % law, runs[0][0], runs[1][0])
	LAWS[law].rebound = runs[0][1]
check('viscosity takes speed from the rebound', LAWS['viscous Hertz-Mindlin'].rebound < .8*LAWS['Hertz-Mindlin'].rebound, [f.rebound for f in LAWS.values()])

# ---- energy: what sphere and contact lose, the block has; with friction too, sticking and slipping ----------------------
def impact(courant, friction, velocity):
	"""Whole energy after an impact over that before, less 1; heat of the contacts, and energy of the block."""
	ids, engine = scene(courant=courant, friction=friction)
	ball = grain((.5, .5, .701), velocity)
	O.trackEnergy = True
	start = .5*ball.state.mass*ball.state.vel.squaredNorm()
	O.run(int(.1/O.dt), True)
	check('energy: they have parted', ball.state.vel[2] > 0 and not contacts())
	e = dict(O.energy.items())
	block, heat = (e['mpmKinetic'] + e['mpmElastic'])/start, e.get('plastDissip', 0)/start
	after = .5*ball.state.mass*ball.state.vel.squaredNorm() + .5*ball.state.inertia[0]*ball.state.angVel.squaredNorm()
	return after/start + block + heat - 1, heat, block


straight = [impact(courant, 0, (0, 0, -1)) for courant in (.2, .1)]
error = [e[0] for e in straight]
near('energy balance of an impact', error, [0, 0], .01)
check('its error is of second order', abs(error[1]) < abs(error[0])/3.5, error)
check('the block has taken a good part', straight[0][2] > .2, straight)
for friction, velocity, least, most in (.5, (0, 0, -1), -1e-9, 1e-3), (.5, (1, 0, -1), -1e-9, 1e-3), (.2, (1, 0, -1), .04, .05):
	error, heat, block = impact(.1, friction, velocity)
	near('energy balance with friction %g, velocity %s' % (friction, velocity), error, 0, .003)
	check('friction %g, velocity %s: heat as expected of a contact that %s' % (friction, velocity, 'sticks' if most < .01 else 'slips'), least <= heat < most, heat)

# ---- restitution: 1 in the limit of a stiff block -----------------------------------------------------------------------
loss = []
for young in 1e6, 1e7, 1e8:
	ids, engine = scene(soft=young, hard=1e5, friction=0, walls=[MpmWall(normal=(0, 0, 1))])
	ball = grain((.5, .5, .701), (0, 0, -1))
	O.run(int(.25/O.dt), True)
	check('restitution: they have parted, E = %g' % young, not contacts())
	loss.append(1 - ball.state.vel[2])
check('restitution tends to 1 with the stiffness of the block', loss[0] > 5*loss[1] > 25*loss[2] > 0 and loss[2] < 1e-3, loss)

# ---- a sphere at rest -------------------------------------------------------------------------------------------------
ids, engine = scene(gravity=(0, 0, -g), damping=.3, walls=[MpmWall(normal=(0, 0, 1))])
engine.damping = .3
ball = grain((.5, .5, .7))
O.run(3000, True)
forces = []
each_step(lambda: forces.append((O.forces.f(ball.id)[2], engine.walls[0].force[2])))
O.run(100, True)
on_ball, on_wall = numpy.mean(forces, axis=0)
weight = ball.state.mass*g
near('the block carries the weight of the sphere', on_ball/weight, 1, 1e-3)
near('and the wall that of both', -on_wall/(weight + mpm.array('mass').sum()*g), 1, 1e-3)

# ---- sliding starts at the angle of friction ------------------------------------------------------------------------------
# The contact's angle is the lesser of two materials' frictionAngle.
for what, plate in (('wall', lambda: wall(0, axis=2, material='grain')), ('box', lambda: box((.25, .25, -.5), (3, 3, .5), fixed=True, material='grain')),
		('facet', lambda: facet([(-9, -9, 0), (9, -9, 0), (0, 20, 0)], material='grain'))):
	for part in .99, 1.01:
		slope = math.atan(part*math.tan(.5))
		ids, engine = scene(region=((0, 0, 0), (.5, .5, .25)), gravity=(g*math.sin(slope), 0, -g*math.cos(slope)), friction=.5, hard=1e9, damping=.2)
		engine.damping = .3
		O.bodies.append(plate())
		for i in ids: O.bodies[i].state.vel = (0, 0, 0)
		O.run(1500, True)
		engine.damping = 0
		O.run(500, True) # what damping held back slides
		v = momentum()[0]/mpm.array('mass').sum()
		t, before = O.time, v
		O.run(500, True)
		v = momentum()[0]/mpm.array('mass').sum()
		acceleration = (v - before)/(O.time - t)
		free = g*math.cos(slope)*(math.tan(slope) - math.tan(.5))
		if part < 1: check('%s: a block at %g of the friction angle stays' % (what, part), abs(v) < 1e-4*g*O.time, v)
		else: near('%s: a block beyond it slides as Coulomb says' % what, acceleration/free, 1, .05)

# ---- a sphere on points must climb out of the dimple between four of them ----------------------------------------------
climb = math.asin(.0625/.2625) # half the spacing over the distance of centres: slope towards the saddle between two points
moved = []
for slope in .5 + climb - .05, .5 + climb + .05:
	pull = (g*math.sin(slope), 0, -g*math.cos(slope))
	ids, engine = scene(walls=[MpmWall(normal=(0, 0, 1))])
	engine.damping, O.engines[3].damping, O.engines[3].gravity = .3, .3, pull
	ball = grain((.5, .5, .4375 + math.sqrt(.2625**2 - 2*.0625**2)))
	ball.state.blockedDOFs = 'XYZ'
	O.run(700, True)
	moved.append(ball.state.displ()[0])
check('a sphere that cannot turn leaves a dimple where friction angle and slope say', moved[0] < 3e-3 and moved[1] > .05, moved)

finish()
