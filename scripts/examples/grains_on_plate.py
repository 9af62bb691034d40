# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains fall on a thin elastoplastic plate that is clamped at two edges, and bend it permanently.

    scripts/yade-mpm -n -x scripts/examples/grains_on_plate.py [out] [--grains 48] [--speed 3] [--time 0.2]

The plate is 1 x 0.5 x 0.05 m, of a soft metal (E = 100 MPa, yield stress 1 MPa, 5 % hardening, 2000 kg/m3),
3D, with three layers of points. Prescribed points clamp its ends at x = 0 and x = 1. Spheres (radius 0.04 m,
2600 kg/m3) in a random loose cloud fall on it. The edges at y = 0 and y = 0.5 m are free: spheres leave the
plate over them and fall below it. Writes grains_on_plate.csv (deflection, plastic strain, energies, contacts
over time) and .png.
"""
import argparse
import csv
import os
import random
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from yade import mpm
from yade import *

LENGTH, WIDTH, HEIGHT, SPACING, RADIUS, G = 1., .5, .05, .05/3, .04, 9.81


def cloud(count):
	"""Centres of spheres that do not touch, above the middle of the plate."""
	random.seed(7)
	centres = []
	while len(centres) < count:
		layer = len(centres)//12 # a dozen a layer
		new = (random.uniform(.25, .75), random.uniform(.08, WIDTH - .08), HEIGHT + 1.1*RADIUS + 2.1*RADIUS*layer + random.uniform(0, .05)*RADIUS)
		if all(sum((a - b)**2 for a, b in zip(new, old)) > (2*RADIUS)**2 for old in centres): centres.append(new)
	return centres


def squares(ax, x, y, values, size, **style):
	"""Draw each point as a square of its size, without gaps between neighbours."""
	corners = size/2*np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
	patches = PolyCollection(np.column_stack((x, y))[:, None] + corners, array=values, edgecolors='face', linewidths=.6, **style)
	ax.add_collection(patches)
	ax.autoscale_view()
	return patches


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--grains', type=int, default=48, help='number of spheres')
	parser.add_argument('--speed', type=float, default=3., help='at which they fall [m/s]')
	parser.add_argument('--time', type=float, default=.2, help='duration [s]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)

	O.materials.append(BoucWenMat(label='plate', young=100e6, poisson=.3, density=2000, yieldStress=1e6, tangentRatio=.05, n=10, frictionAngle=.4))
	O.materials.append(FrictMat(label='grain', young=20e6, poisson=.3, density=2600, frictionAngle=.4))
	plate = mpm.fill(((0, 0, 0), (LENGTH, WIDTH, HEIGHT)), spacing=SPACING, material='plate')
	for i in plate:
		if not 2*SPACING < O.bodies[i].state.pos[0] < LENGTH - 2*SPACING: O.bodies[i].state.blockedDOFs = 'xyz'
	balls = [O.bodies.append(sphere(centre, RADIUS, material='grain')) for centre in cloud(options.grains)]
	for b in balls: O.bodies[b].state.vel = (0, 0, -options.speed)
	middle = [i for i in plate if abs(O.bodies[i].state.pos[0] - LENGTH/2) < SPACING and O.bodies[i].state.pos[2] < SPACING]
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=.4*SPACING),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		MpmEngine(cellSize=2*SPACING, analysis='3d', gravity=(0, 0, -G), timeStepSafety=.4),
		NewtonIntegrator(damping=0, gravity=(0, 0, -G)),
	]
	O.trackEnergy = True
	rows, samples = [], 40
	for k in range(samples):
		O.stopAtTime = options.time*(k + 1)/samples
		O.run()
		O.wait()
		deflection = -np.mean([O.bodies[i].state.displ()[2] for i in middle])
		touching = sum(1 for i in O.interactions if i.isReal)
		falling = .5*sum(O.bodies[b].state.mass*O.bodies[b].state.vel.squaredNorm() for b in balls)
		rows.append([O.time, deflection, mpm.array('plasticStrain').max(), touching, falling, O.energy['mpmKinetic'], O.energy['mpmElastic'], O.energy['mpmDissipation']])
		if (k + 1) % 8 == 0: print('  %3d %%  %6d steps  deflection %6.2f mm  contacts %d' % (100*(k + 1)//samples, O.iter, 1e3*deflection, touching), flush=True)
	with open(os.path.join(options.out, 'grains_on_plate.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['time_s', 'deflection_m', 'plasticStrain', 'contacts', 'grainsKinetic_J', 'mpmKinetic_J', 'mpmElastic_J', 'mpmDissipation_J']] + rows)

	rows = np.array(rows)
	figure, (above, below) = plt.subplots(2, 1, figsize=(8, 8.5), gridspec_kw=dict(height_ratios=[2, 1], hspace=.3))
	x, strain = mpm.array('position'), mpm.array('plasticStrain')
	order = np.argsort(-x[:, 1]) # the nearest are drawn last
	dots = squares(above, x[order, 0], x[order, 2], 100*strain[order], SPACING, cmap='inferno')
	for b in sorted(balls, key=lambda b: -O.bodies[b].state.pos[1]):
		p = O.bodies[b].state.pos
		fallen = not 0 < p[1] < WIDTH
		above.add_patch(plt.Circle((p[0], p[2]), RADIUS, facecolor='.85' if fallen else plt.cm.Blues(.3 + .5*p[1]/WIDTH), edgecolor='k', lw=.5, alpha=.8, ls='--' if fallen else '-'))
	handles = [plt.Line2D([], [], ls='', marker='o', ms=10, mfc=colour, mec='k', label=name) for colour, name in
		((plt.cm.Blues(.3), 'grain near y = 0'), (plt.cm.Blues(.8), 'grain near y = %g m' % WIDTH), ('.85', 'grain beyond a free edge of the plate'))]
	above.legend(handles=handles, fontsize=8, loc='lower left', ncol=1)
	above.set(aspect='equal', xlim=(-.05, LENGTH + .05), ylim=(-.25, .5), xlabel='x [m]', ylabel='z [m]', title='%d grains, %d material points, t = %.2f s' % (len(balls), len(plate), O.time))
	figure.colorbar(dots, ax=above, shrink=.7, label='plastic strain of the plate [%]')
	for column, name in ((4, 'grains, kinetic'), (5, 'plate, kinetic'), (6, 'plate, elastic'), (7, 'plate, heat')): below.plot(1e3*rows[:, 0], rows[:, column], label=name)
	deflection = below.twinx()
	line, = deflection.plot(1e3*rows[:, 0], 1e3*rows[:, 1], 'k--', label='deflection (right axis)')
	deflection.set_ylabel('deflection at mid-span [mm]')
	below.set(xlabel='time [ms]', ylabel='energy [J]')
	below.legend(handles=below.get_lines() + [line], fontsize=8, ncol=5, loc='upper center', bbox_to_anchor=(.5, -.2))
	below.grid(alpha=.3)
	figure.savefig(os.path.join(options.out, 'grains_on_plate.png'), dpi=130, bbox_inches='tight')
	print('results in %s' % os.path.abspath(options.out))


main()
