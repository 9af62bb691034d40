# SPDX-License-Identifier: GPL-2.0-or-later
"""Saved and loaded again, in each of YADE's formats."""
import os
import sys
import tempfile

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish

from yade import *

matrix = Matrix3(1, 2, 3, 4, 5, 6, 7, 8, 9.5)
kept = dict(flag=True, count=12, size=.1, word='cubic & <gimp>', gravity=Vector3(.1, .2, .3), cells=Vector3i(7, 8, 9), tensor=matrix,
            reals=[.1, .2], ints=[5, 6, 7], watched=4.5, label='grid')

with tempfile.TemporaryDirectory() as folder:
    for suffix in ('.xml', '.xml.bz2', '.yade', '.yade.bz2'):
        O.reset()
        O.materials.append(ProbeMat(label='steel', young=210e9, yieldStress=240e6))
        O.bodies.append(sphere((1, 2, 3), .5, material='steel'))
        O.bodies[0].state.stress = matrix
        O.bodies[0].state.blockedDOFs = 'xY'
        item = ProbeItem(normal=(1, 0, 0), kind='slip')
        O.engines = [ForceResetter(), ProbeEngine(item=item, items=[item, ProbeItem(kind='fixed')], scratch=99, **kept),
                     ProbePeriodic(iterPeriod=4, runs=3, nDo=50)]
        O.miscParams = [ProbeItem(kind='kept with the scene')]
        O.dt = 1e-4
        O.run(3, True)
        before = {k: O.engines[1].dict()[k] for k in kept}
        O.save(folder + '/scene' + suffix)
        preSaves = O.engines[1].preSaves
        saved = suffix + ': '
        check(saved + 'preSave and postSave run once', (O.engines[1].preSaves, O.engines[1].postSaves) == (1, 1),
              (O.engines[1].preSaves, O.engines[1].postSaves))

        O.reset()
        O.load(folder + '/scene' + suffix)
        engine, state = O.engines[1], O.bodies[0].state
        equal(saved + 'engine', {k: engine.dict()[k] for k in kept}, before)
        equal(saved + 'preSave runs before the attributes are written', engine.preSaves, 1)
        equal(saved + 'postSave runs after', engine.postSaves, 0)
        equal(saved + 'postLoad runs once', engine.postLoads, 1)
        equal(saved + 'read-only attribute', engine.steps, 3)
        equal(saved + 'noSave attribute', engine.scratch, 7.)
        equal(saved + 'object', (engine.item.normal, engine.item.kind), (Vector3(1, 0, 0), 'slip'))
        equal(saved + 'objects', [i.kind for i in engine.items], ['slip', 'fixed'])
        engine.item.kind = 'friction'
        equal(saved + 'an object that was shared still is', engine.items[0].kind, 'friction')
        equal(saved + 'label', grid.label, 'grid')
        equal(saved + 'attributes of the base', (O.engines[2].iterPeriod, O.engines[2].nDo, O.engines[2].runs), (4, 50, 3))
        equal(saved + 'material', (O.materials['steel'].yieldStress, O.materials['steel'].young), (240e6, 210e9))
        check(saved + 'material is the body\'s', O.bodies[0].material == O.materials['steel'])
        equal(saved + 'state', (state.stress, state.pos, state.blockedDOFs, state.volume), (matrix, Vector3(1, 2, 3), 'xY', 3.))
        equal(saved + 'miscParams', O.miscParams[0].kind, 'kept with the scene')
        O.run(2, True)
        equal(saved + 'runs on', grid.steps, 5)

O.reset()
O.engines = [ProbeEngine(word='in memory')]
O.saveTmp()
O.reset()
O.loadTmp()
equal('saveTmp, loadTmp', O.engines[0].word, 'in memory')

finish()
