# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points from finite element meshes."""

import os

import numpy

_LIMB = 1/numpy.sqrt(3)


class _Element:
	"""Corner functions of a first-order element, and its quadrature rule."""

	def __init__(self, dim, corners, places, weights, functions):
		self.dim, self.corners = dim, corners
		self.places, self.weights = numpy.array(places, dtype=float).reshape(len(weights), dim), numpy.array(weights, dtype=float)
		self.functions = functions  # place -> values (corners,) and gradients (corners, dim)


def _cube(dim, corners):
	corners = numpy.array(corners, dtype=float)

	def functions(xi):
		factors = 1 + corners*xi
		gradient = numpy.array([[corners[a, d]*numpy.prod(numpy.delete(factors[a], d)) for d in range(dim)] for a in range(len(corners))])
		return factors.prod(axis=1)/2**dim, gradient/2**dim
	return _Element(dim, len(corners), corners*_LIMB, [1.]*len(corners), functions)


def _simplex(dim, inner):
	gradient = numpy.vstack((-numpy.ones(dim), numpy.eye(dim)))
	outer = (1 - inner)/dim
	places = [[inner if d == k else outer for d in range(dim)] for k in range(dim)] + [[outer]*dim]
	return _Element(dim, dim + 1, places, [1/(2. if dim == 2 else 6.)/(dim + 1)]*(dim + 1), lambda xi: (numpy.concatenate(([1 - xi.sum()], xi)), gradient))


def _wedge():
	triangle = _simplex(2, 2/3.)

	def functions(xi):
		N, dN = triangle.functions(xi[:2])
		z = (1 - xi[2])/2, (1 + xi[2])/2
		return numpy.concatenate([N*c for c in z]), numpy.vstack([numpy.column_stack((dN*c, s*N/2)) for c, s in zip(z, (-1, 1))])
	return _Element(3, 6, [list(p) + [s*_LIMB] for s in (-1, 1) for p in triangle.places], list(triangle.weights)*2, functions)


_SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
_ELEMENTS = {'triangle': _simplex(2, 2/3.), 'quad': _cube(2, _SQUARE), 'tetra': _simplex(3, .5854101966249685),
	'hexahedron': _cube(3, [c + (z,) for z in (-1, 1) for c in _SQUARE]), 'wedge': _wedge()}
_GMSH = {1: ('line', 2), 2: ('triangle', 3), 3: ('quad', 4), 4: ('tetra', 4), 5: ('hexahedron', 8), 6: ('wedge', 6), 7: ('pyramid', 5), 8: ('line3', 3), 9: ('triangle6', 6),
	10: ('quad9', 9), 11: ('tetra10', 10), 12: ('hexahedron27', 27), 13: ('wedge18', 18), 15: ('vertex', 1), 16: ('quad8', 8), 17: ('hexahedron20', 20), 18: ('wedge15', 15)}
_VTK = {1: 'vertex', 3: 'line', 5: 'triangle', 9: 'quad', 10: 'tetra', 12: 'hexahedron', 13: 'wedge', 14: 'pyramid', 21: 'line3', 22: 'triangle6', 23: 'quad8', 24: 'tetra10',
	25: 'hexahedron20'}
_BELOW = {'vertex': 0, 'line': 1, 'line3': 1}


class Mesh:
	"""Quadrature points of a mesh's elements, for :yref:`mpm.points`.

	:ivar position: places of the points [m], (N,3)
	:ivar volume: their volumes [m3], of a plane mesh their areas [m2], (N,)
	:ivar group: name of the group of each point, '' without one, (N,)
	:ivar element: number of the element of each point, in the order of the file, (N,)
	:ivar dimension: 2 or 3
	"""

	def __init__(self, position, volume, group, element, dimension):
		self.position, self.volume, self.group, self.element, self.dimension = position, volume, group, element, dimension

	@property
	def groups(self):
		"""Names of the groups of the mesh."""
		return sorted(set(self.group.tolist()) - {''})

	def __len__(self): return len(self.volume)

	def __getitem__(self, name):
		"""The points of one group."""
		kept = self.group == name
		if not kept.any(): raise KeyError('mpm.readMesh: there is no group %r; the mesh has %s' % (name, self.groups or 'none'))
		return Mesh(self.position[kept], self.volume[kept], self.group[kept], self.element[kept], self.dimension)

	def __repr__(self): return '<mpm.Mesh of %d points, %d elements, groups %s>' % (len(self), len(set(self.element.tolist())), self.groups)


