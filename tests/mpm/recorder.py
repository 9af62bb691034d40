# SPDX-License-Identifier: GPL-2.0-or-later
"""MpmVtkRecorder: what VTK's own reader finds in the files is what mpm.array says, bit for bit; a picture from them; VTKRecorder beside it.

With arguments this script is the one that draws, in a Python of its own: recorder.py draw <file.vtu> <picture.png>.
"""
import os
import sys


def draw(file, picture):
	"""Points coloured by von Mises stress, on black."""
	import vtkmodules.vtkRenderingOpenGL2, vtkmodules.vtkInteractionStyle
	from vtkmodules.vtkIOImage import vtkPNGWriter
	from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
	from vtkmodules.vtkRenderingCore import vtkActor, vtkDataSetMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
	reader = vtkXMLUnstructuredGridReader()
	reader.SetFileName(file)
	reader.Update()
	mapper = vtkDataSetMapper()
	mapper.SetInputConnection(reader.GetOutputPort())
	mapper.SetScalarModeToUsePointFieldData()
	mapper.SelectColorArray('vonMises')
	mapper.SetScalarRange(reader.GetOutput().GetPointData().GetArray('vonMises').GetRange())
	actor = vtkActor()
	actor.SetMapper(mapper)
	actor.GetProperty().SetPointSize(12)
	renderer = vtkRenderer()
	renderer.AddActor(actor)
	renderer.ResetCamera()
	renderer.GetActiveCamera().Zoom(1.6)
	window = vtkRenderWindow()
	window.SetOffScreenRendering(1)
	window.SetSize(480, 240)
	window.AddRenderer(renderer)
	window.Render()
	image = vtkWindowToImageFilter()
	image.SetInput(window)
	writer = vtkPNGWriter()
	writer.SetFileName(picture)
	writer.SetInputConnection(image.GetOutputPort())
	writer.Write()


if sys.argv[1:2] == ['draw']:
	draw(*sys.argv[2:])
	sys.exit()

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import subprocess
import tempfile
import xml.etree.ElementTree

from common import *
from yade import pack
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

quantities = ('id', 'material', 'displacement', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'vonMises')


def read(file):
	"""Points, fields by name, number of cells, as VTK reads them."""
	reader = vtkXMLUnstructuredGridReader()
	reader.SetFileName(file)
	reader.Update()
	data = reader.GetOutput()
	fields = data.GetPointData()
	return vtk_to_numpy(data.GetPoints().GetData()), {fields.GetArrayName(k): vtk_to_numpy(fields.GetArray(k)) for k in range(fields.GetNumberOfArrays())}, data.GetNumberOfCells()


def collection(file):
	return [(float(e.get('timestep')), e.get('file')) for e in xml.etree.ElementTree.parse(file).getroot().iter('DataSet')]


folder = tempfile.TemporaryDirectory()
path = lambda name: os.path.join(folder.name, name)

# a cantilever beyond yield, with a grain beside it
steel = BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05, n=5)
recorder = MpmVtkRecorder(fileName=path('beam-'), iterPeriod=150, recorders=['all', 'grid'])
beam, grid = block(region=((0, 0), (1, .1)), spacing=1/60., thickness=.05, material=steel, cellSize=1/30., walls=[MpmWall(normal=(1, 0, 0))], gravity=(0, -4e4, 0))
grain = O.bodies.append(sphere((.5, .5, 0), .05, material='steel', color=(1, 0, 0)))
O.bodies[grain].groupMask = 2
O.engines = O.engines + [recorder, VTKRecorder(fileName=path('beam-'), iterPeriod=150, recorders=['spheres'], mask=2)]
O.run(301, True)
check('the beam yields', mpm.array('plasticStrain').max() > 1e-5, mpm.array('plasticStrain').max())
equal('a file at the start and every 150 steps', [os.path.basename(f) for f in recorder.files], ['beam-points.%d.vtu' % k for k in (0, 150, 300)])
equal('the .pvd lists them with their times', collection(path('beam-points.pvd')), [(t, 'beam-points.%d.vtu' % k) for t, k in zip(recorder.times, (0, 150, 300))])
near('times', recorder.times, [0, 150*O.dt, 300*O.dt], 1e-15)
equal('and those of the grid', [f for _, f in collection(path('beam-grid.pvd'))], ['beam-grid.%d.vtu' % k for k in (0, 150, 300)])
x, fields, cells = read(recorder.files[-1])
same('positions', x, mpm.array('position'))
equal('every point is a cell', cells, len(beam))
equal('quantities', sorted(fields), sorted(quantities))
for name in quantities: same(name, fields[name].reshape(mpm.array(name).shape), mpm.array(name))
same('displacement is that of the body', fields['displacement'][7], numpy.array(O.bodies[beam[7]].state.displ()))
check('the beam bends down', fields['displacement'][:, 1].min() < -1e-3, fields['displacement'][:, 1].min())
x, fields, cells = read(path('beam-spheres.300.vtu'))
equal("VTKRecorder's sphere beside them", (len(x), cells), (1, 1))

