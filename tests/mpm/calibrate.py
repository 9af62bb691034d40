# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.calibrate: exact answers of linear regression, known parameters found again, standard errors against the scatter over seeds, CSV files, refusals."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

steel = dict(young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05)
cycle = numpy.interp(numpy.arange(161), [0, 20, 60, 100, 160], [0, .003, -.003, .004, -.005])


def bar(material, strain):
	path = numpy.zeros((len(strain), 3, 3))
	path[:, 0, 0] = strain
	return mpm.drive(material, path, free=('yy', 'zz')).stress[:, 0, 0]


# ---- a straight line: Young's modulus is sum(e s)/sum(e e), its standard error s/sqrt(sum(e e)) -------------------------
random = numpy.random.default_rng(1)
e = numpy.linspace(0, 1e-3, 30)
s = 200e9*e + random.normal(0, 2e6, len(e))
line = mpm.calibrate(FrictMat(young=100e9, poisson=.3, density=7850), {'strain': e, 'stress': s}, ['young'])
best = e @ s/(e @ e)
rest = s - best*e
near('a straight line: modulus', line.parameters['young']/best, 1, 1e-9)
near('standard error', line.standardErrors['young']/numpy.sqrt(rest @ rest/(len(e) - 1)/(e @ e)), 1, 1e-6)
near('residual', line.residual/numpy.sqrt(numpy.mean(rest**2)), 1, 1e-9)
near('residuals', line.residuals[0][:, 0, 0]/1e6, -rest/1e6, 1e-6)
equal('the copy of the material has it', line.material.young, line.parameters['young'])
# two tests of another accuracy: weighted means
two = mpm.calibrate(FrictMat(young=100e9, poisson=.3, density=7850), [{'strain': e, 'stress': 200e9*e, 'error': 1e6}, {'strain': e, 'stress': 230e9*e, 'error': 2e6}], ['young'])
near('weights', two.parameters['young']/206e9, 1, 1e-9)
# Young's modulus and Poisson's ratio from a path in three dimensions, exactly
path = random.normal(0, 1e-3, (20, 3, 3))
path += path.transpose(0, 2, 1)
h = mpm.drive(FrictMat(young=70e9, poisson=.33, density=2700), path)
both = mpm.calibrate(FrictMat(young=60e9, poisson=.2, density=2700), [{'strain': path, 'stress': h.stress}], ['young', 'poisson'])
near('modulus and ratio', [both.parameters['young']/70e9, both.parameters['poisson']], [1, .33], 1e-9)
equal('all six components are compared', both.names, ['young', 'poisson'])

# ---- known parameters are found again, and standard errors are those of the scatter -------------------------------------
exact = bar(J2Mat(**steel), cycle)
free = mpm.calibrate(J2Mat(**dict(steel, young=180e9, yieldStress=300e6, tangentRatio=.02)), {'strain': cycle, 'stress': exact}, ['young', 'yieldStress', 'tangentRatio'])
for name in free.names: near('J2 without noise: ' + name, free.parameters[name]/steel[name], 1, 1e-7)
near('its residual', free.residual/240e6, 0, 1e-8)
estimates, errors, correlations = [], [], []
for seed in range(40):
	noise = numpy.random.default_rng(seed).normal(0, 4e6, len(cycle))
	r = mpm.calibrate(J2Mat(**steel), {'strain': cycle, 'stress': exact + noise}, ['young', 'yieldStress', 'tangentRatio'])
	estimates.append([r.parameters[name] for name in r.names])
	errors.append([r.standardErrors[name] for name in r.names])
	correlations.append(r.correlation)
estimates, errors = numpy.array(estimates), numpy.array(errors)
for k, name in enumerate(r.names):  # a standard deviation of 40 has a scatter of 11 %
	near('scatter over standard error: ' + name, estimates[:, k].std(ddof=1)/errors[:, k].mean(), 1, .33)
	near('and no bias: ' + name, (estimates[:, k].mean() - steel[name])/errors[:, k].mean()*40**.5, 0, 3)
near('correlation', numpy.corrcoef(estimates.T), numpy.mean(correlations, axis=0), .45)
check('which is a correlation', abs(numpy.array(correlations)).max() <= 1 + 1e-12 and numpy.allclose(numpy.diag(correlations[0]), 1))

