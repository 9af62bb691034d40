# SPDX-License-Identifier: GPL-2.0-or-later
"""Calibrate a material: fit its attributes to measured stress by least squares."""

import csv
import math
import os

import numpy
from yade import wrapper

from .driver import _AXES, drive
from .points import findMaterial, isNumber

_COMPONENTS = ('xx', 'yy', 'zz', 'yz', 'xz', 'xy')
_PLACES = dict(xx=(0, 0), yy=(1, 1), zz=(2, 2), yz=(1, 2), xz=(0, 2), zx=(0, 2), xy=(0, 1))
_inf = math.inf

# Admissible ranges, closed; an attribute that is not here has none, and the material itself refuses its values.
_POSITIVE = 'young', 'yieldStress', 'n', 'pinchingRate', 'pinchingWidth'
_BOUNDS = dict({name: (1e-9, _inf) for name in _POSITIVE}, poisson=(-.999, .4999), tangentRatio=(0, .999), gamma=(.5, _inf), beta=(-_inf, .5),
	isotropicModulus=(0, _inf), saturationStress=(0, _inf), saturationRate=(0, _inf), strengthDegradation=(0, _inf), stiffnessDegradation=(0, 2),
	pinching=(0, .999), pinchingLevel=(0, .999), reloading=(1, _inf), cohesion=(0, _inf), internalFriction=(0, 1.5699), dilatancy=(0, 1.5699), tensionCutoff=(0, _inf))
_STRESSES = 'young', 'yieldStress', 'isotropicModulus', 'saturationStress', 'cohesion', 'tensionCutoff'
_TOLERANCE = 1e-9  # of the law's integration, in the fit: differences need its digits
_WIDTH = 1e-4  # of differences, over the scale of a parameter
_LEAST = 1e-5  # differences do not resolve smaller singular values of the scaled, normalised derivatives


class Undetermined(ValueError):
	"""Raised by :yref:`calibrate` when the tests do not determine a parameter.

	:ivar result: the :yref:`Calibration` nevertheless, with infinite or large standard errors
	"""

	def __init__(self, message, result):
		super().__init__(message)
		self.result = result


