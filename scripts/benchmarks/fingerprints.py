# SPDX-License-Identifier: GPL-2.0-or-later
"""Fingerprints of scenes: a SHA-256 of every column of every point, the walls' forces and the energies, after some steps.

	scripts/yade-mpm -n -x [-j2] scripts/benchmarks/fingerprints.py [scene ...]

Run it before and after a change that must not change results, on the same machine and with the same MPM_INSTRUCTIONS, and
compare what it prints. Scenes cover all analyses, shape functions and schemes, the options, contacts and laws. The grid
is not part of a fingerprint.
"""
import hashlib
import sys

import numpy
from yade import *
from yade import mpm

quantities = 'id', 'position', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'dissipation'
steel = dict(young=1e6, poisson=.3, density=1000, yieldStress=2e4, tangentRatio=.05, n=10)
plane, solid = ((.1, .2), (1.1, 1.2)), ((.1, .2, .3), (.7, .8, .9))
floor = dict(normal=(0, 1, 0), origin=(0, .05, 0))


def scene(region=plane, material=None, spacing=.05, velocity=(1, -2, 0), thickness=.1, steps=60, walls=(dict(kind='friction', friction=.3, **floor),),
	bodies=True, energy=False, prescribed=False, ball=False, loads=False, axisymmetric=False, courant=.2, **engine):
	O.reset()
	O.trackEnergy = energy
	O.materials.append(material or FrictMat(young=1e6, poisson=.3, density=1000, frictionAngle=.5))
	if len(region[0]) == 3 or axisymmetric: thickness = None
	ids = mpm.fill(region, spacing=spacing, thickness=thickness, material=0, velocity=velocity, bodies=bodies, axisymmetric=axisymmetric)
	grid = MpmEngine(cellSize=2*spacing, walls=[MpmWall(**w) for w in walls], **engine)
	O.engines = [ForceResetter()]
	if ball:
		O.bodies.append(sphere((.6, 1.2 + .1, 0), .1, material=0))
		O.bodies[-1].state.vel = Vector3(0, -2, 0)
		O.engines += [InsertionSortCollider([Bo1_Sphere_Aabb()]),
			InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])]
	if loads: O.engines += [ForceEngine(ids=ids[:7], force=(3, 5, 0))]
	O.engines += [grid]
	if ball: O.engines += [NewtonIntegrator()]
	if prescribed:
		for i in ids[:20]: O.bodies[i].state.blockedDOFs = 'xy'
	O.dt = courant*2*spacing/36.7 # of the time that a pressure wave takes across a cell: no estimate that may change enters
	O.run(steps, True)
	found = hashlib.sha256()
	for name in quantities: found.update(numpy.ascontiguousarray(mpm.array(name)).tobytes())
	for wall in grid.walls: found.update(numpy.array(wall.force).tobytes())
	found.update(numpy.array([O.dt, *(value for _, value in sorted(O.energy.items()))]).tobytes())
	check = numpy.abs(mpm.array('stress')).max()
	return found.hexdigest()[:16], check


scenes = {
	'planeStress cubic MUSL': {},
	'planeStress cubic USL': dict(scheme='USL'),
	'planeStress cubic USF': dict(scheme='USF'),
	'planeStress quadratic': dict(shape='quadratic'),
	'planeStress linear': dict(shape='linear'),
	'planeStress gimp': dict(shape='gimp'),
	'planeStress hysteretic': dict(material=lambda: BoucWenMat(**steel)),
	'planeStress thinning, hysteretic, energies': dict(material=lambda: BoucWenMat(**steel), thinning=True, energy=True),
	'planeStress Drucker-Prager, small strain': dict(material=lambda: DruckerPragerMat(young=1e6, poisson=.3, density=1000, cohesion=2e4, internalFriction=.5), largeStrain=False),
	'planeStrain mean dilatation, J2, linear': dict(analysis='planeStrain', shape='linear', meanDilatation=True, material=lambda: J2Mat(young=1e6, poisson=.3, density=1000, yieldStress=2e4)),
	'planeStrain mean dilatation, USF': dict(analysis='planeStrain', scheme='USF', meanDilatation=True, energy=True),
	'planeStrain full mass, energies': dict(analysis='planeStrain', fullMass=True, energy=True, loads=True),
	'planeStrain full mass, PIC, filter, energies': dict(analysis='planeStrain', fullMass=True, flip=.98, filterTime=.05, energy=True,
		walls=(dict(kind='fixed', velocity=(.3, .2, 0), **floor),)),
	'planeStrain PIC, damping, gravity, energies': dict(analysis='planeStrain', flip=.95, damping=.1, gravity=(0, -10, 0), energy=True),
	'planeStrain hysteretic options': dict(analysis='planeStrain', material=lambda: BoucWenMat(reloading=2, strengthDegradation=.1, stiffnessDegradation=.05, pinching=.3, **steel)),
	'planeStress contact with a grain': dict(ball=True, loads=True),
	'planeStress contact with a grain, energies': dict(ball=True, energy=True, gravity=(0, -10, 0), scheme='MUSL'),
	'planeStress prescribed points': dict(prescribed=True, energy=True, velocity=(1, .5, 0), material=lambda: BoucWenMat(**steel)),
	'axisymmetric cubic': dict(analysis='axisymmetric', axisymmetric=True, velocity=(0, -2, 0), walls=(dict(kind='fixed', **floor),)),
	'axisymmetric full mass, mean dilatation, energies': dict(analysis='axisymmetric', axisymmetric=True, velocity=(0, -2, 0), fullMass=True, meanDilatation=True,
		energy=True, material=lambda: BoucWenMat(**steel), walls=(dict(kind='slip', **floor),)),
	'3d cubic, without bodies, walls in a corner': dict(region=solid, spacing=.1, analysis='3d', bodies=False, velocity=(-1, -2, .5),
		walls=(dict(kind='slip', normal=(1, 0, 0)), dict(kind='friction', friction=.2, **floor))),
	'3d linear, energies': dict(region=solid, spacing=.1, analysis='3d', shape='linear', energy=True, material=lambda: BoucWenMat(**steel)),
	'3d quadratic, full mass': dict(region=solid, spacing=.1, analysis='3d', shape='quadratic', fullMass=True, material=lambda: BoucWenMat(**steel)),
	'planeStress 5000 points without bodies, moving wall': dict(spacing=.014, bodies=False, walls=(dict(kind='fixed', velocity=(0, .5, 0), **floor),), steps=30,
		material=lambda: BoucWenMat(**steel)),
}

for name, options in scenes.items():
	if len(sys.argv) > 1 and name not in sys.argv[1:]: continue
	options = dict(options)
	if 'material' in options: options['material'] = options['material']()
	print('%-52s %s  %.6g Pa' % ((name,) + scene(**options)))
