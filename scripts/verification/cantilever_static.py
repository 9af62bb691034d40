# SPDX-License-Identifier: GPL-2.0-or-later
"""Example 4.1, 360 and 1440 points, over the whole loading curve: doc/verification/cantilever-static.md."""
import csv
import os
import shutil
import subprocess
import sys
import tempfile
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import DATA, FIGURES, ROOT, Report

import numpy as np

CASES = {'perfectly plastic': 'static_perfectly_plastic', '5 % hardening': 'static_hardening'}
# what is asked for: stiffness, displacement to the load named, displacement beyond, residual displacement; half with 1440 points
BOUNDS = {
	('perfectly plastic', 6): (.01, .03, 26e3, .05, .10), ('5 % hardening', 6): (.01, .04, 40e3, .04, .05),
	('perfectly plastic', 12): (.005, .015, 26e3, .025, .05), ('5 % hardening', 12): (.005, .015, 40e3, .015, .025)}


def read(path, **wanted):
	with open(path) as f: return [row for row in csv.DictReader(f) if all(row[k] == v for k, v in wanted.items())]


report = Report('cantilever-static', 'points', 'case', 'what', 'material points', 'finite elements', 'difference')
for points in (6, 12):
	with tempfile.TemporaryDirectory() as out:
		subprocess.run([os.path.join(ROOT, 'scripts', 'yade-mpm'), '-n', '-x', os.path.join(ROOT, 'scripts', 'examples', 'cantilever_static.py'), out,
			'--points', str(points)], check=True, stdout=sys.stderr)
		table = os.path.join(out, 'cantilever_static.csv')
		curves = {case: np.array([[float(r['load_N']), float(r['displacement_m'])] for r in read(table, case=case)]) for case in CASES}
		if points == 6:
			for name in ('cantilever_static.png', 'cantilever_static_vonMises.png'): shutil.copy(os.path.join(out, name), FIGURES)
	for case, curve in curves.items():
		elements = np.array([[float(r['load_N']), float(r['displacement_m'])] for r in read(os.path.join(DATA, 'cantilever', CASES[case] + '.csv'), branch='1')])
		residual = float(read(os.path.join(DATA, 'cantilever', CASES[case] + '.csv'), branch='2')[-1]['displacement_m'])
		up = curve[:np.argmax(curve[:, 0]) + 1]
		stiff, before, limit, beyond, left = BOUNDS[case, points]
		here, there = (lambda load, c=c: np.interp(load, c[:, 0], c[:, 1]) for c in (up, elements))
		total = 10*points**2

		def row(what, a, b, bound, form):
			report.row(total, case, what, form % a, form % b, '%+.2f %%' % (100*(a/b - 1)), bounds=[('%s, %d points: %s' % (case, total, what), a/b - 1, bound)])
		row('stiffness at 10 kN [N/m]', 10e3/here(10e3), 10e3/there(10e3), stiff, '%.4g')
		top = min(up[-1, 0], elements[-1, 0])
		for load in (20e3, 24e3, 26e3, 28e3) if top < 30e3 else (20e3, 25e3, 30e3, 35e3, 38e3, 40e3):
			load = min(load, top)
			row('displacement at %.0f kN [mm]' % (load/1e3), 1e3*here(load), 1e3*there(load), before if load <= limit else beyond, '%.3f')
		loads = np.linspace(5e3, top, 200)
		worst = loads[np.argmax(abs(here(loads)/there(loads) - 1))]
		row('worst of all, at %.1f kN [mm]' % (worst/1e3), 1e3*here(worst), 1e3*there(worst), max(before, beyond), '%.3f')
		row('residual displacement [mm]', 1e3*np.mean(curve[-3:, 1]), 1e3*residual, left, '%.3f')
report.finish()
