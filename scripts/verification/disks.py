# SPDX-License-Identifier: GPL-2.0-or-later
"""V5, two elastic disks collide (Sulsky, Chen & Schreyer, CMAME 118 (1994) 179): doc/verification/disks.md."""
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import FIGURES, Report, runSampled

import matplotlib.pyplot as plt
import numpy as np
from yade import mpm, pack
from yade import *

CELL = .05
report = Report('disks', 'shape', 'dt [s]', "momentum over one disk's", 'energy error', 'kinetic energy, 3.5 s over 0 s')
figure, axes = plt.subplots(1, 2, figsize=(12, 4))
for shape, dt in (('cubic', 1e-3), ('cubic', 5e-4), ('quadratic', 1e-3), ('linear', 1e-3)):
	O.reset()
	O.materials.append(ElastMat(young=1000, poisson=.3, density=1000, label='disk'))
	for centre, speed in (((.2, .2, 0), .1), ((.8, .8, 0), -.1)):
		mpm.fill(pack.inSphere(centre, .2), spacing=CELL/2, thickness=1., material='disk', velocity=(speed, speed, 0), bodies=False)
	O.engines = [MpmEngine(cellSize=CELL, shape=shape, analysis='planeStrain')]
	O.trackEnergy, O.dt = True, dt
	mass = mpm.array('mass')
	one = mass.sum()/2*.1*2**.5
	history, momenta, pictures = [], [], []

	def sample():
		history.append((O.time, O.energy['mpmKinetic'], O.energy['mpmElastic'], O.energy.total()))
		momenta.append(np.linalg.norm(mass @ mpm.array('velocity')))
		if O.time >= 2 and not pictures: pictures.append((mpm.array('position'), mpm.array('vonMises')))
	runSampled(int(round(3.5/dt)), int(round(.025/dt)), sample)
	momentum = max(momenta)
	history = np.array(history)
	balance, recovered = abs(history[:, 3]/history[0, 3] - 1).max(), history[-1, 1]/history[0, 1]
	report.row(shape, '%g' % dt, '%.1e' % (momentum/one), '%.1e' % balance, '%.3f' % recovered, bounds=[
		('momentum, %s' % shape, momentum/one, 1e-12), ('energy balance, %s' % shape, balance, 1e-3)])
	if shape == 'cubic' and dt == 1e-3:
		position, mises = pictures[0]
		dots = axes[0].scatter(position[:, 0], position[:, 1], c=mises, s=12, cmap='viridis', linewidths=0)
		figure.colorbar(dots, ax=axes[0], label='[Pa]')
		axes[0].set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title='von Mises stress, t = 2 s')
		for column, label in ((1, 'kinetic'), (2, 'elastic'), (3, 'total')): axes[1].plot(history[:, 0], history[:, column], label=label)
		axes[1].set(xlabel='time [s]', ylabel='energy [J]', title='cubic, dt = 1e-3 s')
		axes[1].legend()
figure.savefig(os.path.join(FIGURES, 'disks.png'), dpi=110, bbox_inches='tight')
report.finish()
