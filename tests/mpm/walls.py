# SPDX-License-Identifier: GPL-2.0-or-later
"""What material and walls do to each other.

Momentum: over a step, the change of sum m v is dt times (weight + applied forces - sum of MpmWall.force), whatever the
material does; so at rest MpmWall.force is the weight, or minus the applied load. The balance holds to round-off of forces
that cancel in the sum (1e-9 of the greatest reaction, a difference of momenta over a short step); rest is reached by damping, to 1e-3 of the load, about which the forces of a coarse cubic grid go on swinging for long.
Friction: a block on a plane slides with mu g less, and stays while gravity is inclined by less than arctan(mu).
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

g = 9.81


def mean_force(walls, steps):
	"""Mean of MpmWall.force over some steps: what is left of the motion swings about it."""
	forces = []
	each_step(lambda: forces.append([list(w.force) for w in walls]))
	O.run(steps, True)
	return numpy.array(forces).mean(axis=0)


# ---- the balance of momentum, step by step, in motion ---------------------------------------------------------------


def balance(what, walls, gravity=(1, -g, 0), steps=60, force=(30, -20, 0), tolerance=1e-9, region=((0, 0), (1, 1)), **arguments):
	ids, grid = block(region=region, spacing=.125, gravity=gravity, walls=walls, **arguments)
	O.forces.setPermF(ids[-1], Vector3(*force))
	mass = mpm.array('mass').sum()
	history = [(momentum(), numpy.zeros(3))]
	note = lambda: history.append((momentum(), sum(numpy.array(list(w.force)) for w in grid.walls)))
	each_step(note)
	O.run(steps, True)
	equal('%s: every step is looked at' % what, len(history), steps + 1)
	p, reaction = (numpy.array(h) for h in zip(*history))
	worst = abs(numpy.diff(p, axis=0)/O.dt - mass*numpy.array(gravity) - numpy.array(force) + reaction[1:]).max()
	greatest = abs(reaction).max()
	check('%s: the walls are pressed' % what, greatest > 10, greatest)
	near('%s: change of momentum = (weight + load - wall forces) dt' % what, worst, 0, tolerance*greatest)


bottom = lambda **a: MpmWall(**dict(dict(normal=(0, 1, 0)), **a))
left = lambda **a: MpmWall(**dict(dict(normal=(1, 0, 0)), **a))
right = lambda **a: MpmWall(**dict(dict(normal=(-1, 0, 0), origin=(1, 0, 0)), **a))
for shape in 'linear', 'gimp', 'quadratic', 'cubic':
	balance('fixed, %s' % shape, [left(kind='fixed')], shape=shape, velocity=(.1, .2, 0))
	balance('slip corner, %s' % shape, [left(kind='slip'), bottom(kind='slip')], shape=shape)
balance('two sides and a bottom', [left(kind='fixed'), right(kind='slip'), bottom(kind='fixed')], velocity=(.5, -.5, 0))
balance('linear, USL', [bottom(kind='fixed')], scheme='USL', shape='linear')
balance('a moving wall', [left(kind='fixed', velocity=(.3, .2, 0))])
balance('friction', [bottom(kind='friction', friction=.4), left(kind='slip')])
balance('3D', [MpmWall(normal=(0, 0, 1), kind='fixed'), MpmWall(normal=(1, 0, 0), kind='slip')], region=((0, 0, 0), (.5, .5, .5)), thickness=None, analysis='3d', gravity=(1, 2, -g), force=(-3, 0, 2))

# ---- statics ----------------------------------------------------------------------------------------------------------

for kind in 'fixed', 'slip':
	ids, grid = block(gravity=(0, -g, 0), spacing=.125, damping=.3, walls=[bottom(kind=kind), left(kind='slip'), right(kind='slip')])
	O.run(1500, True)
	weight = mpm.array('mass').sum()*g
	force = mean_force(grid.walls, 200)
	near('at rest a %s bottom carries the weight' % kind, force[0], [0, -weight, 0], 1e-3*weight)
	near('and the sides the same thrust, opposite (%s)' % kind, force[1, 0] + force[2, 0], 0, 1e-3*weight)
	# virtual work of v = (0, y), which the grid holds exactly: sum V sigma_yy = - sum m g y; likewise v = (x, 0) for the thrust
	x, V, sigma = mpm.array('position'), mpm.array('volume'), mpm.array('stress')
	held = -g*(mpm.array('mass')*x[:, 1]).sum()
	near('stress bears the weight above (%s)' % kind, (V*sigma[:, 1, 1]).sum(), held, 2e-3*abs(held))
	near('stress bears the thrust (%s)' % kind, (V*sigma[:, 0, 0]).sum(), force[1, 0], 2e-3*abs(held))
	# eps_xx = 0 in plane stress; the fixed bottom adds nothing to that
	near('the thrust is nu times it (%s)' % kind, force[1, 0], .3*held, .01*abs(held))

ids, grid = block(region=((0, 0), (1, .25)), spacing=1/16., damping=.4, courant=.8, walls=[left(kind='fixed')])
tip = [i for i in ids if O.bodies[i].state.pos[0] > 15/16.]
for i in tip: O.forces.setPermF(i, Vector3(2, -5, 0)/len(tip))
O.run(8000, True)
near('MpmWall.force under a tip load is the load', mean_force(grid.walls, 500)[0], [2, -5, 0], 2e-3*5)
check('the beam hangs', mpm.array('position')[:, 1].min() < 1/32. - .005, mpm.array('position')[:, 1].min())
# two columns of points, because the grid smooths what they carry
pair = [k for k, i in enumerate(ids) if abs(O.bodies[i].state.refPos[0] - .5) < 1/16.]
equal('two columns in the middle', len(pair), 8)
near('the shear force inside is the load', (mpm.array('stress')[pair, 0, 1]*mpm.array('volume')[pair]).sum()*8, -5, .03*5)

# ---- moving walls -------------------------------------------------------------------------------------------------------

ids, grid = block(courant=.2, velocity=(.5, 0, 0), walls=[left(velocity=(.5, 0, 0), kind='slip'), right(velocity=(.5, .25, 0), kind='slip')])
x = mpm.array('position')
O.run(200, True)
t = 200*O.dt
near('a wall carries its origin', [list(w.origin) for w in grid.walls], [(.5*t, 0, 0), (1 + .5*t, .25*t, 0)], 1e-12)
near('what moves along with it is not strained', mpm.array('position') - x, [(.5*t, 0, 0)]*16, 1e-11)
near('and presses on nothing', [list(w.force) for w in grid.walls], numpy.zeros((2, 3)), 1e-8)
ids, grid = block(courant=.2, spacing=.125, damping=.3, analysis='planeStrain', walls=[left(kind='slip'), right(kind='slip', velocity=(-.05, 0, 0)), bottom(kind='slip')])
x = mpm.array('position')
O.run(400, True)
strain = -.05*400*O.dt
grid.walls[1].velocity = Vector3(0, 0, 0)
O.run(2000, True)
near('a wall that stops keeps its place', grid.walls[1].origin[0], 1 + strain, 1e-12)
near('what it has compressed fills the room', mpm.array('F')[:, 0, 0].mean(), 1 + strain, 1e-3*abs(strain))
# uniaxial in plane strain, free to rise: sigma_xx = E/(1 - nu^2) ln(1 + strain); width of the free face in the deformed state
sxx = 1e6/(1 - .3**2)*math.log(1 + strain)
rise = math.exp(-.3/.7*math.log(1 + strain))
force = mean_force(grid.walls, 200)
near('and presses back on it', force[1, 0], -sxx*.1*rise, 2e-3*abs(sxx)*.1)
near('and on the wall behind', force[0, 0], sxx*.1*rise, 2e-3*abs(sxx)*.1)
near('the bottom, beside a free face, carries nothing', force[2], [0, 0, 0], 1e-3*abs(sxx)*.1)

# ---- friction -----------------------------------------------------------------------------------------------------------

mu, young = .3, 1e7


def slider(v, gravity, mu=mu):
	"""A block that rests on a wall, pressed to equilibrium first, then given a velocity."""
	ids, grid = block(region=((0, 0), (2, .5)), spacing=.125, material=FrictMat(young=young, poisson=0, density=1000), gravity=(0, -g, 0), damping=.4, walls=[bottom(kind='friction', friction=mu)])
	O.run(600, True)
	grid.damping = 0
	grid.gravity = Vector3(*gravity)
	for i in ids: O.bodies[i].state.vel = Vector3(v, 0, 0)
	return ids, grid


ids, grid = slider(2, (0, -g, 0))
steps = round(.3/O.dt)
O.run(steps, True)
mean = lambda: momentum()/mpm.array('mass').sum()
near('a sliding block loses mu g t', mean()[0], 2 - mu*g*steps*O.dt, .02*mu*g*steps*O.dt)
near('and stays on the wall', mean()[1], 0, .01)
O.run(int(.7/O.dt), True)
near('until it stops, and does not turn back', mean()[0], 0, .02)
ids, grid = slider(2, (0, -g, 0), mu=0)
O.run(steps, True)
near('without friction it loses nothing', mean()[0], 2, 1e-9)
ids, grid = slider(0, (.8*mu*g, -g, 0))
x = mpm.array('position')[:, 0].mean()
O.run(2*steps, True)
check('it holds on a slope of less than arctan(mu)', abs(mpm.array('position')[:, 0].mean() - x) < .01*.2*mu*g*(2*steps*O.dt)**2/2, mpm.array('position')[:, 0].mean() - x)
ids, grid = slider(0, (1.5*mu*g, -g, 0))
O.run(2*steps, True)
near('and slides on a steeper one', mean()[0], .5*mu*g*2*steps*O.dt, .05*.5*mu*g*2*steps*O.dt)
# in 3D the slip may have any direction in the wall's plane
ids, grid = block(region=((0, 0, 0), (.5, .5, .25)), spacing=.0625, thickness=None, analysis='3d', material=elastic(young, 0), gravity=(0, 0, -g), damping=.4,
	walls=[MpmWall(normal=(0, 0, 1), kind='friction', friction=mu)])
O.run(300, True)
grid.damping = 0
for i in ids: O.bodies[i].state.vel = Vector3(1.2, -1.6, 0)
steps = round(.2/O.dt)
O.run(steps, True)
lost = mu*g*steps*O.dt
near('3D: a block that slides askew loses mu g t along its path', mean(), [1.2 - .6*lost, -1.6 + .8*lost, 0], .02*lost)
near('3D: mean force on the wall: the weight, and mu of it along the slip', mean_force(grid.walls, 100)[0]/(mpm.array('mass').sum()*g), [mu*.6, -mu*.8, -1], .02)
ids, grid = block(velocity=(0, 1, 0), walls=[bottom(kind='friction', friction=.5)])
O.run(50, True)
near('a contact lets go', mpm.array('velocity'), [(0, 1, 0)]*16, 1e-9)
near('without a force', list(grid.walls[0].force), [0, 0, 0], 1e-12)

finish()
