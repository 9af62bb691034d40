# SPDX-License-Identifier: GPL-2.0-or-later
"""The cantilever of example 4.1 in 3D, beside the same in plane stress and finite elements.

	scripts/yade-mpm -n -x scripts/examples/cantilever_3d.py [out] [--points 8]

Steel, 1 x 0.1 x 0.05 m, E = 210 GPa, nu = 0.3, J2 with a yield stress of 240 MPa and no hardening, clamped at x = 0, loaded at the end by 28 kN in
0.1 s and held. In 3D half of the thickness is modelled, from the middle plane (a slip wall) to the free side; --points, a multiple of 4, is the number
of layers through the height. Curves of load against displacement of both, and of a finite element code in plane stress (tests/data/cantilever): at
10 kN both are within 2 % of it and of each other. Leaves cantilever_3d.csv and .png.
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

LENGTH, HEIGHT, THICKNESS, LOAD, TIME = 1., .1, .05, 28e3, .1
DATA = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'tests', 'data', 'cantilever', 'static_perfectly_plastic.csv')


def run(solid, spacing):
	"""Rows (load on the whole beam, displacement of the end), and the beam at the end."""
	O.reset()
	O.materials.append(J2Mat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6))
	walls = [MpmWall(normal=(1, 0, 0), kind='fixed')]
	if solid:
		beam = mpm.fill(((0, -HEIGHT/2, 0), (LENGTH, HEIGHT/2, THICKNESS/2)), spacing, 'steel')
		walls.append(MpmWall(normal=(0, 0, 1), kind='slip'))
	else: beam = mpm.fill(((0, -HEIGHT/2), (LENGTH, HEIGHT/2)), spacing, 'steel', thickness=THICKNESS)
	end = [i for i in beam if O.bodies[i].state.pos[0] > LENGTH - spacing]
	times = np.linspace(0, TIME, 201)
	loads = LOAD*(times/TIME)**3*(10 + times/TIME*(-15 + 6*times/TIME))  # no jolt at either end
	O.engines = [ForceResetter(),
		InterpolatingDirectedForceEngine(ids=end, times=list(times), magnitudes=list(loads/len(end)*(.5 if solid else 1)), direction=(0, -1, 0)),
		MpmEngine(cellSize=2*spacing, analysis='3d' if solid else 'planeStress', walls=walls, damping=.01)]
	O.dt = .7*mpm.criticalTimeStep()
	rows, every = [], int(1.1*TIME/O.dt/100)

	global sample # where PyRunner finds it
	def sample(): rows.append((np.interp(O.time, times, loads), -np.mean([O.bodies[i].state.displ()[1] for i in end])))
	O.engines = O.engines + [PyRunner(command='sample()', iterPeriod=every)]
	O.run(100*every + 1, True)
	print('%s: %d points, %d steps' % ('3D' if solid else 'plane stress', len(beam), O.iter), flush=True)
	return np.array(rows), mpm.array('position'), mpm.array('vonMises')


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--points', type=int, default=8, help='layers of points through the height, a multiple of 4')
	options = parser.parse_args(sys.argv[1:])
	if options.points < 4 or options.points % 4: parser.error('--points: give a multiple of 4; half of the thickness is a quarter of the height')
	os.makedirs(options.out, exist_ok=True)
	with open(DATA) as f: elements = np.array([[float(r['load_N']), float(r['displacement_m'])] for r in csv.DictReader(f) if r['branch'] == '1'])

	(plane, _, _), (solid, x, mises) = (run(dimension == 3, HEIGHT/options.points) for dimension in (2, 3))
	for load in 10e3, 20e3, 26e3:
		here, there = (1e3*np.interp(load, rows[:91, 0], rows[:91, 1]) for rows in (solid, plane))
		print('%2.0f kN: 3D %.3f mm, plane stress %.3f mm (3D %+.2f %%), finite elements %.3f mm (3D %+.2f %%)' % (load/1e3, here, there, 100*(here/there - 1),
			1e3*np.interp(load, *elements.T), 100*(here/1e3/np.interp(load, *elements.T) - 1)))
	with open(os.path.join(options.out, 'cantilever_3d.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['load_N', 'solid_m', 'planeStress_m']] + [(a[0], a[1], b[1]) for a, b in zip(solid, plane)])

	figure = plt.figure(figsize=(12, 4.5))
	ax = figure.add_axes((.06, .12, .36, .8))
	for rows, style, label in (plane, 'C0', 'plane stress'), (solid, 'C3--', '3D'), (elements, 'k:', 'finite elements, plane stress'):
		ax.plot(1e3*rows[:, 1], rows[:, 0]/1e3, style, label=label)
	ax.set(xlabel='displacement of the end [mm]', ylabel='load [kN]', xlim=(0, None), ylim=(0, None))
	ax.legend()
	ax = figure.add_axes((.43, .12, .57, .9), projection='3d')
	both, colour = np.concatenate([x, x*[1, 1, -1]]), np.tile(mises/1e6, 2)
	dots = ax.scatter(*both[:, [0, 2, 1]].T, c=colour, s=22*(8/options.points)**2, marker='s', cmap='viridis', alpha=1, linewidths=0)
	ax.set_box_aspect((4, .5, 1), zoom=1.3)
	ax.view_init(20, -60)
	ax.set_axis_off()
	figure.text(.72, .9, 'von Mises stress [MPa] at %.0f kN' % (LOAD/1e3), ha='center')
	figure.colorbar(dots, cax=figure.add_axes((.55, .12, .34, .03)), orientation='horizontal')
	figure.savefig(os.path.join(options.out, 'cantilever_3d.png'), dpi=110, bbox_inches='tight')


main()
