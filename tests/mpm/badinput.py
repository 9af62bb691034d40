# SPDX-License-Identifier: GPL-2.0-or-later
"""What bad input gets: an exception that names object, attribute, value and remedy, before anything has moved.

One case a check. mpm.fill() raises ValueError or KeyError and makes no points. Bad attributes of engine, materials, walls
and scene come out of the first O.run(1, True) as RuntimeError, and out of mpm.criticalTimeStep() where the time step is
not the culprit; the check is that every part of the sentence that a user needs is in it, that O.iter is still 0 and that
positions and velocities are what they were, bit for bit. During a run the message has the point's id, the time and the
cell; the scene can be saved then, loaded and, once what was wrong has been put right, run on. No tolerances.
"""
import math
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *
from yade import pack

nan, inf = float('nan'), float('inf')


def error(call):
	"""What a call raises, or None."""
	try:
		call()
	except Exception as e:
		return e
	return None


def says(what, e, kind, *parts):
	check(what, type(e) is kind and all(p in str(e) for p in parts), '%s: %s; wanted %s with %s' % (type(e).__name__, e, kind.__name__, parts))


def look(ids):
	return mpm.array('position'), [list(O.bodies[i].state.pos) for i in ids], [list(O.bodies[i].state.vel) for i in ids]


def refused(what, *parts, dt=1e-6, fit=None, bad=None, **arguments):
	"""A scene with bad arguments, or made bad by bad(engine), is refused; made good by fit(engine) it runs."""
	ids, grid = block(velocity=(.1, .2, 0), courant=None, **arguments)
	if bad: bad(grid)
	before = look(ids)
	if dt:
		O.dt = dt
		says(what + ', mpm.criticalTimeStep()', error(mpm.criticalTimeStep), RuntimeError, *parts)
	says(what, error(lambda: O.run(1, True)), RuntimeError, *parts)
	after = look(ids)
	check(what + ': nothing has moved', O.iter == 0 and all(numpy.array_equal(a, b, equal_nan=True) for a, b in zip(before, after)), O.iter)
	if fit:
		fit(grid)
		O.run(1, True)
		check(what + ': repaired, it runs', O.iter == 1 and (mpm.array('position') != before[0]).any())


# ---- mpm.fill ---------------------------------------------------------------------------------------------------------

O.reset()
elastic()
square = ((0, 0), (1, 1))


def fill(what, kind, *parts, **arguments):
	arguments = dict(dict(region=square, spacing=.25, material='elastic', thickness=.1), **arguments)
	says('mpm.fill: ' + what, error(lambda: mpm.fill(**arguments)), kind, *parts)


for value in 0, -.1, nan, inf, 'wide', None:
	fill('spacing %r' % (value,), ValueError, 'spacing = %r' % (value,), 'give a finite value > 0', spacing=value)
for value in 0, -.1, nan, inf, 'thick':
	fill('thickness %r' % (value,), ValueError, 'thickness = %r' % (value,), 'give a finite value > 0', thickness=value)
fill('velocity of two', ValueError, 'velocity', 'three finite components', velocity=(1, 2))
fill('NaN velocity', ValueError, 'velocity', 'nan', 'three finite components', velocity=(1, nan, 0))
fill('velocity out of the plane', ValueError, 'velocity', 'along z', velocity=(0, 0, 1))
fill('region that is none', ValueError, 'region = 3', 'two corners', region=3)
fill('region of one corner', ValueError, 'region', 'two corners', region=((0, 0), ))
fill('region without extent', ValueError, 'region', 'no point', region=((0, 0), (0, 1)))
fill('region turned inside out', ValueError, 'region', 'no point', region=((1, 1), (0, 0)))
fill('region smaller than the spacing', ValueError, 'spacing', '0.25', region=((0, 0), (.1, .1)))
fill('infinite region', ValueError, 'unbounded', region=((0, 0), (inf, 1)))
fill('3D region with thickness', ValueError, 'region', 'two coordinates', region=((0, 0, 0), (1, 1, 1)))
fill('a section that is empty', ValueError, 'no point', 'section at z = 0', region=pack.inSphere((0, 0, 5), 1))
fill('plane region without thickness', ValueError, 'region', 'give a thickness', thickness=None)
fill('label of no material', KeyError, "'lead'", 'elastic', material='lead')
fill('index of no material', KeyError, '7', 'elastic', material=7)
fill('material that is not in O.materials', KeyError, 'O.materials', 'append', material=FrictMat())
equal('mpm.fill: a bad call has made no bodies', len(O.bodies), 0)
equal('mpm.fill: a bad call has made no points', len(mpm.array('id')), 0)

