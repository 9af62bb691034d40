# SPDX-License-Identifier: GPL-2.0-or-later
"""What scripts do to a scene between steps, or between loading and the first step, is neither lost nor misread.

Each case is compared with the same scene that was not interrupted, or with what is exact.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

# ---- a loaded scene has no solver until its first step: energy of what is erased there --------------------------------------
found = []
for loaded in False, True:
	ids, grid = block(velocity=(0, -1, 0), walls=[MpmWall(normal=(0, 1, 0), kind='fixed')], analysis='planeStrain', largeStrain=False)
	O.trackEnergy = True
	O.run(40, True)
	if loaded:
		O.saveTmp()
		O.loadTmp()
	O.bodies.erase(ids[0])
	mpm.fill(((2, 0), (2.5, .5)), spacing=.25, thickness=.1, material='elastic')
	O.run(1, True)
	found.append([O.energy[name] for name in ('mpmKinetic', 'mpmElastic', 'mpmExternal')])
check('the points were strained', found[0][1] > 1, found)
near('energies of points erased after loading', found[1], found[0], 1e-12)

# ---- the stable step follows materials that change, loaded or not; no points, no step ---------------------------------------
for loaded in False, True:
	block(timeStepSafety=.4, analysis='planeStrain')
	O.run(3, True)
	before = O.dt
	if loaded:
		O.saveTmp()
		O.loadTmp()
	O.materials[0].young *= 100
	O.run(1, True)
	near('O.dt of a material 100 times as stiff, %s' % ('loaded' if loaded else 'in a run'), O.dt/before, .1, 1e-3)
ends = []
for loaded in False, True:
	block(velocity=(0, -1, 0), walls=[MpmWall(normal=(0, 1, 0), kind='fixed')], timeStepSafety=.4)
	O.run(20, True)
	if loaded:
		O.saveTmp()
		O.loadTmp()
	O.run(20, True)
	ends.append((O.time, mpm.array('position')))
check('steps that the engine chooses are the same after loading', ends[0][0] == ends[1][0] and (ends[0][1] == ends[1][1]).all(), (ends[0][0], ends[1][0]))
ids, grid = block(timeStepSafety=.4)
O.run(2, True)
for i in ids: O.bodies.erase(i)
O.run(2, True)
check('a scene whose points have been erased keeps its time', O.time < 1 and O.dt < 1, (O.time, O.dt))
mpm.fill(((0, 0), (1, 1)), spacing=.25, thickness=.1, material='elastic')
O.run(2, True)
check('new points move on', numpy.isfinite(mpm.array('position')).all() and O.time < 1, O.time)

# ---- numerical fracture: seen soon after it happens; none where a script moves walls or changes materials -------------------
hung = lambda y: MpmWall(normal=(0, -1, 0), origin=(0, y, 0), kind='fixed')
ids, grid = block(material=FrictMat(young=1e6, poisson=.3, density=1050, label='soft'), analysis='planeStrain', shape='quadratic', gravity=(0, -1000, 0),
	walls=[hung(1)], courant=.1)
raises('a bar that starts from rest and tears', RuntimeError, 'have come apart', lambda: O.run(3000, True))
check('is found when it has torn, not long after', -8 < mpm.array('position')[:, 1].min() < -1, mpm.array('position')[:, 1].min())
last, torn = O.iter, state()
for before in 1, 25, last - 3:
	bar = dict(material=FrictMat(young=1e6, poisson=.3, density=1050, label='soft'), analysis='planeStrain', shape='quadratic', gravity=(0, -1000, 0))
	ids, grid = block(walls=[hung(1)], courant=.1, **bar)
	O.run(last - before, True)
	O.saveTmp()
	O.loadTmp()
	raises('saved and loaded %d steps before it is found to be torn' % before, RuntimeError, 'have come apart', lambda: O.run(3000, True))
	equal('it is found at the same step', O.iter, last)
	same('in the same state', state()['position'], torn['position'])

ids, grid = block(analysis='planeStrain', walls=[hung(1)])
O.run(30, True)
grid.walls = [hung(9)]
O.run(100, True)
check('a wall put elsewhere is no fracture', O.iter > 120)
ids, grid = block(analysis='planeStrain')
O.run(30, True)
O.materials.append(DruckerPragerMat(label='sand', young=1e6, poisson=.3, density=1000, cohesion=1, internalFriction=.5, dilatancy=0))
for i in ids:
	body = O.bodies[i]
	body.mat = O.materials['sand']
	body.state.vel = ((1e3 if body.state.pos[0] > .5 else -1e3)*O.dt, 0, 0)
O.run(1, True)
for i in ids: O.bodies[i].state.vel = (3/O.dt/100 if O.bodies[i].state.pos[0] > .5 else -3/O.dt/100, 0, 0)
O.run(150, True)
check('points that have become sand may part', numpy.ptp(mpm.array('position')[:, 0]) > 4, numpy.ptp(mpm.array('position')[:, 0]))

# ---- one component of a velocity, of a point in contact too; a NaN that is put right ----------------------------------------
ids, grid = block(((0, 0, 0), (1, 1, .5)), thickness=None, analysis='3d',
	before=[InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])],
	after=[NewtonIntegrator()], courant=.05)
O.bodies.append(sphere((.5, .5, .645), .2, material='elastic'))
O.bodies[-1].state.vel = (0, 0, -.5)
O.trackEnergy = True
O.run(4, True)
touched = [i for i in ids if any(k.isReal for k in O.bodies[i].intrs())]
check('the ball touches points', touched)
own = lambda i: mpm.array('velocity')[list(mpm.array('id')).index(i)]
before = own(touched[0])
check('a point in contact shows another velocity than its own', abs(O.bodies[touched[0]].state.vel[2] - before[2]) > 1e-3, (before, O.bodies[touched[0]].state.vel))
O.bodies[touched[0]].state.vel += Vector3(.01, 0, 0)
mpm.criticalTimeStep() # reads the bodies
near('what a script adds to its velocity', own(touched[0]) - before, (.01, 0, 0), 1e-12)
velocity = Vector3(*O.bodies[ids[0]].state.vel)
O.bodies[ids[0]].state.vel = Vector3(float('nan'), 0, 0)
raises('a velocity that is no number', RuntimeError, 'vel', lambda: O.run(1, True))
O.bodies[ids[0]].state.vel = velocity
O.run(1, True)
check('once it is put right, energies are numbers', numpy.isfinite([O.energy[name] for name in O.energy.keys()]).all(), dict(O.energy.items()))

finish()
