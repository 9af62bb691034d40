# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points are bodies of the scene: what YADE and a script do to a body, they do to a point.

Free fall from rest under g: after n steps of a symplectic Euler integrator v = g n dt and the displacement is
g dt^2 n(n+1)/2, exactly. Impulse: a force F on any point changes the momentum sum m v by F dt a step, because shape functions
sum to one; without walls nothing else does, stress included. So the tolerances on these are round-off: 1e-12 of the value
(some hundred steps of relative error 1e-16, on sums over some ten points). Where two runs differ only in something that must
not matter, they are compared bit for bit. Times of forces: an engine that applies forces before MpmEngine in step k does so
at O.time = k dt. Sums over the engines' histories are computed here from their definitions in YADE's manual.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

# ---- what mpm.fill makes --------------------------------------------------------------------------------------------

rho, spacing, thickness = 1234., .25, .1
O.reset()
ball = O.bodies.append(sphere((9, 9, 9), .1, material=elastic(label='other')))
clay = elastic(density=rho, label='clay')
ids = mpm.fill(((0, 0), (1, .5)), spacing=spacing, thickness=thickness, material='clay', velocity=(3, -2, 0))
equal('ids are those of new bodies', ids, list(range(1, 9)))
equal('a body a point', len(O.bodies), 9)
bodies = [O.bodies[i] for i in ids]
equal('points stand at min + (i + 1/2) spacing, last axis fastest', [tuple(b.state.pos) for b in bodies],
	[(x, y, 0.) for x in (.125, .375, .625, .875) for y in (.125, .375)])
check('a Sphere of half the spacing', all(isinstance(b.shape, Sphere) and b.shape.radius == spacing/2 for b in bodies))
check('an MpmState', all(type(b.state) is MpmState for b in bodies))
near('mass = density volume', [b.state.mass for b in bodies], [rho*spacing**2*thickness]*8, 1e-12)
check('the material', all(b.mat is clay or b.mat.label == 'clay' for b in bodies))
equal('the velocity', [tuple(b.state.vel) for b in bodies], [(3., -2., 0.)]*8)
check('a group of its own kind', all(b.groupMask == 1 and b.dynamic for b in bodies))
check('stress before the first step', all(b.state.stress == Matrix3.Zero and b.state.F == Matrix3.Identity for b in bodies))
equal('by index, too', len(mpm.fill(((2, 0), (3, .5)), spacing=spacing, thickness=thickness, material=1)), 8)
equal('by the material itself, too', len(mpm.fill(((4, 0), (5, .5)), spacing=spacing, thickness=thickness, material=clay)), 8)

O.reset()
elastic()
ids = mpm.fill(((0, 0, 0), (1, 1, .5)), spacing=spacing, material='elastic')
equal('a 3D box', len(ids), 32)
near('a 3D volume is spacing^3', mpm.array('volume'), [spacing**3]*32, 1e-15)
near('a 3D lattice', mpm.array('position').min(axis=0).tolist() + mpm.array('position').max(axis=0).tolist(), [.125]*3 + [.875, .875, .375], 1e-15)
O.reset()
elastic()
n = len(mpm.fill(pack.inSphere((0, 0, 0), 1), spacing=.1, material='elastic'))
near('a predicate: volume of a sphere, within the volume of half a point a surface cell', mpm.array('volume').sum(), 4/3*math.pi, .02*4/3*math.pi)
check('every point is in it', (numpy.linalg.norm(mpm.array('position'), axis=1) <= 1).all() and n == len(O.bodies))
O.reset()
elastic()
n = len(mpm.fill(pack.inSphere((0, 0, 0), 1) - pack.inSphere((0, 0, 0), .5), spacing=.05, material='elastic', thickness=.2))
near('a plane predicate: area of an annulus', n*.05**2, math.pi*.75, .02*math.pi)
check('it is plane', (mpm.array('position')[:, 2] == 0).all())
O.reset()
elastic()
equal('rounding costs no layer', len(mpm.fill(((0, 0), (1, .1)), spacing=1/60., thickness=1., material='elastic')), 360)

# ---- mpm.array and MpmState -----------------------------------------------------------------------------------------

ids, grid = block(region=((0, 0), (1, 1)), spacing=.125, material=BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=2e3, tangentRatio=.1, n=4, label='m'),
	velocity=(1., 0, 0), gravity=(0, -9.81, 0), walls=[MpmWall(normal=(0, 1, 0)), MpmWall(normal=(1, 0, 0), origin=(0, 0, 0), kind='slip')])
