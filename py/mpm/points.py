# SPDX-License-Identifier: GPL-2.0-or-later
"""Making material points, and looking at them."""

import math
import os

import numpy
from yade import wrapper
from yade.minieigenHP import Vector3

from . import quadrature

O = wrapper.Omega()


def fill(region, spacing=None, material=None, thickness=None, velocity=(0, 0, 0), bodies=True, axisymmetric=False, placement='uniform', points=None,
		cellSize=None, origin=None, group=None, stress=None, mask=None, color=None):
	"""Fill a region with material points and return their ids.

	With ``placement='uniform'`` points stand at min + (i + 1/2) spacing along each axis, min being the lower corner of the region or of its
	bounding box, and every point stands for a cuboid (in the plane: a rectangle times the thickness) of that size. A side that is
	no multiple of the spacing is divided into the whole number of equal parts whose size is nearest to the spacing: the volume of a
	box is exact.

	With ``placement='gauss'`` points stand at the Gauss-Legendre places of the grid's cells, points an axis, with their weights as
	volumes. The volume of a box is exact, and stress that varies within a cell is integrated to a higher order: six layers of points in
	bending are 2.8 % too soft at uniform places and 0.4 % too stiff at Gauss places (doc/verification/cantilever-static.md). Place the region so that
	its lower corner is on a node of the grid, which has nodes on walls and, along an axis without walls, at multiples of cellSize; or
	give an origin. In cells that the surface of a predicate cuts, points stand at uniform places, points an axis, where these are in it.

	:param region: what to fill: a box as its two corners, ``((x0, y0), (x1, y1))`` in the plane or ``((x0, y0, z0), (x1, y1, z1))``,
		or a predicate of :yref:`yade.pack`, which takes the points whose centre is inside it; in a plane problem its section at z = 0
	:param float spacing: distance between points [m]; uniform placement also takes cellSize and points, spacing = cellSize/points
	:param material: a material of the scene, its label or its index; density sets the points' mass
	:param float thickness: of a plane problem [m]: one layer of points at z = 0; without it, a 3D lattice
	:param velocity: initial velocity [m/s], a vector of 3
	:param bool bodies: whether every point becomes a body of O.bodies (a Sphere with an MpmState). Its radius is half the size of the
		point, that is of the square (3D: the cube) of the point's area (volume): spacing/2 at uniform places.
		Without, points are cheaper, invisible to other engines, and have negative ids.
	:param bool axisymmetric: points are full rings about the axis x = 0: the region is half the section through it, x the radius
		and y along the axis, and the volume of every point is 2 pi x times its area; takes no thickness
	:param str placement: 'uniform' or 'gauss'
	:param int points: points a cell and axis, 1 to 10; with 'gauss' 3 unless given
	:param float cellSize: of the grid [m]; cells begin at the lower corner of the region. In a box a whole number of them is fitted to
		each side, as :yref:`MpmEngine` fits the grid's between two walls.
	:param origin: with 'gauss': a node of the grid [m], where the region's lower corner is none; the cells are those of this grid, cut by the
		box, and pieces shorter than a quarter of a cell are joined to their neighbour
	:param group: name, or number from 1 to 255, of the body that the points belong to; ``mpm.array('group')`` has the numbers, 0 for none.
		Points of one group, of any number of calls, are one continuum. Points of different groups, points without a group being one more,
		move independently: they meet by contact, with the friction of the smaller frictionAngle of their materials, and part freely.
		Groups may touch at the start; the first step raises an error, with the depth, where they overlap by more than a quarter of the spacing.
	:param stress: initial Cauchy stress [Pa], tension positive: a 3x3 tensor, or a function of the position (a Vector3) that returns one
	:param int mask: :yref:`Body.mask` of the bodies
	:param color: colour of the bodies, three numbers in [0, 1]
	:returns: list of ids: of the bodies in O.bodies, or negative
	:raises ValueError: for a spacing, thickness, region, velocity, stress, ... that makes no points
	:raises KeyError: if there is no such material
	"""
	call = 'mpm.fill'
	axisymmetric, bodies = flag(call, 'axisymmetric', axisymmetric), flag(call, 'bodies', bodies)
	if thickness is not None: positive('thickness', thickness)
	if axisymmetric and thickness is not None:
		raise ValueError('mpm.fill: thickness = %r with axisymmetric=True: rings have none; leave it out' % thickness)
	plane = axisymmetric or thickness is not None
	spacing, cellSize, points = _places(spacing, cellSize, points, placement)
	if origin is not None and placement != 'gauss': raise ValueError("mpm.fill: origin = %r: only placement='gauss' follows cells; leave it out" % (origin,))
	velocity = vector(call, 'velocity', velocity, 'three finite components [m/s]')
	lower, upper, inside = _region(region, plane)
	if origin is not None: origin = vector(call, 'origin', origin, 'a node of the grid, %d finite coordinates [m]' % len(lower), len(lower))
	_affordable(region, (upper - lower)/spacing, spacing)

	reach = None
	if placement == 'uniform':
		axes = [quadrature.uniformAxis(a, b, spacing) for a, b in zip(lower, upper)]
		position, measure = quadrature.product(*zip(*axes))
		if inside is not None:
			kept = quadrature.insideOf(inside, position)
			reach = quadrature.reachInside(inside, kept, [a for a, _ in axes], spacing) if kept.any() else None
			position, measure = position[kept], measure[kept]
	else:
		edges = [quadrature.cellEdges(a, b, cellSize, None if origin is None else origin[d], inside is None) for d, (a, b) in enumerate(zip(lower, upper))]
		if inside is None:
			position, measure = quadrature.product(*zip(*[quadrature.gaussAxis(e, points) for e in edges]))
			if len(position): reach = quadrature.reachOfBox(position, lower, [e[-1] for e in edges], cellSize/points)
		else: position, measure = quadrature.gaussInside(inside, edges, points)
	if len(position) == 0:
		raise ValueError('mpm.fill: region = %r: no point lies inside it; choose a spacing smaller than %g m or check the region%s'
			% (region, spacing, ', of which a plane problem takes the section at z = 0' if plane and inside else ''))
	if axisymmetric and not (position[:, 0] > 0).all():
		raise ValueError('mpm.fill: region = %r: with axisymmetric=True x is the radius; give a region at x >= 0' % (region,))
	if plane: position = numpy.column_stack((position, numpy.zeros(len(position))))
	depth = -2*math.pi*position[:, 0] if axisymmetric else numpy.full(len(position), float(thickness or 0))
	size = None if placement == 'gauss' else spacing if (numpy.ptp(measure) == 0 and all(w[0] == spacing for _, w in axes)) else None
	return _append(call, position, velocity, measure*abs(depth) if plane else measure, depth, size, None, material, bodies, group, stress, mask, color, reach)


