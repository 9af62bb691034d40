# SPDX-License-Identifier: GPL-2.0-or-later
"""The cantilever of example 4.1 in 3D, compared with plane stress and finite elements.

	scripts/yade-mpm -n -x scripts/examples/cantilever_3d.py [out] [--points 8]

Steel, 1 x 0.1 x 0.05 m, E = 210 GPa, nu = 0.3, J2 with a yield stress of 240 MPa and no hardening. It is
clamped at x = 0, loaded at the end by 28 kN in 0.1 s, and held. In 3D the model is half of the thickness,
from the middle plane (a slip wall) to the free side. --points, a multiple of 4, is the number of layers
through the height. At 10 kN both curves are within 2 % of finite elements in plane stress
(tests/data/cantilever) and of each other. Writes cantilever_3d.csv and .png.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from yade import mpm
from yade import *

LENGTH, HEIGHT, THICKNESS, LOAD, TIME = 1., .1, .05, 28e3, .1
DATA = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'tests', 'data', 'cantilever', 'static_perfectly_plastic.csv')


def run(solid, spacing):
	"""Return rows (load on the whole beam, displacement of the end); positions, initial positions and stresses of the points."""
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
	x = mpm.array('position')
	return np.array(rows), x, x - mpm.array('displacement'), mpm.array('vonMises')


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
	parser.add_argument('--points', type=int, default=8, help='layers of points through the height, a multiple of 4')
	options = parser.parse_args(sys.argv[1:])
	if options.points < 4 or options.points % 4: parser.error('--points: give a multiple of 4; half of the thickness is a quarter of the height')
	os.makedirs(options.out, exist_ok=True)
	with open(DATA) as f: elements = np.array([[float(r['load_N']), float(r['displacement_m'])] for r in csv.DictReader(f) if r['branch'] == '1'])

	(plane, *_), (solid, x, start, mises) = (run(dimension == 3, HEIGHT/options.points) for dimension in (2, 3))
	for load in 10e3, 20e3, 26e3:
		here, there = (1e3*np.interp(load, rows[:91, 0], rows[:91, 1]) for rows in (solid, plane))
		print('%2.0f kN: 3D %.3f mm, plane stress %.3f mm (3D %+.2f %%), finite elements %.3f mm (3D %+.2f %%)' % (load/1e3, here, there, 100*(here/there - 1),
			1e3*np.interp(load, *elements.T), 100*(here/1e3/np.interp(load, *elements.T) - 1)))
	with open(os.path.join(options.out, 'cantilever_3d.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['load_N', 'solid_m', 'planeStress_m']] + [(a[0], a[1], b[1]) for a, b in zip(solid, plane)])

	figure = plt.figure(figsize=(11, 4.2))
	ax = figure.add_axes((.06, .13, .36, .8))
	for rows, style, label in (plane, 'C0', 'plane stress'), (solid, 'C3--', '3D'), (elements, 'k:', 'finite elements, plane stress'):
		ax.plot(1e3*rows[:, 1], rows[:, 0]/1e3, style, label=label)
	ax.set(xlabel='displacement of the end [mm]', ylabel='load [kN]', xlim=(0, None), ylim=(0, None))
	ax.legend()
	ax.grid(alpha=.3)
	# the layers of points next to the free side and to the upper face; the half that is not modelled is the mirror image
	spacing, mises = HEIGHT/options.points, mises/1e6
	side, top = start[:, 2] > THICKNESS/2 - spacing, start[:, 1] > HEIGHT/2 - spacing
	scale = dict(cmap='viridis', norm=plt.Normalize(0, mises.max()))
	for k, (layer, across, both, name) in enumerate(((side, 1, (1,), 'y [m]'), (top, 2, (1, -1), 'z [m]'))):
		ax = figure.add_axes((.5, .62 - .4*k, .38, .26))
		for sign in both: patches = squares(ax, x[layer, 0], sign*x[layer, across], mises[layer], spacing, **scale)
		ax.set(aspect='equal', xlabel='x [m]', ylabel=name, xlim=(-.02, LENGTH + .02), title=('free side, z = %g m' % (THICKNESS/2), 'upper face')[k],
			yticks=((-HEIGHT/2, 0, HEIGHT/2), (-THICKNESS/2, THICKNESS/2))[k])
	figure.colorbar(patches, cax=figure.add_axes((.91, .2, .015, .68)), label='von Mises stress at %.0f kN [MPa]' % (LOAD/1e3))
	figure.savefig(os.path.join(options.out, 'cantilever_3d.png'), dpi=110, bbox_inches='tight')


main()