class Calibration:
	"""Result of :yref:`calibrate`. Arrays and matrices follow the order of names.

	:ivar names: names of the fitted attributes
	:ivar parameters: their values, a dict [units of the attributes]
	:ivar standardErrors: their standard errors, a dict [units of the attributes]; infinite where nothing determines a parameter
	:ivar correlation: correlation of the estimates [-], matrix; nan where a standard error is infinite
	:ivar residual: root mean square of computed less measured stress [Pa]
	:ivar residuals: computed less measured stress [Pa], one array (N,3,3) a test, nan where nothing was measured
	:ivar undetermined: names of parameters that the tests do not determine
	:ivar atBounds: names of parameters that ended at a bound; their standard errors do not count with it
	:ivar material: a copy of the material with the fitted parameters
	:ivar histories: one :yref:`PointHistory` a test, with these parameters
	"""

	def __init__(self, **values):
		self.__dict__.update(values)

	def __repr__(self):
		lines = ['mpm.Calibration of %s to %d test%s, residual %.4g Pa' % (type(self.material).__name__, len(self.histories), 's'*(len(self.histories) > 1), self.residual)]
		for name in self.names:
			note = ', not determined' if name in self.undetermined else ', at its bound' if name in self.atBounds else ''
			lines.append('  %s = %.6g +- %.2g%s' % (name, self.parameters[name], self.standardErrors[name], note))
		return '\n'.join(lines)

	def plot(self, file=None):
		"""Plot measured and computed stress over strain, a panel a test and the component that was strained most.

		:param file: name of a picture to write; None writes nothing
		:returns: the figure, of matplotlib
		"""
		from matplotlib.figure import Figure
		count = len(self.histories)
		columns = min(count, 3)
		figure = Figure(figsize=(5*columns, 4*-(-count//columns)), layout='constrained')
		for k, (test, history) in enumerate(zip(self._tests, self.histories)):
			axes = figure.add_subplot(-(-count//columns), columns, k + 1)
			name = max(test.measured, key=lambda name: numpy.ptp(history.strain[(slice(None),) + _PLACES[name]]))
			at = (slice(None),) + _PLACES[name]
			axes.plot(100*history.strain[at], test.stress[at]/1e6, '.', ms=3, color='.6', label='measured')
			axes.plot(100*history.strain[at], history.stress[at]/1e6, lw=1, label='fit')
			axes.set(title=test.name, xlabel='strain %s [%%]' % name, ylabel='stress %s [MPa]' % name)
			axes.legend()
		if file is not None: figure.savefig(file, dpi=120)
		return figure


class _Test:
	"""A record, checked: path, measured stress (nan: not measured), free components, standard deviation of the measurement."""

	def __init__(self, test, k):
		self.what = 'mpm.calibrate: tests[%d]' % k
		if isinstance(test, (str, os.PathLike)): test = {'file': test}
		if not isinstance(test, dict): self._refuse('is %s' % _short(test), "give the name of a CSV file, or a dict with 'strain' and 'stress'")
		unknown = sorted(set(map(str, test)) - {'file', 'strain', 'stress', 'free', 'error', 'name'})
		if unknown: self._refuse("has %s" % ', '.join(map(repr, unknown)), "choose among 'file', 'strain', 'stress', 'free', 'error' and 'name'")
		self.name = str(test.get('name', os.path.basename(test['file']) if 'file' in test else 'test %d' % k))
		free = test.get('free')
		if 'file' in test:
			if 'strain' in test or 'stress' in test: self._refuse("has 'file' beside 'strain' or 'stress'", 'give one or the other')
			strain, stress, free = self._read(test['file'], free)
		else:
			for key in 'strain', 'stress':
				if key not in test: self._refuse('has no %r' % key, 'give both, as arrays of equal length')
			strain, stress = self._numbers(test['strain'], 'strain'), self._numbers(test['stress'], 'stress')
		if len(strain) != len(stress): self._refuse('(%s) has %d entries of strain and %d of stress' % (self.name, len(strain), len(stress)), 'give one stress for each strain')
		bar = strain.ndim == 1
		if (stress.ndim == 1) != bar: self._refuse('has strain of shape %s and stress of shape %s' % (strain.shape, stress.shape), 'give both as (N,3,3), or both as (N,) for a bar along x')
		if bar:
			full = numpy.zeros((2, len(strain), 3, 3))
			full[1] = math.nan
			full[:, :, 0, 0] = strain, stress
			strain, stress = full
		if free is None: free = ('yy', 'zz') if bar else ()
		self.free = (free,) if isinstance(free, str) else tuple(free)
		if any(name not in _AXES for name in self.free): self._refuse("has free = %r" % (free,), 'choose among %s' % (_AXES,))
		self.strain, self.stress = strain, .5*(stress + stress.transpose(0, 2, 1))
		self.error = test.get('error', 1.)
		if not (isNumber(self.error) and 0 < self.error < _inf): self._refuse("has error = %r" % (self.error,), 'give the standard deviation of the measured stress, > 0 [Pa]')
		if numpy.isinf(self.stress).any(): self._refuse('has an infinite stress', 'give finite numbers, or nan where nothing was measured')
		self.measured = [name for name in _COMPONENTS if name not in self.free and not numpy.isnan(self.stress[(slice(None),) + _PLACES[name]]).all()]
		if not self.measured: self._refuse('has no measured stress', 'give a stress of a component that is not free')

	def _refuse(self, fault, remedy): raise ValueError('%s %s: %s' % (self.what, fault, remedy))

	def _numbers(self, values, what):
		try:
			array = numpy.array(values if isinstance(values, numpy.ndarray) or (len(values) and isNumber(values[0])) else [[list(row) for row in matrix] for matrix in values], dtype=float)
		except (TypeError, ValueError):
			array = None
		if array is None or not len(array) or not (array.ndim == 1 or array.shape[1:] == (3, 3)):
			self._refuse('has %s of %s' % (what, 'shape %s' % (array.shape,) if array is not None else 'entries that are not numbers'), 'give N matrices, shape (N,3,3), or N numbers for a bar along x')
		return array

	def _read(self, file, free):
		"""Strain, stress and free components of a CSV file."""
		try:
			with open(file, newline='', encoding='utf-8-sig') as stream:
				rows = [row for row in csv.reader(line for line in stream if line.strip() and not line.lstrip().startswith('#'))]
		except (OSError, UnicodeError, TypeError) as fault:
			self._refuse('is %r, which cannot be read (%s)' % (file, fault), 'give a CSV file')
		header = [name.strip().replace(' ', '_') for name in rows[0]] if rows else []
		known = {'%s_%s' % (kind, name): (kind, _PLACES[name]) for kind in ('strain', 'stress') for name in _PLACES}
		columns = [name for name in header if name in known]
		for kind in 'strain', 'stress':
			if not any(name.startswith(kind) for name in columns):
				self._refuse('(%s) has no column of %s in its first line, %s' % (self.name, kind, ','.join(header)), 'name columns strain_xx [-], stress_xx [Pa], ..., strain_xy being half of the engineering shear')
		for name in columns:
			if header.count(name) > 1: self._refuse('(%s) has the column %s twice' % (self.name, name), 'remove one')
		arrays = {'strain': numpy.zeros((len(rows) - 1, 3, 3)), 'stress': numpy.full((len(rows) - 1, 3, 3), math.nan)}
		for n, row in enumerate(rows[1:]):
			if len(row) != len(header): self._refuse('(%s) has %d values in row %d of the data' % (self.name, len(row), n), 'give one for each of the %d columns' % len(header))
			for name, text in zip(header, row):
				if name not in known: continue
				kind, (r, c) = known[name]
				try:
					value = float(text) if text.strip() or kind == 'strain' else math.nan
				except ValueError:
					self._refuse('(%s) has %s = %r in row %d of the data' % (self.name, name, text, n), 'give a number')
				arrays[kind][n, r, c] = arrays[kind][n, c, r] = value
		if not len(rows) > 1: self._refuse('(%s) has no data' % self.name, 'give at least one row below the header')
		if free is None: free = tuple(name for name in _AXES if 'strain_' + name not in columns)
		return arrays['strain'], arrays['stress'], free


def _short(value):
	text = repr(value)
	return text if len(text) < 60 else text[:57] + '...'


def calibrate(material, tests, fit, allowUndetermined=False):
	"""Fit attributes of a material to measured stress, by nonlinear least squares.

	The material's own values are the start; it is not changed. The sum of squares of (computed - measured stress)/error over all measured
	components is least, with the stress of :yref:`drive` (a point initially free of stress; the strain varies linearly between entries). The
	covariance of the estimates is s^2 (J^T J)^-1, with J the derivatives of the residuals and s^2 their sum of squares over the number of
	measured stresses less that of parameters. Source: Bates and Watts, Nonlinear Regression Analysis (1988), chapter 2.

	:param material: a material, or label or index of one in O.materials
	:param tests: a test, or a sequence of tests; each is the name of a CSV file or a dict:

		- ``strain``: path [-], (N,3,3) with tensorial shear, or (N,) for a bar along x with yy and zz free
		- ``stress``: measured Cauchy stress [Pa], tension positive, of the same length; nan where nothing was measured
		- ``file``: a CSV file in place of both, with columns such as strain_xx, stress_xx; normal components without a column of strain are free, other
		  missing strains zero, and empty stresses not measured. A line that begins with # is a comment
		- ``free``: names of stress-free normal components, as in :yref:`drive`
		- ``error``: standard deviation of the measured stress, > 0 [Pa], by default the same for all tests; only ratios of errors have an effect
		- ``name``: title of the panel in the plot
	:param fit: names of the attributes to fit, or a dict from name to (least, greatest) value. beta and gamma change together
	:param allowUndetermined: whether to return a result with parameters that the tests do not determine, instead of an error
	:returns: :yref:`Calibration` with parameters, standardErrors, residual, correlation, material and plot(file)
	:raises ValueError: for tests or names of another form, records of unequal length, no more measured stresses than parameters
	:raises Undetermined: a ValueError with the names and standard errors of parameters that the tests do not determine: their standard error exceeds their
		value and their start, or the derivatives of the stress are zero or linearly dependent
	:raises RuntimeError: if the material's parameters are not admissible, or the fit does not converge
	:raises ImportError: if SciPy is not installed
	"""
	try:
		from scipy.optimize import least_squares
	except ImportError:
		raise ImportError('mpm.calibrate needs SciPy, which is not installed: apt-get install python3-scipy') from None
	if not isinstance(material, wrapper.Material): material = findMaterial(material, 'mpm.calibrate')
	kind = type(material).__name__
	if isinstance(tests, (str, os.PathLike, dict)): tests = [tests]
	try:
		tests = list(tests)
	except TypeError:
		tests = []
	if not tests: raise ValueError('mpm.calibrate: tests is empty or no sequence: give at least one test')
	tests = [_Test(test, k) for k, test in enumerate(tests)]
	names, low, high = _ranges(material, kind, fit)
	start = numpy.array([getattr(material, name) for name in names])
	for name, value, least, greatest in zip(names, start, low, high):
		if not least <= value <= greatest: raise ValueError('mpm.calibrate: %s.%s = %g, the start, is not between %g and %g: change the attribute, or its range in fit' % (kind, name, value, least, greatest))
	scale = numpy.array([_scale(material, name, value, least, greatest) for name, value, least, greatest in zip(names, start, low, high)])
	measured = [numpy.isfinite(_columns(test, test.stress)) for test in tests]
	count = sum(int(mask.sum()) for mask in measured)
	if count <= len(names): raise ValueError('mpm.calibrate: the tests have %d measured stresses, and fit has %d parameters: give more stresses than parameters' % (count, len(names)))
	size = max(numpy.nanmax(numpy.abs(_columns(test, test.stress)))/test.error for test in tests)

	def with_(x):
		copy = type(material)()
		copy.updateAttrs({name: value for name, value in material.dict().items() if name not in ('id', 'label')})
		for name, value in zip(names, x*scale):
			setattr(copy, name, float(value))
			if name == 'beta': copy.gamma = 1 - float(value)
			if name == 'gamma': copy.beta = 1 - float(value)
		return copy

	def residuals(x, copy=None):
		copy = copy or with_(x)
		if hasattr(copy, 'tolerance'): copy.tolerance = min(copy.tolerance, _TOLERANCE)
		return numpy.concatenate([(_columns(test, drive(copy, test.strain, test.free).stress)[mask] - _columns(test, test.stress)[mask])/test.error for test, mask in zip(tests, measured)])

	def admissible(x):
		"""Residuals, or None where the material refuses the parameters or cannot follow the path."""
		try:
			return residuals(x)
		except (RuntimeError, ValueError):
			return None

	def value(x):
		r = admissible(x)
		return r if r is not None else numpy.full(count, 1e3*size + 1e-300)

	def derivatives(x):
		J = numpy.empty((count, len(x)))
		for k in range(len(x)):
			h = _WIDTH*max(1, abs(x[k]))
			sides = []
			for side in x[k] - h, x[k] + h:
				moved = x.copy()
				moved[k] = side
				r = admissible(moved) if low[k] <= side*scale[k] <= high[k] else None
				sides.append((side, r) if r is not None else (x[k], residuals(x)))
			width = sides[1][0] - sides[0][0]
			J[:, k] = (sides[1][1] - sides[0][1])/width if width else 0
		return J

	residuals(start/scale)  # raises where the start is not admissible
	found = least_squares(value, start/scale, derivatives, bounds=(low/scale, high/scale), xtol=1e-12, ftol=1e-13, gtol=1e-13, max_nfev=100*(len(names) + 1))
	if not found.success: raise RuntimeError('mpm.calibrate: no convergence in %d evaluations, at %s: start closer to the solution, or fit fewer parameters'
		% (found.nfev, ', '.join('%s = %g' % pair for pair in zip(names, found.x*scale))))
	x = found.x
	standard, correlation = _errors(derivatives(x), residuals(x))
	copy = with_(x)
	copy.label = material.label
	histories = [drive(copy, test.strain, test.free) for test in tests]
	differences = []
	for test, history in zip(tests, histories):
		difference = history.stress - test.stress
		for d, name in enumerate(_AXES):
			if name in test.free: difference[:, d, d] = math.nan
		differences.append(difference)
	rest = numpy.concatenate([_columns(test, difference)[mask] for test, difference, mask in zip(tests, differences, measured)])
	result = Calibration(names=names, parameters=dict(zip(names, map(float, x*scale))), standardErrors=dict(zip(names, map(float, standard*scale))), correlation=correlation,
		residual=float(numpy.sqrt(numpy.mean(rest**2))), residuals=differences, material=copy, histories=histories, _tests=tests,
		undetermined=[name for name, error, at in zip(names, standard, x) if not error < max(1, abs(at))],
		atBounds=[name for name, at, least, greatest in zip(names, x*scale, low, high) if at - least <= 1e-6*abs(at) or greatest - at <= 1e-6*abs(at)])
	if result.undetermined and not allowUndetermined:
		raise Undetermined('mpm.calibrate: the tests do not determine %s: leave them out of fit, or add tests that depend on them; Undetermined.result holds the fit, and allowUndetermined=True returns it'
			% ', '.join('%s.%s = %.4g +- %.2g' % (kind, name, result.parameters[name], result.standardErrors[name]) for name in result.undetermined), result)
	return result


def _columns(test, tensors): return numpy.stack([tensors[(slice(None),) + _PLACES[name]] for name in test.measured], axis=1)


def _ranges(material, kind, fit):
	"""Names and bounds."""
	if isinstance(fit, str): fit = [fit]
	try:
		names = list(fit)
	except TypeError:
		names = []
	if not names: raise ValueError('mpm.calibrate: fit = %r: give a sequence with the names of one or more attributes' % (fit,))
	known = sorted(name for name, value in material.dict().items() if isinstance(value, float))
	for name in names:
		if name not in known: raise ValueError('mpm.calibrate: fit has %r, which is no number of %s: choose among %s' % (name, kind, ', '.join(known)))
		if names.count(name) > 1: raise ValueError('mpm.calibrate: fit has %r twice: give it once' % name)
	if 'beta' in names and 'gamma' in names: raise ValueError('mpm.calibrate: fit has beta and gamma, which add to 1: give one of them')
	ranges = []
	for name in names:
		least, greatest = _BOUNDS.get(name, (-_inf, _inf))
		if isinstance(fit, dict):
			try:
				given = [float(bound) for bound in fit[name]]
			except (TypeError, ValueError):
				given = []
			if len(given) != 2 or not given[0] < given[1]: raise ValueError('mpm.calibrate: fit[%r] = %s: give (least, greatest) with least < greatest' % (name, _short(fit[name])))
			least, greatest = max(least, given[0]), min(greatest, given[1])
		value = getattr(material, name)
		if not math.isfinite(value): raise ValueError('mpm.calibrate: %s.%s = %g, the start: give a finite value' % (kind, name, value))
		ranges.append((least, greatest))
	return names, numpy.array([r[0] for r in ranges]), numpy.array([r[1] for r in ranges])


def _scale(material, name, value, least, greatest):
	"""Size of a parameter: its start; where that is zero, a tenth of its range, or a part of Young's modulus or of 1."""
	if value: return abs(value)
	if math.isfinite(greatest - least): return .1*(greatest - least)
	return 1e-3*material.young if name in _STRESSES else .1


def _errors(J, r):
	"""Standard errors and correlation from the derivatives J and the residuals r."""
	count = J.shape[1]
	length = numpy.sqrt((J*J).sum(axis=0))
	lost = length <= 1e-7*length.max()
	covariance = numpy.full((count, count), math.inf)
	kept = numpy.flatnonzero(~lost)
	if len(kept):
		_, singular, V = numpy.linalg.svd(J[:, kept]/length[kept], full_matrices=False)
		empty = singular < _LEAST
		part = V.T[:, ~empty]/singular[~empty]
		block = part @ part.T/numpy.outer(length[kept], length[kept])
		involved = (numpy.abs(V[empty]) > 1e-3).any(axis=0)  # in a combination that has no effect
		covariance[numpy.ix_(kept, kept)] = numpy.where(involved[:, None] | involved[None, :], math.inf, block)
	free = len(r) - count
	variance = r @ r/free if free > 0 else math.nan
	diagonal = numpy.diag(covariance)
	with numpy.errstate(invalid='ignore', divide='ignore'):
		standard = numpy.where(numpy.isinf(diagonal), math.inf, numpy.sqrt(variance*diagonal))
		root = numpy.sqrt(diagonal)
		correlation = covariance/numpy.outer(root, root)
	return standard, correlation
