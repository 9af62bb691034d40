# SPDX-License-Identifier: GPL-2.0-or-later
"""A short scene that passes through most of the plugin: two laws, contacts with a grain, walls, energies, filter, recorder, save and load,
points added and erased, a failed step. scripts/memcheck runs it under valgrind.
"""
import os
import tempfile

from yade import *
from yade import mpm
from yade.wrapper import *

O = Omega()
folder = tempfile.TemporaryDirectory()
O.materials.append(BoucWenMat(label='steel', young=1e6, poisson=.3, density=1000, yieldStress=1e4, n=5, tangentRatio=.05))
O.materials.append(FrictMat(label='rubber', young=1e6, poisson=.3, density=1000, frictionAngle=.5))
ids = mpm.fill(((0, 0, 0), (.5, .5, .25)), spacing=.125, material='steel', velocity=(0, -1, 0))
mpm.fill(((0, 1, 0), (.25, 1.25, .25)), spacing=.125, material='rubber', bodies=False)
O.bodies.append(utils.sphere((.25, .6, .125), .1, material='rubber'))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
	[Law2_ScGeom_FrictPhys_CundallStrack()]), MpmEngine(cellSize=.25, analysis='3d', gravity=(0, -10, 0), filterTime=.01, walls=[MpmWall(normal=(0, 1, 0), kind='friction', friction=.3)]),
	NewtonIntegrator(gravity=(0, -10, 0)), MpmVtkRecorder(fileName=os.path.join(folder.name, 'a-'), iterPeriod=3, recorders=['id', 'stress', 'grid'])]
O.trackEnergy = True
O.dt = 1e-6
O.dt = .1*mpm.criticalTimeStep()
O.run(6, True)
O.forces.setPermF(ids[2], (1, 0, 0))
O.save(os.path.join(folder.name, 'a.xml'))
O.load(os.path.join(folder.name, 'a.xml'))
O.bodies.erase(ids[0])
mpm.fill(((1, 0, 0), (1.25, .25, .25)), spacing=.125, material='rubber')
O.materials[0].young *= 1.1
O.trackEnergy = False
O.run(6, True)
for name in 'id', 'stress', 'strain', 'F', 'volume', 'plasticStrain', 'backStress', 'displacement', 'vonMises': mpm.array(name)
mpm.drive('steel', [[[.01*k, 0, 0], [0, 0, 0], [0, 0, 0]] for k in range(4)], free=('yy', 'zz'))
O.bodies[ids[5]].state.vel = (1e9, 0, 0)
try: O.run(3, True)
except RuntimeError as fault: print('refused: %s' % fault)
mpm.array('stress')
O.reset()
print('the scene has run', flush=True)
