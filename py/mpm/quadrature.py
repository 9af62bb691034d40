# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the material points of a region stand, and the volume of each."""

import math

import numpy
from yade.minieigenHP import Vector3


def uniformAxis(lower, upper, spacing):
	"""Places and widths of points along one axis of a box: a whole number of equal widths, as near to spacing as can be.

	Returns two empty arrays where the box is thinner than half a spacing.
	"""
	length = upper - lower
	count = int(math.floor(length/spacing + .5)) if length > 0 else 0
	if count and abs(length - count*spacing) > 1e-9*length: spacing = length/count  # else spacing itself, to the last bit
	return lower + (numpy.arange(count) + .5)*spacing, numpy.full(count, spacing)


def cellEdges(lower, upper, cellSize, origin, stretch):
	"""Boundaries of cells along one axis, from lower to upper.

	Cells begin at lower; stretch fits a whole number of them to upper, as the grid's are fitted between two walls, and without
	it the last one reaches beyond upper. With an origin they are cut from the cells origin + k cellSize; pieces shorter than a quarter
	of a cell are joined to their neighbour.
	"""
	length, slack = upper - lower, 1e-9*cellSize
	if not length > slack: return numpy.array([lower])
	if origin is None:
		count = max(1, round(length/cellSize)) if stretch else math.ceil((length - slack)/cellSize)
		return lower + numpy.arange(count + 1)*(length/count if stretch or abs(length - count*cellSize) <= slack else cellSize)
	first, last = (lower - origin)/cellSize, (upper - origin)/cellSize
	if not stretch: return origin + numpy.arange(math.floor(first + 1e-9), math.ceil(last - 1e-9) + 1)*cellSize
	inner = [origin + k*cellSize for k in range(math.floor(first) + 1, math.ceil(last))]
	inner = [x for x in inner if min(x - lower, upper - x) > .25*cellSize]
	return numpy.array([lower] + inner + [upper])


def gaussAxis(edges, count):
	"""Places and weights of count Gauss-Legendre points in each of the cells between edges."""
	places, weights = numpy.polynomial.legendre.leggauss(count)
	half, middle = .5*numpy.diff(edges)[:, None], .5*(edges[1:] + edges[:-1])[:, None]
	return (middle + half*places).ravel(), (half*weights).ravel()


