# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads on faces."""

import math

import numpy
from yade.minieigenHP import Vector3

from . import points as _points
from . import quadrature


def traction(face, traction=None, pressure=None, thickness=None, axisymmetric=False, times=None, factors=None, cellSize=None, points=3):
	"""Load a face of the material points and return the load, an :yref:`MpmTraction`.

	The load is integrated on the face itself, by massless points that move with the body: the force on a node is the integral
	of its shape function times the traction. Forces on the outermost material points instead act half a spacing inside the face and reach
	other nodes. Make the load after the points that it acts on. With points at Gauss places (:yref:`mpm.fill`) a uniform traction on a
	body at rest gives a uniform stress; with uniform places stresses are up to 8 % off inside and 22 % at the edge of three loaded faces.

	:param face: in the plane (with thickness or axisymmetric): the two ends of a straight segment, ``((x0, y0), (x1, y1))``; in 3D three
		corners of a parallelogram, the second of which is between the other two, or two opposite corners of a rectangle normal to an axis
	:param traction: force an undeformed area [Pa], a vector of 3, or a function of the position (a Vector3) that returns one; it keeps its direction
	:param pressure: force a current area [Pa], > 0 presses on the material, a number or a function of the position; it stays normal to the
		face as the body deforms. One of the two is given. Functions are evaluated once, at the undeformed face.
	:param float thickness: of a plane problem [m]
	:param bool axisymmetric: the face is a ring about the axis x = 0
	:param times: times [s], increasing, for which factors are given; without, the load is constant
	:param factors: factors on the load, one a time: linear between times, constant outside
	:param float cellSize: length of the pieces that the face is divided into for integration [m]; unless given, the size of the material
		points at the face. With the grid's own cellSize, and a corner of the face on a node, integration is exact.
	:param int points: Gauss points a piece and axis, 1 to 10
	:returns: the load; its displacement is that of the face, its force the resultant of the last step
	:raises ValueError: for a face, load or history that is none, or where no material points are next to the face
	"""
	caller = 'mpm.traction'
	if thickness is not None: _points.positive('thickness', thickness, caller)
	if axisymmetric and thickness is not None: raise ValueError('mpm.traction: thickness = %r with axisymmetric=True: rings have none; leave it out' % thickness)
	plane = axisymmetric or thickness is not None
	if (traction is None) == (pressure is None): raise ValueError('mpm.traction: traction = %r, pressure = %r: give one of the two [Pa]' % (traction, pressure))
	field = {}
	if callable(traction): field['traction'], traction = traction, (0, 0, 0)
	if callable(pressure): field['pressure'], pressure = pressure, 0
	if traction is not None:
		traction = _points.vector(caller, 'traction', traction, 'three finite components [Pa]')
		if plane and traction[2] != 0: raise ValueError('mpm.traction: traction = %s: in a plane problem nothing moves along z; give 0' % traction)
	elif not (_points.isNumber(pressure) and math.isfinite(pressure)): raise ValueError('mpm.traction: pressure = %r: give a finite pressure [Pa]' % (pressure,))
	if not (_points.isWhole(points) and 1 <= points <= 10):
		raise ValueError('mpm.traction: points = %r: give a whole number from 1 to 10' % (points,))
	if cellSize is not None: _points.positive('cellSize', cellSize, caller)
	times, factors = _history(times, factors)
	corner, edges = _edges(face, plane)

	x = _points.array('position')
	if len(x) == 0: raise ValueError('mpm.traction: the scene has no material points; make them with mpm.fill() first')
	size = numpy.frombuffer(_points._points().array('size')[0])
	near = _near(x, size, corner, edges)
	if not near.any():
		raise ValueError('mpm.traction: face = %r: no material point is within one and a half times its size of the face; place it on the surface of the points' % (face,))
	piece = cellSize or float(size[near].min())
	axes = []
	for edge in edges:
		length = numpy.linalg.norm(edge)
		places, weights = quadrature.gaussAxis(quadrature.cellEdges(0., length, piece, None, True), int(points))
		axes.append((places/length, weights/length))
	parameter, weight = quadrature.product(*zip(*axes))
	position = corner + parameter @ edges
	normal = numpy.array([edges[0][1], -edges[0][0], 0]) if plane else numpy.cross(edges[0], edges[1])
	if ((x[near] - corner - edges.sum(axis=0)/2) @ normal).sum() > 0: normal = -normal  # outward: away from the material
	if axisymmetric:
		if not (position[:, 0] > 0).all(): raise ValueError('mpm.traction: face = %r: with axisymmetric=True x is the radius; give a face at x >= 0' % (face,))
		weight = weight*2*math.pi*position[:, 0]
	area = weight[:, None]*normal*(thickness or 1.)
	columns = {'position': position, 'area': area}
	for name, function in field.items(): columns[name] = _evaluate(name, function, position, plane)
	return _points._points().addTraction({k: numpy.ascontiguousarray(v, dtype=float) for k, v in columns.items()}, 2 if axisymmetric else 1 if plane else 0,
		Vector3(*(traction if traction is not None else (0, 0, 0))), float(pressure or 0), times, factors)


