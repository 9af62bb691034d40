# SPDX-License-Identifier: GPL-2.0-or-later
"""Where points stand and what they stand for: volumes of any box, Gauss places, points from arrays and meshes, groups, initial stress,
masks and colours, an interrupt in the middle."""
import math
import os
import signal
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *
from yade import pack

folder = tempfile.mkdtemp()


def path(name): return os.path.join(folder, name)


def fresh(**material):
	O.reset()
	return elastic(**material)


def moment(powers):
	"""Sum of V x^a y^b z^c over the points."""
	return (mpm.array('volume')*(mpm.array('position')**numpy.array(powers)).prod(axis=1)).sum()


def says(what, call, kind, *parts):
	try: call()
	except kind as fault: check(what, all(str(part) in str(fault) for part in parts), str(fault))
	else: check(what, False, 'no %s' % kind.__name__)


# ---- volumes of boxes -------------------------------------------------------------------------------------------------

for spacing, number in (1/15., 15*2), (.07, 14), (.04, 25*3), (.1, 10), (1/60., 360):
	fresh()
	ids = mpm.fill(((0, 0), (1, .1)), spacing=spacing, thickness=1, material='elastic')
	near('uniform, spacing %.4f: mass of the box' % spacing, mpm.array('mass').sum(), 100, 1e-10)
	equal('uniform, spacing %.4f: points' % spacing, len(ids), number)
	near('uniform, spacing %.4f: its middle' % spacing, mpm.array('position').mean(axis=0), (.5, .05, 0), 1e-12)
fresh()
mpm.fill(((-1, 2, 0), (.3, 3, .55)), spacing=.2, material='elastic')
near('uniform, 3D: volume', mpm.array('volume').sum(), 1.3*1*.55, 1e-12)
fresh()
mpm.fill(((.3, 0), (1, .55)), spacing=.2, material='elastic', axisymmetric=True)
near('uniform, rings: volume', mpm.array('volume').sum(), math.pi*(1 - .09)*.55, 1e-12)
fresh()
mpm.fill(pack.inAlignedBox((0, 0, 0), (1, .5, .3)), spacing=.2, material='elastic')
near('a predicate that is a box: volume', mpm.array('volume').sum(), .15, 1e-12)
fresh()
equal('uniform places by cells', len(mpm.fill(((0, 0), (1, 1)), cellSize=.25, points=2, thickness=1, material='elastic')), 64)

# ---- Gauss places -----------------------------------------------------------------------------------------------------

for points in 1, 2, 3, 4:
	fresh()
	ids = mpm.fill(((0, .5), (1, 1)), placement='gauss', cellSize=.25, points=points, thickness=.1, material='elastic')
	equal('Gauss, %d: points' % points, len(ids), 8*points**2)
	for power in range(2*points):
		near('Gauss, %d: x^%d y^%d' % (points, power, power), moment((power, power, 0)), .1*(1 - .5**(power + 1))/(power + 1)**2, 1e-13)
	error = abs(moment((2*points, 0, 0)) - .05/(2*points + 1))
	check('Gauss, %d: x^%d is beyond its order' % (points, 2*points), error > 1e-12, error)
for points in 2, 3:
	fresh()
	mpm.fill(((0, 0, 0), (1, .5, .5)), placement='gauss', cellSize=.25, points=points, material='elastic')
	near('Gauss, 3D, %d: volume' % points, moment((0, 0, 0)), .25, 1e-14)
	near('Gauss, 3D, %d: x^3 y^3 z^3' % points, moment((3, 3, 3)), 1/4.*(.5**4/4)**2, 1e-14)
	fresh()
	mpm.fill(((0, 0), (1, .5)), placement='gauss', cellSize=.25, points=points, material='elastic', axisymmetric=True)
	near('Gauss, rings, %d: volume' % points, moment((0, 0, 0)), .5*math.pi, 1e-13)
	near('Gauss, rings, %d: x^2 y^3' % points, moment((2, 3, 0)), 2*math.pi/4*.5**4/4, 1e-13)
