# SPDX-License-Identifier: GPL-2.0-or-later
"""Example 4.2 with 320 and 1280 points, plastic and elastic, lumped and full mass: doc/verification/cantilever-dynamic.md."""
import csv
import os
import shutil
import subprocess
import sys
import tempfile
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import DATA, FIGURES, ROOT, Report

import numpy as np


def read(path, *columns):
	with open(path) as f: return np.array([[float(row[c]) for c in columns] for row in csv.DictReader(f)])


report = Report('cantilever-dynamic', 'points', 'case', 'mass', 'difference over the peak', 'peaks [mm]', 'reference [mm]', 'energy error over work')
peaks = lambda u: '%+.2f, %+.2f' % (1e3*u.max(), 1e3*u.min())
for points, elastic, full, bound in ((8, False, False, .08), (8, False, True, .03), (8, True, False, .12), (8, True, True, .02),
		(16, False, False, .03), (16, False, True, .015), (16, True, False, .03), (16, True, True, .005)):
	reference = read(os.path.join(DATA, 'cantilever', 'dynamic_elastic.csv' if elastic else 'dynamic_finite_strain.csv'), 'time_s',
		'displacement_50_Hz_m' if elastic else 'displacement_m')
	reference = reference[reference[:, 0] < .04 + 1e-9]
	with tempfile.TemporaryDirectory() as out:
		subprocess.run([os.path.join(ROOT, 'scripts', 'yade-mpm'), '-n', '-x', os.path.join(ROOT, 'scripts', 'examples', 'cantilever_dynamic.py'), out,
			'--points', str(points)] + ['--full-mass']*full + ['--elastic']*elastic, check=True, stdout=sys.stderr)
		here = read(os.path.join(out, 'cantilever_dynamic.csv'), 'time_s', 'displacement_m', 'mpmExternal_J', 'total_J')
		if points == 16 and not full and not elastic: shutil.copy(os.path.join(out, 'cantilever_dynamic.png'), FIGURES)
	error = abs(here[:, 1] - np.interp(here[:, 0], reference[:, 0], reference[:, 1])).max()/abs(reference[:, 1]).max()
	balance = abs(here[:, 3]).max()/abs(here[:, 2]).max()
	case = 'elastic, 50 Hz' if elastic else 'plastic'
	what = '%s, %d points' % (case, 5*points**2)
	report.row(5*points**2, case, 'full' if full else 'lumped', '%.2f %%' % (100*error), peaks(here[:, 1]), peaks(reference[:, 1]), '%.1e' % balance,
		bounds=[('displacement, ' + what, error, bound), ('energy balance, ' + what, balance, 1e-3)])
report.finish()
