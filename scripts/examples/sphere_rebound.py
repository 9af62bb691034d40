# SPDX-License-Identifier: GPL-2.0-or-later
"""A sphere falls on an elastic block and rebounds, faster from a stiffer block.

    scripts/yade-mpm -n -x scripts/examples/sphere_rebound.py [out] [--young 1e5 1e6 1e7 1e8] [--time 0.25]

The sphere (radius 0.2 m, 1000 kg/m3, E = 1e5 Pa) hits a block of 1 x 1 x 0.5 m on a rigid wall at 1 m/s,
without gravity or friction. The softer of the two determines the duration of the contact. Waves in the block
carry away the energy that the sphere loses in this time. The ratio of speeds tends to 1 with the stiffness of
the block. Writes sphere_rebound.csv and .png.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

RADIUS, SPACING, SPEED = .2, .125, 1.


def run(young, duration):
	"""Rows (time, height of the sphere's lowest point over the block as it was, velocity, force on the sphere, energies of sphere and block)."""
	O.reset()
	O.materials.append(FrictMat(young=young, poisson=.3, density=1000, frictionAngle=0, label='block'))
	O.materials.append(FrictMat(young=1e5, poisson=.3, density=1000, frictionAngle=0, label='ball'))
	mpm.fill(((0, 0, 0), (1, 1, .5)), spacing=SPACING, material='block')
	ball = O.bodies[O.bodies.append(sphere((.5, .5, .501 + RADIUS), RADIUS, material='ball'))]
	ball.state.vel = (0, 0, -SPEED)
	rows = []

	def note():
		energies = [O.energy[name] if name in O.energy.keys() else 0. for name in ('elastPotential', 'mpmKinetic', 'mpmElastic')]
		rows.append([O.time, ball.state.pos[2] - RADIUS - .5, ball.state.vel[2], O.forces.f(ball.id)[2], .5*ball.state.mass*ball.state.vel.squaredNorm()] + energies)

	import __main__
	__main__.note = note
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=.1*SPACING),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		MpmEngine(cellSize=2*SPACING, analysis='3d', walls=[MpmWall(normal=(0, 0, 1), kind='fixed')]),
		NewtonIntegrator(damping=0),
		PyRunner(iterPeriod=1, initRun=True, command='note()'),
	]
	O.trackEnergy = True
	O.dt = .1*mpm.criticalTimeStep()
	O.run(max(2, int(duration/O.dt)), True)
	return np.array(rows)


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--young', type=float, nargs='+', default=[1e5, 1e6, 1e7, 1e8], help="the block's moduli [Pa]")
	parser.add_argument('--time', type=float, default=.25, help='duration [s]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)
	figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4))
	with open(os.path.join(options.out, 'sphere_rebound.csv'), 'w', newline='') as f:
		table = csv.writer(f)
		table.writerow(['young_Pa', 'time_s', 'height_m', 'velocity_m_s', 'force_N', 'sphere_J', 'contact_J', 'blockKinetic_J', 'blockElastic_J'])
		for young in options.young:
			rows = run(young, options.time)
			for row in rows[::max(1, len(rows)//500)]: table.writerow(['%g' % young] + ['%.9g' % v for v in row])
			total = rows[-1, 4:].sum()/rows[0, 4:].sum() - 1
			print('E = %8.3g Pa: velocity after/before %.5f, energy balance %+.2e' % (young, rows[-1, 2]/SPEED, total), flush=True)
			left.plot(1e3*rows[:, 0], rows[:, 2], label='E = %g Pa' % young)
	energies = rows[:, 4:]/rows[0, 4:].sum()
	right.stackplot(1e3*rows[:, 0], energies.T, labels=['sphere', 'contact', 'block, kinetic', 'block, elastic'])
	left.set(xlabel='time [ms]', ylabel='velocity of the sphere [m/s]', title='Velocity, by the modulus of the block')
	right.set(xlabel='time [ms]', ylabel='energy / energy at the start', title='Energies, E = %g Pa' % young)
	left.legend()
	right.legend(loc='lower right')
	left.grid(alpha=.3)
	figure.savefig(os.path.join(options.out, 'sphere_rebound.png'), dpi=130, bbox_inches='tight')
	print('results in %s' % os.path.abspath(options.out))


main()
