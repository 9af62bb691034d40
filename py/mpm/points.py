# SPDX-License-Identifier: GPL-2.0-or-later
"""Making material points, and looking at them."""

import math

import numpy
from yade import wrapper
from yade.minieigenHP import Vector3

O = wrapper.Omega()


def fill(region, spacing, material, thickness=None, velocity=(0, 0, 0), bodies=True, axisymmetric=False):
	"""Fill a region with material points and return their ids.

	Points stand at min + (i + 1/2) spacing along each axis, min being the lower corner of the region or of its bounding box;
	every point stands for a cube (with thickness: a square times the thickness) of that size.

	:param region: what to fill: a box as its two corners, ``((x0, y0), (x1, y1))`` in the plane or ``((x0, y0, z0), (x1, y1, z1))``,
		or a predicate of :yref:`yade.pack`, which takes the points whose centre is inside it; in a plane problem its section at z = 0
	:param float spacing: distance between points [m]
	:param material: a material of the scene, its label or its index; density sets the points' mass
	:param float thickness: of a plane problem [m]: one layer of points at z = 0, each of volume spacing^2 thickness;
		without it, a 3D lattice of points of volume spacing^3
	:param velocity: initial velocity [m/s], a vector of 3
	:param bool bodies: whether every point becomes a body of O.bodies (a Sphere of radius spacing/2 with an MpmState).
		Without, points are cheaper, invisible to other engines, and have negative ids.
	:param bool axisymmetric: points are full rings about the axis x = 0: the region is half the section through it, x the radius
		and y along the axis, and every point has the volume 2 pi x spacing^2; takes no thickness
	:returns: list of ids: of the bodies in O.bodies, or negative
	:raises ValueError: for a spacing, thickness, region or velocity that makes no points
	:raises KeyError: if there is no such material
	"""
	_positive('spacing', spacing)
	if thickness is not None: _positive('thickness', thickness)
	if axisymmetric and thickness is not None:
		raise ValueError('mpm.fill: thickness = %r with axisymmetric=True: rings have none; leave it out' % thickness)
	plane = axisymmetric or thickness is not None
	velocity = numpy.asarray(velocity, dtype=float)
	if velocity.shape != (3,) or not numpy.isfinite(velocity).all():
		raise ValueError('mpm.fill: velocity = %s: give three finite components [m/s]' % (velocity,))
	if plane and velocity[2] != 0:
		raise ValueError('mpm.fill: velocity = %s: points of a plane problem do not move along z' % (velocity,))

	inside = None
	if callable(region) and hasattr(region, 'aabb'):
		lower, upper = (numpy.array([float(x) for x in corner]) for corner in region.aabb())
		inside = region
		if plane: lower, upper = lower[:2], upper[:2]
	else:
		try:
			lower, upper = (numpy.array([float(x) for x in corner]) for corner in region)
		except (TypeError, ValueError):
			raise ValueError('mpm.fill: region = %r: give two corners, ((x0,y0),(x1,y1)) or ((x0,y0,z0),(x1,y1,z1)), or a predicate of yade.pack' % (region,)) from None
	if lower.size != upper.size or lower.size != (2 if plane else 3):
		raise ValueError('mpm.fill: region = %r: %s' % (region, 'the region is plane with a thickness or axisymmetric=True; give two corners of two coordinates'
			if plane else 'a 3D region needs two corners of three coordinates; give a thickness for a plane one'))

	axes = [_lattice(lower[d], upper[d], spacing) for d in range(lower.size)]
	if plane: axes.append(numpy.zeros(1))
	positions = numpy.ascontiguousarray(numpy.stack(numpy.meshgrid(*axes, indexing='ij'), axis=-1).reshape(-1, 3))
	if inside is not None:
		candidates = (x for begin in range(0, len(positions), 10000) for x in positions[begin:begin + 10000].tolist())  # Python is slow with many lists at a time
		if not type(inside).__module__.endswith('_packPredicates'): candidates = (Vector3(*x) for x in candidates)  # YADE's own take a list for a point, in half the time
		positions = positions[numpy.fromiter((inside(x, 0) for x in candidates), bool, len(positions))]
	if len(positions) == 0:
		raise ValueError('mpm.fill: region = %r: no point lies inside it; choose a spacing smaller than %g m or check the region%s'
			% (region, spacing, ', of which a plane problem takes the section at z = 0' if plane and inside else ''))
	if axisymmetric and not (positions[:, 0] > 0).all():
		raise ValueError('mpm.fill: region = %r: with axisymmetric=True x is the radius; give a region at x >= 0' % (region,))
	return _points(create=True).append(positions, spacing, thickness or 0., axisymmetric, _material(material), Vector3(*velocity), bodies)


