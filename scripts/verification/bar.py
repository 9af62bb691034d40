# SPDX-License-Identifier: GPL-2.0-or-later
"""A solid bar in bending and in torsion, uniform and Gauss places, against finite elements: doc/verification/bar.md."""
import csv
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import DATA, Report

import numpy as np
from yade import mpm
from yade import *

YOUNG, LENGTH, SIDE, SHEAR, TORSION = 10e6, 1., .2, 1e3, 1e4
RAMP = 1. # [s], three periods of the first mode
with open(os.path.join(DATA, 'bar.csv')) as f: reference = [float(v) for v in list(csv.reader(f))[1]]
# bounds of the deflection's and the twist's errors
CASES = {('uniform', 2, 2): (.08, .20), ('gauss', 2, 2): (.03, .07), ('gauss', 2, 3): (.03, .07), ('uniform', 4, 2): (.03, .06), ('gauss', 4, 2): (.015, .015)}


def run(placement, cells, points, torsion):
	O.reset()
	O.materials.append(FrictMat(label='bar', young=YOUNG, poisson=.3, density=1000))
	cell = SIDE/cells
	box = ((0, -SIDE/2, -SIDE/2), (LENGTH, SIDE/2, SIDE/2))
	mpm.fill(box, placement=placement, cellSize=cell, points=points, material='bar', bodies=False)
	face = ((LENGTH, -SIDE/2, -SIDE/2), (LENGTH, SIDE/2, SIDE/2))
	times = np.linspace(0, RAMP, 101)
	load = mpm.traction(face, traction=(lambda x: (0, -TORSION*x[2], TORSION*x[1])) if torsion else (0, -SHEAR, 0), cellSize=cell,
		times=times, factors=(times/RAMP)**3*(10 + times/RAMP*(-15 + 6*times/RAMP)))
	start = np.array(load.position)
	O.engines = [MpmEngine(cellSize=cell, analysis='3d', largeStrain=False, damping=.25, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])]
	O.dt = .6*mpm.criticalTimeStep()
	O.run(int(1.8*RAMP/O.dt), True)
	moved = np.array(load.position) - start
	_, y, z = start.T
	weight = np.array(load.weights)
	found = (weight @ (y*moved[:, 2] - z*moved[:, 1]))/(weight @ (y*y + z*z)) if torsion else -load.displacement[1]
	rest = abs(mpm.array('velocity')).max()*.01/abs(moved).max()
	return found, rest, len(mpm.array('id'))


report = Report('bar', 'places', 'cells of points', 'points', 'deflection [mm]', 'difference', 'twist [mrad]', 'difference')
report.row('finite elements', '', '', '%.3f' % (1e3*reference[0]), '', '%.3f' % (1e3*reference[1]), '')
for (placement, cells, points), bounds in CASES.items():
	values = [run(placement, cells, points, torsion) for torsion in (False, True)]
	off = [value[0]/wanted - 1 for value, wanted in zip(values, reference)]
	what = '%s, %d cells of %d' % (placement, cells, points)
	report.row(placement, '%d of %d' % (cells, points), values[0][2], '%.3f' % (1e3*values[0][0]), '%+.2f %%' % (100*off[0]), '%.3f' % (1e3*values[1][0]), '%+.2f %%' % (100*off[1]),
		bounds=[(what + ', deflection', off[0], bounds[0]), (what + ', twist', off[1], bounds[1]), (what + ', at rest', max(v[1] for v in values), 1e-3)])
report.finish()
