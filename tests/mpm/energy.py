# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy balance and the time step that the engine sets.

O.energy's terms add up to what the scene had at the start: their sum may drift by 1e-3 of the work done (doc/method.md; the
error is that of the time integration, 1e-6 to 1e-4 here). Where a term has a closed form it is compared with that: work of
gravity M g h in free fall; of a constant force F on a bar; m v^2/2; damping takes what is missing. Without O.trackEnergy
there are no terms.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

NAMES = ('mpmKinetic', 'mpmElastic', 'mpmHardening', 'mpmDissipation', 'mpmExternal', 'mpmDamping', 'mpmWalls')


def energies(): return {name: O.energy[name] for name in NAMES}


# ---- free fall: kinetic energy is the work of gravity ---------------------------------------------------------------
ids, grid = block(gravity=(0, -10, 0), velocity=(3, 0, 0))
O.trackEnergy = True
O.run(100, True)
e, mass = energies(), mpm.array('mass').sum()
start = .5*mass*9
# energies are those of the start of the last step, between the velocities half a step before and after it; the initial
# velocity is that of half a step before the first
t = 99.5*O.dt
near('free fall: work of gravity', -e['mpmExternal'], .5*mass*100*(t*t + .25*O.dt**2), 1e-9*start)
near('free fall: kinetic energy', e['mpmKinetic'], start + .5*mass*100*(t*t + .25*O.dt**2), 1e-9*start)
near('free fall: the rest is zero', [e[n] for n in NAMES[1:4] + NAMES[5:]], [0]*5, 1e-9*start)
equal('the sum of O.energy', O.energy.total(), sum(e.values()))

# ---- without trackEnergy there is nothing ----------------------------------------------------------------------------
block(gravity=(0, -10, 0))
O.trackEnergy = False
O.run(10, True)
equal('no terms without trackEnergy', [k for k, v in O.energy.items() if k.startswith('mpm')], [])
check('no dissipation without trackEnergy', (mpm.array('dissipation') == 0).all())

# ---- every kind of work at once, elastic and plastic; linear functions jump where points cross cells ------------------
steel = lambda: BoucWenMat(label='steel', young=1e6, poisson=.3, density=1000, yieldStress=5e3, tangentRatio=.1, n=5)
for shape, scheme, damping, tolerance, more in (('cubic', 'MUSL', 0, 1e-3, {}), ('cubic', 'MUSL', .1, 1e-3, {}), ('quadratic', 'MUSL', 0, 1e-3, {}), ('linear', 'MUSL', 0, 1e-2, {}),
		('gimp', 'MUSL', 0, 1e-3, {}), ('cubic', 'USF', .05, 5e-3, {}), ('cubic', 'MUSL', .1, 1e-3, dict(fullMass=True)), ('cubic', 'MUSL', 0, 1e-3, dict(fullMass=True, filterTime=.01))):
	what = '%s %s damping %g %s: ' % (shape, scheme, damping, ' '.join(more))
	lid = MpmWall(origin=(0, 1, 0), normal=(0, -1, 0), kind='slip', velocity=(0, -.5, 0))
	ids, grid = block(region=((0, 0), (1, 1)), spacing=.0625, material=steel(), shape=shape, scheme=scheme, damping=damping, gravity=(0, -10, 0), courant=.2, **more,
		walls=[MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(normal=(0, 1, 0), kind='fixed'), lid])
	O.trackEnergy = True
	O.forces.setPermF(ids[-1], Vector3(5, 3, 0))
	O.run(400, True)
	e = energies()
	work = abs(e['mpmExternal']) + abs(e['mpmWalls'])
	check(what + 'the lid has pressed the block into plastic flow', e['mpmDissipation'] > .05*work and e['mpmWalls'] < 0, e)
	check(what + 'hardening stores, damping takes', e['mpmHardening'] > 0 and (e['mpmDamping'] > 0) == (damping > 0 or 'filterTime' in more), e)
	near(what + 'balance over the work done', O.energy.total()/work, 0, tolerance)
	volume0 = mpm.array('volume')/numpy.linalg.det(mpm.array('F'))
	near(what + 'heat of the points is that of the scene', (mpm.array('dissipation')*volume0).sum()/e['mpmDissipation'], 1, .02)