def readMesh(file, points=2, groups=None):
	"""Quadrature points of the elements of a mesh: places and volumes for :yref:`mpm.points`.

	``mesh = mpm.readMesh('part.msh')``, then ``mpm.points(mesh.position, mesh.volume, 'steel')``, in the plane
	``mpm.points(mesh.position, .01*mesh.volume, 'steel', thickness=.01)``; ``mesh['web']`` has the points of the group 'web' alone.

	Elements are those of the mesh's highest dimension: triangles (3 points), quadrilaterals (4), tetrahedra (4), hexahedra (8),
	wedges (6), of first order, at the Gauss places of degree two. The volumes of an element's points add up to its own.

	:param str file: name of a Gmsh file (.msh, text, versions 2.2 and 4.1) or a VTK file (.vtu, .vtk); coordinates are taken for metres
	:param int points: 2 for the rules above, 1 for one point an element, at its centroid
	:param str groups: of a VTK file: name of the array of cells that numbers the groups; of a Gmsh file they are the physical names, or numbers
	:returns: a ``Mesh`` with arrays position, volume, group, element
	:raises FileNotFoundError: if there is no such file
	:raises ValueError: for a file that holds no such mesh, or an element that is folded
	"""
	if not isinstance(file, (str, os.PathLike)) or not os.fspath(file): raise ValueError('mpm.readMesh: file = %r: give the name of a .msh, .vtu or .vtk file' % (file,))
	file = os.fspath(file)
	if points not in (1, 2): raise ValueError('mpm.readMesh: points = %r: give 1 or 2' % (points,))
	if not os.path.isfile(file): raise FileNotFoundError('mpm.readMesh: there is no file %r; check the name and the working directory' % file)
	kind = os.path.splitext(file)[1].lower()
	if kind == '.msh': nodes, cells = _readGmsh(file)
	elif kind in ('.vtu', '.vtk'): nodes, cells = _readVtk(file, kind, groups)
	else: raise ValueError('mpm.readMesh: file = %r: give a .msh, .vtu or .vtk file' % file)
	if not numpy.isfinite(nodes).all(): raise ValueError('mpm.readMesh: %r: a node has a coordinate that is not finite; write the mesh anew' % file)
	dims = {name: _ELEMENTS[name].dim for name, *_ in cells if name in _ELEMENTS}
	for name, *_ in cells:
		if name not in _ELEMENTS and name not in _BELOW:
			raise ValueError('mpm.readMesh: %r holds elements of kind %s; write it with first-order %s' % (file, name, ', '.join(_ELEMENTS)))
	if not dims: raise ValueError('mpm.readMesh: %r holds no elements of kind %s' % (file, ', '.join(_ELEMENTS)))
	dim = max(dims.values())
	parts = []
	for name, corners, names, numbers in cells:
		if name not in _ELEMENTS or _ELEMENTS[name].dim < dim: continue
		position, volume = _integrate(file, _ELEMENTS[name], nodes[corners], numbers, points)
		each = volume.shape[1]
		parts.append((position.reshape(-1, 3), volume.ravel(), numpy.repeat(numpy.array(names, dtype=object), each), numpy.repeat(numbers, each)))
	position, volume, group, element = (numpy.concatenate(column) for column in zip(*parts))
	if dim == 2 and numpy.ptp(position[:, 2]) > 1e-9*numpy.ptp(position, axis=0).max():
		raise ValueError('mpm.readMesh: %r is a surface in space; give a mesh of a plane at constant z, or of a solid' % file)
	if dim == 2: position[:, 2] = 0
	order = numpy.argsort(element, kind='stable')
	return Mesh(position[order], volume[order], group[order].astype(str), element[order], dim)


