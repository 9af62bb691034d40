# SPDX-License-Identifier: GPL-2.0-or-later
"""The affine transfer, through the engine: which scenes have it, what a script sees of it, and that bodies that turn keep their spin.

A free square of 0.4 m, E = 1 MPa, nu = 0.3, 1200 kg/m3, 10 points across, that spins with 5 rad/s and flies.
"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

w, side = 5., .4


def spinning(n=10, corner=(.137, .271), courant=.5, **engine):
	"""About the axis normal to the plane, or a skew one in 3D."""
	dim = len(corner)
	ids, grid = block(region=(corner, [c + side for c in corner]), spacing=side/n, thickness=.3 if dim == 2 else None, material=elastic(density=1200.), courant=None, **engine)
	axis = numpy.array((0, 0, w) if dim == 2 else (3, -2, 3.46))
	for i, v in zip(mpm.array('id'), numpy.cross(axis, mpm.array('position') - mpm.array('position').mean(0)) + numpy.array((.7, -.2, 0))): O.bodies[int(i)].state.vel = Vector3(*v)
	O.dt = courant*mpm.criticalTimeStep()
	return grid


def own():
	"""Angular momentum about the centre of mass."""
	m, x, v = mpm.array('mass')[:, None], mpm.array('position'), mpm.array('velocity')
	centre, flight = (m*x).sum(0)/m.sum(), (m*v).sum(0)/m.sum()
	return numpy.array(mpm.angularMomentum(centre)) - m.sum()*numpy.cross(0*centre, flight)


# ---- which scenes have it ------------------------------------------------------------------------------------------------
for expected, engine in ((False, {}), (True, dict(transfer='auto')), (True, dict(transfer='auto', shape='quadratic')), (True, dict(transfer='auto', scheme='USL')), (False, dict(transfer='auto', shape='linear')), (False, dict(transfer='auto', shape='gimp')), (False, dict(transfer='auto', scheme='USF')),
	(False, dict(transfer='flip')), (True, dict(transfer='affine', shape='linear'))):
	spinning(**engine)
	O.run(2, True)
	found = mpm.array('angularVelocity')
	equal('%s: shape of angularVelocity' % engine, found.shape, (100, 3))
	if expected: near('%s: points turn with the body' % engine, found, numpy.tile((0, 0, w), (100, 1)), .02*w)
	else: near('%s: no rotation' % engine, found, 0*found, 0)
grid = spinning()
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
	MpmEngine(cellSize=2*side/10, transfer='auto'), NewtonIntegrator()]
O.run(2, True)
near('with an InteractionLoop there is none', mpm.array('angularVelocity'), numpy.zeros((100, 3)), 0)

raises('a transfer that is none', RuntimeError, "MpmEngine.transfer = 'apic'", lambda: (spinning(transfer='apic'), O.run(1, True)))

# ---- it keeps the spin, and the sum of energies ---------------------------------------------------------------------------
for corner, n, engine, bound in (((.137, .271), 10, {}, 5e-4), ((.137, .271), 10, dict(shape='quadratic', analysis='planeStrain', meanDilatation=True), 1e-3), ((.137, .271), 10, dict(fullMass=True), 1e-3),
	((.1, .2, .3), 6, dict(analysis='3d'), 5e-3)):
	spinning(n, corner, transfer='affine', **engine)
	O.trackEnergy = True
	O.step()
	first, energy = own(), O.energy.total()
	O.run(int(6.283/w/O.dt), True)
	near('%s: spin after a turn' % engine, own()/numpy.linalg.norm(first), first/numpy.linalg.norm(first), bound)
	near('%s: sum of energies' % engine, O.energy.total()/energy, 1, 1e-3)

# ---- a transfer that changes, points that come and go: energies go on closing ------------------------------------------------
grid = spinning(transfer='affine')
O.trackEnergy = True
O.run(50, True)
energy = O.energy.total()
grid.transfer = 'flip'
O.run(1, True)
near('rotation given up: sum of energies', O.energy.total()/energy, 1, 1e-3)
before = O.energy.total()
grid.transfer = 'affine'
O.run(1, True)
energy = O.energy.total()
near('rotation taken up: sum of energies', energy/before, 1, 1e-3)
O.bodies.erase(int(mpm.array('id')[0]))
new = mpm.fill(((5, 5), (5.1, 5.1)), spacing=side/10, thickness=.3, material='elastic')
O.run(1, True)
near('a point erased, and others added', O.energy.total()/energy, 1, 1e-3)
near('new points at rest have no rotation', mpm.array('angularVelocity')[-len(new):], numpy.zeros((len(new), 3)), 1e-9)

# ---- saved half-way: the same bits, and the same momentum before the first step ------------------------------------------------
for corner in (.137, .271), (.1, .2, .3):
	ends = []
	for loaded in False, True:
		spinning(6, corner, transfer='affine', analysis='3d' if len(corner) == 3 else 'planeStress')
		O.run(40, True)
		momentum0 = mpm.angularMomentum()
		if loaded:
			with tempfile.TemporaryDirectory() as folder:
				file = os.path.join(folder, 'a.xml')
				O.save(file)
				O.reset()
				O.load(file)
			near('%dD: angular momentum of a loaded scene' % len(corner), mpm.angularMomentum()/momentum0.norm(), momentum0/momentum0.norm(), 1e-14)
		O.run(40, True)
		ends.append(state())
	for name in ends[0]: same('%dD, loaded half-way: %s' % (len(corner), name), ends[1][name], ends[0][name])
finish()
