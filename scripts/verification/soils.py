# SPDX-License-Identifier: GPL-2.0-or-later
"""Active and passive earth pressure after Rankine, with MohrCoulombMat: doc/verification/soils.md."""
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import FIGURES, Report, runSampled

import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

report = Report('soils', 'case', 'cells', 'result', 'reference', 'difference')
figure, axes = plt.subplots(1, 2, figsize=(13, 4.5), squeeze=False)


def add(case, cells, value, reference, least, greatest):
	"""least, greatest: bounds of the difference."""
	difference = value/reference - 1
	report.row(case, cells, '%.4g' % value, '%.4g' % reference, '%+.2f %%' % (100*difference), bounds=[('%s, %d cells' % (case, cells), difference - (least + greatest)/2, (greatest - least)/2)])


def smooth(curve, part=50):
	"""Means over a part of the curve, without the waves that go up and down."""
	curve, width = np.array(curve), max(1, len(curve)//part)
	return np.stack([np.convolve(column, np.ones(width)/width, 'valid') for column in curve.T])


# ---- Rankine: smooth wall of height 4 m, soil of 18 kN/m3 with phi = 30 degrees --------------------------------------------

HEIGHT, WEIGHT, PHI = 4., 18e3, np.radians(30)


def earthPressure(cells, cohesion, psi, strain):
	"""Force on the wall a width [N/m] over its displacement; strain < 0 is towards the soil."""
	O.reset()
	O.materials.append(MohrCoulombMat(young=200e6, poisson=1/3., density=1800, internalFriction=PHI, cohesion=cohesion, dilatancy=psi, label='soil'))
	rest = lambda x: np.diag([.5, 1, .5])*WEIGHT*(x[1] - HEIGHT)
	cell = HEIGHT/cells
	mpm.fill(((0, 0), (HEIGHT/2, HEIGHT)), spacing=cell/2, thickness=1., material='soil', stress=rest, bodies=False)
	wall = MpmWall(normal=(1, 0, 0), kind='slip')
	grid = MpmEngine(cellSize=cell, analysis='planeStrain', largeStrain=False, damping=.2, gravity=(0, -10, 0),
		walls=[wall, MpmWall(origin=(HEIGHT/2, 0, 0), normal=(-1, 0, 0), kind='slip'), MpmWall(normal=(0, 1, 0), kind='slip')])
	O.engines = [grid]
	O.dt = .4*mpm.criticalTimeStep()
	duration = 40*HEIGHT/350. # waves of 410 m/s go up and down twenty times
	curve = []

	def sample():
		wall.velocity = (-strain*HEIGHT/2/duration*min(1, 10*O.time/duration)/.95, 0, 0)
		curve.append((-wall.origin[0], -wall.force[0]))
	runSampled(int(duration/O.dt), max(1, int(duration/O.dt)//1000), sample)
	return smooth(curve)


for cells in 8, 16:
	for name, sign in ('active', -1), ('passive', 1):
		for cohesion, psi in (0, 0), (5e3, PHI):
			ratio = np.tan(np.pi/4 + sign*PHI/2)**2
			theory = .5*ratio*WEIGHT*HEIGHT**2 + sign*2*cohesion*HEIGHT*ratio**.5
			moved, force = earthPressure(cells, cohesion, psi, 2e-4 if sign < 0 else -2e-3)
			value = force[-len(force)//5:].mean()
			case = '%s pressure, c = %g kPa, psi = %.0f deg [kN/m]' % (name, cohesion/1e3, np.degrees(psi))
			add(case, cells, value/1e3, theory/1e3, -.03, .03)
			if cells == 16: axes[0, int(sign > 0)].plot(1e3*moved, force/1e3, label=case[:-7]), axes[0, int(sign > 0)].axhline(theory/1e3, color='k', lw=.6)
for axis in axes[0]:
	axis.set(xlabel='displacement of the wall [mm]', ylabel='force [kN/m]', title='Rankine (black: theory)')
	axis.legend(fontsize=7)

figure.tight_layout()
figure.savefig(os.path.join(FIGURES, 'soils.png'), dpi=100, bbox_inches='tight')
report.finish()
