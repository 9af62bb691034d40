# SPDX-License-Identifier: GPL-2.0-or-later
"""Calibrate the hysteretic law to a cyclic test of a steel bar, with mpm.calibrate.

    scripts/yade-mpm -n -x scripts/examples/calibrate.py [out] [--record test.csv] [--noise 3]

Without --record the record is synthetic: cycles of growing amplitude up to 1.5 %, by a known BoucWenMat, with
a random error of --noise MPa in each stress. The fit starts from other values, finds the known ones within
two to three standard errors, and prints both. A second fit, to the first elastic cycle alone, shows the error
that names what such a test does not determine. Writes calibrate_record.csv, calibrate.csv and calibrate.png.
"""
import argparse
import csv
import os
import sys

import numpy as np
from yade import mpm
from yade import *

KNOWN = dict(young=205e9, yieldStress=310e6, n=4, tangentRatio=.02, saturationStress=60e6, saturationRate=25)
START = dict(young=190e9, yieldStress=250e6, n=8, tangentRatio=.05, saturationStress=20e6, saturationRate=10)
COMMON = dict(poisson=.3, density=7850)


def synthetic(file, noise):
	"""Write the record of a bar along x: columns strain_xx [-] and stress_xx [Pa]; yy and zz are free."""
	turns = [0] + [sign*amplitude for amplitude in (.001, .004, .008, .015) for sign in (1, -1)] + [0]
	strain = np.concatenate([np.linspace(a, b, 61)[:-1] for a, b in zip(turns, turns[1:])])
	path = np.zeros((len(strain), 3, 3))
	path[:, 0, 0] = strain
	stress = mpm.drive(BoucWenMat(**KNOWN, **COMMON), path, free=('yy', 'zz')).stress[:, 0, 0]
	stress += np.random.default_rng(5).normal(0, noise*1e6, len(strain))
	with open(file, 'w', newline='') as f:
		csv.writer(f).writerows([['strain_xx', 'stress_xx']] + [['%.8g' % e, '%.6g' % s] for e, s in zip(strain, stress)])


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--record', help='CSV file with columns strain_xx and stress_xx [Pa]')
	parser.add_argument('--noise', type=float, default=3, help='random error of the synthetic stress [MPa]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)
	record = options.record or os.path.join(options.out, 'calibrate_record.csv')
	if not options.record: synthetic(record, options.noise)

	steel = BoucWenMat(**START, **COMMON)
	fit = mpm.calibrate(steel, record, list(START))
	print(fit)
	print('correlation of the estimates:')
	for name, row in zip(fit.names, fit.correlation): print('  %-17s %s' % (name, ' '.join('%5.2f' % value for value in row)))
	with open(os.path.join(options.out, 'calibrate.csv'), 'w', newline='') as f:
		writer = csv.writer(f)
		writer.writerow(['strain', 'measured_Pa', 'fit_Pa'])
		computed = fit.histories[0]
		for strain, stress, difference in zip(computed.strain[:, 0, 0], computed.stress[:, 0, 0], fit.residuals[0][:, 0, 0]):
			writer.writerow([strain, stress - difference, stress])
	if not options.record:
		for name in fit.names:
			print('%-17s known %-10.5g off by %+.1f standard errors' % (name, KNOWN[name], (fit.parameters[name] - KNOWN[name])/fit.standardErrors[name]))
	fit.plot(os.path.join(options.out, 'calibrate.png'))

	with open(record) as f: rows = [[float(value) for value in row] for row in list(csv.reader(f))[1:180]]
	strain, stress = np.array(rows).T[:2]
	small = np.abs(strain) < 5e-4
	first = len(small) if small.all() else np.argmin(small)
	try:
		mpm.calibrate(steel, {'strain': strain[:first], 'stress': stress[:first]}, ['young', 'yieldStress', 'tangentRatio'])
	except mpm.Undetermined as fault:
		print('the first elastic branch alone:', fault)
	print('results in %s' % os.path.abspath(options.out))


main()
