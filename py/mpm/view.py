# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points in YADE's 3D view, coloured by what they carry."""

import numpy
from yade import wrapper

from .points import array

O = wrapper.Omega()


def color(quantity='vonMises', limits=None, colormap='viridis'):
	"""Colour the points' bodies for the 3D view and VTKRecorder by a quantity. Points without bodies are not seen.

	Colours stay until the next call; to follow a run, ``PyRunner(realPeriod=.5, command='mpm.color()')``.

	:param quantity: name of a quantity of :yref:`mpm.array` with one number a point, or an array of N numbers in its order
	:param limits: values of the two ends of the colour map, in the quantity's unit; without them its least and greatest value
	:param str colormap: name of a colour map of matplotlib
	:returns: the limits used
	:raises ValueError: if there is no such quantity or colour map, if the quantity is not one number a point, or the limits are not two
		finite numbers, the first one below the second
	"""
	import matplotlib
	try: values = array(quantity) if isinstance(quantity, str) else numpy.asarray(quantity, dtype=float)
	except (TypeError, ValueError) as fault:
		if isinstance(quantity, str): raise ValueError('mpm.color: quantity = %r: %s' % (quantity, fault)) from None
		raise ValueError('mpm.color: quantity = %r: give the name of a quantity of mpm.array, or one number a point' % (quantity,)) from None
	ids = array('id')
	if values.shape != ids.shape:
		raise ValueError('mpm.color: quantity has shape %s: give one number a point, shape %s, e.g. mpm.array(%r)[:,0,0]' % (values.shape, ids.shape, 'stress'))
	if len(ids) == 0: raise ValueError('mpm.color: there are no material points; make them with mpm.fill()')
	if not isinstance(colormap, str) or colormap not in matplotlib.colormaps: raise ValueError('mpm.color: colormap = %r: matplotlib has no colour map of this name; give one that it has, e.g. viridis, jet or coolwarm' % (colormap,))
	low, high = _limits(values, limits)
	shade = (values - low)/(high - low) if high > low else numpy.zeros(len(values))
	for i, rgb in zip(ids.tolist(), matplotlib.colormaps[colormap](shade)[:, :3].tolist()):
		body = O.bodies[i] if 0 <= i < len(O.bodies) else None  # none: without one, or erased since the last step
		if body is not None and body.shape is not None: body.shape.color = rgb
	return low, high


def _limits(values, limits):
	if limits is None: return float(values.min()), float(values.max())
	try: low, high = map(float, limits)
	except (TypeError, ValueError): low, high = 0, 0
	if not -numpy.inf < low < high < numpy.inf:
		raise ValueError('mpm.color: limits = %r: give two finite numbers, the lesser one first, or None for the least and the greatest value' % (limits,))
	return low, high