def array(name):
	"""One quantity of all material points as a NumPy array (a copy).

	Points come in the order they were made in, the same for every quantity and at every time: bodies by id, then points
	without a body.

	:param str name: 'id', 'material' (its index in O.materials) (N,), 'position' [m], 'displacement' (from the place it was
		filled at, NaN for points without bodies) [m], 'velocity' [m/s] (N,3), 'mass' [kg], 'volume' [m3], 'plasticStrain' [-],
		'vonMises' [Pa], 'angularVelocity' (with MpmEngine.transfer = 'affine', else 0; (N,3)) [rad/s], 'dissipation' (heat per undeformed volume [J/m3], kept while O.trackEnergy) (N,), 'stress',
		'backStress' [Pa], 'strain', 'F' [-] (N,3,3); see :yref:`MpmState` for their meaning
	:raises ValueError: if there is no such quantity
	"""
	data, kind, shape = _points().array(name)
	return numpy.frombuffer(data, dtype=kind).reshape(shape)


def angularMomentum(about=(0, 0, 0)):
	"""Angular momentum of all material points about a place [kg m2/s], as a Vector3.

	sum m (x - about) x v and, with MpmEngine.transfer = 'affine', the rotation that the points carry, sum J W: J = m (D_a + D_b)
	about the axis normal to a and b, D = h^2/3 with 'cubic' functions, h^2/4 with 'quadratic' ones, and W their
	'angularVelocity'. Along the axis of a ring (analysis 'axisymmetric') it has no meaning.

	:param about: the place [m]
	"""
	return _points().angularMomentum(Vector3(*about))


def criticalTimeStep():
	"""Largest stable time step of the scene as it stands [s].

	The smaller of 2/omega, with omega the highest frequency of the discrete equations with elastic stiffness (by Lanczos'
	iteration on the points and the grid as they stand), and the time in which the fastest point crosses a cell, combined as
	rates. ``O.dt = .4*mpm.criticalTimeStep()`` leaves room for what changes during a run.

	:raises RuntimeError: if O.engines has no MpmEngine, or the scene is not fit to run
	"""
	return _engine().criticalTimeStep()


def _engine():
	for engine in O.engines:
		if isinstance(engine, wrapper.MpmEngine): return engine
	raise RuntimeError('mpm: O.engines has no MpmEngine; add MpmEngine(cellSize=...) to it first')


def _points(create=False):
	for item in O.miscParams:
		if isinstance(item, wrapper.MpmPoints): return item
	points = wrapper.MpmPoints()
	if create: O.miscParams = list(O.miscParams) + [points]
	return points


def findMaterial(material, caller):
	"""A material of O.materials by label or index; KeyError that names the caller and what there is."""
	try:
		return O.materials[material]
	except (KeyError, IndexError, RuntimeError, TypeError):
		raise KeyError('%s: material = %r: there is no such material; O.materials has %s'
			% (caller, material, [m.label or m.id for m in O.materials] or 'none; append one first')) from None


def _material(material):
	if not isinstance(material, wrapper.Material): return findMaterial(material, 'mpm.fill')
	if any(material is m or material == m for m in O.materials): return material
	raise KeyError('mpm.fill: material %r is not in O.materials; append it first' % material)


def _positive(name, value):
	if not (isinstance(value, (int, float, numpy.floating, numpy.integer)) and math.isfinite(value) and value > 0):
		raise ValueError('mpm.fill: %s = %r: give a finite value > 0 [m]' % (name, value))


def _lattice(lower, upper, spacing):
	if not (math.isfinite(lower) and math.isfinite(upper)):
		raise ValueError('mpm.fill: the region is unbounded, from %g to %g m; intersect it with a box' % (lower, upper))
	# half a spacing of slack would count a point whose cube is more out than in; rounding must not cost a layer
	count = int(math.floor((upper - lower)/spacing + .5))
	return lower + (numpy.arange(max(count, 0)) + .5)*spacing