# ---- a stiffness that changes in mid-run keeps the stress; energies are sums of increments, and stay a balance ------------
for law, factor in (lambda: FrictMat(label='soil', young=1e6, poisson=.3, density=1000), 3), (lambda: steel(), .4):
	ids, grid = block(region=((0, 0), (1, 1)), spacing=.0625, material=law(), gravity=(0, -10, 0), courant=.1, walls=[MpmWall(normal=(0, 1, 0), kind='fixed')])
	O.trackEnergy = True
	O.run(int(.05/O.dt), True)
	elastic, work = O.energy['mpmElastic'], -O.energy['mpmExternal']
	check('young x %g: the block has sunk' % factor, work > 5 and elastic > .1*work, (elastic, work))
	O.materials[0].young *= factor
	O.run(1, True)
	near('young x %g: the step after it stores as much' % factor, (O.energy['mpmElastic'] - elastic)/work, 0, .05)
	O.run(200, True)
	near('young x %g: balance over the work of gravity' % factor, O.energy.total()/work, 0, 1e-3)

# ---- PIC dissipates, and the balance says how much ---------------------------------------------------------------------
ids, grid = block(spacing=.0625, flip=.95, courant=.1, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])
O.trackEnergy = True
for i in ids: O.bodies[i].state.vel = (.5*O.bodies[i].state.pos[0], 0, 0)
mass, v = mpm.array('mass'), .5*mpm.array('position')[:, 0]
start = .5*mass @ v**2
O.run(200, True)
e = energies()
check('PIC takes energy', e['mpmDamping'] > .1*start, e)
near('PIC: balance', O.energy.total()/start, 1, 2e-3)

# ---- the filter takes what fades in the steps that it has been on for, whenever it is switched on ------------------------
ids, grid = block(region=((0, 0), (1, 1)), spacing=.125, courant=.2)
for k, i in enumerate(ids): O.bodies[i].state.vel = (numpy.sin(7*k*k), numpy.sin(3*k*k + 1), 0)
O.trackEnergy = True
O.run(200, True)
for what in 'switched on', 'switched on again':
	grid.filterTime, kinetic, before = 40*O.dt, O.energy['mpmKinetic'], O.energy['mpmDamping']
	O.run(1, True)
	taken = 2*(O.energy['mpmDamping'] - before)  # a balance has half of the work of the step before it, and half of that after it
	check(what + ': the filter takes what fades in a step', 0 < taken < 2/40*kinetic, (taken, kinetic))
	grid.filterTime = 0
	O.run(200, True)

