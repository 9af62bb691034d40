# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.drive: one material point, against exact solutions, a finite element and a block of material points; and bad input.

Exact: uniaxial stress with beta = gamma = 1/2 is sigma = alpha E eps + (1 - alpha) sigma_y z, on loading g(z) grows as the strain,
on unloading z does (doc/law.md); the error must stay below BoucWenMat.tolerance. The reversal stresses and the energy of the
cycle 3, -3 are known to 12 digits. Finite element: tests/data, seven digits, admitted 1e-4. Block: 4 x 4 points between four
slip walls that stretch it homogeneously in plane stress; admitted is 3e-4 from what the walls impose (explicit steps), 1e-5
from each point's own strains (their rate between two entries). Bad input: every part of the sentence that a user needs.
"""
import csv
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

nan, inf = float('nan'), float('inf')
young, yieldStress = 210e9, 240e6
unit = yieldStress/young  # a yield strain
steel = dict(young=young, poisson=.3, density=7850., yieldStress=yieldStress)
bar = ('yy', 'zz')


def pull(x, shear=None):
	"""Path of tension along x, and shear xy, in yield strains."""
	path = numpy.zeros((len(x), 3, 3))
	path[:, 0, 0] = numpy.asarray(x)*unit
	if shear is not None: path[:, 0, 1] = path[:, 1, 0] = numpy.asarray(shear)*unit
	return path


# ---- exact solutions ----------------------------------------------------------------------------------------------------

integrals = {1: lambda z: -math.log1p(-z), 2: math.atanh, 4: lambda z: .5*(math.atan(z) + math.atanh(z))}


def exact(n, alpha, strains):
	"""Stress over yield stress at the ends of straight branches, from rest."""
	x = z = 0.
	stress = []
	for to in strains:
		sign, left = math.copysign(1, to - x), abs(to - x)
		z *= sign  # positive is loading
		back = min(left, max(-z, 0.))
		z, left = z + back, left - back
		if left > 0:
			g, low, high = integrals[n](z) + left, z, 1 - 1e-16
			for _ in range(200):
				z = .5*(low + high)
				low, high = (z, high) if z < 1 and integrals[n](z) < g else (low, z)
		z, x = z*sign, to
		stress.append(alpha*x + (1 - alpha)*z)
	return numpy.array(stress)


strains = (.5, 1., .2, 1.2, 3., -3., 3., -3., 0., 4., -4.)
for n in 1, 2, 4:
	for alpha in 0., .05:
		for tolerance in 1e-4, 1e-8:
			material = BoucWenMat(n=n, tangentRatio=alpha, tolerance=tolerance, **steel)
			h = mpm.drive(material, pull(strains), free=bar)
			near('n = %g, alpha = %g, tolerance %g: exact at every reversal' % (n, alpha, tolerance), h.stress[:, 0, 0]/yieldStress, exact(n, alpha, strains), tolerance)
	fine = pull(numpy.linspace(0, 2, 401))
	near('n = %d: the virgin curve' % n, mpm.drive(material, fine, bar).stress[:, 0, 0]/yieldStress, [exact(n, .05, [x])[0] if x else 0 for x in numpy.linspace(0, 2, 401)], 1e-7)

sharp = dict(steel, n=2, tangentRatio=.05, tolerance=1e-10)
h = mpm.drive(BoucWenMat(**sharp), pull((3, -3, 3, -3, 3, -3)), bar)
near('n = 2, 0, 3, -3, 3, -3: the stresses at the reversals', h.stress[:4, 0, 0]/yieldStress, (1.095302016002394, -1.099914592920165, 1.0999137595565647, -1.0999137597078623), 1e-10)
near('the heat of a steady cycle', (h.dissipation[5] - h.dissipation[3])/(yieldStress*unit), 7.2334515525, 1e-9)
around = numpy.concatenate([numpy.linspace(-3, 3, 6001), numpy.linspace(3, -3, 6001)[1:]])
h = mpm.drive(BoucWenMat(**sharp), pull(numpy.concatenate([(3, -3, 3, -3), around])), bar)
sigma, epsilon = h.stress[4:, 0, 0]/yieldStress, h.strain[4:, 0, 0]/unit
near('is its work, the area of the loop', (.5*(sigma[1:] + sigma[:-1])*numpy.diff(epsilon)).sum(), 7.2334515525, 1e-6)
near('free normals have no stress', h.stress[:, [1, 2], [1, 2]], numpy.zeros((len(h.stress), 2)), 0)
near('and the strain of elasticity and flow of constant volume', h.strain[:, 1, 1]/unit, -.3*h.stress[:, 0, 0]/yieldStress - .5*(h.strain[:, 0, 0]/unit - h.stress[:, 0, 0]/yieldStress), 1e-12)
near('back stress is the plastic modulus times the plastic strain', h.backStress[3, 0, 0], .05/.95*young*(h.strain[3, 0, 0] - h.stress[3, 0, 0]/young), 1e-6*yieldStress)
for rule, greatest in ('normal', 1.), ('paper', 4.):
	h = mpm.drive(BoucWenMat(**dict(steel, n=2, loadingRule=rule)), pull(numpy.concatenate([numpy.linspace(0, 5, 101), numpy.linspace(5, -5, 201)])), bar)
	near("loadingRule = '%s': greatest stress" % rule, abs(h.stress).max()/yieldStress, greatest, 2e-3)
for reloading, loss in (0, .0871), (inf, 0):
	h = mpm.drive(BoucWenMat(**dict(steel, n=2, tolerance=1e-9, reloading=reloading)), pull((math.atanh(.8), math.atanh(.8) - .2, math.atanh(.8))), bar)
	near('reloading = %g: what unloading by 0.2 and reloading loses' % reloading, .8 - h.stress[2, 0, 0]/yieldStress, loss, 1e-4 if loss else 1e-8)



def drift(stress, count=2):
	"""Growth of the strain per cycle, in yield strains, between 1.2 and -0.3 sigma_y; stress: of a path's end, over sigma_y."""
	x = [0.]
	for k in range(2*count + 1):
		goal, low, high = (-.3, x[-1] - 3, x[-1]) if k % 2 else (1.2, x[-1], x[-1] + 6)
		for _ in range(45):
			middle = .5*(low + high)
			low, high = (middle, high) if stress(x[1:] + [middle]) < goal else (low, middle)
		x.append(middle)
	return numpy.diff(x[1::2])


