# SPDX-License-Identifier: GPL-2.0-or-later
"""A cylinder of sand collapses on a plane and spreads, in 3D.

	scripts/yade-mpm -n -x scripts/examples/column_collapse.py [out] [--aspect 1] [--points 32] [--angle 30]

The model is a quarter between two slip walls, on a wall with friction of 30 deg. Radius r0 = 0.1 m, height
aspect times r0. Drucker-Prager, perfectly plastic, friction angle 30 deg (--angle), no dilatancy, cohesion 5
Pa (0.3 % of the weight of 0.1 m), E = 1 MPa, nu = 0.3, 1600 kg/m3. --points is the number of material points
along r0. The run lasts 5 sqrt(height/g), until the heap is at rest. The dashed line is the run-out that Lube,
Huppert, Sparks & Hallworth, J. Fluid Mech. 508 (2004) 175, measured with several kinds of grains: (r - r0)/r0
= 1.24 a for a < 1.7, 1.6 sqrt(a) above (doc/verification/column-collapse.md). Writes column_collapse.csv and
.png.
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
from yade import mpm, pack
from yade import *

RADIUS, G = .1, 9.81


def front(x, spacing):
	"""Radius of the heap in each of six sectors: of the points within two spacings of the base all but the outermost 2 %, which may lie singly."""
	r, sector = np.hypot(x[:, 0], x[:, 1]), (np.arctan2(x[:, 1], x[:, 0])/(math.pi/12)).astype(int)
	low = x[:, 2] < 2*spacing
	return np.array([np.quantile(r[low & (sector == k)], .98) for k in range(6)])


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--aspect', type=float, default=1, help='height over radius of the column')
	parser.add_argument('--points', type=int, default=32, help='material points along the radius')
	parser.add_argument('--angle', type=float, default=30, help='friction angle of the sand [deg]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)
	height, spacing = options.aspect*RADIUS, RADIUS/options.points

	O.materials.append(DruckerPragerMat(label='sand', young=1e6, poisson=.3, density=1600, cohesion=5, internalFriction=math.radians(options.angle), dilatancy=0))
	column = pack.inCylinder((0, 0, 0), (0, 0, height), RADIUS) & pack.inAlignedBox((0, 0, 0), (RADIUS, RADIUS, height))
	mpm.fill(column, spacing=spacing, material='sand', bodies=False)
	walls = [MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(normal=(0, 1, 0), kind='slip'), MpmWall(normal=(0, 0, 1), kind='friction', friction=math.tan(math.radians(30)))]
	O.engines = [MpmEngine(cellSize=2*spacing, analysis='3d', gravity=(0, 0, -G), timeStepSafety=.4, walls=walls)]

	unit, rows, pictures, samples = math.sqrt(height/G), [], [(0, mpm.array('position'))], 25
	began = np.hypot(*pictures[0][1][:, :2].T)
	for k in range(samples):
		O.stopAtTime = 5*unit*(k + 1)/samples
		O.run()
		O.wait()
		x = mpm.array('position')
		radii = front(x, spacing)/RADIUS
		rows.append((O.time/unit, radii.mean(), radii.std(), np.quantile(x[:, 2], .99)/RADIUS, np.linalg.det(mpm.array('F')).max()))
		if k in (6, 11, samples - 1): pictures.append((O.time/unit, x))
		if (k + 1) % 5 == 0: print('  t = %.0f sqrt(H/g)  %5d steps  front %.3f r0  height %.3f r0' % (rows[-1][0], O.iter, rows[-1][1], rows[-1][3]), flush=True)
	published = 1.24*options.aspect if options.aspect < 1.7 else 1.6*math.sqrt(options.aspect)
	print('%d points: run-out %.3f r0, of six sectors +- %.3f; measured with grains %.3f' % (len(x), rows[-1][1] - 1, rows[-1][2], published))
	with open(os.path.join(options.out, 'column_collapse.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['time_over_sqrt_H_g', 'front_over_r0', 'scatter_over_r0', 'height_over_r0', 'greatest_J']] + rows)

	figure, axes = plt.subplots(len(pictures) + 1, 1, figsize=(8, 9.5), layout='constrained', gridspec_kw=dict(height_ratios=[1]*len(pictures) + [1.7]))
	for ax, (time, x) in zip(axes, pictures):
		for side in 1, -1: ax.scatter(side*np.hypot(x[:, 0], x[:, 1])/RADIUS, x[:, 2]/RADIUS, c=began, s=5, cmap='viridis', linewidths=0)
		ax.set(aspect='equal', xlim=(-3, 3), ylim=(0, 1.05*options.aspect), ylabel='z/r0')
		ax.text(-2.9, .8*options.aspect, 't = %.1f sqrt(H/g)' % time)
		ax.tick_params(labelbottom=ax is axes[-2])
	axes[-2].set_xlabel('r/r0, all points; colour: radius at the start')
	time, radius, scatter = np.array(rows)[:, :3].T
	axes[-1].errorbar(time, radius, scatter, fmt='o-', ms=3, label='front, mean and deviation of six sectors')
	axes[-1].axhline(1 + published, color='k', ls='--', label='at rest, experiments (Lube et al. 2004)')
	axes[-1].set(xlabel='t/sqrt(H/g)', ylabel='r/r0', ylim=(.9, 1.1*(1 + published)))
	axes[-1].legend(loc='lower right')
	figure.savefig(os.path.join(options.out, 'column_collapse.png'), dpi=100)


main()
