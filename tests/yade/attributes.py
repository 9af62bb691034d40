# SPDX-License-Identifier: GPL-2.0-or-later
"""Every attribute that pkg/yade declares: written by Python and read through the declarations, and the other way round."""
import os
import sys
import tempfile

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish, same

from yade import *

probe = ProbeEngine()
turn = Quaternion((0, 0, 1), .3)
other = Quaternion((0, 1, 0), -.2)

# An instance, and for each attribute a value for Python to set and one for C++; None where Python cannot set it.
cases = {
    'Engine': (lambda: GlobalEngine(), dict(dead=(True, False), ompThreads=(7, 8), label=('one', 'another, longer than the string itself holds'))),
    'PartialEngine': (lambda: PartialEngine(), dict(ids=([3, 1, 4], [1, 5]))),
    'TimeStepper': (lambda: GlobalStiffnessTimeStepper(), dict(active=(False, True), timeStepUpdateInterval=(17, 18))),
    'PeriodicEngine': (lambda: PeriodicEngine(), dict(
        virtPeriod=(1.5, 2.5), realPeriod=(3.5, 4.5), iterPeriod=(11, 2**40), nDo=(12, 13), initRun=(True, False), firstIterRun=(14, 15),
        virtLast=(5.5, 6.5), realLast=(7.5, 8.5), iterLast=(16, 17), nDone=(18, 19))),
    'State': (lambda: State(), dict(
        pos=(Vector3(1, 2, 3), Vector3(4, 5, 6)), ori=(turn, other), se3=((Vector3(7, 8, 9), turn), (Vector3(1, 1, 2), other)),
        vel=(Vector3(3, 1, 4), Vector3(1, 5, 9)), mass=(2.5, 3.5), angVel=(Vector3(2, 6, 5), Vector3(3, 5, 8)),
        angMom=(Vector3(9, 7, 9), Vector3(3, 2, 3)), inertia=(Vector3(8, 4, 6), Vector3(2, 6, 4)), refPos=(Vector3(3, 3, 8), Vector3(3, 2, 7)),
        refOri=(turn, other), blockedDOFs=('xZ', 'yzX'), isDamped=(False, True), densityScaling=(.25, .75))),
    'Material': (lambda: FrictMat(), dict(id=(None, 6), label=('steel', 'a label longer than the string itself holds'), density=(7850., 2700.))),
    'ElastMat': (lambda: FrictMat(), dict(young=(210e9, 70e9), poisson=(.3, .33))),
    'FrictMat': (lambda: FrictMat(), dict(frictionAngle=(.6, .7))),
    'Shape': (lambda: Sphere(), dict(color=(Vector3(.1, .2, .3), Vector3(.4, .5, .6)), wire=(True, False), highlight=(True, False))),
    'Sphere': (lambda: Sphere(), dict(radius=(.125, .25))),
    'Bound': (lambda: Aabb(), dict(
        lastUpdateIter=(None, 4), refPos=(None, Vector3(4, 5, 6)), sweepLength=(None, .75),
        color=(Vector3(.1, .2, .3), Vector3(.4, .5, .6)), min=(None, Vector3(-1, -2, -3)), max=(None, Vector3(1, 2, 3)))),
    'Body': (lambda: Body(), dict(
        id=(None, 4), groupMask=(5, 6), flags=(None, 3), subdomain=(7, 8), material=(FrictMat(), FrictMat()), state=(State(), State()),
        shape=(Sphere(), Sphere()), bound=(Aabb(), Aabb()), clumpId=(None, 9), iterBorn=(None, 10), timeBorn=(None, 1.25))),
}

for name, (make, attributes) in cases.items():
    for attribute in probe.attributesOf(name):
        if attribute not in attributes:
            check('%s.%s' % (name, attribute), False, 'the declarations name it and this test does not')
    for attribute, (fromPython, fromCpp) in attributes.items():
        full, instance = '%s.%s' % (name, attribute), make()
        try:
            if fromPython is not None:
                setattr(instance, attribute, fromPython)
                if not same(probe.read(instance, full), fromPython):
                    check(full, False, 'Python wrote %r, the declarations read %r' % (fromPython, probe.read(instance, full)))
                    continue
            probe.write(instance, full, fromCpp)
            equal(full, getattr(instance, attribute), fromCpp)
        except Exception as error:
            check(full, False, '%s: %s' % (type(error).__name__, error))

# Attributes of the scene, which Python sees as those of O.
O.bodies.append([sphere((0, 0, 0), 1, material=FrictMat()), sphere((1.5, 0, 0), 1), sphere((9, 0, 0), 1)])


def scene(name, found, wanted):
    try:
        equal(name, found(), wanted)
    except Exception as error:
        check(name, False, '%s: %s' % (type(error).__name__, error))


def read(name):
    return probe.read(None, name)


