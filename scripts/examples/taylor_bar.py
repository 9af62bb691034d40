# SPDX-License-Identifier: GPL-2.0-or-later
"""Taylor's bar: a copper cylinder hits a rigid wall at 227 m/s.

	scripts/yade-mpm -n -x scripts/examples/taylor_bar.py [out] [--cells 8] [--shape cubic]

L = 32.4 mm, R = 3.2 mm, E = 117 GPa, nu = 0.35, 8930 kg/m3, yield stress 400 MPa, isotropic hardening 100
MPa, 80 microseconds, axisymmetric, frictionless wall. Published finite element results: length 21.4 to 21.5
mm, foot 6.9 to 7.2 mm. Prints both, and writes the shape: taylor_bar.png, taylor_bar.csv.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
from yade import mpm
from yade import *

parser = argparse.ArgumentParser()
parser.add_argument('out', nargs='?', default='out')
parser.add_argument('--cells', type=int, default=8, help='cells across the radius')
parser.add_argument('--shape', default='cubic')
arguments = parser.parse_args(sys.argv[1:])

R, L, SPEED, TIME = 3.2e-3, 32.4e-3, 227., 80e-6
cell = R/arguments.cells
O.materials.append(J2Mat(label='copper', young=117e9, poisson=.35, density=8930, yieldStress=400e6, isotropicModulus=100e6))
mpm.fill(((0, 0), (R, L)), spacing=cell/2, material='copper', velocity=(0, -SPEED, 0), axisymmetric=True, bodies=False)
O.engines = [MpmEngine(cellSize=cell, analysis='axisymmetric', shape=arguments.shape, walls=[MpmWall(normal=(0, 1, 0), kind='slip')])]
O.dt = .25*mpm.criticalTimeStep()
steps = int(TIME/O.dt) + 1
O.dt = TIME/steps
O.run(steps, True)

x, F, p = mpm.array('position'), mpm.array('F'), mpm.array('plasticStrain')
length, foot = (1e3*(x[:, axis] + cell/4*F[:, axis, axis]).max() for axis in (1, 0)) # points' edges
print('points %d, steps %d: final length %.2f mm, radius of the foot %.2f mm, plastic strain up to %.2f' % (len(x), steps, length, foot, p.max()))
os.makedirs(arguments.out, exist_ok=True)
with open(os.path.join(arguments.out, 'taylor_bar.csv'), 'w') as f:
	table = csv.writer(f)
	table.writerow(['r_m', 'z_m', 'plastic_strain'])
	table.writerows(zip(x[:, 0], x[:, 1], p))
figure, axes = plt.subplots(figsize=(5, 6))
for side in 1, -1: dots = axes.scatter(side*1e3*x[:, 0], 1e3*x[:, 1], c=p, s=4, cmap='viridis', linewidths=0)
figure.colorbar(dots, label='accumulated plastic strain')
axes.set(aspect='equal', xlabel='r [mm]', ylabel='z [mm]', title='length %.2f mm, foot %.2f mm' % (length, foot))
figure.savefig(os.path.join(arguments.out, 'taylor_bar.png'), dpi=110, bbox_inches='tight')