fresh()
mpm.fill(((0, 0), (1.1, .3)), placement='gauss', cellSize=.25, thickness=1, material='elastic')
near('Gauss, no multiple of the cell: volume', moment((0, 0, 0)), .33, 1e-13)
near('Gauss, no multiple of the cell: x^4', moment((4, 0, 0)), .3*1.1**5/5, 1e-13)
fresh()
ids = mpm.fill(((.1, 0), (1.05, .5)), placement='gauss', cellSize=.25, points=2, thickness=1, material='elastic', origin=(0, 0))
near('Gauss, cells from an origin: x^3', moment((3, 0, 0)), .5*(1.05**4 - .1**4)/4, 1e-13)
equal('Gauss, cells from an origin: the sliver of .05 is joined', len(ids), 4*2*2*2)
x = numpy.unique(mpm.array('position')[:, 0].round(12))
near('Gauss, cells from an origin: places', x[2:4], .375 + .125*numpy.array((-1, 1))/math.sqrt(3), 1e-11)
fresh()
ids = mpm.fill(((0, 0), (.5, .5)), placement='gauss', cellSize=.25, thickness=.02, material='elastic')
size = numpy.sqrt(mpm.array('volume')/.02)
near('Gauss: radius of a body is half the side of its square', [O.bodies[i].shape.radius for i in ids], size/2, 1e-15)
near("mpm.array('size')", mpm.array('size'), size, 1e-15)
check('Gauss: weights differ', size.max()/size.min() > 1.5)

ring = pack.inCylinder((0, 0, -1), (0, 0, 1), 1) - pack.inCylinder((0, 0, -2), (0, 0, 2), .5)
for cell in .2, .1:
	fresh()
	mpm.fill(ring, placement='gauss', cellSize=cell, thickness=1, material='elastic', bodies=False)
	near('Gauss, a ring of cells of %g: area' % cell, moment((0, 0, 0)), .75*math.pi, 2*math.sqrt(3*math.pi)*(cell/3)**1.5)  # parts counted at random along its edge
	distance = numpy.hypot(*mpm.array('position')[:, :2].T)
	check('Gauss, a ring: every point is in it', ((distance <= 1) & (distance >= .5)).all())
	weights = numpy.unique((mpm.array('volume')/cell**2*324).round(6))
	check('Gauss, a ring: whole cells have Gauss weights, cut ones equal parts', set(weights) == {25., 40., 64., 36.}, weights)
fresh()
ids = mpm.fill(pack.inAlignedBox((0, 0, 0), (1, .5, .5)), placement='gauss', cellSize=.25, points=2, material='elastic')
near('Gauss, a predicate that is a box: x^3 y z', moment((3, 1, 1)), .25*.125**2, 1e-14)

