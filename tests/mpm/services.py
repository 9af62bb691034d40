# SPDX-License-Identifier: GPL-2.0-or-later
"""What YADE offers every scene, with material points in it: reload, several scenes, bodies that come and go, timing, plot, PyRunner,
export, pack, periodic cells, energies, batches, colours of the 3D view."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import subprocess

from common import *
from yade import export, pack, plot, timing, ymport

folder = tempfile.TemporaryDirectory()
path = lambda name: os.path.join(folder.name, name)


def moving(**more):
	return block(velocity=(2, 0, 0), gravity=(0, -9.81, 0), **more)


# O.reload
moving()
O.save(path('start.xml.bz2'))
O.load(path('start.xml.bz2'))
start = state()
O.run(50, True)
first = state()
check('the scene has moved', (first['position'] != start['position'])[:, :2].all())
O.reload()
now = state()
for name in start: same('O.reload: %s as at the start' % name, now[name], start[name])
O.run(50, True)
now = state()
for name in first: same('O.reload: %s after the same steps' % name, now[name], first[name])

# two scenes, one beside the other, as if each were alone
moving()
O.run(60, True)
alone = state()
moving()
O.run(30, True)
here = state()
O.addScene()
O.switchToScene(1)
elastic()
mpm.fill(((0, 0), (.5, .5)), spacing=.25, thickness=.1, material='elastic', velocity=(0, 1, 0))
O.engines = [ForceResetter(), MpmEngine(cellSize=.5)]
O.dt = .4*mpm.criticalTimeStep()
O.run(30, True)
equal('the other scene has its own points', len(mpm.array('id')), 4)
near('and its own motion', mpm.array('velocity').mean(axis=0), (0, 1, 0), 1e-12)
O.switchToScene(0)
now = state()
for name in here: same('O.switchToScene: %s waits unchanged' % name, now[name], here[name])
O.run(30, True)
now = state()
for name in alone: same('O.switchToScene: %s goes on' % name, now[name], alone[name])
O.switchScene()
equal('O.switchScene: the other one is empty', len(mpm.array('id')), 0)
O.switchScene()
for name in alone: same('O.switchScene: %s is back' % name, mpm.array(name), alone[name])

# bodies that come and go during a run
ids, grid = moving()
O.engines = O.engines + [PyRunner(iterPeriod=10, nDo=1, firstIterRun=10, command='O.bodies.erase(%d)' % ids[3]),
	PyRunner(iterPeriod=10, nDo=1, firstIterRun=20, command="mpm.fill(((5, 5), (5.5, 5.5)), spacing=.25, thickness=.1, material='elastic', velocity=(0, 0, 0))")]
O.run(40, True)
equal('one gone, four come', len(mpm.array('id')), 16 - 1 + 4)
check('the erased one is among neither', ids[3] not in mpm.array('id')[:-4] or O.bodies[ids[3]].state.pos[0] > 4)
born = mpm.array('position')[:, 0] > 4
equal('the new ones have fallen since', born.sum(), 4)
steps = -mpm.array('velocity')[born, 1].mean()/(9.81*O.dt)
check('for the steps that they were there', abs(steps - round(steps)) < 1e-6 and 18 <= steps <= 21, steps)

# yade.timing
O.timingEnabled = True
moving()
timing.reset()
O.run(25, True)
engine = [e for e in O.engines if isinstance(e, MpmEngine)][0]
equal('timing: the engine has run as often as there were steps', engine.execCount, 25)
check('timing: and took time', 0 < engine.execTime < 60e9, engine.execTime)
passes = engine.timingDeltas.data
equal('timing: its passes, each in every step', [(label, count) for label, time, count in passes], [(label, 25) for label in
	('bodies to points', 'points sorted into tiles', 'stress, points to nodes', 'nodes', 'nodes to points and back', 'points to bodies')])
near('timing: they are all there is', sum(time for label, time, count in passes)/engine.execTime, 1, .1)
timing.stats()
timing.reset()
equal('timing: and can be reset', engine.timingDeltas.data, [])
O.timingEnabled = False
O.run(1, True)
equal('timing: nothing is kept while it is off', engine.timingDeltas.data, [])

# plot and PyRunner
moving()
plot.reset()
O.engines = O.engines + [PyRunner(iterPeriod=5, command='yade.plot.addData(t=O.time, vx=float(yade.mpm.array("velocity")[:, 0].mean()))')]
O.run(51, True)
equal('plot: a value every five steps', len(plot.data['t']), 10)
near('plot: of the points as they are', plot.data['vx'], [2]*10, 1e-12)
plot.saveDataTxt(path('plot.txt'))
equal('plot: saved', numpy.loadtxt(path('plot.txt')).shape, (10, 2))

# O.trackEnergy
moving()
O.trackEnergy = True
O.run(100, True)
check('energies in O.energy', {'mpmKinetic', 'mpmElastic', 'mpmExternal'} <= set(O.energy.keys()), O.energy.keys())
near('a falling body: kinetic energy is what it had and what gravity gave', O.energy['mpmKinetic'] + O.energy['mpmExternal'], .5*mpm.array('mass').sum()*4, 2e-3*O.energy['mpmKinetic'])
O.trackEnergy = False

# a periodic cell is refused, by name
moving()
O.periodic = True
raises('periodic scenes', RuntimeError, 'set O.periodic = False', lambda: O.run(1, True))
O.periodic = False
O.run(1, True)

# export and ymport: material points are spheres to them
ids, grid = moving()
export.text(path('spheres.txt'))
rows = numpy.loadtxt(path('spheres.txt'))
near('export.text: positions and radii', rows[:, :4], numpy.column_stack([mpm.array('position'), numpy.full(16, .125)]), 1e-6)
equal('ymport.text: reads them as grains', len(ymport.text(path('spheres.txt'))), 16)

# predicates of pack
def count(region, **more):
	O.reset()
	elastic()
	mpm.fill(region, material='elastic', **dict(dict(spacing=.05, bodies=False), **more))
	return mpm.array('position')

x = count(pack.inSphere((1, 2, 3), .5))
near('a sphere: volume', len(x)*.05**3, 4/3*numpy.pi*.5**3, .02*.52)
check('all inside', (numpy.linalg.norm(x - (1, 2, 3), axis=1) <= .5).all())


class Ball(pack.Predicate):
	"""A script's own predicate, which counts on a Vector3."""
	def __call__(self, point, pad=0): return (point - Vector3(1, 2, 3)).norm() <= .5
	def aabb(self): return Vector3(.5, 1.5, 2.5), Vector3(1.5, 2.5, 3.5)