order = mpm.array('id')
for i in ids[::3]: O.bodies[i].state.vel = (2, -1, 0)
O.run(200, True)
found = state()
same('ids keep their order while points are sorted anew', found['id'], order)
same('and are the bodies', found['id'], ids)
check('the scene is one that yields', found['plasticStrain'].max() > 1e-4, found['plasticStrain'].max())
shapes = {'id': (), 'position': (3, ), 'velocity': (3, ), 'mass': (), 'volume': (), 'stress': (3, 3), 'strain': (3, 3), 'backStress': (3, 3), 'F': (3, 3), 'plasticStrain': (), 'vonMises': (), 'angularVelocity': (3, )}
equal('shapes', {k: v.shape for k, v in found.items()}, {k: (64, ) + v for k, v in shapes.items()})
check('types', all(v.dtype == ('int64' if k == 'id' else 'float64') for k, v in found.items()))
states = [O.bodies[i].state for i in ids]
tensor = lambda T: [[T[r, c] for c in range(3)] for r in range(3)]
for name in 'stress', 'strain', 'backStress', 'F':
	same('MpmState.%s' % name, [tensor(getattr(s, name)) for s in states], found[name])
same('MpmState.pos, written back each step', [list(s.pos) for s in states], found['position'])
same('MpmState.vel, written back each step', [list(s.vel) for s in states], found['velocity'])
same('MpmState.mass', [s.mass for s in states], found['mass'])
same('MpmState.volume', [s.volume for s in states], found['volume'])
same('MpmState.plasticStrain', [s.plasticStrain for s in states], found['plasticStrain'])
s = found['stress']
near('vonMises of plane stress', found['vonMises'], numpy.sqrt(s[:, 0, 0]**2 - s[:, 0, 0]*s[:, 1, 1] + s[:, 1, 1]**2 + 3*s[:, 0, 1]**2), 1e-12*abs(s).max())
near('volume is det F times the initial one', found['volume'], numpy.linalg.det(found['F'])*.125**2*.1, 1e-15)
same('tensors are symmetric', s, s.transpose(0, 2, 1))
b = numpy.einsum('nij,nkj->nik', found['F'], found['F'])
w, v = numpy.linalg.eigh(b[:, :2, :2])
near('strain is ln(F F^T)/2', found['strain'][:, :2, :2], numpy.einsum('nij,nj,nkj->nik', v, .5*numpy.log(w), v), 1e-13)
near('strain zz of plane stress: tr(strain) = (1-2 nu)/E tr(stress)', numpy.trace(found['strain'], axis1=1, axis2=2), .4/1e6*numpy.trace(s, axis1=1, axis2=2), 1e-15)
a = mpm.array('stress')
a[:] = 0
check('an array is a copy', abs(mpm.array('stress')).max() > 0)

# ---- free fall, forces, impulses ------------------------------------------------------------------------------------

g, n = -9.81, 250
for scheme in 'USF', 'USL', 'MUSL':
	ids, grid = block(gravity=(0, g, 0), velocity=(.5, 0, 0), scheme=scheme)
	x = mpm.array('position')
	O.run(n, True)
	dt = O.dt
	near('free fall: velocity, %s' % scheme, mpm.array('velocity'), [(.5, g*n*dt, 0)]*16, 1e-12*abs(g*n*dt))
	near('free fall: displacement, %s' % scheme, mpm.array('position') - x, [(.5*n*dt, g*dt**2*n*(n + 1)/2, 0)]*16, 1e-12*abs(g*dt**2*n*n))
	# round-off in the velocities strains the points by 1e-16 of the way fallen over the size of a cell
	near('free fall: no stress, %s' % scheme, mpm.array('stress')/1e6, numpy.zeros((16, 3, 3)), 1e-10)
own = state()
ids, grid = block(velocity=(.5, 0, 0), before=[GravityEngine(gravity=(0, g, 0))])
O.run(n, True)
near("YADE's GravityEngine does the same: velocity", mpm.array('velocity'), own['velocity'], 1e-12*abs(g*n*dt))
near("YADE's GravityEngine does the same: position", mpm.array('position'), own['position'], 1e-12*abs(g*dt**2*n*n))


