# SPDX-License-Identifier: GPL-2.0-or-later
"""First bending frequency of the cantilever of example 4.2, elastic: doc/verification/frequency.md."""
import csv
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import DATA, Report, runSampled

import numpy as np
from yade import mpm
from yade import *

LENGTH, HEIGHT = 1., .2
with open(os.path.join(DATA, 'cantilever', 'frequencies.csv')) as f: reference = float(list(csv.DictReader(f))[-1]['f1_Hz'])

report = Report('frequency', 'points through the depth', 'mass', 'first frequency [Hz]', 'finite elements [Hz]', 'difference')
for points, full, bound in [(points, full, bound) for full in (False, True) for points, bound in ((8, np.inf), (16, .01), (24, .01))]: # 8 layers are shown for the trend
	O.reset()
	spacing = HEIGHT/points
	O.materials.append(ElastMat(young=210e9, poisson=.3, density=7850, label='steel'))
	beam = mpm.fill(((0, -HEIGHT/2), (LENGTH, HEIGHT/2)), spacing=spacing, thickness=.02, material='steel')
	for i in beam: # the first mode of a Bernoulli beam, near enough
		x = 1.875104*O.bodies[i].state.pos[0]
		O.bodies[i].state.vel = (0, .05*(np.cosh(x) - np.cos(x) - .734096*(np.sinh(x) - np.sin(x))), 0)
	O.engines = [MpmEngine(cellSize=2*spacing, fullMass=full, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])]
	O.dt = .4*mpm.criticalTimeStep()
	tip = [i for i in beam if O.bodies[i].state.pos[0] > LENGTH - spacing]
	times, deflection = [], []

	def sample():
		times.append(O.time)
		deflection.append(np.mean([O.bodies[i].state.displ()[1] for i in tip]))
	runSampled(int(6/reference/O.dt), 5, sample)
	# least squares of one harmonic over a range of frequencies: higher modes are orthogonal to it but for the ends
	times, deflection = np.array(times), np.array(deflection)

	def misfit(f):
		basis = np.stack([np.sin(2*np.pi*f*times), np.cos(2*np.pi*f*times)], 1)
		return np.linalg.norm(deflection - basis @ np.linalg.lstsq(basis, deflection, rcond=None)[0])
	trial = np.linspace(.95*reference, 1.05*reference, 2001)
	frequency = trial[np.argmin([misfit(f) for f in trial])]
	report.row(points, 'full' if full else 'lumped', '%.2f' % frequency, '%.2f' % reference, '%+.2f %%' % (100*(frequency/reference - 1)), bounds=[('first frequency, %d points' % points, frequency/reference - 1, bound)])
report.finish()
