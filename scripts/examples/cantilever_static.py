# SPDX-License-Identifier: GPL-2.0-or-later
"""Example 4.1 of Sofianos & Koumousis (COMPDYN 2017): a steel cantilever, loaded slowly beyond yield and unloaded.

	scripts/yade-mpm -n -x scripts/examples/cantilever_static.py [out] [--points 6] [--hardening 0|0.05|both]

1 x 0.1 m, 0.05 m thick, E = 210 GPa, nu = 0.3, sigma_y = 240 MPa, plane stress, 60 x 6 material points at the Gauss places of 20 x 2
cells. The load acts on the end face, as shear, and the displacement is that of the end face: nothing is fitted. Compared with a finite
element solution with classical plasticity (tests/data/cantilever) and with beam theory. Leaves in the folder out:
cantilever_static.csv, .png (load against displacement) and cantilever_static_vonMises.png (at the greatest load).

The paper does not state: n (here 25), reloading (2: without it the points' small vibrations ratchet plastic strain, the more the
finer the points, 2 mm of 27 with 1440), the grid (three points a cell and axis, nodes along the beam's axis and faces), the ramp (0.3 s up
and down, with hardening 0.8 s, 25 and 67 periods of the first mode, quintic so that it starts and ends without a jolt; a yielding
beam is soft and follows a faster ramp late), the time step (0.7 of the stable one), the damping (0.005, Cundall's), hardening
(both are run), density (7850 kg/m3).
"""
import argparse
import csv
import os
import sys
import time

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

LENGTH, HEIGHT, THICKNESS = 1., .1, .05
YOUNG, POISSON, DENSITY, YIELD = 210e9, .3, 7850, 240e6
DAMPING, SHARPNESS, RELOADING = .005, 25, 2
# tangent ratio, greatest load [N], duration of a ramp [s], reference
CASES = {'perfectly plastic': (0., 28e3, .3, 'static_perfectly_plastic.csv'), '5 % hardening': (.05, 40e3, .8, 'static_hardening.csv')}
DATA = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'tests', 'data', 'cantilever')


def ramp(x):
	"""0 to 1 over 0 < x < 1 with vanishing first and second derivatives at both ends."""
	x = np.clip(x, 0, 1)
	return x**3*(10 + x*(-15 + 6*x))


def reference(name):
	"""(load [N], displacement [m]) of the finite element code, loading and unloading one after the other."""
	with open(os.path.join(DATA, name)) as f: rows = list(csv.DictReader(f))
	return np.array([[float(r['load_N']), float(r['displacement_m']), int(r['branch'])] for r in rows])


def beamTheory(load):
	"""Tip displacement [m] of an elastic-perfectly plastic Bernoulli beam, with the elastic shear flexibility of Timoshenko."""
	inertia, area = THICKNESS*HEIGHT**3/12, THICKNESS*HEIGHT
	first = YIELD*inertia/(HEIGHT/2)/LENGTH # load of first yield
	bending = first*LENGTH**3/(3*YOUNG*inertia)
	p = np.maximum(load/first, 1e-9)
	plastic = (5 - (3 + p)*np.sqrt(np.maximum(3 - 2*p, 0)))/p**2
	return bending*np.where(p <= 1, p, plastic) + load*LENGTH/(5./6*YOUNG/(2*(1 + POISSON))*area)