def points(position, volume, material, velocity=None, stress=None, bodies=True, group=None, thickness=None, axisymmetric=False, density=None, mask=None,
		color=None):
	"""Make material points from arrays, at any places, and return their ids.

	The N points stand where position puts them, each with a volume of its own: quadrature points of a mesh (:yref:`mpm.readMesh`), a
	random cloud, the state of another program. The size of a point, for GIMP, contacts and the 3D view, is the side of the square (3D:
	the cube) of its area (volume).

	:param position: (N,3), or (N,2) of points in the plane [m]
	:param volume: (N,) or one for all [m3]: of a plane problem area times thickness, of a ring 2 pi x times its area
	:param material: a material of the scene, its label or its index
	:param velocity: (N,3), or three components for all [m/s]; at rest unless given
	:param stress: initial Cauchy stress [Pa], tension positive: (N,3,3), a 3x3 tensor for all, or a function of the position
	:param bool bodies: whether every point becomes a body of O.bodies; see :yref:`mpm.fill`
	:param group: name or number of the points' group; see :yref:`mpm.fill`
	:param float thickness: of a plane problem [m]; without it, points of a 3D one
	:param bool axisymmetric: points are full rings about the axis x = 0
	:param density: (N,) or one for all [kg/m3]; the material's unless given
	:param int mask: :yref:`Body.mask` of the bodies
	:param color: colour of the bodies, three numbers in [0, 1]
	:returns: list of ids, in the order of position
	:raises ValueError: for an array of a wrong shape, or a value that a point cannot have, with its row
	:raises KeyError: if there is no such material
	"""
	call = 'mpm.points'
	axisymmetric, bodies = flag(call, 'axisymmetric', axisymmetric), flag(call, 'bodies', bodies)
	if thickness is not None: positive('thickness', thickness, call)
	if axisymmetric and thickness is not None:
		raise ValueError('mpm.points: thickness = %r with axisymmetric=True: rings have none; leave it out' % thickness)
	plane = axisymmetric or thickness is not None
	position = rows(call, 'position', position, (3,), 'an array (N,3) of finite coordinates [m]', (2,) if plane else None)
	if position.shape[1] == 2: position = numpy.column_stack((position, numpy.zeros(len(position))))
	if len(position) == 0: raise ValueError('mpm.points: position has no rows: give at least one point')
	if plane and (position[:, 2] != 0).any():
		row = int(numpy.flatnonzero(position[:, 2])[0])
		raise ValueError('mpm.points: position[%d] = %s: points of a plane problem lie at z = 0' % (row, position[row]))
	if axisymmetric and not (position[:, 0] > 0).all():
		row = int(numpy.flatnonzero(~(position[:, 0] > 0))[0])
		raise ValueError('mpm.points: position[%d] = %s: with axisymmetric=True x is the radius; give points at x > 0' % (row, position[row]))
	volume = _positives(call, 'volume', volume, len(position), '[m3]')
	if density is not None: density = _positives(call, 'density', density, len(position), '[kg/m3]')
	velocity = (0, 0, 0) if velocity is None else velocity
	if numpy.ndim(velocity) == 2: velocity = rows(call, 'velocity', velocity, (3,), 'an array (N,3) of finite components [m/s]', count=len(position))
	else: velocity = vector(call, 'velocity', velocity, 'three finite components, or an array (N,3) of them [m/s]')
	depth = -2*math.pi*position[:, 0] if axisymmetric else numpy.full(len(position), float(thickness or 0))
	return _append(call, position, velocity, volume, depth, None, density, material, bodies, group, stress, mask, color)


