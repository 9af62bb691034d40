# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact where bodies are: walls of kind 'friction', grips, groups of points.

The face of a lattice is half a spacing from its outer points, the surface of a disk where the disk ends. A body that falls is
touched there, rests there with its weight, in any direction of wall and gravity. A bar that is pulled to a stretch lambda bears
E ln(lambda) at its grip and at its wall. Two equal bars exchange their velocities. Saved, loaded and with other threads: the same bits.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *
from yade import pack

directory = tempfile.mkdtemp()


# ---- walls -----------------------------------------------------------------------------------------------------------

# a disk rolls down an oblique wall from where it touches it: its lowest place, not that of its lowest point
for angle in 0, 2.5:
	O.reset()
	n = Vector3(-math.sin(angle), math.cos(angle), 0)
	material = elastic(1e6, .3)
	ids = mpm.fill(pack.inCylinder(.62*n + Vector3(0, 0, -1), .62*n + Vector3(0, 0, 1), .6), spacing=.06, thickness=1, material=material, velocity=-n)
	wall = MpmWall(normal=n, kind='friction', friction=.3)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.12, analysis='planeStrain', walls=[wall])]
	O.dt = .1*mpm.criticalTimeStep()
	while wall.force.norm() == 0 and O.time < .1: O.step()
	near('a disk is touched where it ends, angle %g' % angle, .02 - O.time, 0, .05*.12)
	check('and pushed back, angle %g' % angle, wall.force.dot(n) < 0, wall.force)

# at rest on an oblique wall, between half sizes of it: weight and torque about its origin
g, slope = 9.81, .3
n, t = Vector3(-math.sin(slope), math.cos(slope), 0), Vector3(math.cos(slope), math.sin(slope), 0)
ids, grid = block(region=((0, 0), (.5, .25)), spacing=.0625, material=FrictMat(young=1e7, poisson=.3, density=1000), gravity=(0, -g, 0), damping=.5,
	walls=[MpmWall(normal=(0, 1, 0), origin=(.3, 0, 0), extent=[.35], kind='friction', friction=.5)])
O.run(1500, True)
weight, forces, torques = mpm.array('mass').sum()*g, [], []
for _ in range(100):
	O.run(2, True)
	forces.append(list(grid.walls[0].force))
	torques.append(grid.walls[0].torque[2])
near('weight on a wall with an end', numpy.mean(forces, axis=0), [0, -weight, 0], 1e-3*weight)
near('its torque about the origin', numpy.mean(torques), .05*weight, 2e-3*weight)
near('smooth', numpy.array(forces)[:, 1], numpy.full(100, -weight), .05*weight)
grid.walls[0].origin = (2, 0, 0)
grid.damping = 0
before, start = O.time, momentum()[1]
O.run(20, True)
near('and free beside it', momentum()[1] - start, -weight*(O.time - before), 1e-9*weight)

# corners: walls at rest take energy and give none, in any order
results = []
for order in (0, 1), (1, 0):
	walls = [MpmWall(normal=(1, 0, 0), kind='friction', friction=10), MpmWall(normal=(0, 1, 0), kind='friction', friction=10)]
	ids, grid = block(spacing=.125, material=FrictMat(young=1e6, poisson=.3, density=1000), analysis='planeStrain', gravity=(-10, -10, 0), damping=.3,
		walls=[walls[k] for k in order])
	O.trackEnergy = True
	least = []
	each_step(lambda: least.append(O.energy['mpmWalls']))
	O.run(600, True)
	check('walls of a corner give no energy', min(least) >= 0, min(least))
	near('energies add up, but for a term of first order in O.dt', O.energy.total(), 0, 4e-3*O.energy['mpmElastic'])
	weight = 10*mpm.array('mass').sum()
	near('the corner bears the weight', walls[0].force + walls[1].force, [-weight, -weight, 0], .02*weight)
	results.append(mpm.array('position'))
O.trackEnergy = False
near('the order of walls does not matter', results[0], results[1], 1e-13)