def impulse(what, wanted, before=(), prepare=lambda ids: None, steps=100):
	"""Momentum after some steps is the impulse of the forces, wanted(dt, times)."""
	ids, grid = block(before=before)
	O.dt *= .5
	prepare(ids)
	O.run(steps, True)
	wanted = numpy.array(wanted(O.dt, O.dt*numpy.arange(steps)))
	near(what, momentum(), wanted, 1e-12*abs(wanted).max())
	check(what + ': the block is deformed, not only moved', abs(mpm.array('stress')).max() > 1e-3)


impulse('ForceEngine', lambda dt, t: numpy.array([3., -5, 0])*2*dt*len(t), [ForceEngine(ids=[0, 7], force=(3, -5, 0))])
impulse('InterpolatingDirectedForceEngine', lambda dt, t: [0, -2*numpy.interp(t, [0, 1], [0, 40.]).sum()*dt, 0],
	[InterpolatingDirectedForceEngine(ids=[3, 15], times=[0, 1], magnitudes=[0, 40], direction=(0, -1, 0))])
impulse('HarmonicForceEngine', lambda dt, t: [3*(7*numpy.sin(2*math.pi*2*t + .3).sum())*dt, 0, 0], [HarmonicForceEngine(ids=[1, 2, 3], A=(7, 0, 0), f=(2, 0, 0), fi=(.3, 0, 0))])
impulse('O.forces.setPermF', lambda dt, t: [0, 11*dt*len(t), 0], prepare=lambda ids: O.forces.setPermF(ids[9], Vector3(0, 11, 0)))


def push():
	O.forces.addF(ids[4], Vector3(2, 1, 0))


impulse('O.forces.addF from a PyRunner', lambda dt, t: numpy.array([2., 1, 0])*dt*len(t), [PyRunner(iterPeriod=1, initRun=True, command='push()')])
ids, grid = block()
O.engines = [grid]
O.forces.setPermF(ids[0], Vector3(1, 0, 0))
O.forces.setPermF(ids[5], Vector3(2, 0, 0))
O.run(20, True)
O.forces.setPermF(ids[5], Vector3(0, 0, 0))
O.run(20, True)
near('permanent forces without a ForceResetter, one taken back', momentum()[0], (3 + 1)*20*O.dt, 1e-13*80*O.dt)
ids, grid = block(region=((0, 0, 0), (1, 1, .5)), thickness=None, analysis='3d', before=[ForceEngine(ids=[2], force=(1, 2, 3))])
O.run(50, True)
near('a force in 3D', momentum(), numpy.array([1., 2, 3])*50*O.dt, 1e-12*150*O.dt)

# ---- writing into bodies between steps ------------------------------------------------------------------------------

ids, grid = block(gravity=(0, g, 0))
O.run(10, True)
v = mpm.array('velocity')
for i in ids: O.bodies[i].state.vel = Vector3(1, 2, 0)
O.run(1, True)
near('a velocity that is written holds from the next step on', mpm.array('velocity'), [(1, 2 + g*O.dt, 0)]*16, 1e-12)
for i in ids: O.bodies[i].state.pos += Vector3(10, -3, 0)
x, moved = mpm.array('position'), numpy.array([list(O.bodies[i].state.pos) for i in ids])
O.run(1, True)
near('a position that is written holds from the next step on', mpm.array('position') - moved, [(O.dt, (2 + 2*g*O.dt)*O.dt, 0)]*16, 1e-12)
near('what is moved keeps its momentum', momentum(), 100*numpy.array([1, 2 + 2*g*O.dt, 0]), 1e-9)
O.bodies[ids[0]].state.pos = Vector3(0, 0, 0)
O.run(1, True)
near('one point of many, moved on its own, moves alone', mpm.array('position')[0], [O.dt, (2 + 3*g*O.dt)*O.dt, 0], 1e-12)

ids, grid = block(region=((0, 0), (2, 1)), gravity=(0, g, 0), damping=.5)
held = [i for i in ids if O.bodies[i].state.pos[0] < .5]
for i in held: O.bodies[i].state.blockedDOFs = 'xyz'
x = mpm.array('position')
O.run(100, True)
held_rows, free = [i in held for i in ids], [i not in held for i in ids]
same('blockedDOFs: points at rest stay where they are', mpm.array('position')[held_rows], x[held_rows])
check('and hold the others', -1 < mpm.array('velocity')[free][:, 1].min() < 0 and abs(mpm.array('stress')[:, 0, 1]).max() > 1e2)
for i in held: O.bodies[i].state.blockedDOFs, O.bodies[i].state.vel = 'x', Vector3(.25, 0, 0)
x = mpm.array('position')
O.run(8, True)
near('a blocked component keeps its velocity', mpm.array('position')[held_rows][:, 0] - x[held_rows][:, 0], [.25*8*O.dt]*len(held), 1e-14)
check('the other component is free', (abs(mpm.array('velocity')[held_rows][:, 1]) > 1e-3).all(), mpm.array('velocity')[held_rows][:, 1])
for i in held: O.bodies[i].state.blockedDOFs = ''
O.run(1, True)
check('unblocked, it follows', (mpm.array('velocity')[held_rows][:, 0] != .25).all())