def setStress(ids, stress):
	"""Give points an initial stress.

	The points keep their places, volumes and deformation; their elastic strain is the one that the stress needs, their back stress and
	plastic strain start from zero. The engine refuses, at its next step, a stress beyond a law's yield surface or out of the plane of a plane analysis.

	:param ids: ids of points, or None for all
	:param stress: Cauchy stress [Pa], tension positive: (N,3,3) in the order of ids (of ``mpm.array('id')``), a 3x3 tensor for all, or a
		function of the position (a Vector3) that returns one
	:raises ValueError: for a stress that is no symmetric finite tensor, or ids of no points
	"""
	holder, known = _points(), array('id')
	if len(known) == 0: raise ValueError('mpm.setStress: the scene has no material points; make them with mpm.fill() first')
	if ids is None: ids = known.tolist()
	try: ids = [int(i) for i in ids]
	except (TypeError, ValueError): raise ValueError('mpm.setStress: ids = %r: give a list of ids, or None for all points' % (ids,)) from None
	place = {int(i): k for k, i in enumerate(known)}
	for i in ids:
		if i not in place: raise ValueError('mpm.setStress: ids: there is no material point %d; see mpm.array(\'id\')' % i)
	if not ids: return
	holder.setStress(ids, _stresses('mpm.setStress', stress, array('position')[[place[i] for i in ids]]))


