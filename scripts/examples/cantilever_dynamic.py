# SPDX-License-Identifier: GPL-2.0-or-later
"""Example 4.2 of Sofianos & Koumousis (COMPDYN 2017): a steel cantilever shaken far beyond its plastic hinge.

	scripts/yade-mpm -n -x scripts/examples/cantilever_dynamic.py [out] [--points 16] [--full-mass] [--elastic] [--frequency 50]

1 x 0.2 m, 0.02 m thick, S235 (E = 210 GPa, nu = 0.3, sigma_y = 235 MPa, 7850 kg/m3), 5 % kinematic hardening, plane stress;
shear 75 kN sin(2 pi 50 Hz t) on the end face for two periods from rest, no damping. The paper states neither the frequency nor n
(here 25), grid (two points a cell and axis, at Gauss places) and time step (0.3 of the stable one). Compared with a finite element
solution in finite strain, or with --elastic, without yield, with the sum of all modes (both in tests/data/cantilever). Leaves in
the folder out: cantilever_dynamic.csv (history, energies) and cantilever_dynamic.png (history, plastic zone, hysteresis loops at the
support, energy balance).

The load acts on the end face itself (mpm.traction), and the displacement is the mean of this face.
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

LENGTH, HEIGHT, THICKNESS = 1., .2, .02
FORCE = 75e3
DATA = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..', 'tests', 'data', 'cantilever')
ENERGIES = ('mpmKinetic', 'mpmElastic', 'mpmHardening', 'mpmDissipation', 'mpmExternal')


def build(options):
	"""The scene; returns the load on the end face."""
	O.reset()
	cell = 2*HEIGHT/options.points
	O.materials.append(FrictMat(label='steel', young=210e9, poisson=.3, density=7850) if options.elastic
		else BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=235e6, tangentRatio=.05, n=25))
	mpm.fill(((0, -HEIGHT/2), (LENGTH, HEIGHT/2)), placement='gauss', cellSize=cell, points=2, thickness=THICKNESS, material='steel')
	times = np.linspace(0, 2/options.frequency, 4001)
	tip = mpm.traction(((LENGTH, -HEIGHT/2), (LENGTH, HEIGHT/2)), traction=(0, -FORCE/(HEIGHT*THICKNESS), 0), thickness=THICKNESS,
		times=times, factors=np.sin(2*np.pi*options.frequency*times), cellSize=cell)
	O.engines = [
		ForceResetter(),
		MpmEngine(cellSize=cell, analysis='planeStress', fullMass=options.full_mass, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')]),
	]
	O.trackEnergy = True
	O.dt = .3*mpm.criticalTimeStep()
	return tip


def reference(options):
	"""Times [s] and displacements [m]."""
	name, column = ('dynamic_elastic', {50: 1, 20: 2}.get(options.frequency)) if options.elastic else ('dynamic_finite_strain', 2 if options.frequency == 50 else None)
	if column is None: return None
	with open(os.path.join(DATA, name + '.csv')) as f: rows = np.array([[float(v) for v in row] for row in list(csv.reader(f))[1:]])
	return rows[rows[:, 0] < 2/options.frequency + 1e-9][:, (0, column)]


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--points', type=int, default=16, help='material points through the depth, a multiple of 4')
	parser.add_argument('--full-mass', action='store_true', help='MpmEngine.fullMass: more accurate in motion, dearer a step')
	parser.add_argument('--elastic', action='store_true', help='without yield')
	parser.add_argument('--frequency', type=float, default=50, help='of the load [Hz]; there are references for 50 and, elastic, for 20')
	options = parser.parse_args(sys.argv[1:])
	if options.points <= 0 or options.points % 4: parser.error('--points %d: give a multiple of 4, two points in each of an even number of cells' % options.points)
	if not options.frequency > 0: parser.error('--frequency %g: give a frequency > 0 [Hz]' % options.frequency)
	os.makedirs(options.out, exist_ok=True)

	duration = 2/options.frequency
	tip = build(options)
	corner = mpm.array('position')
	watched = int(np.argmin((corner[:, 0] - .06)**2 + (corner[:, 1] - HEIGHT/2)**2)) # an outer fibre near the support
	history, energies, loop = [], [], []
	samples = 200
	every = int(duration/O.dt)//samples + 1
	steps = samples*every
	O.dt = duration/steps # ends with the reference

	global sample # where PyRunner finds it
	def sample():
		history.append((O.time + O.dt, -tip.displacement[1])) # the end of this step
		energies.append([O.energy[name] for name in ENERGIES] + [O.energy.total()])
		state = O.bodies[watched].state
		loop.append((state.strain[0, 0], state.stress[0, 0]))
		if len(history) % 40 == 0:
			print('  %3d %%  t = %5.2f ms  displacement %8.2f mm' % (100*len(history)//samples, 1e3*history[-1][0], 1e3*history[-1][1]), flush=True)

	O.engines = O.engines + [PyRunner(command='sample()', iterPeriod=every)]
	start = time.time()
	O.run(steps + 1, True) # in one go: each call of O.run takes 40 ms
	seconds = time.time() - start
	print('%d points, %d steps in %.1f s: %.2f million point-steps a second' % (len(corner), steps, seconds, steps*len(corner)/seconds/1e6))

	history, energies, loop = map(np.array, (history, energies, loop))
	wanted = reference(options)
	balance = abs(energies[:, -1]).max()/abs(energies[:, 4]).max()
	if wanted is not None:
		error = abs(history[:, 1] - np.interp(history[:, 0], *wanted.T)).max()/abs(wanted[:, 1]).max()
		print('greatest difference from the reference: %.2f %% of the peak; peaks %+.2f and %+.2f mm (%+.2f and %+.2f)' % (
			100*error, 1e3*history[:, 1].max(), 1e3*history[:, 1].min(), 1e3*wanted[:, 1].max(), 1e3*wanted[:, 1].min()))
	print('error of the energy balance: %.2g of the work done' % balance)

	with open(os.path.join(options.out, 'cantilever_dynamic.csv'), 'w', newline='') as f:
		table = csv.writer(f)
		table.writerow(['time_s', 'displacement_m', 'strain_xx', 'stress_xx_Pa'] + [e + '_J' for e in ENERGIES] + ['total_J'])
		for a, b, c in zip(history, loop, energies): table.writerow(['%.9g' % v for v in (*a, *b, *c)])

	figure, ((one, two), (three, four)) = plt.subplots(2, 2, figsize=(12, 8))
	one.plot(1e3*history[:, 0], 1e3*history[:, 1], 'C0', label='%d material points' % len(corner))
	if wanted is not None: one.plot(1e3*wanted[::8, 0], 1e3*wanted[::8, 1], 'ko', ms=3, mfc='none', label='finite elements')
	one.set(xlabel='time [ms]', ylabel='tip displacement [mm]', title='History')
	one.legend()
	x, plastic = mpm.array('position'), mpm.array('plasticStrain')
	dots = two.scatter(x[:, 0], x[:, 1], c=100*plastic, s=4600*(mpm.array('size')/HEIGHT)**2, marker='s', linewidths=0, cmap='inferno')
	two.set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title='Accumulated plastic strain [%], at the end')
	figure.colorbar(dots, ax=two, shrink=.6)
	three.plot(100*loop[:, 0], loop[:, 1]/1e6, 'C3', lw=1)
	three.set(xlabel='strain xx [%]', ylabel='stress xx [MPa]', title='Outer fibre at x = %.2f m' % corner[watched, 0])
	for k, name in enumerate(ENERGIES): four.plot(1e3*history[:, 0], energies[:, k]/1e3, label=name, lw=1)
	four.plot(1e3*history[:, 0], energies[:, -1]/1e3, 'k', label='total')
	four.set(xlabel='time [ms]', ylabel='energy [kJ]', title='Energy balance, error %.1g of the work done' % balance)
	four.legend(fontsize=8)
	for ax in (one, three, four): ax.grid(alpha=.3)
	figure.tight_layout()
	figure.savefig(os.path.join(options.out, 'cantilever_dynamic.png'), dpi=120)
	print('results in %s' % os.path.abspath(options.out))


main()