for arguments, parts in (
	(dict(placement='gauss'), ('cellSize = None', 'MpmEngine')),
	(dict(placement='lobatto', spacing=.1), ("placement = 'lobatto'", "'gauss'")),
	(dict(placement='gauss', cellSize=.25, points=0), ('points = 0', 'whole number')),
	(dict(placement='gauss', cellSize=.25, points=2.5), ('points = 2.5', )),
	(dict(placement='gauss', cellSize=.25, points=True), ('points = True', )),
	(dict(placement='gauss', cellSize=float('nan')), ('cellSize = nan', 'finite')),
	(dict(placement='gauss', cellSize=.25, points=3, spacing=.2), ('spacing = 0.2', 'leave the spacing out')),
	(dict(placement='gauss', cellSize=.25, origin=(0, )), ('origin', 'node of the grid')),
	(dict(spacing=.1, origin=(0, 0)), ('origin', 'gauss')),
	(dict(spacing=1e-300), ('spacing = 1e-300', 'memory')),
	(dict(spacing=1e-7), ('spacing = 1e-07', 'places for points', 'memory')),
	(dict(spacing=.1, velocity='abc'), ('velocity', "'abc'", 'three finite')),
	(dict(spacing=.1, velocity=None), ('velocity', 'None', 'three finite')),
	(dict(spacing=.1, group=-1), ('group = -1', 'name')),
	(dict(spacing=.1, group=''), ("group = ''", )),
	(dict(spacing=.1, group=256), ('group = 256', '255')),
	(dict(spacing=.1, mask=-1), ('mask = -1', )),
	(dict(spacing=.1, mask='a'), ("mask = 'a'", )),
	(dict(spacing=.1, color=(1, 0)), ('color', 'three numbers')),
	(dict(spacing=.1, color=(1, 0, 7)), ('color', '[0, 1]')),
	(dict(spacing=.1, bodies=False, color=(1, 0, 0)), ('color', 'bodies=False')),
	(dict(spacing=.1, stress=((1, 2), (3, 4))), ('stress', '3x3')),
	(dict(spacing=.1, stress=[[0, 1, 0], [0, 0, 0], [0, 0, 0]]), ('stress of point 0', 'symmetric')),
	(dict(spacing=.1, stress=lambda x: numpy.diag((float('nan'), 0, 0))), ('stress of point 0', 'nan')),
	(dict(spacing=.1, stress='high'), ('stress', "'high'")),
):
	fresh()
	says('mpm.fill(%s)' % arguments, lambda: mpm.fill(((0, 0), (1, 1)), material='elastic', thickness=1, **arguments), ValueError, 'mpm.fill', *parts)
	equal('makes nothing', (len(O.bodies), len(mpm.array('id'))), (0, 0))
fresh()
for material in 2**31, 2**70, -7, None, 'lead', 1.5: says('material=%r' % (material,), lambda: mpm.fill(((0, 0), (1, 1)), spacing=.5, material=material, thickness=1), KeyError, 'mpm.fill', 'material', 'elastic')
O.reset()
elastic()
mpm.fill(((0, 0, 0), (1, 1, 1)), .5, 'elastic')
O.engines = [ForceResetter(), MpmEngine(cellSize=.5)]
O.dt = 1e-6
says('a solid without analysis', lambda: O.run(1, True), RuntimeError, 'material point 0.thickness = 0', "MpmEngine.analysis = '3d'")
says('a 3D region with a thickness', lambda: mpm.fill(((0, 0, 0), (1, 1, 1)), .5, 0, thickness=1), ValueError, "analysis = '3d'")

# ---- points from arrays -----------------------------------------------------------------------------------------------