def driven(material): return lambda x: mpm.drive(material, pull(x), bar).stress[-1, 0, 0]/yieldStress


right = drift(lambda x: exact(4, .05, x)[-1])
check('the law ratchets about a mean stress', right.min() > .1, right)
near('n = 4: by as much as the exact solution', drift(driven(BoucWenMat(n=4, tangentRatio=.05, tolerance=1e-7, **steel))), right, 1e-5)
near('n = 10: in the first cycle', drift(driven(BoucWenMat(n=10, tangentRatio=.05, tolerance=1e-6, **steel)), 1), (.2033,), 1e-4)
near('reloading does not cure it', drift(driven(BoucWenMat(n=10, tangentRatio=.05, tolerance=1e-6, reloading=inf, **steel)), 1), (.2033,), 1e-4)
near('classical plasticity closes that cycle', drift(driven(J2Mat(tangentRatio=.05, **steel))), (0, 0), 1e-6)

# ---- a finite element ---------------------------------------------------------------------------------------------------

for name in 'uniaxial_cyclic', 'square_syy0':
	with open(os.path.join(root, 'tests', 'data', 'mp_%s_kin.csv' % name)) as f: rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
	column = lambda key: numpy.array([row[key] for row in rows])
	steps = 160  # between rows, as the element took them
	fine = numpy.linspace(0, len(rows) - 1, steps*(len(rows) - 1) + 1)
	path = pull(*(numpy.interp(fine, range(len(rows)), column(key)/unit*part) for key, part in (('eps_xx', 1), ('gamma_xy', .5))))
	for material, admitted in (J2Mat(tangentRatio=.05, **steel), 1e-4), (BoucWenMat(tangentRatio=.05, n=200, **steel), .01):
		h = mpm.drive(material, path, free=bar)
		what = '%s of a finite element, %s: ' % (name, type(material).__name__)
		near(what + 'stress', h.stress[::steps, 0, :2]/yieldStress, numpy.stack([column('sig_xx_Pa'), column('sig_xy_Pa')], axis=1)/yieldStress, admitted)
		if admitted > 1e-3: continue
		near(what + 'transverse strain', h.strain[::steps, 1, 1]/unit, column('eps_yy')/unit, admitted)
		near(what + 'plastic strain', h.plasticStrain[::steps]/unit, column('peeq')/unit, admitted)
		near(what + 'one free normal that is given what it takes is none', mpm.drive(material, h.strain, free='zz').stress[:, 1, 1]/yieldStress, numpy.zeros(len(fine)), admitted)

