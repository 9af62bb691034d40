# SPDX-License-Identifier: GPL-2.0-or-later
"""One material point through a strain path: to calibrate a material, and to see what a law does."""

import numpy
from yade import wrapper

from .points import findMaterial

_AXES = ('xx', 'yy', 'zz')


class PointHistory:
	"""What a material point went through, at each of the N entries of its path.

	:ivar stress: Cauchy stress [Pa], (N,3,3), tension positive
	:ivar strain: strain [-], (N,3,3) with tensorial shear; the free components as found
	:ivar backStress: back stress [Pa], (N,3,3); without components along free directions
	:ivar plasticStrain: accumulated equivalent plastic strain [-], (N,)
	:ivar dissipation: accumulated heat a volume [J/m3], (N,)
	"""

	def __init__(self, raw):
		for name in ('stress', 'strain', 'backStress'): setattr(self, name, numpy.frombuffer(raw[name]).reshape(-1, 3, 3))
		for name in ('plasticStrain', 'dissipation'): setattr(self, name, numpy.frombuffer(raw[name]))

	def __repr__(self): return '<mpm.PointHistory of %d entries: stress, strain, backStress, plasticStrain, dissipation>' % len(self.plasticStrain)


def drive(material, strain, free=()):
	"""Take one material point, from rest without stress, through a path of small strains, in C++.

	Between two entries the strain grows in a straight line and the law integrates it to its own tolerance; the first entry is
	reached from zero. The path is one of material strain: no rotation, no geometry.

	:param material: a material, or label or index of one in O.materials
	:param strain: path [-], N symmetric matrices with tensorial shear (gamma_xy = 2 strain[0,1]): array (N,3,3) or a sequence of Matrix3
	:param free: names of normal components that are free of stress instead of prescribed: ``('zz',)`` is plane stress,
		``('yy', 'zz')`` a bar under tension along x; what the path says of them is not read
	:returns: :yref:`PointHistory` with arrays stress, strain, backStress, plasticStrain, dissipation
	:raises ValueError: for a path or names that are not of this form (naming entry and component)
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
	"""The path as C++ wants it."""
	try:
		path = numpy.ascontiguousarray(strain if isinstance(strain, numpy.ndarray) else [[list(row) for row in matrix] for matrix in strain], dtype=float)
		shape = 'shape %s' % (path.shape,)
	except (TypeError, ValueError):
		path, shape = None, 'entries that are not 3x3 numbers'
	if path is None or path.ndim != 3 or path.shape[1:] != (3, 3):
		raise ValueError('mpm.drive: strain has %s: give N symmetric matrices, shape (N,3,3)' % shape)
	return path