e = error(lambda: mpm.array('colour'))
says('mpm.array of an unknown name', e, ValueError, "'colour'", 'choose', *["'%s'" % n for n in ('id', 'position', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'vonMises')])

# ---- unknown attributes -------------------------------------------------------------------------------------------------

for cls in MpmEngine, MpmWall, BoucWenMat, MpmState:
	raises('%s(cellsize=1)' % cls.__name__, AttributeError, 'cellsize', lambda: cls(cellsize=1))
	raises('%s().updateAttrs of an unknown name' % cls.__name__, AttributeError, 'nothing', lambda: cls().updateAttrs({'nothing': 1}))
raises('a positional argument', RuntimeError, 'MpmEngine', lambda: MpmEngine(.1))
raises('a text for a number', TypeError, 'double', lambda: MpmEngine(cellSize='.1'))
raises('a material for a wall', TypeError, 'MpmWall', lambda: MpmEngine(walls=[FrictMat()]))
raises('MpmWall.force is read-only', AttributeError, '', lambda: setattr(MpmWall(), 'force', Vector3(1, 2, 3)))
raises('MpmState.stress is read-only', AttributeError, '', lambda: setattr(MpmState(), 'stress', Matrix3.Zero))
raises('MpmState of no point', RuntimeError, 'mpm.fill', lambda: MpmState().stress)

# ---- the engine ---------------------------------------------------------------------------------------------------------


def good(**attributes):
	def repair(grid):
		grid.updateAttrs(attributes)
	return repair


for value, text in (0, '0'), (-1, '-1'), (nan, 'nan'), (inf, 'inf'):
	refused('cellSize %s' % text, 'MpmEngine.cellSize = ' + text, 'edge of a grid cell > 0 [m]', cellSize=value, fit=good(cellSize=.5))
for value in -.1, 1.1, nan:
	refused('flip %r' % value, 'MpmEngine.flip = %r' % value, '[0, 1]', flip=value, fit=good(flip=1))
for value in -1., nan:
	refused('filterTime %r' % value, 'MpmEngine.filterTime = ', '0 for no filter', filterTime=value, fit=good(filterTime=0))
for scheme in 'USF', 'USL':
	refused('full mass with ' + scheme, 'MpmEngine.fullMass = 1', "scheme = 'MUSL'", scheme=scheme, fullMass=True, fit=good(fullMass=False))
for value in (0, -1, nan):
	refused('largestGap %r' % value, 'MpmEngine.largestGap = ', 'inf to have none', largestGap=value, fit=good(largestGap=2))
for value in -.1, 1., nan:
	refused('damping %r' % value, 'MpmEngine.damping = %g' % value, '[0, 1)', damping=value, fit=good(damping=0))
refused('NaN gravity', 'MpmEngine.gravity', 'nan', 'finite acceleration', gravity=(0, nan, 0), fit=good(gravity=(0, 0, 0)))
refused('analysis', "MpmEngine.analysis = 'plane'", "choose one of 'planeStress', 'planeStrain', 'axisymmetric', '3d'", analysis='plane', fit=good(analysis='planeStrain'))
refused('shape', "MpmEngine.shape = 'spline'", "choose one of 'linear', 'gimp', 'quadratic', 'cubic'", shape='spline', fit=good(shape='linear'))
refused('scheme', "MpmEngine.scheme = 'musl'", "choose one of 'USF', 'USL', 'MUSL'", scheme='musl', fit=good(scheme='USL'))
refused('thinning in plane strain', 'MpmEngine.thinning', 'thinning = False', analysis='planeStrain', thinning=True, fit=good(thinning=False))
refused('mean dilatation in plane stress', 'MpmEngine.meanDilatation', 'meanDilatation = False', meanDilatation=True, fit=good(meanDilatation=False))
refused('thinning in small strain', 'MpmEngine.thinning', 'thinning = False', largeStrain=False, thinning=True, fit=good(thinning=False))
refused('GIMP in cells smaller than the points', 'MpmEngine.cellSize = 0.2', 'GIMP', shape='gimp', cellSize=.2, fit=good(cellSize=.25))
refused('3d analysis of points with a thickness', 'material point 0.thickness = 0.1', 'thickness=None', analysis='3d', fit=good(analysis='planeStress'))
for analysis in 'planeStress', 'planeStrain':
	refused('%s of points without a thickness' % analysis, 'material point 0.thickness = 0', 'mpm.fill(..., thickness=...)', region=((0, 0, 0), (1, 1, .5)), thickness=None, analysis=analysis,
		fit=good(analysis='3d'))

