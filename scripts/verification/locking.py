# SPDX-License-Identifier: GPL-2.0-or-later
"""Cook's membrane, a strip footing and Taylor's bar, with and without mean dilatation: doc/verification/locking.md."""
import os
import sys
sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from report import FIGURES, Report, runSampled

import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

ALL = ('linear', False), ('linear', True), ('quadratic', True), ('cubic', False), ('cubic', True)
report = Report('locking', 'case', 'cells', 'functions', 'mean dilatation', 'result', 'reference', 'difference')
figure, axes = plt.subplots(2, 2, figsize=(13, 10))


def draw(axis, x, value, size, limits, **labels):
	dots = axis.scatter(x[:, 0], x[:, 1], c=value, s=size, cmap='viridis', linewidths=0, vmin=limits[0], vmax=limits[1])
	axis.set(aspect='equal', **labels)
	return dots


def add(case, cells, shape, mean, text, value, reference, bound):
	"""bound: least and greatest difference."""
	difference, (least, greatest) = value/reference - 1, bound
	report.row(case, cells, shape, 'yes' if mean else 'no', text, '%g' % reference, '%+.2f %%' % (100*difference),
		bounds=[('%s, %d cells, %s, mean dilatation %s' % (case, cells, shape, mean), difference - (least + greatest)/2, (greatest - least)/2)])


# ---- Cook's membrane ------------------------------------------------------------------------------------------------------

YOUNG, POISSON, LOAD = 240.565, .4999, 1.
DISPLACEMENT = .0772 # mean of the right edge; finite elements


class Trapezoid:
	"""(0, 0), (48, 44), (48, 60), (0, 44), between two abscissas."""

	def __init__(self, left, right): self.left, self.right = left, right
	def aabb(self): return (self.left, 0, 0), (self.right, 60, 0)
	def __call__(self, x, pad): return 44*x[0]/48 < x[1] < 44 + 16*x[0]/48


def cook(cells, shape, mean):
	O.reset()
	O.materials.append(ElastMat(young=YOUNG, poisson=POISSON, density=1, label='membrane'))
	cell = 48/cells
	mpm.fill(Trapezoid(0, 48 - cell/2), spacing=cell/2, thickness=1., material='membrane', bodies=False)
	edge = mpm.fill(Trapezoid(48 - cell/2, 48), spacing=cell/2, thickness=1., material='membrane')
	period = 40*48/(YOUNG/2/(1 + POISSON))**.5 # time for shear waves to run forty times across
	load = InterpolatingDirectedForceEngine(ids=edge, times=[0, 2/3*period], magnitudes=[0, LOAD/len(edge)], direction=(0, 1, 0), wrap=False)
	O.engines = [ForceResetter(), load, MpmEngine(cellSize=cell, shape=shape, analysis='planeStrain', largeStrain=False, damping=.3,
		meanDilatation=mean, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])]
	O.dt = .5*mpm.criticalTimeStep()
	O.run(int(period/O.dt), True)
	if cells == 24 and shape == 'cubic':
		draw(axes[0, int(mean)], mpm.array('position'), np.trace(mpm.array('stress'), axis1=1, axis2=2)/3, 12, (-.25, .25),
			xlabel='x', ylabel='y', title='mean stress, cubic, ' + ('mean dilatation' if mean else 'without remedy'))
	return np.mean([O.bodies[i].state.displ()[1] for i in edge])


for cells in 12, 24:
	for shape, mean in ALL:
		if cells == 24 and shape == 'linear' and not mean: continue # takes long to come to rest
		value = cook(cells, shape, mean)
		bound = (-.08, .02) if mean else (-.5, -.08)
		add("Cook's membrane, tip", cells, shape, mean, '%.5f' % value, value, DISPLACEMENT, bound)

# ---- strip footing --------------------------------------------------------------------------------------------------------

DEPTH, TIME = .004, 2.5 # half width, cohesion and density 1, E = 1e4: shear waves run ten times across in this time


