# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls that points and grains touch, and the forces on prescribed points."""

import math

from yade import utils, wrapper
from yade.minieigenHP import Vector3

from . import points

O = wrapper.Omega()
subdomainOfPoints = 1  # of bodies that make no contact with material points (doc/architecture.md)


def reaction(ids):
	"""Force that the material exerts on points whose motion is prescribed, their sum [N].

	A point is prescribed by ``blockedDOFs`` of its body: the material follows it, and what that takes is its reaction, of the last
	step. Sign as that of :yref:`MpmWall.force`: a bar that is pulled along x pulls its grip with a negative force.

	:param ids: ids of points, or one id
	:returns: a Vector3
	:raises RuntimeError: if an id is no point's, or the point is not prescribed
	"""
	return points._points().reaction([ids] if isinstance(ids, int) else [int(i) for i in ids])


def wall(origin, normal, material, extent=(), along=None, friction=None):
	"""Add a wall at rest that material points and grains touch, and return its :yref:`MpmWall`.

	Points touch the wall of kind 'friction' that joins the engine's walls; grains, spheres and other bodies of YADE touch bodies that
	are added to the scene: a Wall where the plane is whole and normal to an axis, facets where it has an extent. Those bodies make no
	contact with points.

	:param origin: a point of the plane, the centre of its extent [m]
	:param normal: into the material
	:param material: a FrictMat of the scene, its label or index, of the bodies
	:param extent: half sizes [m], as :yref:`MpmWall.extent`: none, the whole plane; one, a segment in the plane or a disk; two, a rectangle
	:param along: direction of the first side of a rectangle
	:param friction: coefficient of friction of the points [-]; the tangent of the material's frictionAngle unless given
	:raises ValueError: for an oblique plane without an extent, or a rectangle without a direction
	:raises KeyError: if there is no such material
	"""
	engine, material = points._engine(), points._material(material, 'mpm.wall')
	if not isinstance(material, wrapper.FrictMat): raise ValueError('mpm.wall: material = %r: give a FrictMat, which has a frictionAngle' % material)
	origin, normal, extent = Vector3(*origin), Vector3(*normal), [float(half) for half in extent]
	if not normal.norm() > 0: raise ValueError('mpm.wall: normal = %s: give the direction from the wall into the material' % normal)
	normal = normal.normalized()
	if len(extent) == 2 and along is None: raise ValueError('mpm.wall: along = None: give the direction of the first side of the rectangle')
	along = Vector3(0, 0, 0) if along is None else Vector3(*along)
	if friction is None: friction = math.tan(material.frictionAngle)
	made = wrapper.MpmWall(origin=origin, normal=normal, kind='friction', friction=friction, extent=extent, along=along)
	axis = max(range(3), key=lambda d: abs(normal[d]))
	if not extent:
		if abs(normal[axis]) < 1 - 1e-12: raise ValueError('mpm.wall: extent = (): YADE has no oblique plane without end; give half sizes')
		bodies = [utils.wall(origin, axis=axis, sense=1 if normal[axis] > 0 else -1, material=material)]
	else:
		bodies = [utils.facet(corners, material=material, fixed=True) for corners in _facets(origin, normal, extent, along, engine.analysis == '3d')]
	for body in bodies: body.subdomain = subdomainOfPoints
	O.bodies.append(bodies)
	engine.walls = list(engine.walls) + [made]
	return made


def _facets(origin, normal, extent, along, solid, count=48):
	"""Corners of triangles that cover a wall: a rectangle, or a disk by a polygon with as much area."""
	if len(extent) == 1 and solid:
		first = normal.cross(min((Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)), key=lambda e: abs(e.dot(normal)))).normalized()
		second, angle = normal.cross(first), 2*math.pi/count
		radius = extent[0]*math.sqrt(angle/math.sin(angle))
		rim = [origin + radius*(math.cos(k*angle)*first + math.sin(k*angle)*second) for k in range(count + 1)]
		return [(origin, rim[k], rim[k + 1]) for k in range(count)]
	if len(extent) == 1: first, second, extent = Vector3(normal[1], -normal[0], 0), Vector3(0, 0, 1), extent*2
	else: first, second = along.normalized(), normal.cross(along.normalized())
	a, b = extent[0]*first, extent[1]*second
	return [(origin - a - b, origin + a - b, origin + a + b), (origin - a - b, origin + a + b, origin - a + b)]