refused('gravity out of the plane', 'MpmEngine.gravity = ', 'nothing moves along z', gravity=(0, 0, -9.81), fit=good(gravity=(0, -9.81, 0)))
refused('radial gravity', 'MpmEngine.gravity = ', 'x is the radius', gravity=(1, -9.81, 0), analysis='axisymmetric', thickness=None, axisymmetric=True,
	fit=good(gravity=(0, -9.81, 0)))
refused('a wall that moves out of the plane', 'MpmWall 0.velocity = ', 'nothing moves along z', walls=[MpmWall(normal=(0, 1, 0), velocity=(0, 0, 1))], fit=good(walls=[]))
refused('thinning in 3d', 'MpmEngine.thinning', 'thinning = False', region=((0, 0, 0), (1, 1, .5)), thickness=None, analysis='3d', thinning=True, fit=good(thinning=False))
refused('axisymmetric analysis of plane points', 'material point 0.thickness = 0.1', 'axisymmetric=True', analysis='axisymmetric', fit=good(analysis='planeStress'))
refused('a wall behind the axis', 'MpmEngine.walls', 'x is the radius', analysis='axisymmetric', thickness=None, axisymmetric=True,
	walls=[MpmWall(normal=(1, 0, 0), origin=(-.5, 0, 0))], fit=good(walls=[]))
raises('a ring with a thickness', ValueError, 'rings have none', lambda: mpm.fill(((0, 0), (1, 1)), .5, 0, thickness=1, axisymmetric=True))

# ---- materials ----------------------------------------------------------------------------------------------------------


def material(what, *parts, cls=FrictMat, repair=None, **attributes):
	base = dict(young=1e6, poisson=.3, density=1000., label='clay')
	if cls is BoucWenMat: base.update(yieldStress=1e3)
	refused(what, *parts, material=cls(**dict(base, **attributes)), fit=repair and (lambda grid: O.materials[0].updateAttrs(repair)))


for value in 0, -1, nan, inf:
	material('young %r' % value, "FrictMat 'clay'.young = %r" % value, 'give a positive modulus [Pa]', young=value, repair={'young': 1e6})
for value in 0, -1, nan, inf:
	material('density %r' % value, "FrictMat 'clay'.density = %r" % value, 'give a density > 0 [kg/m3]', density=value)
for value in -1, .5, .7, nan:
	material('poisson %r' % value, "FrictMat 'clay'.poisson = %r" % value, 'above -1 and below 0.5', poisson=value, repair={'poisson': .3})
for value in nan, 0, -1:
	material('yieldStress %r' % value, "BoucWenMat 'clay'.yieldStress = %r" % value, 'give a positive stress [Pa]', cls=BoucWenMat, yieldStress=value, repair={'yieldStress': 1e3})
refused('no yieldStress, no label', 'BoucWenMat 0.yieldStress = nan', 'give a positive stress [Pa]', material=BoucWenMat(young=1e6, poisson=.3))
for value in 0, -2, nan:
	material('n %r' % value, "BoucWenMat 'clay'.n = %r" % value, 'give a positive exponent', cls=BoucWenMat, n=value, repair={'n': 2})
material('gamma < abs(beta)', "BoucWenMat 'clay'.gamma = 0.4", 'at least abs(beta)', cls=BoucWenMat, beta=.6, gamma=.4, repair={'beta': .4, 'gamma': .6})
material('beta + gamma != 1', "BoucWenMat 'clay'.beta + gamma = 0.9", 'must add to 1', cls=BoucWenMat, beta=.4, gamma=.5, repair={'gamma': .6})
material('NaN beta', "BoucWenMat 'clay'.beta + gamma = nan", 'must add to 1', cls=BoucWenMat, beta=nan)
material('NaN gamma', "BoucWenMat 'clay'.beta + gamma = nan", 'must add to 1', cls=BoucWenMat, gamma=nan)
for value in -.1, 1, 1.5, nan:
	material('tangentRatio %r' % value, "BoucWenMat 'clay'.tangentRatio = %r" % value, '[0, 1)', cls=BoucWenMat, tangentRatio=value, repair={'tangentRatio': 0})