def product(places, weights):
	"""All points of a lattice, last axis fastest: places (N,d) and products of weights (N,)."""
	rest, measure = numpy.zeros((1, 0)), numpy.ones(1)
	for x, w in zip(reversed(places), reversed(weights)):
		n, m = len(x), len(rest)
		position, volume = numpy.empty((n*m, rest.shape[1] + 1)), numpy.empty(n*m)
		step = max(1, 200000//max(m, 1))  # of this axis at a time: between two of them Ctrl-C acts
		for begin in range(0, n, step):
			end = min(n, begin + step)
			position[begin*m:end*m, 0] = numpy.repeat(x[begin:end], m)
			position[begin*m:end*m, 1:] = numpy.tile(rest, (end - begin, 1))
			volume[begin*m:end*m] = numpy.multiply.outer(w[begin:end], measure).ravel()
		rest, measure = position, volume
	return rest, measure


def insideOf(predicate, places):
	"""Which places (N,d) a predicate of yade.pack contains; a plane one is taken at z = 0."""
	if len(places) == 0: return numpy.zeros(0, bool)
	if places.shape[1] == 2: places = numpy.column_stack((places, numpy.zeros(len(places))))
	candidates = (x for begin in range(0, len(places), 10000) for x in places[begin:begin + 10000].tolist())  # Python is slow with many lists at a time
	if not type(predicate).__module__.endswith('_packPredicates'): candidates = (Vector3(*x) for x in candidates)  # YADE's own take a list for a point, in half the time
	return numpy.fromiter((predicate(x, 0) for x in candidates), bool, len(places))


def reachInside(predicate, kept, axes, spacing):
	"""Distance (N,) from the points of a lattice that a predicate contains to its surface, 0 inside and for a box that the lattice fits.

	kept: which points of the whole lattice the predicate contains. The distance is looked for from the outer points along the normal,
	which the missing neighbours give, and along the axes without a neighbour, to 0.004 of the spacing.
	"""
	dim = len(axes)
	grid = numpy.pad(kept.reshape([len(a) for a in axes]), 2)
	inner = tuple(slice(2, -2) for _ in axes)
	shifted = lambda offset: grid[tuple(slice(2 + o, n - 2 + o) for o, n in zip(offset, grid.shape))]
	offsets = numpy.array(numpy.meshgrid(*[[-2, -1, 0, 1, 2]]*dim, indexing='ij')).reshape(dim, -1).T
	outer, normal = numpy.zeros(grid[inner].shape, bool), numpy.zeros(grid[inner].shape + (dim,))
	for offset in offsets:
		if not offset.any(): continue
		missing = ~shifted(offset)
		if abs(offset).max() == 1: outer |= missing
		normal += missing[..., None]*(offset/(offset @ offset))
	outer = (outer & grid[inner]).reshape(-1)
	places = product(axes, axes)[0][outer]
	least = numpy.full(len(places), 1.5)  # spacings
	directions = [(normal.reshape(-1, dim)[outer], numpy.ones(len(places), bool))]
	for d in range(dim):
		for sign in -1, 1:
			direction = numpy.zeros(dim)
			direction[d] = sign
			directions.append((numpy.broadcast_to(direction, places.shape), ~shifted(direction.astype(int)).reshape(-1)[outer]))
	for direction, tried in directions:
		length = numpy.sqrt((direction**2).sum(axis=1))
		tried = tried & (length > 0)
		if not tried.any(): continue
		start, step = places[tried], direction[tried]/length[tried, None]*spacing
		low, high = numpy.zeros(len(start)), numpy.full(len(start), 1.5)
		high[insideOf(predicate, start + 1.5*step)] = numpy.inf  # no surface that way
		found = numpy.isfinite(high)
		for _ in range(9):
			middle = .5*(low[found] + high[found])
			within = insideOf(predicate, start[found] + middle[:, None]*step[found])
			low[found], high[found] = numpy.where(within, middle, low[found]), numpy.where(within, high[found], middle)
		least[tried] = numpy.minimum(least[tried], .5*(low + high))
	reach = numpy.zeros(len(kept))
	if (abs(least - .5) > .01).any(): reach[outer] = numpy.where(least < 1.5, least*spacing, 0)
	return reach[kept]


def reachOfBox(position, lower, upper, size):
	"""Distance (N,) from the outermost Gauss points of a box to its faces, 0 inside."""
	distance = numpy.minimum(position - lower, upper - position).min(axis=1)
	return numpy.where(distance < .5*size, distance, 0)


def gaussInside(predicate, edges, count):
	"""Gauss points of the cells that lie in a predicate; of cells that its surface cuts, the equal parts, count an axis, whose centre lies in it.

	A cell lies in the predicate if its corners and the centres of all its parts do.
	"""
	dim = len(edges)
	corner, size = product([e[:-1] for e in edges], [numpy.diff(e) for e in edges])[0], product([numpy.diff(e) for e in edges], [numpy.diff(e) for e in edges])[0]
	local, _ = product([(numpy.arange(count) + .5)/count]*dim, [numpy.ones(count)]*dim)
	tips, _ = product([numpy.array([1e-6, 1 - 1e-6])]*dim, [numpy.ones(2)]*dim)  # a surface on the cell's own boundary does not cut it
	def at(points): return (corner[:, None, :] + size[:, None, :]*points).reshape(-1, dim)
	parts = insideOf(predicate, at(local)).reshape(len(corner), -1)
	whole = parts.all(axis=1)
	candidates = numpy.flatnonzero(whole)
	corner, size, allCorners, allSizes = corner[whole], size[whole], corner, size
	whole[candidates] = insideOf(predicate, at(tips)).reshape(len(corner), -1).all(axis=1)
	corner, size = allCorners, allSizes
	places, weights = product(*zip(*[gaussAxis(numpy.array([0., 1.]), count)]*dim))
	volume = size.prod(axis=1)
	kept = parts & ~whole[:, None]
	return (numpy.concatenate((at(places).reshape(len(corner), -1, dim)[whole].reshape(-1, dim), at(local).reshape(len(corner), -1, dim)[kept])),
		numpy.concatenate(((volume[:, None]*weights)[whole].ravel(), numpy.repeat(volume[:, None]/count**dim, count**dim, axis=1)[kept])))