# ---- erasing, adding, changing material -----------------------------------------------------------------------------

ids, grid = block(velocity=(1, 0, 0), gravity=(0, g, 0))
O.run(5, True)
ghost = O.bodies[ids[6]].state
whole, before = mpm.array('mass').sum(), momentum()
for k in 6, 0, 15: O.bodies.erase(ids[k])
O.run(1, True)
kept = [i for k, i in enumerate(ids) if k not in (6, 0, 15)]
same('erased bodies are points no more', mpm.array('id'), kept)
near('their mass is gone', mpm.array('mass').sum(), whole*13/16, 1e-12*whole)
near('the others fall on', mpm.array('velocity'), [(1, 6*g*O.dt, 0)]*13, 1e-12)
raises('the state of an erased body has no stress', RuntimeError, 'no material point 6', lambda: ghost.stress)
new = mpm.fill(((3, 0), (4, 1)), spacing=.5, thickness=.1, material='elastic', velocity=(0, 4, 0))
equal('points are added in mid-run', len(mpm.array('id')), 17)
x = mpm.array('position')
O.run(3, True)
ordered = mpm.array('id').tolist()
equal('in the order of ids', ordered, sorted(kept + new))
rows = [ordered.index(i) for i in new]
near('they move', mpm.array('velocity')[rows], [(0, 4 + 3*g*O.dt, 0)]*4, 1e-12)
rows = [ordered.index(i) for i in kept]
near('beside the old ones', mpm.array('velocity')[rows], [(1, 9*g*O.dt, 0)]*13, 1e-12)
for b in [b for b in O.bodies]: O.bodies.erase(b.id)
O.run(1, True)
equal('a scene whose last point is erased runs on, empty', (len(mpm.array('id')), O.iter), (0, 10))
back = mpm.fill(((0, 0), (1, 1)), spacing=.5, thickness=.1, material='elastic')
O.run(1, True)
same('and can be filled again', mpm.array('id'), back)

# A layer between slip walls is strained uniformly, by rate dt over its length at the time: stress rates are the material's.
rate = 1e-3


def oedometer(**arguments):
	ids, grid = block(analysis='planeStrain', largeStrain=False, courant=.05, walls=[MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(normal=(-1, 0, 0), origin=(1, 0, 0), kind='slip', velocity=(rate, 0, 0)),
		MpmWall(normal=(0, 1, 0), kind='slip'), MpmWall(normal=(0, -1, 0), origin=(0, 1, 0), kind='slip')], **arguments)
	for i in ids: O.bodies[i].state.vel = Vector3(rate*O.bodies[i].state.pos[0], 0, 0)
	return ids, grid


def modulus(E, nu): return E*(1 - nu)/((1 + nu)*(1 - 2*nu))


