# SPDX-License-Identifier: GPL-2.0-or-later
"""Thick cylinder and sphere under internal pressure, elastic and elastoplastic: doc/verification/thick-walled.md."""
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import FIGURES, Report

import matplotlib.pyplot as plt
import numpy as np
from vessels import A, B, YOUNG, errors, hill, lame, pressurise, radial

YIELD = 1e3
pressure, sphere = hill(YIELD, 1.5)
PRESSURE = {'sphere': pressure, 'cylinder': .7*YIELD}
plastic = {'sphere': sphere, 'cylinder': radial('cylinder', YIELD, PRESSURE['cylinder'])}
r = np.linspace(A, B, 101)
off = max(abs(a - b).max()/abs(b).max() for a, b in zip(radial('sphere', YIELD, pressure, 600)(r)[:1], sphere(r)[:1]))
print('the radial solution and that of Hill for the sphere: %.1e of the displacement' % off)
if not off < 1e-4: sys.exit('the radial solution is wrong')

report = Report('thick-walled', 'case', 'analysis', 'cells', 'points', 'elastic: displacement', 'stress', 'elastoplastic: displacement', 'stress')
figure, axes = plt.subplots(1, 2, figsize=(11, 4))
# bounds of the finest level, in the order of the columns
for kind, analysis, levels, bounds in (('cylinder', 'axisymmetric', (8, 16, 32), (.003, .005, .003, .005)), ('cylinder', 'planeStrain', (8, 16, 32), (.005, .006, .012, .03)),
		('sphere', 'axisymmetric', (8, 16, 32), (.01, .01, .02, .02)), ('sphere', '3d', (4, 6, 10), (.02, .04, .05, .06))):
	for cells in levels:
		small = pressurise(kind, analysis, cells, .1*YIELD)
		large = pressurise(kind, analysis, cells, PRESSURE[kind], YIELD)
		found = errors(kind, analysis, small, lame(kind, .1*YIELD)) + errors(kind, analysis, large, plastic[kind])
		report.row(kind, analysis, cells, len(small[0]), *('%.2f %%' % (100*e) for e in found), bounds=[('%s, %s, %s' % (kind, analysis, what), e, bound) for what, e, bound
			in zip(('elastic displacement', 'elastic stress', 'plastic displacement', 'plastic stress'), found, bounds)] if cells == levels[-1] else ())
	if analysis in ('planeStrain', '3d'):
		start, moved, stress, volume = large
		x = start*[1, 1, kind == 'sphere']
		distance = np.linalg.norm(x, axis=1)
		e = x/distance[:, None]
		radially = np.einsum('pi,pij,pj->p', e, stress, e)
		hoop = (np.trace(stress, axis1=1, axis2=2) - radially)/2 if kind == 'sphere' else np.einsum('pii->p', stress) - radially - stress[:, 2, 2]
		ax = axes[int(kind == 'sphere')]
		exact = plastic[kind](r)
		for values, line, name, colour in ((radially, exact[1], 'radial', 'C0'), (hoop, exact[2], 'hoop', 'C3')):
			ax.plot(distance, values/YIELD, '.', ms=1.5, color=colour, alpha=.4)
			exactly, = ax.plot(r, line/YIELD, 'k', lw=1)
			ax.plot([], [], 'o', color=colour, label=name)
		ax.set(xlabel='r [m]', ylabel='stress over yield stress', title='%s, %s, %d points' % (kind, analysis, len(start)))
		exactly.set_label('exact')
		ax.legend()
figure.savefig(os.path.join(FIGURES, 'thick_walled.png'), dpi=110, bbox_inches='tight')
report.finish()