def array(name):
	"""One quantity of all material points as a NumPy array (a copy).

	Points come in the order they were made in, the same for every quantity and at every time: bodies by id, then points
	without a body.

	:param str name: 'id', 'material' (its index in O.materials), 'group' (its number, 0: none) (N,), 'position' [m], 'displacement' (from the place it was
		filled at, NaN for points without bodies) [m], 'velocity' [m/s] (N,3), 'mass' [kg], 'volume' [m3], 'size' (side of the undeformed point) [m], 'plasticStrain' [-],
		'vonMises' [Pa], 'dissipation' (heat per undeformed volume [J/m3], kept while O.trackEnergy) (N,), 'stress',
		'backStress' [Pa], 'strain', 'F' [-] (N,3,3); see :yref:`MpmState` for their meaning
	:raises ValueError: if there is no such quantity
	"""
	if not isinstance(name, str): raise ValueError("mpm.array: name = %r: give the name of a quantity, e.g. 'stress'" % (name,))
	data, kind, shape = _points().array(name)
	return numpy.frombuffer(data, dtype=kind).reshape(shape)


def criticalTimeStep():
	"""Largest stable time step of the scene as it stands [s].

	The smaller of 2/omega, with omega the highest frequency of the discrete equations with elastic stiffness (by Lanczos'
	iteration on the points and the grid as they stand), and the time in which the fastest point crosses a cell, combined as
	rates. ``O.dt = .4*mpm.criticalTimeStep()`` leaves room for what changes during a run.

	:raises RuntimeError: if O.engines has no MpmEngine, or the scene is not fit to run
	"""
	return _engine().criticalTimeStep()


def _engine():
	engines = [engine for engine in O.engines if isinstance(engine, wrapper.MpmEngine)]
	if engines: return next((engine for engine in engines if not engine.dead), engines[0])
	raise RuntimeError('mpm: O.engines has no MpmEngine; add MpmEngine(cellSize=...) to it first')


def _points(create=False):
	if create: return wrapper.MpmPoints.ofScene()
	for item in O.miscParams:
		if isinstance(item, wrapper.MpmPoints): return item
	return wrapper.MpmPoints()


def findMaterial(material, caller):
	"""A material of O.materials by label or index; KeyError that names the caller and what there is."""
	try:
		return O.materials[material]
	except (KeyError, IndexError, RuntimeError, TypeError, OverflowError):
		labels = [m.label or m.id for m in O.materials]
		raise KeyError('%s: material = %r: there is no such material; %s'
			% (caller, material, 'give one of O.materials, by its label or index: %s' % labels if labels else 'O.materials has none; append one first')) from None


def _material(material, caller):
	if not isinstance(material, wrapper.Material): return findMaterial(material, caller)
	if any(material is m or material == m for m in O.materials): return material
	raise KeyError('%s: material %r is not in O.materials; append it first' % (caller, material))


# ---- checks of arguments ------------------------------------------------------------------------------------------------

def isNumber(value): return isinstance(value, (int, float, numpy.floating, numpy.integer)) and not isinstance(value, bool)


def isWhole(value): return isNumber(value) and math.isfinite(value) and int(value) == value


def positive(name, value, caller='mpm.fill'):
	"""ValueError unless value is a finite length > 0."""
	if not (isNumber(value) and math.isfinite(value) and value > 0):
		raise ValueError('%s: %s = %r: give a finite value > 0 [m]' % (caller, name, value))


def flag(caller, name, value):
	"""True or False, or ValueError."""
	if isinstance(value, (bool, numpy.bool_)) or (isNumber(value) and value in (0, 1)): return bool(value)
	raise ValueError('%s: %s = %r: give True or False' % (caller, name, value))


def vector(caller, name, value, wanted, size=3):
	"""Finite components as an array."""
	try: array = numpy.array([float(x) for x in value])
	except (TypeError, ValueError): array = None
	if array is None or array.shape != (size,) or not numpy.isfinite(array).all():
		raise ValueError('%s: %s = %s: give %s' % (caller, name, array if array is not None else repr(value), wanted))
	return array


