# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures and tables of doc/accuracy from its accuracy.csv, steps.csv, columns.csv and drift.csv.  python3 scripts/benchmarks/accuracy.py doc/accuracy [errors]

Cost is points times steps times the unit cost of a choice: CPU time a point and step, the least over the grids of a case, which is that of
the fine ones. It is steadier than the time of one run."""
import csv
import datetime
import math
import os
import re
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt

FOLDER = sys.argv[1]
SHAPES = ('linear', 'gimp', 'quadratic', 'cubic')
COLOURS = dict(zip(SHAPES, ('C3', 'C1', 'C2', 'C0')))
STYLES = {'MUSL': '-', 'USL': '--', 'USF': ':', 'MUSL full mass': '-.'}
TITLES = {
	'V1 small': 'bar, strain 3e-4', 'V1 large': 'bar, strain 0.16', 'V2 small': 'plane stress, strain 3e-4', 'V2 large': 'plane stress, strain 0.16',
	'hysteretic': 'hysteretic bar, 1.3 yield strains', 'hysteretic far': 'hysteretic bar, 3.2 yield strains', 'V3 velocity': 'vibrating bar, velocity',
	'V6': 'soft cantilever, 1.1 s', 'V6 published': 'soft cantilever, 3 s', 'V6 three seconds': 'soft cantilever, 6 m/s2, 3 s',
	'V3 energy': 'vibrating bar, energy', 'V3 large velocity': 'vibrating bar, large, velocity', 'V3 large energy': 'vibrating bar, large, energy',
	'static elastic': 'static cantilever, elastic', 'static plastic': 'static cantilever, plastic', 'static residual': 'static cantilever, unloaded'}
TARGETS = {
	'V1 small': (1e-5, 1e-6), 'V1 large': (5e-3, 5e-4), 'V2 small': (1e-5, 2e-6), 'V2 large': (1e-2, 1e-3), 'hysteretic': (2e-4, 2e-5), 'V6': (.3, .1),
	'V6 three seconds': (.2, .05), 'static elastic': (.02, .005), 'static plastic': (.02, .005), 'static residual': (.05,),
	'hysteretic far': (1e-4, 3e-5), 'V3 velocity': (.1, .02), 'V3 energy': (1e-3, 1e-4), 'V3 large energy': (1e-2, 1e-3)}


def read():
	runs, quadrature = {}, {}
	with open(os.path.join(FOLDER, 'accuracy.csv')) as f:
		for row in csv.DictReader(f):
			if row['problem'] == 'V4':
				quadrature.setdefault(row['variant'], {})[row['shape']] = float(row['error'])
				continue
			key = row['shape'], row['scheme'], int(row['points_a_cell']), row['variant']
			runs.setdefault(row['problem'], {}).setdefault(key, []).append(
				(int(row['cells']), float(row['error']), float(row['point_steps']), float(row['cpu_seconds'])))
	return runs, quadrature


def name(key):
	shape, scheme, points, variant = key
	return '%s %s, %d a cell%s' % (shape, scheme, points, ', ' + variant if variant else '')


def costs(levels):
	unit = min(seconds/work for _, _, work, seconds in levels if work)
	return [work*unit for _, _, work, _ in levels]


def costOf(levels, target):
	"""Core-seconds to reach an error: between two grids by a straight line in the logarithms; from a grid on which the error stays below."""
	spent, errors = costs(levels), [e for _, e, _, _ in levels]
	for k in range(len(errors)):
		if not max(errors[k:]) <= target: continue
		if k == 0 or not errors[k - 1] < math.inf: return spent[k]
		part = math.log(errors[k - 1]/target)/math.log(errors[k - 1]/errors[k])
		return math.exp(math.log(spent[k - 1]) + part*math.log(spent[k]/spent[k - 1]))
	return math.inf


def order(levels):
	(n1, e1, _, _), (n2, e2, _, _) = levels[-2:]
	return math.log(e1/e2)/math.log(n2/n1) if 0 < e1 < math.inf and 0 < e2 < math.inf else math.nan


def number(x): return '-' if not x < math.inf else '%.2g' % x


def table(head, rows): return '\n'.join(['| ' + ' | '.join(head) + ' |', '|' + '---|'*len(head)] + ['| ' + ' | '.join(map(str, r)) + ' |' for r in rows])


def draw(problem, choices):
	figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5), sharey=True)
	for key, levels in choices.items():
		shape, scheme, points, variant = key
		if variant == 'full mass': scheme, variant = 'MUSL full mass', ''
		if variant or points not in ((16,) if problem[:2] == 'V6' else (2, 4)): continue
		kept = [(1/n, e, c) for (n, e, _, _), c in zip(levels, costs(levels)) if e < math.inf]
		if not kept: continue
		h, e, c = zip(*kept)
		left.loglog(h, e, STYLES[scheme], color=COLOURS[shape], marker='o', markersize=3, label='%s %s' % (shape, scheme))
		right.loglog(c, e, STYLES[scheme], color=COLOURS[shape], marker='o', markersize=3)
	left.set_xlabel('cell size over %s' % {'V6': 'height', 'st': 'depth'}.get(problem[:2], 'length')); right.set_xlabel('cost [core-seconds]'); left.set_ylabel('error')
	x0, x1 = left.get_xlim(); y0, y1 = left.get_ylim()
	for order, end in ((2, 3.5), (4, 2.2)):
		slope = [x0*1.2, x0*end]
		left.loglog(slope, [y0*1.5*(x/slope[0])**order for x in slope], color='grey', linewidth=1)
		left.annotate('order %d' % order, (slope[1], y0*1.5*(slope[1]/slope[0])**order), fontsize=8, color='grey')
	for axes in (left, right): axes.grid(True, which='major', linewidth=.3)
	labelled = dict(zip(*reversed(left.get_legend_handles_labels())))
	figure.legend(labelled.values(), labelled.keys(), fontsize=7, ncol=6, loc='lower center'); figure.suptitle(TITLES[problem])
	figure.tight_layout(rect=(0, .1, 1, 1))
	figure.savefig(os.path.join(FOLDER, problem.replace(' ', '_') + '.png'), dpi=110)
	plt.close(figure)


def machine():
	with open('/proc/cpuinfo') as f: model = re.search(r'model name\s*: (.*)', f.read())
	return '%s, one thread, %s' % (model.group(1) if model else 'unknown processor', datetime.date.today().isoformat())


def limits():
	"""Rows of the table of stable steps: bulk, and the worst place of a free end."""
	groups = {}
	with open(os.path.join(FOLDER, 'steps.csv')) as f:
		for row in csv.DictReader(f):
			groups.setdefault((row['body'], row['shape'], row['scheme']), {}).setdefault(row['where'], []).append((float(row['computed']), float(row['actual'])))
	for key, found in groups.items():
		(inside, failed), = found['bulk']
		parts = [actual/computed for computed, actual in found['edge']]
		yield key + ('%.3f' % inside, '%.3f' % (failed/inside), '%.3f' % min(c for c, _ in found['edge']), '%.3f' % min(a for _, a in found['edge']),
			'%.3f to %.3f' % (min(parts), max(parts)))


def columns():
	"""Rows of the table of columns, one a load."""
	rows = {}
	with open(os.path.join(FOLDER, 'columns.csv')) as f:
		for row in csv.DictReader(f):
			told = '%.2g; %+.1f; %+.1f' % (100*float(row['spread']), 100*float(row['first_point']), 100*float(row['wall_force'])) if row['spread'] else 'torn'
			rows.setdefault(row['load'], {})[row['shape']] = told.replace('+0.0', '0').replace('-0.0', '0')
	return [(load,) + tuple(told[k] for k in SHAPES) for load, told in rows.items()]


def put(text, mark, content):
	return re.sub('(<!-- %s -->\n).*?(<!-- end of %s -->)' % (mark, mark), lambda m: m.group(1) + content + '\n' + m.group(2), text, flags=re.S)


def transfers(name):
	"""Cases by rows, transfers by columns, and the kernel's next to those of the study."""
	columns, rows = [], {}
	for file in (name + '.csv', name + '_kernel.csv'):
		path = os.path.join(FOLDER, file)
		if not os.path.exists(path): continue
		with open(path) as f:
			for case, quantity, transfer, value in list(csv.reader(f))[1:]:
				if transfer not in columns: columns.append(transfer)
				rows.setdefault(case + ': ' + quantity, {})[transfer] = '%.3g' % float(value) if abs(float(value)) < .1 else '%.4g' % float(value)
	columns = sorted(columns, key=lambda column: columns.index(column.replace(', kernel', '')))
	return table([''] + columns, [[row] + [values.get(c, '') for c in columns] for row, values in rows.items()])