def run(tangentRatio, greatest, duration, points, say=print):
	"""Load to `greatest` [N] and back, in `duration` [s] each; returns rows (time, load, displacement of the end face, reaction of the wall), and
	positions, sizes and von Mises stress at the greatest load."""
	O.reset()
	cell = 3*HEIGHT/points
	O.materials.append(BoucWenMat(label='steel', young=YOUNG, poisson=POISSON, density=DENSITY, yieldStress=YIELD, tangentRatio=tangentRatio,
		n=SHARPNESS, reloading=RELOADING))
	beam = mpm.fill(((0, -HEIGHT/2), (LENGTH, HEIGHT/2)), placement='gauss', cellSize=cell, points=3, thickness=THICKNESS, material='steel')
	times = np.linspace(0, 2*duration, 481)
	tip = mpm.traction(((LENGTH, -HEIGHT/2), (LENGTH, HEIGHT/2)), traction=(0, -greatest/(HEIGHT*THICKNESS), 0), thickness=THICKNESS,
		times=times, factors=ramp(1 - abs(times/duration - 1)), cellSize=cell)
	wall = MpmWall(normal=(1, 0, 0), kind='fixed')
	O.engines = [ForceResetter(), MpmEngine(cellSize=cell, analysis='planeStress', walls=[wall], damping=DAMPING)]
	O.dt = .7*mpm.criticalTimeStep()

	samples, rows, field = 200, [], []
	every = int(round(2.05*duration/O.dt))//samples
	steps = samples*every

	global sample # where PyRunner finds it
	def sample():
		now, at, load = O.time + O.dt, -tip.displacement[1], -tip.force[1] # the end of this step
		rows.append((now, load, at, wall.force[1]))
		if not field and now >= duration: field.extend((mpm.array('position'), mpm.array('size'), mpm.array('vonMises')))
		if len(rows) % 20 == 0: say('  %3d %%  load %6.2f kN  displacement %7.3f mm' % (100*len(rows)//samples, load/1e3, at*1e3))

	O.engines = O.engines + [PyRunner(command='sample()', iterPeriod=every)]
	start = time.time()
	O.run(steps + 1, True) # in one go: each call of O.run takes 40 ms
	seconds = time.time() - start
	say('  %d points, %d steps in %.1f s: %.2f million point-steps a second' % (len(beam), steps, seconds, steps*len(beam)/seconds/1e6))
	return np.array(rows), field


def compare(rows, name):
	"""(what, here, reference) in mm; stiffness in N/m."""
	fe = reference(name)
	up = fe[fe[:, 2] == 1]
	top = np.argmax(rows[:, 1])
	here = lambda load: np.interp(load, rows[:top + 1, 1], rows[:top + 1, 2])
	table = [('elastic stiffness at 10 kN [N/m]', 10e3/here(10e3), 10e3/np.interp(10e3, up[:, 0], up[:, 1]))]
	for load in (20e3, 24e3, 26e3, 28e3) if fe[:, 0].max() < 30e3 else (20e3, 25e3, 30e3, 35e3, 40e3):
		load = min(load, rows[top, 1])
		table.append(('displacement at %.0f kN [mm]' % (load/1e3), 1e3*here(load), 1e3*np.interp(load, up[:, 0], up[:, 1])))
	table.append(('residual displacement [mm]', 1e3*np.mean(rows[-3:, 2]), 1e3*fe[-1, 1]))
	return table


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--points', type=int, default=6, help='material points through the depth, a multiple of 6 (6: the paper\'s 360)')
	parser.add_argument('--hardening', choices=['0', '0.05', 'both'], default='both')
	options = parser.parse_args(sys.argv[1:])
	if options.points <= 0 or options.points % 6: parser.error('--points %d: give a multiple of 6, three points in each of an even number of cells' % options.points)
	os.makedirs(options.out, exist_ok=True)

	figure, axes = plt.subplots(figsize=(7, 5))
	fields = []
	with open(os.path.join(options.out, 'cantilever_static.csv'), 'w', newline='') as f:
		table = csv.writer(f)
		table.writerow(['case', 'time_s', 'load_N', 'displacement_m', 'wall_force_y_N'])
		for (name, (ratio, greatest, duration, fe)), colour in zip(CASES.items(), ('C0', 'C3')):
			if options.hardening not in ('both', '%g' % ratio): continue
			print('%s, to %.0f kN and back' % (name, greatest/1e3), flush=True)
			rows, field = run(ratio, greatest, duration, options.points, lambda text: print(text, flush=True))
			fields.append((name, greatest, field))
			for row in rows: table.writerow([name] + ['%.9g' % v for v in row])
			for what, here, there in compare(rows, fe):
				print('  %-36s %12.6g   finite elements %12.6g   %+.2f %%' % (what, here, there, 100*(here/there - 1)), flush=True)
			axes.plot(1e3*rows[:, 2], rows[:, 1]/1e3, colour, label='material points, ' + name)
			curve = reference(fe)
			axes.plot(1e3*curve[::6, 1], curve[::6, 0]/1e3, colour + 'o', ms=3, mfc='none', label='finite elements, ' + name)
	load = np.linspace(0, 29.8e3, 200)
	axes.plot(1e3*beamTheory(load), load/1e3, 'k:', lw=1, label='beam theory, perfectly plastic')
	axes.set(xlabel='tip displacement [mm]', ylabel='tip load [kN]', xlim=(0, None), ylim=(0, None),
		title='Cantilever 1 x 0.1 x 0.05 m, %d material points' % (10*options.points**2))
	axes.legend(fontsize=8)
	axes.grid(alpha=.3)
	figure.savefig(os.path.join(options.out, 'cantilever_static.png'), dpi=150, bbox_inches='tight')

	figure, rows = plt.subplots(len(fields), 1, figsize=(9, 1.9*len(fields)), squeeze=False, sharex=True)
	for ax, (name, greatest, (x, size, mises)) in zip(rows[:, 0], fields):
		dots = ax.scatter(x[:, 0], x[:, 1], c=mises/1e6, s=3600*(size/HEIGHT)**2, marker='s', cmap='viridis', linewidths=0)
		ax.set(aspect='equal', ylabel='y [m]', title='%s, %.0f kN: von Mises stress [MPa]' % (name, greatest/1e3))
		figure.colorbar(dots, ax=ax, shrink=.9)
	rows[-1, 0].set_xlabel('x [m]')
	figure.savefig(os.path.join(options.out, 'cantilever_static_vonMises.png'), dpi=150, bbox_inches='tight')
	print('results in %s' % os.path.abspath(options.out))


main()
