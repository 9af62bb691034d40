# SPDX-License-Identifier: GPL-2.0-or-later
"""Run-out of a collapsing column of sand for three heights, in 3D: doc/verification/column-collapse.md."""
import csv
import math
import os
import subprocess
import sys
import tempfile
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import ROOT, Report

import numpy as np

LEVELS = 10, 16, 24  # points along the radius
report = Report('column-collapse', 'a', 'angle', *('%d points' % n for n in LEVELS), 'scatter', 'extrapolated', 'experiment', 'height, %d' % LEVELS[-1])
for angle in 25.4, 30:
	for aspect in .5, 1, 2:
		found = []
		for points in LEVELS:
			with tempfile.TemporaryDirectory() as out:
				subprocess.run([os.path.join(ROOT, 'scripts', 'yade-mpm'), '-n', '-x', os.path.join(ROOT, 'scripts', 'examples', 'column_collapse.py'), out,
					'--aspect', str(aspect), '--points', str(points), '--angle', str(angle)], check=True, stdout=sys.stderr)
				with open(os.path.join(out, 'column_collapse.csv')) as f: last = [float(x) for x in list(csv.reader(f))[-1]]
			found.append((last[1] - 1, last[2], last[3]))
		runout = [r for r, _, _ in found]
		limit = np.polyfit([1/n for n in LEVELS], runout, 1)[1]
		wanted = 1.24*aspect if aspect < 1.7 else 1.6*math.sqrt(aspect)
		report.row(aspect, angle, *('%.2f' % r for r in runout), '%.3f' % max(s for _, s, _ in found), '%.2f' % limit, '%.2f' % wanted, '%.2f' % found[-1][2],
			bounds=[('run-out, %g deg, height %g' % (angle, aspect), limit/wanted - 1, .2 if angle < 30 else .3)])
report.finish()