def _integrate(file, element, corners, numbers, points):
	"""Places (M,q,3) and volumes (M,q) of the quadrature points of M elements, corners (M,c,3)."""
	position, volume = [], []
	for place, weight in zip(element.places, element.weights):
		N, dN = element.functions(place)
		J = numpy.einsum('mcx,cd->mxd', corners, dN)
		position.append(numpy.einsum('c,mcx->mx', N, corners))
		volume.append(weight*(numpy.linalg.det(J[:, :2]) if element.dim == 2 else numpy.linalg.det(J)))
	position, volume = numpy.stack(position, axis=1), numpy.stack(volume, axis=1)
	turned = (volume < 0).all(axis=1)  # corners in the other sense: VTK's wedges, and the plane seen from behind
	volume[turned] *= -1
	bad = ~(volume > 0).all(axis=1)
	if bad.any(): raise ValueError('mpm.readMesh: %r: element %d has no volume, or is folded; check the order of its corners, or repair the mesh' % (file, numbers[bad.argmax()]))
	if points == 1:
		total = volume.sum(axis=1, keepdims=True)
		position = (position*volume[:, :, None]).sum(axis=1, keepdims=True)/total[:, :, None]
		volume = total
	return position, volume


def _readGmsh(file):
	"""Nodes (M,3) and [(kind, corners, names, numbers)] of a Gmsh file of version 2.2 or 4.1, text."""
	with open(file, 'rb') as f: head = f.read(64)
	if b'$MeshFormat' not in head: raise ValueError('mpm.readMesh: %r is no Gmsh file: it does not begin with $MeshFormat' % file)
	with open(file, errors='replace') as f: lines = f.read().split('\n')
	sections, k = {}, 0
	while k < len(lines):
		name = lines[k].strip()
		if name.startswith('$') and not name.startswith('$End'):
			end = next((e for e in range(k + 1, len(lines)) if lines[e].strip() == '$End' + name[1:]), None)
			if end is None: raise ValueError('mpm.readMesh: %r: the section %s has no end; is the file complete?' % (file, name))
			sections[name[1:]], k = lines[k + 1:end], end
		k += 1
	try:
		version, text = sections['MeshFormat'][0].split()[:2]
		if text != '0': raise ValueError('it is a binary file; write it as text (Mesh.Binary = 0)')
		if version not in ('2.2', '4.1'): raise ValueError('its version is %s; write version 2.2 or 4.1 (Mesh.MshFileVersion)' % version)
		physical = {}
		for line in sections.get('PhysicalNames', ['0'])[1:]:
			dim, tag, name = line.split(None, 2)
			physical[int(dim), int(tag)] = name.strip().strip('"')
		return (_gmsh2 if version == '2.2' else _gmsh4)(sections, physical)
	except (KeyError, IndexError, ValueError) as fault:
		what = 'the section %s is missing' % fault if isinstance(fault, KeyError) else 'a section ends too early' if isinstance(fault, IndexError) else fault
		raise ValueError('mpm.readMesh: %r: %s' % (file, what)) from None


def _gather(found, tags):
	"""Cells by kind, their corners as rows of the nodes."""
	row = {tag: k for k, tag in enumerate(tags)}
	cells = []
	for kind, entries in found.items():
		missing = next((t for _, _, corners in entries for t in corners if t not in row), None)
		if missing is not None: raise ValueError('an element has the node %d, which the file does not hold' % missing)
		cells.append((kind, numpy.array([[row[t] for t in corners] for _, _, corners in entries]), [name for _, name, _ in entries],
			numpy.array([number for number, _, _ in entries])))
	return cells


def _kind(code):
	if code not in _GMSH: raise ValueError('it holds elements of type %d, which mpm.readMesh does not know; write first-order elements' % code)
	return _GMSH[code]


def _dimensionOf(kind): return _ELEMENTS[kind].dim if kind in _ELEMENTS else _BELOW.get(kind, -1)  # those of no order one are refused