same('a predicate written in Python', count(Ball()), x)
x = count(pack.inCylinder((0, 0, 0), (0, 0, 1), .5))
near('a cylinder: volume', len(x)*.05**3, numpy.pi*.25, .02*.785)
x = count(pack.inAlignedBox((0, 0, -1), (1, 1, 1)) - pack.inAlignedBox((.4, .5, -2), (.6, 2, 2)), thickness=.1)
near('a notched plate: area', len(x)*.05**2, 1 - .2*.5, 1e-12)
check('nothing in the notch', not ((x[:, 0] > .4) & (x[:, 0] < .6) & (x[:, 1] > .5)).any())
try:
	import gts
	surface = gts.sphere(3)
	x = count(pack.inGtsSurface(surface))
	near('a surface of GTS: volume', len(x)*.05**3, surface.volume(), .01*surface.volume())
	plate = mpm.readStl(os.path.join(root, 'scripts', 'examples', 'plate.stl'))
	polygon = .4*.2 - .5*48*numpy.sin(2*numpy.pi/48)*.04**2
	near('an STL file: volume, the hole a polygon of about 48 corners', plate.volume(), .02*polygon, 2e-3*.02*polygon)
	x = count(pack.inGtsSurface(plate), spacing=.004, thickness=.02)
	near('its section: area', len(x)*.004**2, polygon, .01*polygon)
	check('nothing in the hole', numpy.hypot(x[:, 0] - .2, x[:, 1] - .1).min() > .039)
	raises('no such file', FileNotFoundError, 'there is no file', lambda: mpm.readStl(path('none.stl')))
	with open(path('open.stl'), 'w') as file: file.write('solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n')
	raises('an open surface', ValueError, 'do not close', lambda: mpm.readStl(path('open.stl')))
except ImportError:
	check('GTS is there', False)
raises('an empty region', ValueError, 'no point lies inside it', lambda: count(pack.inSphere((0, 0, 0), .01)))
raises('an unbounded one', ValueError, 'unbounded', lambda: count(pack.notInNotch((0, 0, 0), (1, 0, 0), (0, 1, 0), .1)))
raises('not a region', ValueError, 'or a predicate of yade.pack', lambda: count('box'))

# colours
ids, grid = block()
O.bodies.append(sphere((9, 9, 9), 1, color=(1, 0, 0), material='elastic'))
limits = mpm.color(mpm.array('position')[:, 0])
near('mpm.color: limits are those of the values', limits, (.125, .875), 1e-12)
near('the ends of the map', [O.bodies[ids[0]].shape.color, O.bodies[ids[-1]].shape.color], [(0.267004, 0.004874, 0.329415), (0.993248, 0.906157, 0.143936)], 1e-6)
equal('a grain keeps its colour', O.bodies[16].shape.color, Vector3(1, 0, 0))
equal('limits given', mpm.color('vonMises', limits=(0, 1e6)), (0., 1e6))
raises('not one number a point', ValueError, 'give one number a point', lambda: mpm.color('stress'))
raises('no such quantity', ValueError, "mpm.color: quantity = 'xyz'", lambda: mpm.color('xyz'))
raises('no such map', ValueError, 'give one that it has', lambda: mpm.color(colormap='rainbows'))

# a batch, two lines of its table
with open(path('n.table'), 'w') as table: table.write('description n duration\nsmooth 2 2e-3\nsharp 20 2e-3\n')
environment = dict(os.environ, MPM_OUT=path('out'), OMP_WAIT_POLICY='passive')
environment.pop('YADE_PREFIX', None)
examples = os.path.join(root, 'scripts', 'examples')
done = subprocess.run([os.path.join(root, 'scripts', 'yade-mpm-batch'), '--job-threads=1', '--log=' + path('%.log'), path('n.table'), os.path.join(examples, 'batch_n.py')],
	cwd=folder.name, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
equal('a batch: a curve for each line of the table, and a picture', sorted(os.listdir(path('out/batch_n'))) if os.path.exists(path('out/batch_n')) else done.stdout, ['batch_n.png', 'n=2.txt', 'n=20.txt'])
if os.path.exists(path('out/batch_n/n=2.txt')):
	smooth, sharp = (numpy.loadtxt(path('out/batch_n/n=%d.txt' % n)) for n in (2, 20))
	check('n makes a difference', smooth[:, 0].max() != sharp[:, 0].max())

finish()
