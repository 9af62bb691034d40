# SPDX-License-Identifier: GPL-2.0-or-later
"""A column of soil collapses onto a bed of grains.

    scripts/yade-mpm -n -x scripts/examples/column_on_grains.py [out] [--points 16] [--time 0.6]

Plane strain, a slice of 0.1 m. The soil is 0.5 m wide and 1 m high, against a rough wall at x = 0: Drucker-
Prager, phi = 30 deg, almost no cohesion, E = 1 MPa, 1800 kg/m3. Below it, loose grains of radius 0.04 m lie
on a wall of YADE. Soil, grains and walls touch by Cundall and Strack's law with a friction angle of 30 deg.
--points is the number of material points across the column. Writes column_on_grains.csv and .png.
"""
import argparse
import csv
import math
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

WIDTH, HEIGHT, SLICE, RADIUS, REACH, G = .5, 1., .1, .04, 2.4, 9.81


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--points', type=int, default=16, help='material points across the column')
	parser.add_argument('--time', type=float, default=.6, help='duration [s]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)
	spacing = WIDTH/options.points

	O.materials.append(DruckerPragerMat(label='soil', young=1e6, poisson=.3, density=1800, cohesion=50, internalFriction=math.radians(30), dilatancy=0, frictionAngle=math.radians(30)))
	O.materials.append(FrictMat(label='grain', young=5e6, poisson=.3, density=2600, frictionAngle=math.radians(30)))
	soil = mpm.fill(((0, 0), (WIDTH, HEIGHT)), spacing=spacing, thickness=SLICE, material='soil')
	gap = REACH/int(REACH/(2.15*RADIUS))
	grains = [O.bodies.append(sphere(((k + .5)*gap, -RADIUS, 0), RADIUS, material='grain')) for k in range(int(REACH/gap + .5))]
	for b in grains: O.bodies[b].state.blockedDOFs = 'zXY' # in the plane
	O.bodies.append([wall((0, -2*RADIUS, 0), axis=1, material='grain'), wall((0, 0, 0), axis=0, material='grain'), wall((REACH, 0, 0), axis=0, material='grain')])
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=.3*spacing),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		GlobalStiffnessTimeStepper(timestepSafetyCoefficient=.6),
		MpmEngine(cellSize=2*spacing, analysis='planeStrain', gravity=(0, -G, 0), damping=.02, timeStepSafety=.4),
		NewtonIntegrator(damping=.1, gravity=(0, -G, 0)),
	]
	rows, pictures, samples = [], [], 30
	for k in range(samples):
		O.stopAtTime = options.time*(k + 1)/samples
		O.run()
		O.wait()
		x = mpm.array('position')
		on_grains = sum(O.forces.f(i)[1] for i in soil)
		rows.append([O.time, np.quantile(x[:, 0], .99), np.quantile(x[:, 1], .99), on_grains, mpm.array('plasticStrain').max()])
		if (k + 1) % (samples//3) == 0:
			pictures.append((O.time, x, mpm.array('plasticStrain'), [tuple(O.bodies[b].state.pos) for b in grains]))
			print('  %3d %%  %6d steps  front %.3f m  height %.3f m  force on the grains %.0f N' % (100*(k + 1)//samples, O.iter, *rows[-1][1:4]), flush=True)
	with open(os.path.join(options.out, 'column_on_grains.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['time_s', 'front_m', 'height_m', 'forceOnSoil_N', 'plasticStrain']] + rows)

	figure, axes = plt.subplots(len(pictures), 1, figsize=(8, 9), sharex=True)
	for ax, (time, x, strain, centres) in zip(axes, pictures):
		dots = ax.scatter(x[:, 0], x[:, 1], c=np.minimum(strain, 2), s=16*(16/options.points)**2, cmap='viridis', vmin=0, vmax=2, linewidths=0)
		for c in centres: ax.add_patch(plt.Circle(c[:2], RADIUS, facecolor='tan', edgecolor='k', lw=.5))
		ax.set(aspect='equal', xlim=(0, REACH), ylim=(-.1, 1.02), ylabel='y [m]', title='t = %.2f s: accumulated plastic strain' % time)
		figure.colorbar(dots, ax=ax, shrink=.8)
	axes[-1].set_xlabel('x [m]')
	figure.savefig(os.path.join(options.out, 'column_on_grains.png'), dpi=120, bbox_inches='tight')
	print('results in %s' % os.path.abspath(options.out))


main()