for value in 0, -1e-4, nan:
	material('tolerance %r' % value, "BoucWenMat 'clay'.tolerance = ", 'give 1e-13 to 0.1', cls=BoucWenMat, tolerance=value, repair={'tolerance': 1e-4})
for m in Material(label='dust'), BubbleMat(label='dust'):
	refused('a %s has no law' % type(m).__name__, "%s 'dust'" % type(m).__name__, 'no law', 'ElastMat', 'BoucWenMat', material=m)

# ---- walls --------------------------------------------------------------------------------------------------------------


def wall(what, *parts, repair=None, others=(), **attributes):
	w = MpmWall(**dict(dict(normal=(1, 0, 0), origin=(-1, 0, 0)), **attributes))
	refused(what, *parts, walls=list(others) + [w], fit=repair and (lambda grid: w.updateAttrs(repair)))


left = {'normal': (1, 0, 0)}
refused('a wall without normal', 'MpmWall 0.normal', 'nan', 'into the material', walls=[MpmWall(origin=(-1, 0, 0))])
# refused as soon as it is given, and where one component of it is set, before the step
for what, normal, *parts in ('of zero', (0, 0, 0), 'into the material'), ('inclined', (1, 1, 0), '1 1 0', 'coordinate axis'), ('slightly inclined', (1, 1e-3, 0), 'coordinate axis'), \
		('partly NaN', (1, nan, 0), 'nan', 'into the material'):
	says('normal %s, of a new wall' % what, error(lambda: MpmWall(normal=normal)), RuntimeError, 'MpmWall.normal', *parts)
	says('normal %s, of a wall that has one' % what, error(lambda: setattr(MpmWall(normal=(0, 1, 0)), 'normal', normal)), RuntimeError, 'MpmWall.normal', *parts)
turned = MpmWall(normal=(1, 0, 0), origin=(-1, 0, 0))
turned.normal[1] = 1
refused('inclined by a component', 'MpmWall 0.normal', '1 1 0', 'coordinate axis', walls=[turned], fit=lambda grid: turned.updateAttrs(left))
says('a YADE wall in walls', error(lambda: MpmEngine(cellSize=1, walls=[MpmWall(normal=(1, 0, 0)), Body()])), TypeError, 'MpmEngine.walls[1]', 'Body', 'MpmWall')
says('a number for walls', error(lambda: setattr(MpmEngine(cellSize=1), 'walls', 3)), TypeError, 'MpmEngine.walls = 3', 'list', 'MpmWall')
for kind in 'fixed', 'slip':
	wall('friction of a wall of kind %s' % kind, 'MpmWall 0.friction = 0.3', "kind = 'friction'", kind=kind, friction=.3, repair={'friction': 0})
wall('wall normal to z in the plane', 'MpmWall 0.normal', 'plane', 'normal to z', normal=(0, 0, 1), repair=left)
wall('kind of wall', "MpmWall 0.kind = 'sticky'", "choose 'fixed', 'slip' or 'friction'", kind='sticky', repair={'kind': 'slip'})
for value in -.1, nan, inf:
	wall('friction %r' % value, 'MpmWall 0.friction = %r' % value, 'friction >= 0', kind='friction', friction=value, repair={'friction': .3})
wall('NaN origin', 'MpmWall 0.origin', 'nan', 'a point of the wall', origin=(nan, 0, 0), repair={'origin': (-1, 0, 0)})
wall('infinite velocity', 'MpmWall 0.velocity', 'inf', 'finite velocity', velocity=(inf, 0, 0), repair={'velocity': (0, 0, 0)})
wall('two walls that face the same way', 'MpmEngine.walls', 'walls 0 and 1', 'face the same way', others=[MpmWall(normal=(2, 0, 0), origin=(-2, 0, 0))], repair={'normal': (-1, 0, 0), 'origin': (3, 0, 0)})
wall('two walls with no room between', 'MpmEngine.walls', 'walls 0 and 1', 'no room', 'into the material', others=[MpmWall(normal=(-1, 0, 0), origin=(-2, 0, 0))])
refused('None for a wall', 'MpmEngine.walls[0] = None', 'MpmWall', walls=[None], fit=good(walls=[]))
refused('points behind a wall', 'material point 0', 'has left the walls', 'cell (', walls=[MpmWall(normal=(1, 0, 0), origin=(.5, 0, 0))], fit=lambda grid: grid.walls[0].updateAttrs({'origin': (0, 0, 0)}))

