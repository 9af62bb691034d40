# SPDX-License-Identifier: GPL-2.0-or-later
"""V3, the vibrating bar of Buzzi, Pedroso & Giacomini (CMES 31 (2008) 85), through the engine: doc/verification/vibrating-bar.md."""
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import FIGURES, Report, runSampled

import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

YOUNG, LENGTH, SPEED, OMEGA = 100., 25., 10., np.pi*10/50


def vibrate(shape, cells, scheme, v0):
	"""Greatest error of the centre of mass' velocity over its amplitude, energy at the end over the start, history."""
	O.reset()
	h = LENGTH/cells
	O.materials.append(ElastMat(young=YOUNG, poisson=0, density=1, label='bar'))
	mpm.fill(((0, 0), (LENGTH, h)), spacing=h/2, thickness=1., material='bar')
	for b in O.bodies: b.state.vel = (v0*np.sin(np.pi*b.state.pos[0]/(2*LENGTH)), 0, 0)
	O.engines = [MpmEngine(cellSize=h, shape=shape, scheme=scheme, analysis='planeStress', walls=[
		MpmWall(normal=(1, 0, 0), kind='fixed'), MpmWall(normal=(0, 1, 0), kind='slip'), MpmWall(origin=(0, h, 0), normal=(0, -1, 0), kind='slip')])]
	O.dt = .1*h/SPEED
	mass = mpm.array('mass')
	area = mass/mass.sum()*h*LENGTH # undeformed, of unit thickness

	def energy():
		"""Kinetic, plus what sigma = E ln F stores."""
		F, v = mpm.array('F')[:, 0, 0], mpm.array('velocity')[:, 0]
		return .5*mass @ v**2 + YOUNG*area @ (F*np.log(F) - F + 1)

	amplitude, history = v0*2/np.pi, []
	start = .5*mass @ (v0*np.sin(np.pi*mpm.array('position')[:, 0]/(2*LENGTH)))**2
	steps = int(round(100/O.dt))
	every = max(1, int(.25/O.dt))
	try:
		# O.time is advanced after the engines
		runSampled(steps, every, lambda: history.append((O.time + O.dt, mpm.array('velocity')[:, 0].mean())))
	except RuntimeError as failure:
		return None, None, str(failure)
	history = np.array(history)
	return abs(history[:, 1] - amplitude*np.cos(OMEGA*history[:, 0])).max()/amplitude, energy()/start, history


report = Report('vibrating-bar', 'v0', 'shape, cells', 'scheme', 'velocity error', 'elsewhere', 'energy ratio', 'elsewhere')
# (v0, shape, cells, scheme, error and energy of an independent implementation; None: no bound but the one named)
for v0, shape, cells, scheme, error, energy in (
		(.1, 'linear', 16, 'USF', 7.28e-2, 1.00078), (.1, 'linear', 16, 'USL', 8.49e-2, .99810), (.1, 'linear', 16, 'MUSL', 8.49e-2, .99920),
		(.1, 'linear', 32, 'USF', 1.63e-2, 1.00009), (.1, 'linear', 32, 'USL', 2.23e-2, .99976), (.1, 'linear', 32, 'MUSL', 2.23e-2, .99990),
		(.1, 'cubic', 16, 'MUSL', .204, .9981), (.1, 'cubic', 32, 'MUSL', 5.44e-2, .99975), (.1, 'cubic', 64, 'MUSL', 1.65e-2, .99997),
		(.1, 'cubic', 32, 'USF', None, None), (.1, 'cubic', 32, 'USL', None, None),
		(.75, 'cubic', 32, 'USF', None, 1), (.75, 'cubic', 32, 'USL', None, 1), (.75, 'cubic', 32, 'MUSL', None, 1)):
	e, ratio, history = vibrate(shape, cells, scheme, v0)
	if e is None:
		report.row(v0, '%s, %d' % (shape, cells), scheme, 'stopped', '', '', '', bounds=[(history, 1, 0)])
		continue
	bounds = [] if error is None else [('velocity error over that elsewhere, %s %d %s' % (shape, cells, scheme), e/error - 1, .03)]
	if energy is not None: bounds.append(('energy ratio, %s %d %s' % (shape, cells, scheme), ratio - energy, 5e-4 if v0 == .1 else 1e-3))
	report.row(v0, '%s, %d' % (shape, cells), scheme, '%.3g' % e, '' if error is None else '%.3g' % error, '%.5f' % ratio, '' if energy is None or v0 != .1 else '%.5f' % energy, bounds=bounds)
	if (v0, shape, cells, scheme) == (.1, 'cubic', 64, 'MUSL'):
		figure, ax = plt.subplots(figsize=(8, 3.2))
		t = np.linspace(0, 100, 1000)
		ax.plot(t, .1*2/np.pi*np.cos(OMEGA*t), 'k', lw=.8, label='exact')
		ax.plot(history[::4, 0], history[::4, 1], 'C0.', ms=3, label='cubic, 64 cells, MUSL')
		ax.set(xlabel='time [s]', ylabel='velocity of the centre of mass [m/s]')
		ax.legend(loc='lower center', bbox_to_anchor=(.5, 1), ncol=2, frameon=False)
		figure.savefig(os.path.join(FIGURES, 'vibrating_bar.png'), dpi=110, bbox_inches='tight')
report.finish()