# ---- what one may hand over ---------------------------------------------------------------------------------------------

O.reset()
material = BoucWenMat(label='steel', **sharp)
O.materials.append([FrictMat(label='other'), material])
path = pull(numpy.linspace(0, 3, 31), numpy.linspace(0, -1, 31))
h = mpm.drive(material, path, free=('zz',))
for what, found in (
		('label', mpm.drive('steel', path, free=('zz',))), ('index', mpm.drive(1, path, free=('zz',))), ('index from the end', mpm.drive(-1, path, free=('zz',))),
		('an equal material of no scene', mpm.drive(BoucWenMat(**sharp), path, free=('zz',))), ('free as a string', mpm.drive(material, path, 'zz')),
		('free as a list', mpm.drive(material, path, ['zz'])), ('Matrix3', mpm.drive(material, [Matrix3(*m.ravel().tolist()) for m in path], 'zz')),
		('lists', mpm.drive(material, path.tolist(), 'zz')), ('another order in memory', mpm.drive(material, numpy.asfortranarray(path), 'zz')),
		('a NaN that is not read', mpm.drive(material, path + numpy.diag([0, 0, nan]), 'zz'))):
	for name in 'stress', 'strain', 'backStress', 'plasticStrain', 'dissipation': same('%s: %s' % (what, name), getattr(found, name), getattr(h, name))
equal('shapes', [getattr(h, name).shape for name in ('stress', 'strain', 'backStress', 'plasticStrain', 'dissipation')], [(31, 3, 3)]*3 + [(31,)]*2)
equal('an empty path', mpm.drive(material, path[:0]).stress.shape, (0, 3, 3))
same('the path is what was asked for', h.strain[:, :2, :2], path[:, :2, :2])
for kind in FrictMat, ElastMat:
	h = mpm.drive(kind(young=young, poisson=.3), pull((3,)), bar)
	near('%s is linear elastic' % kind.__name__, (h.stress[0, 0, 0]/yieldStress, h.strain[0, 1, 1]/unit, h.plasticStrain[0], h.dissipation[0]), (3, -.9, 0, 0), 1e-12)
equal('nothing has been added to the scene', (len(O.materials), len(O.bodies), O.miscParams), (2, 0, []))

# ---- what one may not ---------------------------------------------------------------------------------------------------


def refused(what, kind, *parts, **arguments):
	arguments = dict(dict(material=material, strain=path), **arguments)
	try:
		mpm.drive(**arguments)
	except Exception as e:
		check(what, type(e) is kind and all(part in str(e) for part in parts), '%s: %s; wanted %s with %s' % (type(e).__name__, e, kind.__name__, parts))
	else:
		check(what, False, 'no exception')


for what, strain, text in (
		('one matrix', path[1], 'shape (3, 3)'), ('Voigt', numpy.zeros((5, 6)), 'shape (5, 6)'), ('3 x 2', numpy.zeros((5, 3, 2)), 'shape (5, 3, 2)'),
		('lists, 4 x 4', [[[0]*4]*4], 'shape (1, 4, 4)'), ('nothing', [], 'shape (0,)')):
	refused('path of shape: %s' % what, ValueError, 'mpm.drive: strain', text, 'N symmetric matrices, shape (N,3,3)', strain=strain)