# ---- the scene ----------------------------------------------------------------------------------------------------------

ids, grid = block()
limit = mpm.criticalTimeStep()
check('the critical step is a number of the right size, some cells over the wave speed', .1 < limit*math.sqrt(1e6/910)/.5 < 10, limit)
for value, text in (1.01*limit, '%g' % (1.01*limit)), (1., '1'), (0., '0'), (nan, 'nan'), (inf, 'inf'):
	refused('O.dt %s' % text, 'O.dt = ' + text[:6], 'mpm.criticalTimeStep()', dt=None, bad=lambda grid: setattr(O, 'dt', value), fit=lambda grid: setattr(O, 'dt', .5*limit))
ids, grid = block(courant=.999)
O.run(1, True)
equal('a step just below the stable one is taken', O.iter, 1)
O.dt = 1.1*limit
says('O.dt above the stable step in mid-run', error(lambda: O.run(1, True)), RuntimeError, 'O.dt', 'criticalTimeStep')
O.dt = .9*limit
O.run(1, True)
O.materials[0].young *= 4
says('O.dt above the stable step for a material that has been stiffened', error(lambda: O.run(1, True)), RuntimeError, 'O.dt', 'criticalTimeStep')
equal('and no step was taken', O.iter, 2)
O.materials[0].young /= 4
grid.cellSize = .25
says('O.dt above the stable step of a finer grid', error(lambda: O.run(1, True)), RuntimeError, 'O.dt', 'criticalTimeStep')

O.reset()
raises('no engine', RuntimeError, 'add MpmEngine(cellSize=...)', mpm.criticalTimeStep)
O.engines = [ForceResetter(), MpmEngine(cellSize=1)]
O.dt = 1e-6
raises('no points', RuntimeError, 'mpm.fill()', lambda: O.run(1, True))
raises('no points, mpm.criticalTimeStep()', RuntimeError, 'mpm.fill()', mpm.criticalTimeStep)
equal('no points: no step', O.iter, 0)

refused('periodic scene', 'O.periodic', 'O.periodic = False', bad=lambda grid: setattr(O, 'periodic', True), fit=lambda grid: setattr(O, 'periodic', False))


def out_of_plane(name):
	def bad(grid):
		setattr(O.bodies[5].state, name, getattr(O.bodies[5].state, name) + Vector3(0, 0, .01))
	def repair(grid):
		s = O.bodies[5].state
		setattr(s, name, Vector3(getattr(s, name)[0], getattr(s, name)[1], 0))
	return dict(bad=bad, fit=repair)


refused('position out of the plane', 'O.bodies[5].state', 'z = 0', **out_of_plane('pos'))
refused('velocity out of the plane', 'O.bodies[5].state', 'z = 0', **out_of_plane('vel'))
refused('NaN position', 'O.bodies[5].state.pos', 'nan', bad=lambda grid: setattr(O.bodies[5].state, 'pos', Vector3(0, nan, 0)))
refused('NaN velocity', 'O.bodies[5].state.vel', 'nan', bad=lambda grid: setattr(O.bodies[5].state, 'vel', Vector3(0, nan, 0)))
refused('NaN force', 'O.forces.f(5)', 'nan', bad=lambda grid: O.forces.setPermF(5, Vector3(nan, 0, 0)), fit=lambda grid: O.forces.setPermF(5, Vector3(0, 0, 0)))


def order(what, engines, *parts):
	grid = MpmEngine(cellSize=.5)
	def arrange(_): O.engines = [grid if e is None else e for e in engines]
	refused('order of engines: ' + what, 'O.engines', 'ForceResetter', 'before MpmEngine', *parts, bad=arrange,
		fit=lambda _: setattr(O, 'engines', [ForceResetter()] + [e for e in O.engines if not isinstance(e, (ForceResetter, MpmEngine))] + [grid]))