law = BoucWenMat(n=3, **steel)
smooth = mpm.calibrate(BoucWenMat(n=6, **dict(steel, yieldStress=200e6, tangentRatio=.1)), {'strain': cycle, 'stress': bar(BoucWenMat(n=3, tolerance=1e-9, **steel), cycle)}, ['yieldStress', 'n', 'tangentRatio'])
near('Bouc-Wen', [smooth.parameters['yieldStress']/240e6, smooth.parameters['n']/3, smooth.parameters['tangentRatio']/.05], [1, 1, 1], 1e-5)
asymmetric = mpm.calibrate(BoucWenMat(n=3, beta=.5, gamma=.5, **steel), {'strain': cycle, 'stress': bar(BoucWenMat(n=3, beta=.3, gamma=.7, tolerance=1e-9, **steel), cycle)}, {'gamma': (.5, 1)})
near('gamma, with beta', [asymmetric.parameters['gamma'], asymmetric.material.beta], [.7, .3], 1e-4)
# soil from two triaxial-like paths: at two pressures both friction and cohesion show
soil = dict(young=50e6, poisson=.25, density=1800)
paths = []
for squeeze in .5e-3, 2e-3:
	path = numpy.zeros((60, 3, 3))
	path[:20] = -numpy.linspace(0, squeeze, 20)[:, None, None]*numpy.eye(3)
	path[20:] = path[19]
	path[20:, 2, 2] -= numpy.linspace(0, 5e-3, 40)
	path[20:, 0, 0] += numpy.linspace(0, 2e-3, 40)
	paths.append(path)
sand = MohrCoulombMat(cohesion=8e3, internalFriction=.55, dilatancy=.15, **soil)
triaxial = [{'strain': path, 'stress': mpm.drive(sand, path).stress} for path in paths]
found = mpm.calibrate(MohrCoulombMat(cohesion=3e3, internalFriction=.45, dilatancy=.05, **soil), triaxial, ['cohesion', 'internalFriction', 'dilatancy'])
near('Mohr-Coulomb', [found.parameters['cohesion']/8e3, found.parameters['internalFriction'], found.parameters['dilatancy']], [1, .55, .15], 1e-6)