ids, grid = oedometer()
critical = mpm.criticalTimeStep()
O.run(10, True)
strains = numpy.cumsum(rate*O.dt/(1 + rate*O.dt*numpy.arange(20)))
strain, later = strains[9], strains[19] - strains[9]
sxx = mpm.array('stress')[:, 0, 0]
near('a plain FrictMat is linear elastic', sxx, [modulus(1e6, .3)*strain]*16, 1e-9*modulus(1e6, .3)*strain)
near('and its strain is what it was given', mpm.array('strain')[:, 0, 0], [strain]*16, 1e-9*strain)
near('plane strain: zz', mpm.array('stress')[:, 2, 2], [.3/.7*sxx[0]]*16, 1e-9*abs(sxx[0]))
same('an elastic point has no back stress', mpm.array('backStress'), numpy.zeros((16, 3, 3)))
O.materials[0].young *= 3
near('young in mid-run: the critical step', mpm.criticalTimeStep()/critical, 1/math.sqrt(3), 1e-4)
O.run(10, True)
near('young in mid-run: the stress', mpm.array('stress')[:, 0, 0], sxx + 3*modulus(1e6, .3)*later, 1e-9*sxx[0])
O.materials[0].young /= 3
ids, grid = oedometer()
stiff = elastic(young=5e6, label='stiff')
O.run(10, True)
for i in ids: O.bodies[i].mat = stiff
O.run(10, True)
near('b.mat in mid-run: the stress', mpm.array('stress')[:, 0, 0], sxx + 5*modulus(1e6, .3)*later, 1e-9*sxx[0])
O.bodies[ids[3]].mat = O.materials['elastic']
O.run(1, True)
step = mpm.array('stress')[:, 0, 0] - sxx - 5*modulus(1e6, .3)*later
check('b.mat of one body is its own', step[3] < .5*step[0] and (numpy.delete(step, 3) > .9*step[0]).all(), step)
plastic = BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=1., n=10, label='plastic')
O.materials.append(plastic)
for i in ids: O.bodies[i].mat = plastic
O.run(400, True)
check('an elastic point turns into one that yields', mpm.array('plasticStrain').min() > 0, mpm.array('plasticStrain'))

# ---- with other engines ---------------------------------------------------------------------------------------------

ids, grid = block(velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(0, 1, 0), origin=(0, -.01, 0))])
O.run(150, True)
alone = state()
for what, place in ('after', 2), ('before', 1):
	ids, grid = block(velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(0, 1, 0), origin=(0, -.01, 0))])
	ball = O.bodies.append(sphere((9, 9, 0), .1, material='elastic'))
	engines = O.engines
	engines.insert(place, NewtonIntegrator(gravity=(0, g, 0), damping=0))
	O.engines = engines
	O.run(150, True)
	for name in 'position', 'velocity', 'stress':
		same('NewtonIntegrator %s MpmEngine moves no material point: %s' % (what, name), mpm.array(name), alone[name])
	near('NewtonIntegrator %s MpmEngine moves the other bodies' % what, O.bodies[ball].state.vel[1], g*150*O.dt, 1e-12*abs(g*150*O.dt))

ids, grid = block(velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(0, 1, 0), origin=(0, -.01, 0))], bodies=False)
check('points without bodies have negative ids', ids == list(range(-1, -17, -1)) and len(O.bodies) == 0, ids)
O.run(150, True)
same('in the order they were made in', mpm.array('id'), ids)
for name in 'position', 'velocity', 'mass', 'stress', 'strain', 'F', 'volume':
	same('points without bodies do the same: %s' % name, mpm.array(name), alone[name])
mixed = mpm.fill(((3, 0), (4, 1)), spacing=.25, thickness=.1, material='elastic')
equal('with and without bodies in one scene, bodies first', mpm.array('id').tolist(), mixed + ids)
O.run(5, True)
check('and both move', (mpm.array('velocity')[:, 1] != 0).all())

ids, grid = block(region=((0, 0), (2, .5)), velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(1, 0, 0))])
O.run(120, True)
whole = state()
ids, grid = block(region=((0, 0), (2, .5)), velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(1, 0, 0))])
O.run(60, True)
O.engines = [ForceResetter(), MpmEngine(cellSize=.5, gravity=(0, g, 0), walls=[MpmWall(normal=(1, 0, 0))])]
del grid
O.run(60, True)
for name in whole:
	same('a new engine in mid-run takes the points as they are: %s' % name, mpm.array(name), whole[name])
ids, grid = block(region=((0, 0), (2, .5)), velocity=(.5, 0, 0), gravity=(0, g, 0), walls=[MpmWall(normal=(1, 0, 0))])
for k in range(120):
	O.run(1, True)
	if k % 7 == 0: mpm.array('stress')
for name in whole:
	same('looking at the points changes nothing: %s' % name, mpm.array(name), whole[name])

# ---- other scenes ---------------------------------------------------------------------------------------------------

ids, grid = block(gravity=(0, g, 0))
O.run(10, True)
first = mpm.array('velocity')
O.switchScene()
equal('another scene has no points', (len(mpm.array('id')), len(O.bodies)), (0, 0))
elastic()
mpm.fill(((0, 0), (1, 1)), spacing=.5, thickness=1, material='elastic', velocity=(7, 0, 0))
O.engines = [ForceResetter(), MpmEngine(cellSize=1)]
O.dt = 1e-3
O.run(10, True)
near('it has its own', mpm.array('velocity'), [(7, 0, 0)]*4, 1e-12)
O.switchScene()
same('and the first is as it was', mpm.array('velocity'), first)
O.run(10, True)
near('and runs on', mpm.array('velocity'), [(0, 20*g*O.dt, 0)]*16, 1e-12)
orphan = O.bodies[ids[0]].state
O.reset()
O.switchScene()
O.reset()
equal('no points after O.reset', len(mpm.array('id')), 0)
check('a state that outlives its scene can be looked at', orphan.stress[0, 0] == orphan.stress[0, 0])

