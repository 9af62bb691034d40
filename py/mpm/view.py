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
	:raises ValueError: if there is no such quantity or colour map, or it is not one number a point
	"""
	import matplotlib
	values = array(quantity) if isinstance(quantity, str) else numpy.asarray(quantity, dtype=float)
	ids = array('id')
	if values.shape != ids.shape:
		raise ValueError('mpm.color: quantity has shape %s: give one number a point, shape %s, e.g. mpm.array(%r)[:,0,0]' % (values.shape, ids.shape, 'stress'))
	if len(ids) == 0: raise ValueError('mpm.color: there are no material points; make them with mpm.fill()')
	if colormap not in matplotlib.colormaps: raise ValueError('mpm.color: colormap = %r: matplotlib has none of this name; try viridis, jet or coolwarm' % (colormap,))
	low, high = (float(values.min()), float(values.max())) if limits is None else map(float, limits)
	shade = (values - low)/(high - low) if high > low else numpy.zeros(len(values))
	for i, rgb in zip(ids.tolist(), matplotlib.colormaps[colormap](shade)[:, :3].tolist()):
		if i >= 0: O.bodies[i].shape.color = rgb
	return low, high