for what, strain in ('a Matrix3 alone', Matrix3.Identity), ('numbers', [0., .001]), ('a number', .001), ('None', None), ('ragged', [[[0, 0], [0]]]), ('text', [['abc']*3]):
	refused('path: %s' % what, ValueError, 'mpm.drive: strain', '3x3 numbers', 'N symmetric matrices, shape (N,3,3)', strain=strain)
for value, text in (nan, 'nan'), (inf, 'inf'), (-inf, '-inf'):
	for (r, c), name in ((0, 0), 'xx'), ((1, 2), 'yz'), ((2, 1), 'yz'):
		bad = path.copy()
		bad[7, r, c] = value
		refused('%s in the path at %d%d' % (text, r, c), ValueError, 'mpm.drive: strain ', 'of entry 7', text if (r, c) != (2, 1) else '', 'finite number', strain=bad)
bad = path.copy()
bad[3, 0, 1] += 1e-7
refused('a matrix that is not symmetric', ValueError, 'mpm.drive: strain xy of entry 3', '-1e-07', 'symmetric', 'half the engineering shear', strain=bad)
for free in 'z', 'xy', ('zz', 'xy'), 'yyzz', (2,), None, 2:
	refused('free = %r' % (free,), ValueError, 'mpm.drive: free = ', repr(free) if not isinstance(free, str) else free, "('xx', 'yy', 'zz')", free=free)
for unknown in 'stee', 2, -3, None:
	refused('material = %r' % unknown, KeyError, 'mpm.drive: material = %r' % unknown, "['other', 'steel']", material=unknown)

admissible = {BoucWenMat: dict(steel), J2Mat: dict(steel), DruckerPragerMat: dict(young=1e7, poisson=.3, density=1800., cohesion=1e4, internalFriction=.5, dilatancy=.1)}
admissible[MohrCoulombMat] = dict(admissible[DruckerPragerMat], tensionCutoff=5e3)
positive, notNegative = (0, -1, nan, inf), (-1, nan, inf)
shared = {'young': (positive, 'positive modulus [Pa]'), 'poisson': ((-1, .5, nan), 'above -1 and below 0.5'), 'density': (positive, 'density > 0 [kg/m3]')}
metal = dict(shared, yieldStress=(positive, 'positive stress [Pa]'), tangentRatio=((-.1, 1, nan), '[0, 1)'), isotropicModulus=(notNegative, '0 or more'),
	saturationStress=(notNegative, '0 or more'), saturationRate=(notNegative, '0 or more'))
bounds = {
	J2Mat: metal,
	DruckerPragerMat: dict(shared, cohesion=(notNegative, '0 or more'), internalFriction=((-.1, 1.57, nan), 'below 1.57 [rad]'), dilatancy=((-.1, .6, nan), '0 to internalFriction'),
		match=(('triaxial', ''), "'planeStrain' or 'inscribed'")),
	MohrCoulombMat: dict(shared, cohesion=(notNegative, '0 or more'), internalFriction=((-.1, 1.57, nan), 'below 1.57 [rad]'), dilatancy=((-.1, .6, nan), '0 to internalFriction'),
		tensionCutoff=((-1, nan, 1.84e4, 1e9), 'or inf for no cut-off')),
	BoucWenMat: dict(metal, n=(positive, 'positive exponent'), gamma=((.4,), 'abs(beta)'), tolerance=((0, 1e-14, .2, nan), '1e-13 to 0.1'), strengthDegradation=(notNegative, '0 or more'),
		stiffnessDegradation=((-1, 2.1, nan), '0 to 2'), pinching=((-.1, 1, nan), '0 to below 1'), pinchingRate=(positive, 'positive number'), pinchingLevel=((-.1, 1, nan), '0 to below 1'),
		pinchingWidth=(positive, 'positive part'), reloading=((.5, -1, nan), 'infinity'), degradationMeasure=(('energy',), "'hysteretic'"), loadingRule=(('papers',), "'normal'")),
}
for kind, parameters in bounds.items():
	name = kind.__name__
	unnamed = {'frictionAngle'} | ({'beta'} if kind is BoucWenMat else set())
	equal('%s: every parameter is here' % name, sorted(set(kind().dict()) - unnamed - set(Material().dict())), sorted(set(parameters) - {'density'}))
	for attribute, (values, remedy) in parameters.items():
		for value in values:
			with_ = dict(admissible[kind], **{attribute: value})
			if attribute == 'gamma': with_['beta'] = 1 - value
			text = "'%s'" % value if isinstance(value, str) else '%g' % value
			refused('%s.%s = %s' % (name, attribute, text), RuntimeError, '%s.%s = %s: ' % (name, attribute, text), remedy, material=kind(**with_))
	good = mpm.drive(kind(**admissible[kind]), path)
	check('%s with admissible parameters is driven' % name, numpy.isfinite(good.stress).all() and good.plasticStrain[-1] > 0, good.plasticStrain[-1])