O.dt = 1.25e-3
scene('Scene.dt', lambda: read('Scene.dt'), 1.25e-3)
probe.write(None, 'Scene.dt', 2.5e-3)
scene('Scene.dt, from C++', lambda: O.dt, 2.5e-3)
O.trackEnergy = True
scene('Scene.trackEnergy', lambda: read('Scene.trackEnergy'), True)
O.stopAtIter, O.stopAtTime = 1234567, 12.5
scene('Scene.stopAtIter', lambda: read('Scene.stopAtIter'), 1234567)
scene('Scene.stopAtTime', lambda: read('Scene.stopAtTime'), 12.5)
O.stopAtIter, O.stopAtTime = 0, 0
O.periodic = True
scene('Scene.isPeriodic', lambda: read('Scene.isPeriodic'), True)
O.periodic = False
probe.write(None, 'Scene.subdomain', 2)
scene('Scene.subdomain', lambda: O._sceneObj.subdomain, 2)
probe.write(None, 'Scene.subdomain', 0)
for attribute, value in dict(doSort=True, selectedBody=1, speed=3.5, subStep=4).items():
    probe.write(None, 'Scene.' + attribute, value)
    scene('Scene.' + attribute, lambda: getattr(O._sceneObj, attribute), value)
probe.write(None, 'Scene.doSort', False)
probe.write(None, 'Scene.subStep', -1)
probe.write(None, 'Scene.selectedBody', -1)
# Hidden from Python, and seen in what is saved.
probe.write(None, 'Scene.runInternalConsistencyChecks', True)
with tempfile.TemporaryDirectory() as folder:
    O.save(folder + '/scene.xml')
    with open(folder + '/scene.xml') as saved:
        check('Scene.runInternalConsistencyChecks', '<runInternalConsistencyChecks>1<' in saved.read())
probe.write(None, 'Scene.runInternalConsistencyChecks', False)
O.subStepping = True
scene('Scene.subStepping', lambda: read('Scene.subStepping'), True)
O.subStepping = False
O.engines = [ForceResetter(), probe]
scene('Scene.engines', lambda: [type(e).__name__ for e in (read('Scene._nextEngines') or read('Scene.engines'))], ['ForceResetter', 'ProbeEngine'])
scene('Scene.materials', lambda: read('Scene.materials'), [O.materials[i] for i in range(len(O.materials))])
O.tags['description'] = 'probe'
scene('Scene.tags', lambda: 'description=probe' in read('Scene.tags'), True)
O.miscParams = [FrictMat(young=5)]
scene('Scene.miscParams', lambda: read('Scene.miscParams')[0].young, 5.)
probe.write(None, 'Scene.miscParams', [FrictMat(young=6), State(mass=7)])
scene('Scene.miscParams, from C++', lambda: (O.miscParams[0].young, O.miscParams[1].mass), (6., 7.))
O.step()
scene('Scene.iter', lambda: read('Scene.iter'), 1)
scene('Scene.time', lambda: read('Scene.time'), 2.5e-3)
scene('Engine.scene', probe.sceneIsOmegas, True)

scene('BodyContainer.body', lambda: read('BodyContainer.body'), [O.bodies[i] for i in range(3)])
for attribute in ('useRedirection', 'enableRedirection'):
    before = read('BodyContainer.' + attribute)
    setattr(O.bodies, attribute, not before)
    scene('BodyContainer.' + attribute, lambda: read('BodyContainer.' + attribute), not before)
    setattr(O.bodies, attribute, before)
O.bodies.erase(1)
scene('BodyContainer.erasedBodies', lambda: list(read('BodyContainer.erasedBodies')), [1])
scene('BodyContainer.insertedBodies', lambda: set(read('BodyContainer.insertedBodies')) >= {0, 2}, True)
scene('BodyContainer.begin, end skip an erased body', probe.liveBodyIds, [0, 2])
O.bodies.insertAtId(sphere((1.5, 0, 0), 1), 1)

O.forces.addF(0, (1, 2, 3))
scene('ForceContainer::getForce', lambda: read('ForceContainer.force0'), Vector3(1, 2, 3))
probe.write(None, 'ForceContainer.force0', Vector3(1, 1, 1))
scene('ForceContainer::addForce', lambda: O.forces.f(0, sync=True), Vector3(2, 3, 4))
O.forces.addT(0, (4, 5, 6))
scene('ForceContainer::getTorque', lambda: read('ForceContainer.torque0'), Vector3(4, 5, 6))
probe.write(None, 'ForceContainer.torque0', Vector3(1, 1, 1))
scene('ForceContainer::addTorque', lambda: O.forces.t(0, sync=True), Vector3(5, 6, 7))
probe.write(None, 'ForceContainer.permForce0', Vector3(7, 8, 9))
scene('ForceContainer::setPermForce', lambda: O.forces.permF(0), Vector3(7, 8, 9))
scene('ForceContainer::getPermForce', lambda: read('ForceContainer.permForce0'), Vector3(7, 8, 9))
O.forces.reset()
probe.write(None, 'EnergyTracker.probe', 4.5)
scene('EnergyTracker::setItem_py', lambda: O.energy['probe'], 4.5)
scene('EnergyTracker::getItem_py', lambda: read('EnergyTracker.probe'), 4.5)

# A contact, for the attributes of an interaction.
O.engines = [
    ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])]
O.dt = 1e-9
O.step()
contact = O.interactions[0, 1]
for attribute in ('id1', 'id2', 'iterMadeReal', 'iterBorn', 'geom', 'phys', 'cellDist', 'isActive'):
    equal('Interaction.' + attribute, probe.read(contact, 'Interaction.' + attribute), getattr(contact, attribute))
equal('Bound.min after the collider', probe.read(O.bodies[0].bound, 'Bound.min'), O.bodies[0].bound.min)

finish()
