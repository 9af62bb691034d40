# SPDX-License-Identifier: GPL-2.0-or-later
"""One material point under tension and compression: effect of the parameters of the hysteretic law.

	scripts/yade-mpm -n -x scripts/examples/element_test.py [out]

Uniaxial stress (free=('yy', 'zz')), strain 0, 3, -3, 3 yield strains: n = 1, 2, 5, 25 and classical
plasticity; tangent ratios 0, 0.05, 0.2; beta and gamma. Then closed stress cycles, 0.8 -> 0.6 -> 0.8 of the
yield stress: the smooth law drifts, unless reloading is compatible with plasticity. Writes element_test.csv
and element_test.png.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

YOUNG, YIELD = 210e9, 240e6
APART = .3 # between the curves of (d)
STEEL = dict(young=YOUNG, poisson=.3, density=7850, yieldStress=YIELD)


def pull(material, x):
	"""A bar along x through strains x, in yield strains; returns its PointHistory and stress over yield stress."""
	strain = np.zeros((len(x), 3, 3))
	strain[:, 0, 0] = np.asarray(x)*YIELD/YOUNG
	history = mpm.drive(material, strain, free=('yy', 'zz'))
	return history, history.stress[:, 0, 0]/YIELD


def closedCycles(material, count, level=.8, depth=.2):
	"""Turning points [yield strains] of stress cycles level -> level - depth -> level, n = 2, alpha = 0."""
	turns = [np.arctanh(level)]
	for _ in range(count):
		low = turns[-1] - depth # unloading is elastic
		up = np.linspace(low, low + 3*depth, 3001)
		_, stress = pull(material, turns + list(up))
		turns += [low, np.interp(level, stress[len(turns):], up)]
	return np.array(turns)


def between(turns, steps=150):
	"""The path 0, turns... with so many steps a branch."""
	return np.concatenate([[0]] + [np.linspace(a, b, steps + 1)[1:] for a, b in zip([0] + list(turns)[:-1], turns)])


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	out = parser.parse_args(sys.argv[1:]).out
	os.makedirs(out, exist_ok=True)

	loop = between([3, -3, 3])
	steel = lambda **parameters: BoucWenMat(**dict(STEEL, tolerance=1e-8, **parameters))
	panels = {
		'(a) sharpness of the knee, tangentRatio = 0.05': [('n = %d' % n, steel(n=n, tangentRatio=.05), loop) for n in (1, 2, 5, 25)]
			+ [('J2Mat', J2Mat(tangentRatio=.05, **STEEL), loop)],
		'(b) hardening, n = 5': [('tangentRatio = %g' % a, steel(n=5, tangentRatio=a), loop) for a in (0, .05, .2)],
		'(c) unloading, n = 2, tangentRatio = 0.05': [('beta, gamma = %g, %g' % (b, 1 - b), steel(n=2, tangentRatio=.05, beta=b, gamma=1 - b), loop) for b in (.5, .1)],
	}
	cycles = panels['(d) eight closed stress cycles, n = 2'] = []
	for reloading in (0, 2, float('inf')):
		material = steel(n=2, reloading=reloading)
		turns = closedCycles(material, 8)
		drift = np.diff(turns[::2])
		print('reloading = %3g: drift %.4f yield strains in the first cycle, %.4f in eight' % (reloading, drift[0], drift.sum()), flush=True)
		cycles.append(('reloading = %g, drift %.3f' % (reloading, drift.sum()), material, between(list(turns) + [turns[-1] + .6])))

	figure, axes = plt.subplots(2, 2, figsize=(11, 8.5))
	with open(os.path.join(out, 'element_test.csv'), 'w', newline='') as f:
		table = csv.writer(f)
		table.writerow(['panel', 'curve', 'strain_xx', 'stress_xx_Pa', 'strain_yy', 'plastic_strain', 'dissipation_J_m3'])
		for ax, (title, curves) in zip(axes.flat, panels.items()):
			for k, (name, material, x) in enumerate(curves):
				history, stress = pull(material, x)
				for row in zip(history.strain[:, 0, 0], history.stress[:, 0, 0], history.strain[:, 1, 1], history.plasticStrain, history.dissipation):
					table.writerow([title[1], name] + ['%.9g' % v for v in row])
				style = dict(color='k', ls='--', lw=1) if name == 'J2Mat' else dict(color='C%d' % k, lw=1.3)
				ax.plot(x, stress + APART*k*(curves is cycles), label=name, **style)
			ax.set(title=title, xlabel='strain [yield strains]', ylabel='stress [yield stress]')
			ax.grid(alpha=.3)
			ax.legend(fontsize=8, loc='upper right' if curves is cycles else 'lower right')
	axes[1, 1].set(xlim=(.6, None), ylim=(.45, None), ylabel='stress [yield stress], each raised by %g' % APART)
	figure.tight_layout()
	figure.savefig(os.path.join(out, 'element_test.png'), dpi=150)
	print('results in %s' % os.path.abspath(out))


main()