push = lambda: ForceEngine(ids=[0], force=(1, 0, 0))
order('force, reset, grid', [push(), ForceResetter(), None], 'ForceEngine (place 0)')
order('grid, force, reset', [None, push(), ForceResetter()], 'ForceEngine (place 1)')
order('gravity', [GravityEngine(gravity=(0, -1, 0)), ForceResetter(), None], 'GravityEngine')
order('contacts', [InteractionLoop([], [], []), ForceResetter(), None], 'InteractionLoop')
order('directed force', [InterpolatingDirectedForceEngine(ids=[0], times=[0, 1], magnitudes=[1, 1], direction=(1, 0, 0)), ForceResetter(), None], 'InterpolatingDirectedForceEngine')
ids, grid = block(courant=None)
O.dt = 1e-6
late = ForceResetter(dead=True)
O.engines = [grid, push(), late]
O.run(2, True)
late.dead = False
raises('an engine that comes to life between two steps', RuntimeError, 'before MpmEngine', lambda: O.run(1, True))
ids, grid = block(courant=None)
O.dt = 1e-6
O.engines = [grid, ForceResetter(), push()]
O.run(3, True)
near('forces applied after the engine, and not cleared before the next step, count', momentum()[0], 2e-6, 1e-18)

# ---- during a run -------------------------------------------------------------------------------------------------------


def stops(what, *parts, make, spoil, repair):
	"""A run that is spoilt after 5 steps stops; its scene is saved, loaded, repaired and runs on."""
	ids, grid = make()
	O.run(5, True)
	spoil(ids)
	whole = mpm.array('position')
	e = error(lambda: O.run(2000, True))
	says(what, e, RuntimeError, *parts)
	check(what + ': the loop has stopped', not O.running and 5 <= O.iter < 2005, O.iter)
	count = O.iter
	found = state()
	check(what + ': positions are finite still', numpy.isfinite(found['position']).all())
	with tempfile.TemporaryDirectory() as folder:
		for name in 'a.xml', 'a.yade.bz2':
			file = os.path.join(folder, name)
			O.save(file)
			O.reset()
			O.load(file)
			loaded = state()
			check(what + ': %s is the scene that stopped' % name, O.iter == count and all(numpy.array_equal(loaded[k], found[k], equal_nan=True) for k in found),
				[k for k in found if not numpy.array_equal(loaded[k], found[k], equal_nan=True)])
	if repair is None: return
	repair(ids)
	O.run(5, True)
	check(what + ': repaired, it runs on', O.iter == count + 5 and numpy.isfinite(mpm.array('velocity')).all())


def leave(ids):
	s = O.bodies[ids[0]].state
	s.blockedDOFs, s.vel = 'x', Vector3(-10, 0, 0)


def back(ids):
	s = O.bodies[ids[0]].state
	s.blockedDOFs, s.vel, s.pos = '', Vector3(0, 0, 0), Vector3(.125, .125, 0)


stops('a point that leaves the walls', 'material point 0', 'has left the walls', 'at time 0.0', 'position (', 'cell (', 'reduce O.dt',
	make=lambda: block(walls=[MpmWall(normal=(1, 0, 0), kind='slip')]), spoil=leave, repair=back)


def push_hard(ids):
	O.forces.setPermF(ids[0], Vector3(1e9, 1e9, 0))


stops('a load that turns a point inside out', 'material point', 'a volume that is not positive', 'at time 0.0', 'position (', 'cell (', 'reduce O.dt or the load',
	make=block, spoil=push_hard, repair=None)


def let_go(ids):
	O.engines[1].largestGap = inf
	O.dt = .4*mpm.criticalTimeStep()


# hung up and drawn out by its own weight
stops('a body that is drawn apart', 'material point', 'have come apart at time', 'position (', 'cells more than the deformation', 'larger cells', 'largestGap',
	make=lambda: block(material=elastic(density=1050.), walls=[MpmWall(normal=(0, -1, 0), origin=(0, 1, 0), kind='fixed')], gravity=(0, -1000, 0), courant=.2),
	spoil=lambda ids: None, repair=let_go)
stops('a NaN force', 'O.forces.f(5) = ', 'nan', make=block, spoil=lambda ids: O.forces.setPermF(5, Vector3(0, nan, 0)), repair=lambda ids: O.forces.setPermF(5, Vector3(0, 0, 0)))
stops('a NaN velocity', 'O.bodies[5].state.vel = ', 'nan', make=block, spoil=lambda ids: setattr(O.bodies[5].state, 'vel', Vector3(nan, 0, 0)),
	repair=lambda ids: setattr(O.bodies[5].state, 'vel', Vector3(0, 0, 0)))

finish()