# ---- a body whose motion is prescribed does work -----------------------------------------------------------------------
ids, grid = block(region=((0, 0), (2, .5)), spacing=.0625, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')], courant=.2)
O.trackEnergy = True
for i in ids:
	if O.bodies[i].state.pos[0] > 1.75: O.bodies[i].state.blockedDOFs, O.bodies[i].state.vel = 'xy', (.05, 0, 0)
held = .5*sum(O.bodies[i].state.mass for i in ids if O.bodies[i].state.blockedDOFs)*.05**2
O.run(600, True)
e = energies()
check('pulling a prescribed end does work', e['mpmWalls'] < -5*held and e['mpmElastic'] > 5*held, e)
near('prescribed end: balance over the work', (O.energy.total() - held)/-e['mpmWalls'], 0, 5e-3)

# ---- what comes and goes during a run is booked -----------------------------------------------------------------------
ids, grid = block(region=((0, 0), (1, 1)), spacing=.125, material=steel(), courant=.1, walls=[MpmWall(normal=(0, 1, 0), kind='slip')])
for i in ids: O.bodies[i].state.vel = (0, -.1 - O.bodies[i].state.pos[1], 0)
O.trackEnergy = True
O.run(100, True)


def jumps(what, change, least):
	"""The sum of the energies over a change; and that the change is one of at least so many joules."""
	before, total = energies(), O.energy.total()
	change()
	O.run(2, True)
	after = energies()
	check(what + ': is worth something', abs(after['mpmExternal'] - before['mpmExternal']) > least, (before, after))
	near(what + ': the sum does not jump', (O.energy.total() - total)/abs(after['mpmExternal'] - before['mpmExternal']), 0, .02)


def push():
	for i in ids: O.bodies[i].state.vel += Vector3(2, 0, 0)


def erase():
	for i in ids[:8]: O.bodies.erase(i)


def prescribe():
	for i in ids[-8:]: O.bodies[i].state.blockedDOFs, O.bodies[i].state.vel = 'x', (5, 0, 0)


start = energies()
check('the block is strained, elastically and plastically', min(start[n] for n in ('mpmElastic', 'mpmHardening', 'mpmDissipation')) > .01, start)
jumps('velocities that a script writes', push, 10)
jumps('points erased', erase, 10)
jumps('points added', lambda: mpm.fill(((3, 3), (3.5, 3.5)), spacing=.125, thickness=.1, material='steel', velocity=(3, 0, 0)), 10)
jumps('prescribed velocities', prescribe, 10)

# ---- tracking continues over save and load, bit for bit -------------------------------------------------------------------
ids, grid = block(spacing=.125, material=steel(), gravity=(0, -10, 0), walls=[MpmWall(normal=(0, 1, 0), kind='fixed')], velocity=(0, -2, 0))
O.trackEnergy = True
O.run(50, True)
O.saveTmp('half')
O.run(50, True)
whole = energies()
O.loadTmp('half')
O.run(50, True)
equal('energies over save and load', energies(), whole)

# ---- timeStepSafety: the engine sets O.dt --------------------------------------------------------------------------------
ids, grid = block(spacing=.125, timeStepSafety=.3, velocity=(2, 0, 0), courant=None)
limit = mpm.criticalTimeStep()
O.dt = 1e9 # whatever the script says
O.run(1, True)
near('O.dt is the safety times the stable step', O.dt, .3*limit, 1e-3*limit)
still = O.dt
for i in ids: O.bodies[i].state.vel = (200, 0, 0)
O.run(1, True)
crossing = 200/grid.cellSize
near('O.dt follows the points\' velocity', .3/O.dt, .3/still + crossing - 2/grid.cellSize, 1e-6*crossing)
raises('timeStepSafety out of range', RuntimeError, 'MpmEngine.timeStepSafety = 1.5', lambda: (setattr(grid, 'timeStepSafety', 1.5), O.run(1, True)))
# A confined bar pressed to a fifth of its length and let go: the stress is (lambda + 2 mu) ln(stretch) throughout. Its stable step grows by
# 1.9 on the way (waves of speed (M/rho)^(1/2), rho five times as large; cells shrink from 1/8 to 1/10), and shrinks again. It is found anew
# when the cells have changed by 5 %, and every 500 steps.
M = 1e6/1.3*(.3/.4 + 1)
ids, grid = block(region=((0, 0), (1, .25)), spacing=.0625, timeStepSafety=.5, courant=None, cellSize=.125, analysis='planeStrain', damping=.1,
	walls=[MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(origin=(1, 0, 0), normal=(-1, 0, 0), kind='slip', velocity=(-.2, 0, 0)),
		MpmWall(normal=(0, 1, 0), kind='slip'), MpmWall(origin=(0, .25, 0), normal=(0, -1, 0), kind='slip')])
O.run(1, True)
first = O.dt
for target, velocity in (.2, -.2), (1, .2):
	grid.walls[1].velocity = (velocity, 0, 0)
	while (grid.walls[1].origin[0] - target)*velocity < 0: O.run(1, True)
	length, stress = grid.walls[1].origin[0], mpm.array('stress')[:, 0, 0]
	near('bar of length %g: stress over M' % target, stress/M, numpy.full(len(stress), numpy.log(length)), .01)
	near('bar of length %g: O.dt is the safety times the stable step' % target, O.dt/mpm.criticalTimeStep(), .5, .03)
	near('bar of length %g: O.dt over the first' % target, O.dt/first, {.2: 1.91, 1: 1}[target], .08)

finish()