# ---- grips -----------------------------------------------------------------------------------------------------------

for axis, length in (0, 1.), (1, .8):
	swap = lambda v: v if axis == 0 else (v[1], v[0], 0)
	young, spacing, pull = 1e5, .05, .02*length
	ids, grid = block(region=((0, 0), swap((length, .2, 0))[:2]), spacing=spacing, thickness=.3, material=FrictMat(young=young, poisson=0, density=1000), analysis='planeStrain',
		damping=.3, walls=[MpmWall(normal=swap((1, 0, 0)), kind='fixed')])
	grip = [i for i in ids if O.bodies[i].state.pos[axis] > length - spacing]
	for i in grip: O.bodies[i].state.blockedDOFs, O.bodies[i].state.vel = 'xy', swap((pull, 0, 0))
	raises('mpm.reaction before a step', RuntimeError, 'blockedDOFs', lambda: mpm.reaction(grip))
	O.trackEnergy = True
	O.dt = 1/math.ceil(1/O.dt)
	O.run(round(1/O.dt), True)
	least = O.energy['mpmDamping']
	for i in grip: O.bodies[i].state.vel = (0, 0, 0)
	O.run(round(1.5/O.dt), True)
	exact = young*.2*.3*math.log(1 + pull/(length - spacing/2))
	near('a grip pulls along %s' % 'xy'[axis], grid.walls[0].force[axis], exact, .02*exact)
	near('its reaction is that of the wall', mpm.reaction(grip) + grid.walls[0].force, (0, 0, 0), 1e-3*exact)
	near('of one id', sum((mpm.reaction(i) for i in grip), Vector3.Zero), mpm.reaction(grip), 1e-12*exact)
	check('damping takes energy', 0 <= least <= O.energy['mpmDamping'], least)
	near('energies add up, but for a term of first order in O.dt', O.energy.total(), 0, 1e-2*O.energy['mpmElastic'])
	raises('mpm.reaction of a free point', RuntimeError, 'blockedDOFs', lambda: mpm.reaction(ids[0]))
	for i in ids: O.bodies[i].state.blockedDOFs = 'xy'
	raises('a grip on all points', RuntimeError, 'blockedDOFs', O.step)
	O.trackEnergy = False

# kinematic engines of YADE: with blockedDOFs they work, without they are refused
ids, grid = block(region=((0, 0), (1, .2)), spacing=.05, material=FrictMat(young=1e5, poisson=0, density=1000), analysis='planeStrain', walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])
grip = [i for i in ids if O.bodies[i].state.pos[0] > .95]
O.engines = [ForceResetter(), TranslationEngine(ids=grip, translationAxis=(1, 0, 0), velocity=.01), grid]
raises('a moved point without blockedDOFs', RuntimeError, 'O.bodies[%d].state.blockedDOFs: TranslationEngine' % grip[0], O.step)
for i in grip: O.bodies[i].state.blockedDOFs = 'xy'
O.run(20, True)
near('TranslationEngine moves the grip', [O.bodies[i].state.vel[0] for i in grip], [.01]*len(grip), 0)
near('and the material with it', mpm.array('velocity')[-8, 0], .01, .01)
check('a reaction', mpm.reaction(grip)[0] < 0, mpm.reaction(grip))

# ---- groups ----------------------------------------------------------------------------------------------------------


def collide(second, steps=None, gap=.01, **how):
	"""Two bars in line, the first at 1 m/s; returns mean velocities when they have parted."""
	O.reset()
	O.materials.append(FrictMat(label='e', young=1e6, poisson=0, density=1000, frictionAngle=.3))
	O.materials.append(FrictMat(label='f', young=1e6, poisson=0, density=1000*second, frictionAngle=.3))
	first = mpm.fill(((0, 0), (1, .1)), spacing=.025, thickness=1, material='e', velocity=(1, 0, 0), group='one', **how)
	other = mpm.fill(((1 + gap, 0), (2 + gap, .1)), spacing=.025, thickness=1, material='f', group='two', **how)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.05, analysis='planeStrain')]
	O.dt = .3*mpm.criticalTimeStep()
	before = momentum()
	if steps: O.run(steps, True)
	else: O.run(int((gap + 2.6/math.sqrt(1e6/1000/second))/O.dt), True)
	near('momentum', momentum() - before, (0, 0, 0), 1e-11*before[0])
	v, group = mpm.array('velocity')[:, 0], mpm.array('group')
	return [v[group == k].mean() for k in (1, 2)]