for beta, gamma in (.5, .6), (nan, .5), (.5, nan):
	refused('beta = %g, gamma = %g' % (beta, gamma), RuntimeError, 'BoucWenMat.beta + gamma = %g: ' % (beta + gamma), 'must add to 1', material=BoucWenMat(beta=beta, gamma=gamma, **steel))
refused('a step that the law cannot follow', ValueError, 'mpm.drive: strain of entry 1: ', 'cannot follow', 'yieldStress in Pa',
	strain=pull((0, 1e6)), material=BoucWenMat(**dict(steel, n=10, strengthDegradation=.1)))
refused('no strength', RuntimeError, 'DruckerPragerMat.cohesion = 0: ', 'positive cohesion', material=DruckerPragerMat(young=1e7, poisson=.3))
refused('no strength', RuntimeError, 'MohrCoulombMat.cohesion = 0: ', 'positive cohesion', material=MohrCoulombMat(young=1e7, poisson=.3))
refused('tension beyond the apex', RuntimeError, 'MohrCoulombMat.tensionCutoff = 1: ', 'cohesion/tan(internalFriction) = 0 [Pa]', material=MohrCoulombMat(young=1e7, poisson=.3, internalFriction=.5, tensionCutoff=1))
sheared = numpy.zeros((3, 3, 3))
sheared[1:, 0, 1] = sheared[1:, 1, 0] = 1e-3
refused('shear and two free normals', ValueError, 'mpm.drive: strain xy of entry 1 is 0.001: ', 'free one of them at most', material=MohrCoulombMat(**admissible[MohrCoulombMat]), strain=sheared, free=('yy', 'zz'))
for option in dict(isotropicModulus=1e9), dict(strengthDegradation=.1), dict(stiffnessDegradation=.1), dict(pinching=.1), dict(reloading=2):
	refused('the paper\'s rule with %s' % list(option)[0], RuntimeError, "BoucWenMat.loadingRule = 'paper': ", "'normal'", material=BoucWenMat(loadingRule='paper', **dict(steel, **option)))
refused('yieldStress is mandatory', RuntimeError, 'BoucWenMat.yieldStress = nan: ', material=BoucWenMat())
material.n = 0
refused('a material of the scene is named by its label', RuntimeError, "BoucWenMat 'steel'.n = 0: ", material='steel')
material.label = ''
refused('or by its place', RuntimeError, 'BoucWenMat 1.n = 0: ', material=1)
refused('no law', RuntimeError, 'Material has no law', 'BoucWenMat', 'J2Mat', 'DruckerPragerMat', 'MohrCoulombMat', material=Material())

# ---- a block of material points -----------------------------------------------------------------------------------------

soft = dict(young=1e6, poisson=.3, density=1000.)
strength, rates = 1e3, numpy.array([2.5e-3, -1e-3])  # a yield strain is 1e-3; strain rates [1/s]


