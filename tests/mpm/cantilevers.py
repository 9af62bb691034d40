# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's two examples through the example scripts themselves, against the finite element curves in tests/data/cantilever.

Example 4.1 at the paper's 360 points, perfectly plastic: elastic stiffness within 1 %, displacement within 3 % up to 26 kN and
5 % at 28 kN, residual displacement within 10 %. (Hardening and 1440 points: scripts/verify.) Example 4.2 with 320 points, a
quarter of those the example takes by default: within 8 % of the peak at all times, 3 % with the full mass; energy balance within 1e-3 of the work.
"""
import csv
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

data = os.path.join(root, 'tests', 'data', 'cantilever')


def columns(rows, *names): return numpy.array([[float(row[n]) for n in names] for row in rows])


def reference(name, **wanted):
	with open(os.path.join(data, name + '.csv')) as f: return [row for row in csv.DictReader(f) if all(row[k] == v for k, v in wanted.items())]


here = columns(example('cantilever_static', '--hardening', '0'), 'load_N', 'displacement_m', 'wall_force_y_N')
elements = columns(reference('static_perfectly_plastic', branch='1'), 'load_N', 'displacement_m')
top = numpy.argmax(here[:, 0])
check('the load is reached', abs(here[top, 0] - 28e3) < 1)
off = lambda load: numpy.interp(load, *here[:top + 1, :2].T)/numpy.interp(load, *elements.T) - 1
near('4.1: elastic stiffness', off(10e3), 0, .01)
near('4.1: displacement up to 26 kN', [off(load) for load in numpy.linspace(5e3, 26e3, 43)], [0]*43, .03)
near('4.1: displacement at 28 kN', off(here[top, 0]), 0, .05)
residual = float(reference('static_perfectly_plastic', branch='2')[-1]['displacement_m'])
near('4.1: residual displacement', here[-3:, 1].mean()/residual - 1, 0, .10)
check('4.1: the beam has yielded', here[-3:, 1].mean() > .5e-3)
near('4.1: the wall carries the load', here[40:, 2]/28e3, -here[40:, 0]/28e3, .02)

elements = columns(reference('dynamic_finite_strain'), 'time_s', 'displacement_m')
peak = abs(elements[:, 1]).max()
for options, bound in ((), .08), (('--full-mass',), .03):
	here = columns(example('cantilever_dynamic', '--points', '8', *options), 'time_s', 'displacement_m', 'mpmExternal_J', 'total_J')
	what = ' '.join(('4.2',) + options) + ': '
	near(what + 'history over the peak', (here[:, 1] - numpy.interp(here[:, 0], *elements.T))/peak, 0*here[:, 0], bound)
	check(what + 'work is done', abs(here[:, 2]).max() > 1e4)
	near(what + 'energy balance over the work', here[:, 3]/abs(here[:, 2]).max(), 0*here[:, 0], 1e-3)

finish()
