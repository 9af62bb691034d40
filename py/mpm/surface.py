# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions from files of surfaces."""

import os


def readStl(file):
	"""A closed surface from an STL file, for ``pack.inGtsSurface``.

	``mpm.fill(pack.inGtsSurface(mpm.readStl('part.stl')), ...)`` fills what it encloses; with a thickness, its section at z = 0.

	:param str file: name of an STL file, text or binary; its numbers are taken for metres
	:returns: a ``gts.Surface``, normals outward
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: if file is no name of a file, or the file holds no triangles, or they do not close
	"""
	import gts
	from vtkmodules.vtkIOGeometry import vtkSTLReader
	if not isinstance(file, (str, os.PathLike)) or not os.fspath(file): raise ValueError('mpm.readStl: file = %r: give the name of an STL file' % (file,))
	file = os.fspath(file)
	if not os.path.isfile(file): raise FileNotFoundError('mpm.readStl: there is no file %r; check the name and the working directory' % (file,))
	if not os.access(file, os.R_OK): raise PermissionError('mpm.readStl: the file %r cannot be read; check its permissions' % (file,))
	reader = vtkSTLReader()  # merges the corners that triangles share
	reader.SetFileName(file)
	reader.Update()
	triangles = reader.GetOutput()
	vertices = [gts.Vertex(*triangles.GetPoint(k)) for k in range(triangles.GetNumberOfPoints())]
	edges = {}

	def edge(p, q):
		key = min(p, q), max(p, q)
		if key not in edges: edges[key] = gts.Edge(vertices[p], vertices[q])
		return edges[key]

	surface = gts.Surface()
	for k in range(triangles.GetNumberOfCells()):
		p, q, r = (triangles.GetCell(k).GetPointId(c) for c in range(3))
		if len({p, q, r}) == 3: surface.add(gts.Face(edge(p, q), edge(q, r), edge(r, p)))
	if surface.Nfaces == 0: raise ValueError('mpm.readStl: %r holds no triangles; is it an STL file?' % (file,))
	if not surface.is_closed(): raise ValueError('mpm.readStl: the %d triangles of %r do not close; repair the surface where it was made' % (surface.Nfaces, file))
	if surface.volume() < 0:
		for face in surface.faces(): face.revert()
	return surface