random = numpy.random.RandomState(5)
x, V, v = random.rand(50, 3), .1 + random.rand(50), random.randn(50, 3)
density = 500 + 1000*random.rand(50)
fresh()
first = mpm.fill(((5, 5, 5), (6, 6, 6)), spacing=.5, material='elastic')
ids = mpm.points(x, V, 'elastic', velocity=v, density=density, group='cloud', mask=5, color=(1, .5, 0))
equal('ids are those of new bodies', ids, list(range(8, 58)))
mine = numpy.isin(mpm.array('id'), ids)
for name, wanted in ('position', x), ('velocity', v), ('volume', V), ('mass', V*density), ('size', V**(1/3.)): near('mpm.points: %s' % name, mpm.array(name)[mine], wanted, 1e-12)
equal('mask and colour', {(O.bodies[i].mask, tuple(O.bodies[i].shape.color)) for i in ids}, {(5, (1, .5, 0))})
equal('and no others', {O.bodies[i].mask for i in first}, {1})
equal('group', sorted(set(zip(mpm.array('group').tolist(), mine.tolist()))), [(0, False), (1, True)])
fresh()
loose = mpm.points(x[:, :2], 2., 'elastic', thickness=.5, bodies=False, velocity=(1, 2, 0))
equal('without bodies', (loose, len(O.bodies)), (list(range(-1, -51, -1)), 0))
near('in the plane: size', mpm.array('size'), [2.]*50, 1e-15)
near('one velocity for all', mpm.array('velocity'), numpy.tile((1, 2, 0), (50, 1)), 0)
fresh()
mpm.points(x[:, :2] + 1, V, 'elastic', axisymmetric=True)
near('rings: size', mpm.array('size'), numpy.sqrt(V/(2*math.pi*(x[:, 0] + 1))), 1e-14)
for arguments, parts in (
	(dict(position=x[:, :2]), ('position has shape (50, 2)', '(N,3)')),
	(dict(position='here'), ('position', '(N,3)')),
	(dict(position=numpy.zeros((0, 3))), ('position has no rows', )),
	(dict(position=numpy.where(numpy.arange(150).reshape(50, 3) == 7, float('nan'), x)), ('position[2]', 'nan')),
	(dict(volume=V[:-1]), ('volume has shape (49,)', 'array of 50')),
	(dict(volume=-V), ('volume[0]', '> 0')),
	(dict(volume=0), ('volume[0] = 0', )),
	(dict(volume=None), ('volume', )),
	(dict(velocity=v[:-1]), ('velocity has shape (49, 3)', 'N = 50')),
	(dict(velocity='fast'), ("velocity", "'fast'")),
	(dict(density=float('inf')), ('density[0] = inf', '[kg/m3]')),
	(dict(stress=numpy.zeros((49, 3, 3))), ('stress has shape (49, 3, 3)', 'N = 50')),
	(dict(thickness=1), ('position[0]', 'z = 0')),
	(dict(thickness=-1), ('thickness = -1', )),
	(dict(position=x[:, :2] - 5, axisymmetric=True), ('position[0]', 'x > 0')),
):
	fresh()
	says('mpm.points(%s)' % ', '.join(arguments), lambda: mpm.points(**dict(dict(position=x, volume=V, material='elastic'), **arguments)), ValueError, 'mpm.points', *parts)
	equal('makes nothing', (len(O.bodies), len(mpm.array('id'))), (0, 0))

# ---- groups -----------------------------------------------------------------------------------------------------------

fresh()
square = lambda x, **more: mpm.fill(((x, 0), (x + 1, 1)), spacing=.5, thickness=1, material='elastic', **more)
square(0), square(1.5, group='upper'), square(3, group='lower'), square(4.5, group='upper'), square(6, group=7), square(7.5, bodies=False, group='later')
O.engines = [ForceResetter(), MpmEngine(cellSize=.5, flip=1)]
O.dt = .1*mpm.criticalTimeStep()
O.run(3, True)
groups = mpm.array('group').reshape(6, 4)
equal('groups by name and number', groups[:, 0].tolist(), [0, 1, 2, 1, 7, 8])
check('each of all points of a call', (groups == groups[:, :1]).all())
for k in range(0, 24, 4): O.bodies.erase(k if k < 20 else 19)
kept = mpm.array('group')
O.save(path('groups.yade.gz'))
O.reset()
O.load(path('groups.yade.gz'))
same('after saving and loading', mpm.array('group'), kept)
square(9, group='lower')
equal('names are kept', mpm.array('group')[mpm.array('position')[:, 0] > 9].tolist(), [2]*4)

# ---- initial stress ---------------------------------------------------------------------------------------------------

