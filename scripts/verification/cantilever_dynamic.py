# SPDX-License-Identifier: GPL-2.0-or-later
"""Example 4.2 with 320, 1280 and 5120 points, and 320 and 1280 with the full mass: doc/verification/cantilever-dynamic.md."""
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


reference = read(os.path.join(DATA, 'cantilever', 'dynamic_finite_strain.csv'), 'time_s', 'displacement_m')
peak = abs(reference[:, 1]).max()
report = Report('cantilever-dynamic', 'points', 'mass', 'difference over the peak', 'peaks [mm]', 'finite elements [mm]', 'energy error over work')
for points, full, bound in ((8, False, .08), (16, False, .03), (32, False, .01), (8, True, .03), (16, True, .01)):
	with tempfile.TemporaryDirectory() as out:
		subprocess.run([os.path.join(ROOT, 'scripts', 'yade-mpm'), '-n', '-x', os.path.join(ROOT, 'scripts', 'examples', 'cantilever_dynamic.py'), out,
			'--points', str(points)] + ['--full-mass']*full, check=True, stdout=sys.stderr)
		here = read(os.path.join(out, 'cantilever_dynamic.csv'), 'time_s', 'displacement_m', 'mpmExternal_J', 'total_J')
		if points == 16 and not full: shutil.copy(os.path.join(out, 'cantilever_dynamic.png'), FIGURES)
	error = abs(here[:, 1] - np.interp(here[:, 0], reference[:, 0], reference[:, 1])).max()/peak
	balance = abs(here[:, 3]).max()/abs(here[:, 2]).max()
	report.row(5*points**2, 'full' if full else 'lumped', '%.2f %%' % (100*error), '%+.2f, %+.2f' % (1e3*here[:, 1].max(), 1e3*here[:, 1].min()),
		'%+.2f, %+.2f' % (1e3*reference[:, 1].max(), 1e3*reference[:, 1].min()), '%.1e' % balance, bounds=[
			('displacement, %d points' % (5*points**2), error, bound), ('energy balance, %d points' % (5*points**2), balance, 1e-3)])
report.finish()