def _gmsh2(sections, physical):
	rows = [line.split() for line in sections['Nodes'][1:] if line.strip()]
	if len(rows) != int(sections['Nodes'][0]): raise ValueError('it holds %d nodes instead of %s' % (len(rows), sections['Nodes'][0]))
	found = {}
	for line in sections['Elements'][1:]:
		if not line.strip(): continue
		numbers = [int(word) for word in line.split()]
		kind, corners = _kind(numbers[1])
		tag = numbers[3] if numbers[2] else 0
		if len(numbers) != 3 + numbers[2] + corners: raise ValueError('element %d has %d nodes instead of %d' % (numbers[0], len(numbers) - 3 - numbers[2], corners))
		name = physical.get((_dimensionOf(kind), tag), str(tag) if tag else '')
		found.setdefault(kind, []).append((numbers[0], name, numbers[3 + numbers[2]:]))
	return numpy.array([[float(x) for x in r[1:4]] for r in rows]).reshape(-1, 3), _gather(found, [int(r[0]) for r in rows])


def _gmsh4(sections, physical):
	tagOf = {}
	if 'Entities' in sections:
		counts = [int(word) for word in sections['Entities'][0].split()]
		at = 1
		for dim, count in enumerate(counts):
			for _ in range(count):
				words = sections['Entities'][at].split()
				first = 4 if dim == 0 else 7  # behind the tag and the place or the box
				if int(words[first]): tagOf[dim, int(words[0])] = abs(int(words[first + 1]))
				at += 1
	lines = [line.split() for line in sections['Nodes'] if line.strip()]
	at, tags, nodes = 1, [], []
	for _ in range(int(lines[0][0])):
		count = int(lines[at][3])
		tags += [int(line[0]) for line in lines[at + 1:at + 1 + count]]
		nodes += [[float(x) for x in line[:3]] for line in lines[at + 1 + count:at + 1 + 2*count]]
		at += 1 + 2*count
	if not len(tags) == len(nodes) == int(lines[0][1]): raise ValueError('it holds %d nodes instead of %s' % (len(nodes), lines[0][1]))
	lines = [line.split() for line in sections['Elements'] if line.strip()]
	at, found = 1, {}
	for _ in range(int(lines[0][0])):
		dim, entity, code, count = (int(word) for word in lines[at])
		kind, corners = _kind(code)
		tag = tagOf.get((dim, entity), 0)
		for line in lines[at + 1:at + 1 + count]:
			if len(line) != 1 + corners: raise ValueError('element %s has %d nodes instead of %d' % (line[0], len(line) - 1, corners))
			found.setdefault(kind, []).append((int(line[0]), physical.get((dim, tag), str(tag) if tag else ''), [int(word) for word in line[1:]]))
		if len(lines) < at + 1 + count: raise IndexError
		at += 1 + count
	return numpy.array(nodes).reshape(-1, 3), _gather(found, tags)


def _readVtk(file, kind, groups):
	"""The same of a VTK file."""
	from vtkmodules.util.numpy_support import vtk_to_numpy
	if kind == '.vtu': from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader as Reader
	else: from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader as Reader
	from vtkmodules.vtkCommonCore import vtkObject
	reader = Reader()
	reader.SetFileName(file)
	shown = vtkObject.GetGlobalWarningDisplay()
	vtkObject.SetGlobalWarningDisplay(0)  # the exception below says it
	try: reader.Update()
	finally: vtkObject.SetGlobalWarningDisplay(shown)
	grid = reader.GetOutput()
	if grid is None or grid.GetNumberOfCells() == 0: raise ValueError('mpm.readMesh: %r holds no unstructured grid with cells' % file)
	names = [''] * grid.GetNumberOfCells()
	if groups is not None:
		array = grid.GetCellData().GetArray(groups)
		if array is None:
			data = grid.GetCellData()
			raise ValueError('mpm.readMesh: groups = %r: %r has no such array of cells; it has %s'
				% (groups, file, [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())] or 'none'))
		names = ['%g' % value for value in vtk_to_numpy(array).reshape(len(names), -1)[:, 0]]
	found = {}
	for k in range(grid.GetNumberOfCells()):
		code, cell = grid.GetCellType(k), grid.GetCell(k)
		corners = [cell.GetPointId(c) for c in range(cell.GetNumberOfPoints())]
		found.setdefault(_VTK.get(code, 'VTK type %d' % code), []).append((k, names[k], corners))
	return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), [
		(kind, numpy.array([c for *_, c in entries]), [n for _, n, _ in entries], numpy.array([number for number, *_ in entries])) for kind, entries in found.items()]