for analysis, make, tensor in (
	('planeStress', lambda **more: mpm.fill(((0, 0), (1, 1)), .25, 'elastic', thickness=.1, **more), [[-3e3, 1e3, 0], [1e3, 2e3, 0], [0, 0, 0]]),
	('planeStrain', lambda **more: mpm.fill(((0, 0), (1, 1)), .25, 'elastic', thickness=.1, **more), [[-3e3, 1e3, 0], [1e3, 2e3, 0], [0, 0, -5e2]]),
	('axisymmetric', lambda **more: mpm.fill(((0, 0), (1, 1)), None, 'elastic', axisymmetric=True, placement='gauss', cellSize=.25, points=2, **more), [[-3e3, 0, 0], [0, 2e3, 0], [0, 0, -3e3]]),
	('3d', lambda **more: mpm.fill(((0, 0, 0), (1, 1, .5)), .25, 'elastic', **more), [[-3e3, 1e3, 50], [1e3, 2e3, -20], [50, -20, 700]]),
):
	fresh()
	ids = make(stress=tensor)
	near('%s: initial stress before the first step' % analysis, mpm.array('stress'), [tensor]*len(ids), 0)
	near('and of a body', numpy.array(O.bodies[ids[0]].state.stress), tensor, 0)
	dims = range(3 if analysis == '3d' else 2)
	walls = [MpmWall(normal=[s*(d == e) for e in range(3)], origin=[(0 if s > 0 else .5 if d == 2 else 1)*(d == e) for e in range(3)], kind='fixed') for d in dims for s in (1, -1)
		if not (analysis == 'axisymmetric' and d == 0 and s > 0)]
	O.engines = [ForceResetter(), MpmEngine(cellSize=.25, analysis=analysis, walls=walls)]
	O.dt = .4*mpm.criticalTimeStep()
	O.save(path('stress.yade.gz'))
	O.run(20, True)
	if tensor[0][1] == 0: near('%s: between fixed walls it stays' % analysis, mpm.array('stress'), [tensor]*len(ids), 1e-7)
	else: check('%s: it is taken over' % analysis, abs(mpm.array('stress').mean(axis=0) - tensor).max() < 500)
	after = mpm.array('stress')
	O.reset()
	O.load(path('stress.yade.gz'))
	O.run(20, True)
	same('%s: saved before the first step' % analysis, mpm.array('stress'), after)

fresh()
ids = mpm.fill(((0, 0), (1, 2)), .25, 'elastic', thickness=.1, stress=lambda x: numpy.diag((0, -1e4*(2 - x[1]), 0)))
near('a function of position', mpm.array('stress')[:, 1, 1], -1e4*(2 - mpm.array('position')[:, 1]), 1e-9)
O.engines = [ForceResetter(), MpmEngine(cellSize=.5, analysis='planeStress', gravity=(0, -10, 0), walls=[MpmWall(normal=(0, 1, 0), kind='slip')])]
O.dt = .4*mpm.criticalTimeStep()
O.run(1, True)
equal('a fill in mid-run', len(mpm.fill(((5, 0), (6, 1)), .5, 'elastic', thickness=.1, stress=numpy.diag((1., 2, 0)))), 4)
near('has its stress at once', mpm.array('stress')[-4:, 0, 0], [1.]*4, 0)
mpm.setStress(ids[:3], Matrix3(7, 0, 0, 0, 8, 0, 0, 0, 0))
near('mpm.setStress of some', mpm.array('stress')[:4, 1, 1] - [8, 8, 8, mpm.array('stress')[3, 1, 1]], [0]*4, 0)
mpm.setStress(None, numpy.zeros((3, 3)))
near('mpm.setStress of all', mpm.array('stress'), numpy.zeros((len(ids) + 4, 3, 3)), 0)
says('mpm.setStress of no point', lambda: mpm.setStress([10**6], numpy.zeros((3, 3))), ValueError, 'mpm.setStress', '1000000')
says('mpm.setStress of text', lambda: mpm.setStress('all', numpy.zeros((3, 3))), ValueError, 'mpm.setStress', 'ids')
says('mpm.setStress of a wrong number', lambda: mpm.setStress(ids[:2], numpy.zeros((3, 3, 3))), ValueError, 'mpm.setStress', 'N = 2')
O.reset()
says('mpm.setStress without points', lambda: mpm.setStress(None, numpy.zeros((3, 3))), ValueError, 'no material points')