near('equal bars exchange their velocities', collide(1), (0, 1), .06)
collide(1, 100)
O.save(directory + '/bars.yade')
O.run(100, True)
going_on = state()
for threads in 1, 2:
	O.load(directory + '/bars.yade')
	O.engines[-1].ompThreads = threads
	O.run(100, True)
	for name, value in state().items(): same('%s with %d threads, saved and loaded in contact' % (name, threads), value, going_on[name])
O.reset()
elastic()
for x, group in (0, 1), (.94, 2): mpm.fill(((x, 0), (x + 1, .2)), spacing=.1, thickness=1, material='elastic', group=group)
O.engines = [ForceResetter(), MpmEngine(cellSize=.2, analysis='planeStrain')]
O.dt = 1e-5
raises('groups that overlap', RuntimeError, 'overlap by 0.06', O.step)

# one wall for grains and points: neither falls through, and points make no contact with its body
O.reset()
elastic(1e6, .3)
mpm.fill(((0, 0), (1, .25)), spacing=.125, thickness=1, material='elastic')
grain = O.bodies.append(sphere((2, .2, 0), .2, material='elastic'))
grid = MpmEngine(cellSize=.25, analysis='planeStrain', gravity=(0, -g, 0), damping=.4)
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()]),
	InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	grid, NewtonIntegrator(gravity=(0, -g, 0), damping=.4)]
made = mpm.wall((0, 0, 0), (0, 1, 0), 'elastic')
near('friction of its material', made.friction, math.tan(.5), 1e-12)
O.dt = .2*mpm.criticalTimeStep()
O.run(1500, True)
check('the grain lies on it', .18 < O.bodies[grain].state.pos[1] < .2, O.bodies[grain].state.pos)
near('so do the points, by contact in place alone', made.force[1], -g*mpm.array('mass').sum(), 2e-2*g*mpm.array('mass').sum())
check('one contact of bodies', O.interactions.countReal() == 1, O.interactions.countReal())

# ---- what cannot be --------------------------------------------------------------------------------------------------


def refused(what, words, walls, **how):
	block(region=((0, 0), (.5, .5)), spacing=.125, courant=None, **how)
	O.dt = 1e-6
	O.engines[-1].walls = walls
	raises(what, RuntimeError, words, O.step)


floor = lambda **a: MpmWall(**dict(dict(normal=(0, 1, 0), kind='friction'), **a))
refused('an empty wall', 'MpmWall 0.extent = 0', [floor(extent=[0])])
refused('two half sizes in the plane', 'MpmWall 0.extent', [floor(extent=[1, 1])])
refused('an extent of a bond', 'MpmWall 0.extent', [floor(kind='slip', extent=[1])])
refused('a bond that turns', 'MpmWall 0.angularVelocity', [floor(kind='fixed', angularVelocity=(0, 0, 1))])
refused('a wall that turns out of the plane', 'MpmWall 0.angularVelocity', [floor(angularVelocity=(1, 0, 0))])
refused('a corner of a bond and a contact', 'walls 1 and 0', [floor(), MpmWall(normal=(1, 0, 0), kind='fixed')])
refused('friction below 0', 'MpmWall 0.friction = -0.1', [floor(friction=-.1)])
refused('friction that is none', 'MpmWall 0.friction = nan', [floor(friction=float('nan'))])
O.materials[0].frictionAngle = -1
raises('a negative angle of friction', RuntimeError, 'frictionAngle = -1', O.step)

finish()