def stretch(material):
	"""Strain, stress, back stress and plastic strain of all points over one second there and 1.4 back, (N, points, ...)."""
	walls = [MpmWall(normal=n, origin=o, kind='slip', velocity=v) for n, o, v in (
		((1, 0, 0), (0, 0, 0), (0, 0, 0)), ((-1, 0, 0), (1, 0, 0), (rates[0], 0, 0)), ((0, 1, 0), (0, 0, 0), (0, 0, 0)), ((0, -1, 0), (0, 1, 0), (0, rates[1], 0)))]
	ids, grid = block(material=material, walls=walls, analysis='planeStress', largeStrain=False, shape='cubic', courant=.4)
	steps = int(1/O.dt)
	start = mpm.array('position')[:, :2]
	def move(sign):
		for i, v in zip(ids, sign*rates*start): O.bodies[i].state.vel = Vector3(v[0], v[1], 0)
	move(1)
	names, history = ('strain', 'stress', 'backStress', 'plasticStrain'), []
	for k in range(24):
		if k == 10:  # at once, as homogeneous as it came
			move(-1)
			for wall in walls: wall.velocity = -wall.velocity
		O.run(steps//10, True)
		history.append([mpm.array(name) for name in names])
	return [numpy.array(column) for column in zip(*history)], steps//10


def follow(material, strain, steps):
	"""mpm.drive in plane stress with as many steps between entries as the block took: return mappings are of first order."""
	fine = numpy.linspace(-1, len(strain) - 1, steps*len(strain) + 1)
	path = numpy.zeros((len(fine), 3, 3))
	for r in 0, 1:
		for c in 0, 1: path[:, r, c] = numpy.interp(fine, range(-1, len(strain)), numpy.append(0, strain[:, r, c]))
	h = mpm.drive(material, path, free=('zz',))
	for name in 'stress', 'strain', 'backStress', 'plasticStrain': setattr(h, name, getattr(h, name)[steps::steps])
	return h


for material in (FrictMat(**soft), BoucWenMat(n=2, tangentRatio=.05, yieldStress=strength, **soft), BoucWenMat(n=25, tangentRatio=.05, yieldStress=strength, reloading=inf, isotropicModulus=1e4, **soft),
		J2Mat(tangentRatio=.05, yieldStress=strength, **soft), DruckerPragerMat(cohesion=500, internalFriction=.4, **soft),
		DruckerPragerMat(cohesion=500, internalFriction=.4, dilatancy=.3, **soft), BoucWenMat(n=5, yieldStress=strength, stiffnessDegradation=1, **soft),
		MohrCoulombMat(cohesion=500, internalFriction=.4, dilatancy=.3, **soft), MohrCoulombMat(cohesion=500, internalFriction=.4, tensionCutoff=300, **soft)):
	(strain, stress, backStress, plasticStrain), steps = stretch(material)
	what = 'a stretched block of %s%s: ' % (type(material).__name__, ', n = %g' % material.n if isinstance(material, BoucWenMat) else '')
	near(what + 'homogeneous', strain[:, :, :2, :2]/1e-3, strain[:, :1, :2, :2].repeat(16, axis=1)/1e-3, 1e-9)
	x = numpy.minimum(numpy.arange(1, 25), 20 - numpy.arange(1, 25))*steps*O.dt
	asked = numpy.zeros((24, 3, 3))
	asked[:, 0, 0], asked[:, 1, 1] = numpy.log1p(x*rates[0]), numpy.log1p(x*rates[1])
	h = follow(material, asked, steps)
	near(what + 'the strain of its walls', strain[:, :, :2, :2].mean(axis=1)/1e-3, asked[:, :2, :2]/1e-3, 3e-4)
	near(what + 'stress of mpm.drive', stress.mean(axis=1)/strength, h.stress/strength, 3e-4)
	for p in 0, 5:
		h = follow(material, strain[:, p], steps)
		near(what + 'point %d: stress' % p, stress[:, p]/strength, h.stress/strength, 1e-5)
		near(what + 'point %d: back stress' % p, backStress[:, p]/strength, h.backStress/strength, 1e-5)
		near(what + 'point %d: plastic strain' % p, plasticStrain[:, p]/1e-3, h.plasticStrain/1e-3, 1e-5)
		near(what + 'point %d: strain zz' % p, strain[:, p, 2, 2]/1e-3, h.strain[:, 2, 2]/1e-3, 1e-5)
	check(what + 'it has yielded', type(material) is FrictMat or plasticStrain.min(axis=1)[-1] > .5e-3, plasticStrain[-1].min())

finish()