# ---- changes in mid-run that points could misread ------------------------------------------------------------------

ids, grid = block(velocity=(1, 0, 0))
O.run(3, True)
new = mpm.fill(((3, 0), (4, 1)), spacing=.25, thickness=.1, material='elastic')
k = numpy.isin(mpm.array('id'), new)
same('a fill in mid-run: F of the new points', mpm.array('F')[k], numpy.tile(numpy.eye(3), (len(new), 1, 1)))
same('... their stress', mpm.array('stress')[k], numpy.zeros((len(new), 3, 3)))
near('... their volume', mpm.array('volume')[k], [.25*.25*.1]*len(new), 1e-15)
near('... through the body', O.bodies[new[0]].state.volume, .25*.25*.1, 1e-15)

mass = mpm.array('mass')[:len(ids)].sum()
O.bodies.clear()
again = mpm.fill(((0, 0), (1, 1)), spacing=.25, thickness=.1, material='elastic')
near('bodies cleared and filled again: no point is there twice', mpm.array('mass').sum(), mass, 1e-12*mass)
O.run(1, True)
equal('... nor after a step', (len(mpm.array('id')), len(set(mpm.array('id')))), (len(again), len(again)))

steel = BoucWenMat(label='steel', young=1e6, poisson=.3, density=1000, yieldStress=1e3, n=2)
ids, grid = block(material=steel, velocity=(0, -5, 0), walls=[MpmWall(normal=(0, 1, 0), kind='fixed')])
O.run(100, True)
p = mpm.array('plasticStrain')
check('the block has yielded', p.max() > 1e-3)
steel.reloading = 2
raises('an option that keeps other internal variables', RuntimeError, 'internal variables', lambda: O.run(1, True))
steel.reloading = 0
O.materials.append(DruckerPragerMat(label='soil', young=1e6, poisson=.3, density=1000, cohesion=1e3))
for i in ids: O.bodies[i].mat = O.materials['soil']
raises('a law that keeps other internal variables', RuntimeError, 'O.bodies[', lambda: O.run(1, True))
for i in ids: O.bodies[i].mat = steel
O.run(1, True)
check('and the plastic strain is still there', (mpm.array('plasticStrain') >= p).all())

ids, grid = block(spacing=.25, cellSize=.2)
O.run(1, True)
grid.shape = 'gimp'
raises('a shape that does not fit, in mid-run', RuntimeError, 'MpmEngine.cellSize', lambda: O.run(1, True))
ids, grid = block(spacing=.25, cellSize=.25, shape='gimp', courant=None, walls=[MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(origin=(1.4, 0, 0), normal=(-1, 0, 0), kind='slip')])
raises('GIMP in cells that two walls have shrunk', RuntimeError, 'GIMP needs cells', lambda: mpm.criticalTimeStep())

# ---- contact with a facet through YADE's own engines: the collider hears of the points' motion ----------------------

O.reset()
O.materials.append(FrictMat(young=1e6, poisson=.3, density=1000, frictionAngle=0, label='soft'))
O.bodies.append(facet([(-2, -.5, -2), (4, -.5, -2), (1, -.5, 4)], material='soft'))
ids = mpm.fill(((0, 0), (1, 1)), spacing=.125, thickness=.125, material='soft', velocity=(0, -2, 0))
grid = MpmEngine(cellSize=.25)
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=.02),
	InteractionLoop([Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	NewtonIntegrator(damping=0), grid]
O.dt = .2*mpm.criticalTimeStep()
O.stopAtTime = .6
O.run()
O.wait()
v = momentum()[1]/mpm.array('mass').sum()
check('a block bounces off a facet', 1 < v < 2.001 and mpm.array('position')[:, 1].min() > -.5, (v, mpm.array('position')[:, 1].min()))
equal('points do not touch each other', [i for i in O.interactions if i.isReal and i.id1 in ids and i.id2 in ids], [])

finish()