# ---- CSV, labels, plot, parts that were not measured --------------------------------------------------------------------
with tempfile.TemporaryDirectory() as folder:
	name = os.path.join(folder, 'test.csv')
	with open(name, 'w') as f:
		f.write('# a bar\ntime, strain xx, stress_xx\n' + ''.join('%d, %.17g, %s\n' % (k, strain, '' if k % 3 == 1 else '%.17g' % stress) for k, (strain, stress) in enumerate(zip(cycle, exact))))
	O.reset()
	O.materials.append(J2Mat(label='steel', **dict(steel, yieldStress=300e6)))
	csvFit = mpm.calibrate('steel', name, ['yieldStress'])
	near('a CSV file', csvFit.parameters['yieldStress']/240e6, 1, 1e-7)
	equal('what was not measured is nan', int(numpy.isfinite(csvFit.residuals[0]).sum()), 107)
	equal('the material of the scene stays', O.materials['steel'].yieldStress, 300e6)
	equal('the copy has its label', csvFit.material.label, 'steel')
	picture = os.path.join(folder, 'fit.png')
	figure = csvFit.plot(picture)
	check('a plot', os.path.getsize(picture) > 5000 and len(figure.axes) == 1 and figure.axes[0].get_title() == 'test.csv')
	check('and a table', 'yieldStress = 2.4e+08 +-' in repr(csvFit), repr(csvFit))

	def write(text):
		with open(name, 'w') as f: f.write(text)
		return name

	def says(what, parts, kind=ValueError, **change):
		arguments = dict(dict(material=J2Mat(**steel), tests={'strain': cycle, 'stress': exact}, fit=['yieldStress']), **change)
		try:
			mpm.calibrate(**arguments)
		except Exception as e:
			check(what, type(e) is kind and all(part in str(e) for part in parts), '%s: %s' % (type(e).__name__, e))
		else: check(what, False, 'no exception')

	says('records of unequal length', ('mpm.calibrate: tests[1] (wall) has 161 entries of strain and 160 of stress', 'one stress for each strain'),
		tests=[{'strain': cycle, 'stress': exact}, {'strain': cycle, 'stress': exact[1:], 'name': 'wall'}])
	says('a short row', ('3 columns', '2 values in row 1'), tests=write('strain_xx,strain_yy,stress_xx\n0,0,0\n1e-3,2e8\n'))
	says('text in a row', ("stress_xx = 'x' in row 0",), tests=write('strain_xx,stress_xx\n0,x\n'))
	says('no stress', ('no column of stress', 'stress_xx [Pa]'), tests=write('strain_xx,sigma\n0,0\n'))
	says('no data', ('no data',), tests=write('strain_xx,stress_xx\n'))
	says('no file', ('cannot be read',), tests='/nowhere/test.csv')
	says('a number as test', ('tests[0] is 3',), tests=[3])
	says('no tests', ('tests is empty',), tests=[])
	says('a misspelt key', ("'sress'",), tests={'strain': cycle, 'sress': exact})
	says('shapes', ('shape (161,)',), tests={'strain': numpy.zeros((161, 3, 3)), 'stress': exact})
	says('nothing measured', ('no measured stress',), tests={'strain': cycle, 'stress': exact*numpy.nan})
	says('infinite stress', ('infinite',), tests={'strain': cycle, 'stress': exact + numpy.inf})
	says('error', ('error = 0',), tests={'strain': cycle, 'stress': exact, 'error': 0})
	says('strain that is no number', ('finite number',), tests={'strain': cycle + numpy.nan, 'stress': exact})
	says('an attribute that is not there', ("'yeildStress'", 'J2Mat', 'yieldStress'), fit=['yeildStress'])
	says('no parameter', ('fit = []',), fit=[])
	says('a parameter twice', ('twice',), fit=['yieldStress', 'yieldStress'])
	says('beta and gamma', ('beta and gamma',), material=BoucWenMat(n=2, **steel), fit=['beta', 'gamma'])
	says('a range', ("fit['yieldStress']",), fit={'yieldStress': (2, 1)})
	says('a start out of range', ('J2Mat.yieldStress = 2.4e+08, the start',), fit={'yieldStress': (3e8, 4e8)})
	says('more parameters than stresses', ('1 measured stresses', 'more stresses'), tests={'strain': [1e-3], 'stress': [2e8]})
	says('an inadmissible start', ('J2Mat.tangentRatio = 1',), material=J2Mat(**dict(steel, tangentRatio=1)), kind=RuntimeError)
	says('an unknown material', ("'iron'",), material='iron', kind=KeyError)
	# parameters that a test within the elastic range does not determine
	elastic = {'strain': e, 'stress': s}
	says('an undetermined parameter', ('J2Mat.yieldStress = 2.4e+08 +- inf', 'J2Mat.tangentRatio = 0.05 +- inf'), tests=elastic, fit=['young', 'yieldStress', 'tangentRatio'], kind=mpm.Undetermined)
	loose = mpm.calibrate(J2Mat(**steel), elastic, ['young', 'yieldStress'], allowUndetermined=True)
	equal('on demand it is returned', (loose.undetermined, loose.standardErrors['yieldStress']), (['yieldStress'], float('inf')))
	near('beside what is determined', loose.parameters['young']/best, 1, 1e-6)
	check('with no correlation', numpy.isnan(loose.correlation[0, 1]) and loose.correlation[0, 0] == 1, loose.correlation)
	# in uniaxial strain only young (1 - nu)/((1 + nu) (1 - 2 nu)) shows: two parameters, one combination
	oedometer = numpy.zeros((30, 3, 3))
	oedometer[:, 0, 0] = e
	one = mpm.drive(FrictMat(**soil), oedometer).stress
	one[:, 1, 1] = one[:, 2, 2] = numpy.nan
	says('a combination', ('FrictMat.young', 'FrictMat.poisson', 'inf'), material=FrictMat(**soil), tests={'strain': oedometer, 'stress': one}, fit=['young', 'poisson'], kind=mpm.Undetermined)
	# weakly: far above its own value
	shaken = {'strain': cycle[:25]*.3, 'stress': bar(BoucWenMat(n=10, **steel), cycle[:25]*.3) + numpy.random.default_rng(3).normal(0, 8e6, 25)}
	says('a large standard error', ('BoucWenMat.n = ', '+-'), material=BoucWenMat(n=10, **steel), tests=shaken, fit=['young', 'yieldStress', 'n'], kind=mpm.Undetermined)

rows = example('calibrate')
near('the example: residual over its noise', numpy.sqrt(numpy.mean([(row['fit_Pa'] - row['measured_Pa'])**2 for row in rows]))/3e6, 1, .1)

# without SciPy
import builtins
importer = builtins.__import__
def without(name, *rest, **more):
	if name.startswith('scipy'): raise ImportError(name)
	return importer(name, *rest, **more)
builtins.__import__ = without
try: says('without SciPy', ('apt-get install python3-scipy',), kind=ImportError)
finally: builtins.__import__ = importer
finish()
