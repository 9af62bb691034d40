# SPDX-License-Identifier: GPL-2.0-or-later
"""The 3D examples run, with few points, and leave what they say.

The cantilever of 4 layers: at 10 and 20 kN within 2 % of the finite elements and 3.5 % of plane stress, which has the same few layers. The column of sand
spreads evenly and comes to lie lower and wider, the less its friction the wider, and its single points at the front do not stop it.
"""
import csv
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

rows = example('cantilever_3d', '--points', '4')[:91]
with open(os.path.join(root, 'tests', 'data', 'cantilever', 'static_perfectly_plastic.csv')) as f:
	elements = numpy.array([[float(r['load_N']), float(r['displacement_m'])] for r in csv.DictReader(f) if r['branch'] == '1'])
solid, plane = (lambda load, name=name: numpy.interp(load, [r['load_N'] for r in rows], [r[name] for r in rows]) for name in ('solid_m', 'planeStress_m'))
for load in 10e3, 20e3:
	near('cantilever_3d at %.0f kN, finite elements' % (load/1e3), solid(load)/numpy.interp(load, *elements.T), 1, .02)
	near('cantilever_3d at %.0f kN, plane stress' % (load/1e3), solid(load)/plane(load), 1, .035)
check('cantilever_3d yields', solid(27.9e3) > 1.02*27.9/10*solid(10e3), (solid(27.9e3), solid(10e3)))

runout = []
for angle in '30', '20':
	rows = example('column_collapse', '--points', '8', '--angle', angle)
	last = rows[-1]
	check('column_collapse: the heap lies', abs(last['front_over_r0'] - rows[-4]['front_over_r0']) < .03*last['front_over_r0'], [r['front_over_r0'] for r in rows])
	check('column_collapse: as wide in all directions, to a spacing', last['scatter_over_r0'] < .125, last)
	check('column_collapse: lower than it was', last['height_over_r0'] < .7, last)
	runout.append(last['front_over_r0'] - 1)
check('column_collapse: it has spread', runout[0] > .6, runout)
check('column_collapse: farther with less friction', runout[1] > 1.3*runout[0], runout)
rows = example('retaining_wall', '--points', '16')
for case in 'passive', 'active':  # 7 % with these few points, 4 % with 24
	last = [row for row in rows if row['case'] == case][-20:]
	near('retaining_wall, %s: force over Coulomb\'s' % case, numpy.mean([row['coefficient'] for row in last])/last[0]['coulomb'], 1, .1)
finish()