runs, quadrature = read()
cheapest, orders = [], []
for problem, choices in runs.items():
	if problem in TARGETS: draw(problem, choices)
	for target in TARGETS.get(problem, ()):
		ranked = sorted((costOf(levels, target), name(key)) for key, levels in choices.items())
		default = costOf(choices['cubic', 'MUSL', 2 if ('cubic', 'MUSL', 2, '') in choices else 4, ''], target)
		first = ranked[:2]
		cheapest.append((TITLES[problem], '%g' % target) + tuple('%s: %s' % (n, number(c)) if c < math.inf else '-' for c, n in first) + (number(default),))
	for key, levels in sorted(choices.items()):
		orders.append((TITLES[problem], name(key), ', '.join('%d: %s' % (n, '%.3g' % e if e < math.inf else 'fails') for n, e, _, _ in levels),
			'%.2f' % order(levels), '%.0f' % (1e9*min(t/w for _, _, w, t in levels if w))))
page = os.path.join(FOLDER, 'README.md')
with open(page) as f: text = f.read()
if 'errors' in sys.argv: text = put(text, 'machine', machine())
text = put(text, 'cheapest', table(('case', 'wanted error', 'cheapest [core-s]', 'second [core-s]', 'cubic MUSL, 2 points an axis [core-s]'), cheapest))
text = put(text, 'orders', table(('case', 'choice', 'cells: error', 'last order', 'ns a point and step'), orders))
text = put(text, 'quadrature', table(('spacing/h',) + SHAPES, [(s,) + tuple('%.2g' % v[k] if v[k] > 1e-12 else '0' for k in SHAPES) for s, v in quadrature.items()]))
text = put(text, 'steps', table(('body', 'shape', 'scheme', 'bulk: computed [h/c]', 'failure over it', 'edge: least computed [h/c]', 'least that fails [h/c]',
	'failure over computed, all places'), limits()))
text = put(text, 'columns', table(('rho g L/E',) + SHAPES, columns()))
with open(os.path.join(FOLDER, 'drift.csv')) as f: drift = list(csv.reader(f))[1:]
text = put(text, 'drift', table(('body', 'scheme', 'points', 'steps', 'energy over that at the start', 'centre of mass has moved by [cells]'), drift))
for mark in ('transfers', 'transfers_drift'): text = put(text, mark, transfers(mark))
with open(page, 'w') as f: f.write(text)