def rows(caller, name, value, shape, wanted, other=None, count=None):
	"""Finite numbers as an array of rows of a shape (or another one)."""
	try: array = numpy.ascontiguousarray([[float(x) for x in row] for row in value] if not isinstance(value, numpy.ndarray) else value, dtype=float)
	except (TypeError, ValueError): raise ValueError('%s: %s: give %s' % (caller, name, wanted)) from None
	if array.size == 0: return numpy.zeros((0,) + shape)
	if array.ndim < 2 or (array.shape[1:] != shape and array.shape[1:] != other) or (count is not None and len(array) != count):
		raise ValueError('%s: %s has shape %s: give %s%s' % (caller, name, array.shape, wanted, '' if count is None else ', N = %d' % count))
	bad = ~numpy.isfinite(array.reshape(len(array), -1)).all(axis=1)
	if bad.any(): raise ValueError('%s: %s[%d] = %s: give %s' % (caller, name, bad.argmax(), array[bad.argmax()], wanted))
	return array


def _positives(caller, name, value, count, unit):
	wanted = 'finite values > 0 %s, one for all or an array of %d' % (unit, count)
	try: array = numpy.asarray(value, dtype=float)
	except (TypeError, ValueError): raise ValueError('%s: %s = %r: give %s' % (caller, name, value, wanted)) from None
	if array.shape not in ((), (count,)): raise ValueError('%s: %s has shape %s: give %s' % (caller, name, array.shape, wanted))
	array = numpy.array(numpy.broadcast_to(array, (count,)))
	bad = ~(numpy.isfinite(array) & (array > 0))
	if bad.any(): raise ValueError('%s: %s[%d] = %r: give %s' % (caller, name, bad.argmax(), float(array[bad.argmax()]), wanted))
	return array


def _stresses(caller, stress, position):
	"""(N,3,3) from a tensor, an array or a function of position."""
	wanted = 'a symmetric 3x3 tensor [Pa], an array (N,3,3) of them, or a function of the position that returns one'
	def tensor(value):
		try: return numpy.array([[float(x) for x in row] for row in value])
		except (TypeError, ValueError): raise ValueError('%s: stress = %r: give %s' % (caller, value, wanted)) from None
	if callable(stress): array = numpy.array([tensor(stress(Vector3(*x))) for x in position.tolist()])
	elif numpy.ndim(stress) == 3: array = numpy.array(stress, dtype=float)
	else: array = tensor(stress)
	if array.shape not in ((3, 3), (len(position), 3, 3)): raise ValueError('%s: stress has shape %s: give %s, N = %d' % (caller, array.shape, wanted, len(position)))
	array = numpy.ascontiguousarray(numpy.broadcast_to(array, (len(position), 3, 3)))
	scale = numpy.abs(array).max(axis=(1, 2))
	bad = ~(numpy.isfinite(array).all(axis=(1, 2)) & (numpy.abs(array - array.transpose(0, 2, 1)).max(axis=(1, 2)) <= 1e-12*scale))
	if bad.any(): raise ValueError('%s: stress of point %d at %s = %s: give %s' % (caller, bad.argmax(), position[bad.argmax()], array[bad.argmax()].tolist(), wanted))
	return array


def _places(spacing, cellSize, points, placement):
	"""Spacing, size of cells and points a cell and axis, of which a call gives some."""
	if placement not in ('uniform', 'gauss'): raise ValueError("mpm.fill: placement = %r: choose 'uniform' or 'gauss'" % (placement,))
	if points is not None and not (isWhole(points) and 1 <= points <= 10):
		raise ValueError('mpm.fill: points = %r: give the points a cell and axis, a whole number from 1 to 10' % (points,))
	if cellSize is not None: positive('cellSize', cellSize)
	if placement == 'gauss':
		points = int(points or 3)
		if cellSize is None: raise ValueError("mpm.fill: cellSize = None: placement='gauss' puts points into the cells of the grid; give MpmEngine's cellSize [m]")
	elif spacing is None and cellSize is not None and points is not None: spacing = cellSize/points
	if placement == 'uniform' or spacing is not None: positive('spacing', spacing)
	if points and cellSize and spacing is not None and abs(spacing*points/cellSize - 1) > 1e-9:
		raise ValueError('mpm.fill: spacing = %r: cellSize/points is %g m; leave the spacing out' % (spacing, cellSize/points))
	return float(spacing or cellSize/points), cellSize, points


