# SPDX-License-Identifier: GPL-2.0-or-later
"""Drive one material point along a strain path, to calibrate a material or to examine a law."""

import numpy
from yade import wrapper

from .points import findMaterial

_AXES = ('xx', 'yy', 'zz')


class PointHistory:
	"""History of a material point, at each of the N entries of its path.

	:ivar stress: Cauchy stress [Pa], (N,3,3), tension positive
	:ivar strain: strain [-], (N,3,3) with tensorial shear, including the computed free components
	:ivar backStress: back stress [Pa], (N,3,3); without components along free directions
	:ivar plasticStrain: accumulated equivalent plastic strain [-], (N,)
	:ivar dissipation: accumulated heat per volume [J/m3], (N,)
	"""

	def __init__(self, raw):
		for name in ('stress', 'strain', 'backStress'): setattr(self, name, numpy.frombuffer(raw[name]).reshape(-1, 3, 3))
		for name in ('plasticStrain', 'dissipation'): setattr(self, name, numpy.frombuffer(raw[name]))

	def __repr__(self): return '<mpm.PointHistory of %d entries: stress, strain, backStress, plasticStrain, dissipation>' % len(self.plasticStrain)


def drive(material, strain, free=()):
	"""Drive one material point, initially free of stress, along a path of small strains.

	The strain varies linearly between two entries, and from zero to the first one. The law integrates it to its own
	tolerance. The path has neither rotation nor geometry.

	:param material: a material, or label or index of one in O.materials
	:param strain: path [-], N symmetric matrices with tensorial shear (gamma_xy = 2 strain[0,1]): an array (N,3,3) or a
		sequence of Matrix3
	:param free: names of normal components with zero stress instead of a prescribed strain: ``('zz',)`` is plane stress,
		``('yy', 'zz')`` a bar under tension along x; their strains in the path are ignored
	:returns: :yref:`PointHistory` with arrays stress, strain, backStress, plasticStrain, dissipation
	:raises ValueError: for a path or names of another form; the message names entry and component
	:raises RuntimeError: if the material's parameters are not admissible
	"""
	path = _path(strain)
	free = (free,) if isinstance(free, str) else free
	if not isinstance(free, (tuple, list, set)) or any(name not in _AXES for name in free):
		raise ValueError('mpm.drive: free = %r: choose among %s' % (free, _AXES))
	if not isinstance(material, wrapper.Material): material = findMaterial(material, 'mpm.drive')
	try:
		return PointHistory(wrapper.MpmPoints.drive(material, path, *(name in free for name in _AXES)))
	except ValueError as fault:
		raise ValueError('mpm.drive: %s' % fault) from None


def _path(strain):
	"""Return the path as a contiguous array (N,3,3)."""
	try:
		path = numpy.ascontiguousarray(strain if isinstance(strain, numpy.ndarray) else [[list(row) for row in matrix] for matrix in strain], dtype=float)
		shape = 'shape %s' % (path.shape,)
	except (TypeError, ValueError):
		path, shape = None, 'entries that are not 3x3 numbers'
	if path is None or path.ndim != 3 or path.shape[1:] != (3, 3):
		raise ValueError('mpm.drive: strain has %s: give N symmetric matrices, shape (N,3,3)' % shape)
	return path