for material, analysis, tensor, parts in (
	(BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=1e3, tangentRatio=.1, n=4, label='m'), 'planeStress', numpy.diag((1001., 0, 0)), ('xx 1001', 'yield surface of BoucWenMat')),
	(J2Mat(young=1e6, poisson=.3, density=1000, yieldStress=1e3, label='m'), 'planeStrain', numpy.diag((1001., 0, 0)), ('yield surface of J2Mat', )),
	(DruckerPragerMat(young=1e6, poisson=.3, density=1000, cohesion=0, internalFriction=.5, label='m'), 'planeStrain', numpy.diag((1., 1, 1)), ('yield surface of DruckerPragerMat', )),
	(MohrCoulombMat(young=1e6, poisson=.3, density=1000, cohesion=1e3, internalFriction=.5, tensionCutoff=10, label='m'), 'planeStrain', numpy.diag((11., -1, -1)), ('yield surface of MohrCoulombMat', )),
	(FrictMat(young=1e6, poisson=.3, density=1000, label='m'), 'planeStress', numpy.diag((0, 0, 1.)), ('zz', 'plane stress')),
	(FrictMat(young=1e6, poisson=.3, density=1000, label='m'), 'planeStrain', [[0, 0, 1], [0, 0, 0], [1, 0, 0]], ('shear out of its plane', )),
):
	O.reset()
	O.materials.append(material)
	mpm.fill(((0, 0), (1, 1)), .5, 'm', thickness=.1, stress=tensor)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.5, analysis=analysis)]
	O.dt = 1e-6
	says('%s, %s: an initial stress that cannot be' % (type(material).__name__, analysis), lambda: O.run(1, True), RuntimeError, 'material point 0.stress', *parts)
	mpm.setStress(None, .5*numpy.diag((1., 0, 0)) if analysis == 'planeStress' else numpy.diag((-1., -1, -1)))
	O.run(1, True)
	equal('and can be mended', O.iter, 1)

O.reset()
O.materials.append(elastic(density=1000))
mpm.fill(((0, 0), (1, 1)), .5, 'elastic', thickness=.1, stress=numpy.diag((1e3, 0, 0)))
O.trackEnergy = True
O.engines = [ForceResetter(), MpmEngine(cellSize=.5, analysis='planeStress', walls=[MpmWall(normal=(s*(d == 0), s*(d == 1), 0), origin=((s < 0)*(d == 0), (s < 0)*(d == 1), 0)) for d in (0, 1) for s in (1, -1)])]
O.dt = .1*mpm.criticalTimeStep()
O.run(1, True)
near('its energy', O.energy['mpmElastic'], .5*1e3**2/1e6*.1, 1e-6)
mpm.setStress(None, numpy.diag((2e3, 0, 0)))
O.run(1, True)
near('of a stress given in mid-run: elastic, from outside', (O.energy['mpmElastic'], O.energy['mpmExternal']), (.2, -.15), 1e-6)

# ---- an interrupt -----------------------------------------------------------------------------------------------------

class Interrupt(Exception): pass


def interrupted(what, call, after=.3):
	"""A signal in the middle of a call ends it within a second, as Ctrl-C does."""
	def handler(number, frame): raise Interrupt
	before = signal.signal(signal.SIGALRM, handler)
	sent = time.time() + after
	signal.setitimer(signal.ITIMER_REAL, after)
	try: call()
	except Interrupt: check('%s: acts within a second' % what, time.time() - sent < 1, time.time() - sent)
	else: check('%s: is longer than %g s' % (what, after), False)
	finally:
		signal.setitimer(signal.ITIMER_REAL, 0)
		signal.signal(signal.SIGALRM, before)


fresh()
square(0)
for bodies in True, False:
	interrupted('mpm.fill, bodies=%s' % bodies, lambda: mpm.fill(((0, 0), (20, 20)), .01, 'elastic', thickness=1, bodies=bodies), .2)
	equal('no half-made points', (len(O.bodies), len(mpm.array('id')), max(mpm.array('id'))), (4, 4, 3))
interrupted('mpm.fill of a predicate', lambda: mpm.fill(pack.inSphere((0, 0, 0), 1), .01, 'elastic'))
equal('no half-made points', (len(O.bodies), len(mpm.array('id'))), (4, 4))
equal('and the scene goes on', square(2), [4, 5, 6, 7])
path_ = numpy.zeros((2000000, 3, 3))
path_[:, 0, 0] = .01*numpy.sin(numpy.arange(2000000))
interrupted('mpm.drive', lambda: mpm.drive(BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=1e3, tangentRatio=.1, n=4), path_))

finish()