def footing(cells, shape, mean):
	O.reset()
	cell = 1/cells
	O.materials.append(J2Mat(young=1e4, poisson=.3, density=1, yieldStress=3**.5, label='soil'))
	O.materials.append(ElastMat(young=1e4, poisson=.3, density=1, label='footing'))
	mpm.fill(((0, -2), (4, 0)), spacing=cell/2, thickness=1., material='soil', bodies=False)
	plate = [O.bodies[i].state for i in mpm.fill(((0, 0), (1, 4*cell)), spacing=cell/2, thickness=1., material='footing')]
	for state in plate: state.blockedDOFs = 'xyzXYZ'
	base = MpmWall(origin=(0, -2, 0), normal=(0, 1, 0), kind='fixed')
	O.engines = [MpmEngine(cellSize=cell, shape=shape, analysis='planeStrain', largeStrain=False, damping=.1, meanDilatation=mean,
		walls=[MpmWall(normal=(1, 0, 0), kind='slip'), MpmWall(origin=(4, 0, 0), normal=(-1, 0, 0), kind='slip'), base])]
	O.dt = .4*mpm.criticalTimeStep()
	steps = int(TIME/O.dt)
	curve = []

	def sample():
		speed = DEPTH/(.9*TIME)*min(1, O.time/(.2*TIME))
		for state in plate: state.vel = (0, -speed, 0)
		curve.append((-plate[0].displ()[1], -base.force[1]))
	runSampled(steps, max(1, steps//1000), sample)
	curve = np.array(curve)
	wave = len(curve)//50 # the base feels waves that go up and down
	return np.stack([np.convolve(column, np.ones(wave)/wave, 'valid') for column in curve.T])


LIMIT = 2 + np.pi
studies = [(8, *choice) for choice in ALL] + [(16, *choice) for choice in ALL] + [(32, 'linear', True)]
for cells, shape, mean in studies:
	depth, pressure = footing(cells, shape, mean)
	value = pressure.max()
	if shape == 'linear' and mean: bound = (0, {8: .05, 16: .03, 32: .02}[cells])
	elif mean: bound = (.03, .10)
	else: bound = (.05, .20)
	add('footing, limit pressure', cells, shape, mean, '%.3f' % value, value, LIMIT, bound)
	if cells >= 16: axes[1, 0].plot(100*depth, pressure, '-' if mean else '--', label='%s, %d cells%s' % (shape, cells, ', mean dilatation' if mean else ''))
axes[1, 0].axhline(LIMIT, color='k', linewidth=.8, label='2 + pi')
axes[1, 0].set(xlabel='settlement over half width [%]', ylabel='pressure over cohesion [-]', title='strip footing')
axes[1, 0].legend(fontsize=7)

# ---- Taylor's bar ---------------------------------------------------------------------------------------------------------

RADIUS, LENGTH, SPEED, END = 3.2e-3, 32.4e-3, 227., 80e-6


def taylor(cells, shape, mean):
	O.reset()
	cell = RADIUS/cells
	O.materials.append(J2Mat(young=117e9, poisson=.35, density=8930, yieldStress=400e6, isotropicModulus=100e6, label='copper'))
	mpm.fill(((0, 0), (RADIUS, LENGTH)), spacing=cell/2, material='copper', velocity=(0, -SPEED, 0), axisymmetric=True, bodies=False)
	O.engines = [MpmEngine(cellSize=cell, shape=shape, analysis='axisymmetric', meanDilatation=mean, walls=[MpmWall(normal=(0, 1, 0), kind='slip')])]
	O.trackEnergy = True
	O.dt = .25*mpm.criticalTimeStep()
	steps = int(END/O.dt) + 1
	O.dt = END/steps
	energies = []
	runSampled(steps, steps//100, lambda: energies.append(O.energy.total()))
	x, F = mpm.array('position'), mpm.array('F')
	length, foot = (1e3*(x[:, axis] + cell/4*F[:, axis, axis]).max() for axis in (1, 0))
	if cells == 8 and shape == 'linear':
		side = np.array([1 if mean else -1, 1])
		draw(axes[1, 1], 1e3*x[:, :2]*side, mpm.array('plasticStrain'), 5, (0, 2.5), xlabel='r [mm]', ylabel='z [mm]',
			title="Taylor's bar, linear: plastic strain\nwithout (left) and with mean dilatation (right)", ylim=(0, 10))
	return length, foot, abs(np.array(energies)/energies[0] - 1).max()


for cells in 4, 8:
	for shape, mean in ALL:
		length, foot, balance = taylor(cells, shape, mean)
		add("Taylor's bar, length [mm]", cells, shape, mean, '%.2f' % length, length, 21.45, (-.01, .01))
		add("Taylor's bar, foot [mm]", cells, shape, mean, '%.2f; energy %.1e' % (foot, balance), foot, 7.07, (-.03, .03) if mean else (-.06, .03))
		if not balance < 3e-3: sys.exit('FAIL: energies of the bar balance to %g only' % balance)
for axis in axes[0, 1], axes[1, 1]: figure.colorbar(axis.collections[0], ax=axis)
figure.savefig(os.path.join(FIGURES, 'locking.png'), dpi=100, bbox_inches='tight')
report.finish()
