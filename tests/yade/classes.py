# SPDX-License-Identifier: GPL-2.0-or-later
"""Classes of a plugin behave in Python as YADE's own do."""
import math
import os
import sys

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish, raises

import yade
from yade import *

# What a class looks like.
check('childClasses of GlobalEngine', 'ProbeEngine' in yade.system.childClasses('GlobalEngine'))
check('childClasses of FrictMat', 'ProbeMat' in yade.system.childClasses('FrictMat'))
check('childClasses of Engine reach through PeriodicEngine', 'ProbePeriodic' in yade.system.childClasses('Engine'))
check('isinstance', isinstance(ProbeMat(), FrictMat) and isinstance(ProbeState(), State))
equal('docstring of a class', ProbeMat.__doc__, 'A material with a state of its own.')
equal('docstring of an attribute', ProbeMat.yieldStress.__doc__, 'Yield stress [Pa] :ydefault:`1e6` :yattrtype:`Real` :yattrflags:`0` ')
equal('docstring of a read-only attribute', ProbeEngine.steps.__doc__, 'Steps done :ydefault:`0` :yattrtype:`long` :yattrflags:`2` ')
equal('docstring with an empty default', ProbeEngine.item.__doc__, 'One object :ydefault:`` :yattrtype:`shared_ptr<ProbeItem>` :yattrflags:`0` ')

# Construction.
engine = ProbeEngine(flag=True, size=2, word='gimp', gravity=(1, 2, 3), ints=[1, 2], reals=(1.5, 2), label='grid')
equal('keywords', (engine.flag, engine.size, engine.word, engine.gravity, engine.ints, engine.reals, engine.label),
      (True, 2., 'gimp', Vector3(1, 2, 3), [1, 2], [1.5, 2.], 'grid'))
equal('keywords call postLoad once', engine.postLoads, 1)
equal('the constructor body runs', ProbeEngine().count, 4)
raises('an unknown keyword', AttributeError, 'No such attribute: cellsize', lambda: ProbeEngine(cellsize=1))
raises('a keyword of the wrong type', TypeError, 'double', lambda: ProbeEngine(size='big'))
raises('an argument without a name', RuntimeError, 'ProbeEngine(name=value', lambda: ProbeEngine(1))
raises('two arguments without a name', RuntimeError, '2 arguments', lambda: ProbeMat(1, 2))
raises('the keyword of a hidden attribute', AttributeError, 'inner', lambda: ProbeEngine(inner=1))

# Attributes.
engine = ProbeEngine()
equal('dict() merges with the base', {k: engine.dict()[k] for k in ('size', 'dead', 'label')}, {'size': 1.5, 'dead': False, 'label': ''})
check('dict() without the hidden', 'inner' not in engine.dict() and 'steps' in engine.dict())
check('no hidden attribute', not hasattr(engine, 'inner'))
engine.gravity[2] = 5
equal('an item of a vector', engine.gravity, Vector3(0, 0, 5))
engine.tensor[0, 1] = 6
equal('an item of a matrix', engine.tensor[0, 1], 6.)
engine.reaction[0] = 99
equal('an item of a read-only vector', engine.reaction, Vector3(1, 2, 3))
raises('setting a read-only attribute', AttributeError, 'no setter', lambda: setattr(engine, 'steps', 3))
raises('setting the wrong type', Exception, 'did not match', lambda: setattr(engine, 'size', 'big'))
engine.watched = 3
equal('triggerPostLoad', (engine.watched, engine.postLoads), (3., 1))
engine.updateAttrs({'count': 5, 'word': 'linear'})
equal('updateAttrs', (engine.count, engine.word), (5, 'linear'))
raises('updateAttrs with an unknown name', AttributeError, 'No such attribute: nothing', lambda: engine.updateAttrs({'nothing': 1}))
engine.size = float('nan')
check('NaN', math.isnan(engine.size))
engine.cells = (4, 5, 6)
equal('integers', engine.cells, Vector3i(4, 5, 6))

# Objects.
equal('no object', engine.item, None)
item = ProbeItem(kind='fixed')
engine.item = item
engine.item.kind = 'slip'
equal('an object is shared', item.kind, 'slip')
engine.items = [item, ProbeItem(normal=(1, 0, 0))]
equal('a list of objects', [i.normal for i in engine.items], [Vector3(0, 0, 1), Vector3(1, 0, 0)])
engine.items[0].kind = 'friction'
equal('an object of a list is shared', item.kind, 'friction')
equal('a list by keyword', len(ProbeEngine(items=[item, item, item]).items), 3)
equal('a tuple of objects', len(ProbeEngine(items=(item, item)).items), 2)
raises('a list with a wrong object', TypeError, 'ProbeItem', lambda: ProbeEngine(items=[FrictMat()]))
raises('no list', TypeError, 'ProbeEngine.items = 3: give a list', lambda: ProbeEngine(items=3))

# In the loop.
O.engines = [ForceResetter(), ProbeEngine(label='grid'), ProbePeriodic(iterPeriod=3, initRun=False, label='every')]
O.dt = 1e-3
check('the label is a name', grid is O.engines[1] or grid.label == 'grid')
O.run(7, True)
equal('action runs', grid.steps, 7)
equal('action sees the scene', grid.scratch, 1e-3)
equal('PeriodicEngine', every.runs, 2)
grid.failWith = 'point 12 left the walls'
raises('an exception from action, O.run', RuntimeError, 'point 12 left the walls', lambda: O.run(3, True))
raises('an exception from action, O.step', RuntimeError, 'point 12 left the walls', lambda: O.step())
grid.failWith = ''
O.run(2, True)
check('the scene lives on', grid.steps >= 9, grid.steps)
grid.dead = True
steps = grid.steps
O.run(2, True)
equal('dead', grid.steps, steps)

# Dispatch by class index.
O.reset()
material = O.materials.append(ProbeMat(young=1e7, frictionAngle=.4))
a, b = O.bodies.append([sphere((0, 0, 0), 1, material=material), sphere((1.9, 0, 0), 1, material=FrictMat(young=1e7))])
check('newAssocState', isinstance(O.bodies[a].state, ProbeState) and type(O.bodies[b].state) is State)
equal('dispHierarchy', ProbeMat().dispHierarchy(), ['ProbeMat', 'FrictMat', 'ElastMat', 'Material'])
equal('dispHierarchy of the state', ProbeState().dispHierarchy(), ['ProbeState', 'State'])
check('indices differ', len({m().dispIndex for m in (ProbeMat, FrictMat, ElastMat, CohFrictMat)}) == 4)
O.engines = [
    ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(), ProbeEngine()]
O.dt = 1e-5
O.run(5, True)
check('Ip2_FrictMat_FrictMat_FrictPhys takes a derived material', isinstance(O.interactions[a, b].phys, FrictPhys) and O.forces.f(a)[0] < 0)
equal('a derived state is reached from C++', O.bodies[a].state.volume, 5.)

finish()