picture = path('beam.png')
done = subprocess.run(['xvfb-run', '-a', sys.executable, os.path.realpath(sys.argv[0]), 'draw', recorder.files[-1], picture], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
check('VTK draws the file', done.returncode == 0 and os.path.exists(picture), done.stdout)
if os.path.exists(picture):
	import matplotlib.image
	pixels = matplotlib.image.imread(picture)[:, :, :3]
	lit = pixels.max(axis=2) > .1
	check('the beam fills its part of the picture', .02 < lit.mean() < .6, lit.mean())
	check('in several colours', len(numpy.unique((pixels[lit]*15).round(), axis=0)) > 20)
	if os.environ.get('MPM_KEEP_PICTURE'):
		import shutil
		shutil.copy(picture, os.environ['MPM_KEEP_PICTURE'])

# saved, loaded and run on: the list goes on
O.save(path('scene.yade.bz2'))
O.load(path('scene.yade.bz2'))
O.run(150, True)
equal('a loaded scene goes on with its .pvd', [f for _, f in collection(path('beam-points.pvd'))], ['beam-points.%d.vtu' % k for k in (0, 150, 300, 450)])

# the grid of a body in free flight
for shape in 'linear', 'cubic':
	ids, grid = block(velocity=(3, -1, 0), shape=shape)
	recorder = MpmVtkRecorder(fileName=path('flight-'), iterPeriod=1, recorders=['grid', 'velocity'], compress=True, ascii=shape == 'linear')
	O.engines = O.engines + [recorder]
	O.run(5, True)
	x, fields, cells = read(recorder.gridFiles[-1])
	mass = fields['mass']
	near(shape + ': mass of the nodes', mass.sum(), mpm.array('mass').sum(), 1e-12)
	near(shape + ': centre of mass of the nodes, one displacement behind the points', mass @ x/mass.sum(), mpm.array('position').mean(axis=0) - O.dt*numpy.array((3, -1, 0)), 1e-12)
	near(shape + ': momentum of the nodes', mass @ fields['velocity'], momentum(), 1e-11)
	near(shape + ': nodes stand on the lattice of cells', x/grid.cellSize, (x/grid.cellSize).round(), 1e-12)
	equal(shape + ': only what was asked for', sorted(read(recorder.files[-1])[1]), ['velocity'])

# in 3D, a sphere
O.reset()
elastic()
mpm.fill(pack.inSphere((1, 2, 3), .5), spacing=.125, material='elastic', velocity=(1, 2, -3), bodies=False)
recorder = MpmVtkRecorder(fileName=path('ball-'), iterPeriod=1, recorders=['velocity', 'F', 'grid'])
O.engines = [MpmEngine(cellSize=.25, analysis='3d'), recorder]
O.dt = .4*mpm.criticalTimeStep()
O.run(5, True)
x, fields, cells = read(recorder.files[-1])
same('3D: positions', x, mpm.array('position'))
for name in 'velocity', 'F': same('3D: %s' % name, fields[name].reshape(mpm.array(name).shape), mpm.array(name))
x, fields, cells = read(recorder.gridFiles[-1])
near('3D: mass of the nodes', fields['mass'].sum(), mpm.array('mass').sum(), 1e-9)
near('3D: momentum of the nodes', fields['mass'] @ fields['velocity'], momentum(), 1e-9)

# points without bodies do not know where they began
block(bodies=False)
recorder = MpmVtkRecorder(fileName=path('loose-'), iterPeriod=1)
O.engines = O.engines + [recorder]
O.run(1, True)
equal('all but the displacement', sorted(read(recorder.files[-1])[1]), sorted(set(quantities) - {'displacement'}))


def refused(what, part, **attributes):
	block(bodies=attributes.pop('bodies', True))
	O.engines = O.engines + [MpmVtkRecorder(**dict(dict(fileName=path('x-'), iterPeriod=1), **attributes))]
	raises(what, RuntimeError, part, lambda: O.run(1, True))


refused('no name', "MpmVtkRecorder.fileName = ''", fileName='')
refused('no folder', 'there is no folder ' + path('nowhere'), fileName=path('nowhere/x-'))
refused('no such quantity', "MpmVtkRecorder.recorders = 'stres': choose among 'id'", recorders=['stres'])
refused('no displacement without bodies', "MpmVtkRecorder.recorders = 'displacement'", recorders=['displacement'], bodies=False)
refused('a file that cannot be written', 'MpmVtkRecorder: cannot write', fileName='/proc/x-')


# files appear whole, under a name of their own, or the run ends
def recording(name, **attributes):
	"""A block in motion with a recorder at each step, and one with the grid where asked for."""
	ids, grid = block(velocity=(.1, 0, 0))
	recorder = MpmVtkRecorder(**dict(dict(fileName=path(name), iterPeriod=1, recorders=['id']), **attributes))
	O.engines = O.engines + [recorder]
	return grid, recorder


grid, recorder = recording('again-')
O.run(3, True)
first = {file: open(file, 'rb').read() for file in recorder.files + [path('again-points.pvd')]}
O.resetTime()
raises('after O.resetTime() a name comes again', RuntimeError, "MpmVtkRecorder.fileName = '%s': %s has been written already, before O.resetTime(); give another fileName"
	% (path('again-'), path('again-points.0.vtu')), lambda: O.run(1, True))
equal('and nothing is overwritten', {file: open(file, 'rb').read() for file in first}, first)
recorder.fileName = path('then-')
O.run(6, True)
check('with another name it goes on', os.path.exists(path('then-points.pvd')) and collection(path('then-points.pvd'))[-1][1].startswith('then-'), os.listdir(folder.name))

for name, taken in ('list-', 'points.pvd'), ('file-', 'points.0.vtu'):
	os.mkdir(path(name + taken))
	recording(name)
	raises('a folder in the place of %s' % taken, RuntimeError, 'cannot write ' + path(name + taken), lambda: O.run(1, True))
equal('no half-written file is left', [file for file in os.listdir(folder.name) if file.endswith('.part')], [])

# the grid's times are those of its own files
grid, recorder = recording('switch-', recorders=['id', 'grid'])
O.run(2, True)
recorder.recorders = ['id']
O.run(3, True)
recorder.recorders = ['id', 'grid']
O.run(1, True)
equal('files of a grid that is switched off and on', [f for _, f in collection(path('switch-grid.pvd'))], ['switch-grid.%d.vtu' % k for k in (0, 1, 5)])
near('and their times', [t for t, _ in collection(path('switch-grid.pvd'))], [0, O.dt, 5*O.dt], 1e-12)

# mpm.criticalTimeStep() leaves the grid that is shown alone
shown = []
for asked in False, True:
	grid, recorder = recording('asked-%d-' % asked, recorders=['velocity', 'grid'], dead=True)
	O.run(3, True)
	if asked: mpm.criticalTimeStep()
	recorder.dead = False
	recorder()
	shown.append(read(recorder.gridFiles[-1])[1]['velocity'])
same('nodal velocities after mpm.criticalTimeStep()', shown[1], shown[0])

finish()