def _evaluate(name, function, position, plane):
	"""A load that is a function of position, at the quadrature points."""
	rows = []
	for x in position.tolist():
		value = function(Vector3(*x))
		if name == 'traction': rows.append(_points.vector('mpm.traction', 'traction at %s' % (x,), value, 'a function that returns three finite components [Pa]'))
		elif _points.isNumber(value) and math.isfinite(value): rows.append(float(value))
		else: raise ValueError('mpm.traction: pressure at %s = %r: give a function that returns a finite pressure [Pa]' % (x, value))
		if name == 'traction' and plane and rows[-1][2] != 0: raise ValueError('mpm.traction: traction at %s = %s: in a plane problem nothing moves along z; give 0' % (x, rows[-1]))
	return numpy.array(rows)


def _history(times, factors):
	if (times is None) != (factors is None): raise ValueError('mpm.traction: times = %r, factors = %r: give both, or none' % (times, factors))
	if times is None: return [], []
	columns = []
	for name, values in ('times', times), ('factors', factors):
		try: values = [float(v) for v in values]
		except (TypeError, ValueError): raise ValueError('mpm.traction: %s = %r: give a list of numbers' % (name, values)) from None
		for k, value in enumerate(values):
			if not math.isfinite(value): raise ValueError('mpm.traction: %s[%d] = %r: give finite numbers' % (name, k, value))
		columns.append(values)
	times, factors = columns
	if len(times) != len(factors) or not times: raise ValueError('mpm.traction: %d times and %d factors: give a factor for each time' % (len(times), len(factors)))
	for k in range(1, len(times)):
		if times[k] <= times[k - 1]: raise ValueError('mpm.traction: times[%d] = %r after %r: give times that increase [s]' % (k, times[k], times[k - 1]))
	return times, factors


def _edges(face, plane):
	"""A corner (3,) and the one or two edges (k,3) that span the face."""
	wanted = 'give the two ends of a segment, ((x0,y0),(x1,y1))' if plane else 'give three corners of a parallelogram, or two opposite corners of a rectangle normal to an axis'
	try: corners = numpy.array([[float(x) for x in corner] for corner in face])
	except (TypeError, ValueError): corners = None
	dim = 2 if plane else 3
	if corners is None or corners.ndim != 2 or corners.shape[1] != dim or len(corners) not in ((2,) if plane else (2, 3)) or not numpy.isfinite(corners).all():
		raise ValueError('mpm.traction: face = %r: %s' % (face, wanted))
	if plane: corners = numpy.column_stack((corners, numpy.zeros(2)))
	if plane: edges = corners[1:] - corners[:1]
	elif len(corners) == 3: edges = numpy.array([corners[0] - corners[1], corners[2] - corners[1]])
	else:
		diagonal = corners[1] - corners[0]
		flat = numpy.flatnonzero(diagonal == 0)
		if len(flat) != 1: raise ValueError('mpm.traction: face = %r: %s; two corners of a rectangle share exactly one coordinate' % (face, wanted))
		edges = numpy.array([diagonal*(numpy.arange(3) == d) for d in range(3) if d != flat[0]])
	corner = corners[1] if len(corners) == 3 else corners[0]
	measure = numpy.linalg.norm(edges[0]) if plane else numpy.linalg.norm(numpy.cross(*edges))
	if not measure > 0 or (len(edges) == 2 and measure < 1e-9*numpy.linalg.norm(edges[0])*numpy.linalg.norm(edges[1])):
		raise ValueError('mpm.traction: face = %r: it has no area; %s' % (face, wanted))
	return corner, edges


def _near(x, size, corner, edges):
	"""Which points x lie within one and a half times their size of the face."""
	metric = edges @ edges.T
	parameter = numpy.clip(numpy.linalg.solve(metric, edges @ (x - corner).T).T, 0, 1)
	return numpy.linalg.norm(x - corner - parameter @ edges, axis=1) < 1.5*size