def _region(region, plane):
	"""Lower and upper corner of a region, and its predicate or None."""
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
		raise ValueError('mpm.fill: region = %r: %s' % (region, 'the region is plane with a thickness or axisymmetric=True; give two corners of two coordinates, '
			"or leave the thickness out for a 3D region (MpmEngine.analysis = '3d')" if plane else 'a 3D region needs two corners of three coordinates; give a thickness for a plane one'))
	for a, b in zip(lower, upper):
		if not (math.isfinite(a) and math.isfinite(b)): raise ValueError('mpm.fill: region = %r: the region is unbounded, from %g to %g m; intersect it with a box' % (region, a, b))
	return lower, upper, inside


def _affordable(region, counts, spacing):
	"""ValueError where the points would not fit into the machine's memory: a point takes at least 400 bytes while it is made."""
	count = float(numpy.prod(numpy.maximum(counts, 1)))
	memory = os.sysconf('SC_PAGE_SIZE')*os.sysconf('SC_PHYS_PAGES')
	if not count < min(2.**31, memory/400.):
		raise ValueError('mpm.fill: spacing = %g: the region %r holds %.3g places for points, more than the machine\'s memory (%.3g bytes); '
			'choose a larger spacing or a smaller region' % (spacing, region, count, memory))


def _append(caller, position, velocity, volume, depth, size, density, material, bodies, group, stress, mask, color, reach=None):
	"""Hands new points to the scene: all of them, or none."""
	material = _material(material, caller)
	n, plane = len(position), bool(depth[0] != 0)
	velocity = numpy.array(numpy.broadcast_to(velocity, (n, 3)))
	if plane and (velocity[:, 2] != 0).any():
		raise ValueError('%s: velocity = %s: points of a plane problem do not move along z' % (caller, velocity[(velocity[:, 2] != 0).argmax()]))
	if mask is not None and not (isWhole(mask) and 0 <= mask < 2**31):
		raise ValueError('%s: mask = %r: give a whole number from 0 to 2^31 - 1' % (caller, mask))
	if color is not None: color = Vector3(*vector(caller, 'color', color, 'three numbers in [0, 1]'))
	if color is not None and not all(0 <= c <= 1 for c in color): raise ValueError('%s: color = %s: give three numbers in [0, 1]' % (caller, color))
	if not bodies and (mask is not None or color is not None): raise ValueError('%s: mask = %r, color = %r with bodies=False: points without bodies have neither; leave them out' % (caller, mask, color))
	if group is not None and not (isinstance(group, str) and group) and not (isWhole(group) and 0 <= group <= 255):
		raise ValueError('%s: group = %r: give a name, or a number from 0 (none) to 255' % (caller, group))
	name = group if isinstance(group, str) else ''
	if size is None: size = numpy.sqrt(volume/numpy.abs(depth)) if plane else numpy.cbrt(volume)
	columns = {'position': position, 'velocity': velocity, 'volume': volume, 'mass': (material.density if density is None else density)*volume,
		'size': numpy.broadcast_to(size, (n,)), 'depth': depth}
	if reach is not None and reach.any(): columns['reach'] = reach
	if stress is not None: columns['stress'] = _stresses(caller, stress, position)
	try: return _points(create=True).append({k: numpy.ascontiguousarray(v, dtype=float) for k, v in columns.items()}, material, 0 if name or group is None else int(group), name, bool(bodies), None if mask is None else int(mask), color)
	except ValueError as fault: raise ValueError('%s: %s' % (caller, fault)) from None
