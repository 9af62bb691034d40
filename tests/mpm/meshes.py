# SPDX-License-Identifier: GPL-2.0-or-later
"""Points from meshes: volumes and moments of every kind of element, groups, Gmsh's two versions, VTK, damaged files."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

folder = tempfile.mkdtemp()


def path(name): return os.path.join(folder, name)


def write(name, text):
	with open(path(name), 'w') as file: file.write(text)
	return path(name)


def says(what, call, kind, *parts):
	try: call()
	except kind as fault: check(what, all(str(part) in str(fault) for part in parts), str(fault))
	else: check(what, False, 'no %s' % kind.__name__)


def gmsh2(nodes, elements, names=()):
	"""elements: (type, physical tag, nodes from 1)."""
	text = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n'
	if names: text += '$PhysicalNames\n%d\n%s\n$EndPhysicalNames\n' % (len(names), '\n'.join('%d %d "%s"' % n for n in names))
	text += '$Nodes\n%d\n%s\n$EndNodes\n' % (len(nodes), '\n'.join('%d %.17g %.17g %.17g' % ((10*(k + 1), ) + tuple(x)) for k, x in enumerate(nodes)))
	return text + '$Elements\n%d\n%s\n$EndElements\n' % (len(elements), '\n'.join('%d %d 2 %d 1 %s' % (k + 1, kind, tag, ' '.join(str(10*n) for n in corners))
		for k, (kind, tag, corners) in enumerate(elements)))


def moments(mesh): return numpy.concatenate(([mesh.volume.sum()], mesh.volume @ mesh.position, mesh.volume @ mesh.position**2))


# a trapezium of a quadrilateral and two triangles, (0,0) (2,0) (2,1) (0,1) and (3,0)
plane = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), (3, 0, 0), (3, 1, 0)]
elements = [(15, 9, (1, )), (1, 9, (1, 2)), (3, 1, (1, 2, 3, 4)), (2, 2, (2, 5, 3)), (2, 0, (6, 3, 5))]
file = write('plane.msh', gmsh2(plane, elements, [(2, 1, 'web'), (2, 2, 'a flange'), (1, 9, 'edge')]))
mesh = mpm.readMesh(file)
near('a quadrilateral and triangles', moments(mesh), (3, 4.5, 1.5, 0, 9, 1, 0), 1e-12)
equal('points of each', [(mesh.element == e).sum() for e in (3, 4, 5)], [4, 3, 3])
equal('groups', (mesh.groups, len(mesh['web']), len(mesh['a flange']), sorted(set(mesh.group.tolist()))), (['a flange', 'web'], 4, 3, ['', 'a flange', 'web']))
near('a group', moments(mesh['a flange'])[:3], (.5, .5*7/3., .5/3), 1e-12)
says('no such group', lambda: mesh['beam'], KeyError, "'beam'", 'web')
equal('dimension', mesh.dimension, 2)
one = mpm.readMesh(file, points=1)
near('one point an element', (len(one), *moments(one)[:3]), (3, 3, 4.5, 1.5), 1e-12)
equal('repr', repr(one), "<mpm.Mesh of 3 points, 3 elements, groups ['a flange', 'web']>")

O.reset()
elastic(young=1e6)
ids = mpm.points(mesh['web'].position, .1*mesh['web'].volume, 'elastic', thickness=.1, group='web')
near('its mass', mpm.array('mass').sum(), 200, 1e-10)

file4 = write('plane4.msh', '''$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "web"
2 2 "a flange"
$EndPhysicalNames
$Entities
1 1 2 0
1 0 0 0 0
1 0 0 0 2 0 0 0 2 1 -1
5 0 0 0 2 1 0 1 1 0
6 2 0 0 3 1 0 1 2 0
$EndEntities
$Nodes
2 6 10 60
2 5 0 4
10
20
30
40
0 0 0
2 0 0
2 1 0
0 1 0
2 6 0 2
50
60
3 0 0
3 1 0
$EndNodes
$Elements
3 4 1 4
1 1 1 1
1 10 20
2 5 3 1
2 10 20 30 40
2 6 2 2
3 20 50 30
4 60 30 50
$EndElements
''')
mesh4 = mpm.readMesh(file4)
near('version 4.1: the same points', mesh4.position, mesh.position, 1e-15)
equal('version 4.1: groups by entity', [len(mesh4[name]) for name in ('web', 'a flange')], [4, 6])

# solids: a unit cube as a hexahedron, as two wedges, as six tetrahedra, and all of it sheared
cube = numpy.array([(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
kinds = {'hexahedron': [(5, 1, range(1, 9))], 'wedges': [(6, 1, (1, 2, 3, 5, 6, 7)), (6, 1, (1, 3, 4, 5, 7, 8))],
	'tetrahedra': [(4, 1, c) for c in ((1, 2, 3, 7), (1, 2, 6, 7), (1, 5, 6, 7), (1, 4, 3, 7), (1, 4, 8, 7), (1, 5, 8, 7))]}
shear = numpy.array(((1, .3, .1), (0, 2, .2), (0, 0, .5)))
for name, cells in kinds.items():
	for matrix in numpy.eye(3), shear:
		mesh = mpm.readMesh(write('solid.msh', gmsh2(cube @ matrix.T, cells)))
		volume = numpy.linalg.det(matrix)
		second = volume*numpy.diag(matrix @ (numpy.eye(3)/12 + .25) @ matrix.T)
		near('%s: volume, first and second moments' % name, moments(mesh), numpy.concatenate(([volume], volume*matrix.sum(axis=1)/2, second)), 1e-12)
		equal('groups by number', mesh.groups, ['1'])
distorted = cube + .2*numpy.random.RandomState(1).rand(8, 3)
near('a distorted hexahedron: the same volume by one point and by eight', *(mpm.readMesh(write('d.msh', gmsh2(distorted, kinds['hexahedron'])), points=n).volume.sum() for n in (1, 2)), 1e-14)

# VTK
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
grid, places, part = vtkUnstructuredGrid(), vtkPoints(), vtkIntArray()
for x in cube: places.InsertNextPoint(x)
grid.SetPoints(places)
part.SetName('part')
for kind, corners in ((13, (0, 2, 1, 4, 6, 5)), (13, (0, 3, 2, 4, 7, 6))):  # VTK's wedges are turned the other way
	grid.InsertNextCell(kind, 6, corners)
	part.InsertNextValue(3 + corners[1])
grid.GetCellData().AddArray(part)
for suffix, writer in ('.vtu', vtkXMLUnstructuredGridWriter()), ('.vtk', vtkUnstructuredGridWriter()):
	writer.SetFileName(path('cube' + suffix))
	writer.SetInputData(grid)
	writer.Write()
	mesh = mpm.readMesh(path('cube' + suffix), groups='part')
	near('%s: moments' % suffix, moments(mesh), (1, .5, .5, .5, 1/3., 1/3., 1/3.), 1e-6)
	equal('%s: groups' % suffix, mesh.groups, ['5', '6'])
	says('%s: no such groups' % suffix, lambda: mpm.readMesh(path('cube' + suffix), groups='body'), ValueError, "groups = 'body'", 'part')

# bad input
good = gmsh2(plane, elements)
for what, text, parts in (
	('empty', '', ('no Gmsh file', )),
	('cut in the nodes', good[:good.index('$EndNodes') - 9], ('$Nodes', 'no end')),
	('a node missing', good.replace('60 3 1 0\n', ''), ('nodes instead of', )),
	('an unknown node', good.replace('60 30 50', '70 30 50'), ('node 70', )),
	('text for a number', good.replace('20 2 0 0', '20 two 0 0'), ('two', )),
	('nan', good.replace('20 2 0 0', '20 nan 0 0'), ('not finite', )),
	('binary', good.replace('2.2 0 8', '2.2 1 8'), ('binary', )),
	('version 3', good.replace('2.2 0 8', '3 0 8'), ('version is 3', )),
	('no elements', good[:good.index('$Elements')], ('Elements', 'missing')),
	('second order', good.replace('4 2 2 2 1 20 50 30', '4 9 2 2 1 20 50 30 40 50 60'), ('triangle6', 'first-order')),
	('folded', good.replace('10 20 30 40', '10 30 20 40'), ('element 3', 'folded')),
	('a curved surface', good.replace('60 3 1 0', '60 3 1 1'), ('surface in space', )),
	('edges alone', gmsh2(plane, elements[:2]), ('holds no elements', )),
	('too few nodes of an element', good.replace('10 20 30 40', '10 20 30'), ('3 nodes instead of 4', )),
):
	says(what, lambda: mpm.readMesh(write('bad.msh', text)), ValueError, 'mpm.readMesh', 'bad.msh', *parts)
says('not VTK', lambda: mpm.readMesh(write('bad.vtu', 'nothing')), ValueError, 'mpm.readMesh', 'no unstructured grid')
says('no such file', lambda: mpm.readMesh(path('none.msh')), FileNotFoundError, 'none.msh')
says('another kind of file', lambda: mpm.readMesh(write('part.step', '')), ValueError, 'part.step', '.msh')
for value in None, 3, '': says('readMesh(%r)' % (value,), lambda: mpm.readMesh(value), ValueError, 'mpm.readMesh', 'file = %r' % (value,))
for value in None, 3, '': says('readStl(%r)' % (value,), lambda: mpm.readStl(value), ValueError, 'mpm.readStl', 'file = %r' % (value,))
says('points=3', lambda: mpm.readMesh(file, points=3), ValueError, 'points = 3')

finish()
