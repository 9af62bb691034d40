# SPDX-License-Identifier: GPL-2.0-or-later
"""A retaining wall is pushed into sand and away from it: passive and active earth pressure against Coulomb's.

    scripts/yade-mpm -n -x scripts/examples/retaining_wall.py [out] [--points 24] [--friction 10]

Plane strain. Sand (Mohr-Coulomb, phi = 30 deg, psi = 10 deg, 16 kN/m3) is 1 m high behind a wall
of YADE, which a TranslationEngine moves. Sand and wall touch by Cundall and Strack's law with a wall friction
of --friction degrees. --points is the number of material points over the height. The force on the wall is
compared with Rankine's (smooth wall) and Coulomb's (with wall friction): 4 % above Coulomb's passive and 3 %
below his active pressure, half a minute each. Writes retaining_wall.csv and .png.

The base matters more than anything else here. It has friction 0.577, that of the sand itself. On a fixed base the
passive force is 70 % above Coulomb's, because the sand sticks to it; on a smooth one the sand slides off as a block.
"""
import argparse
import csv
import math
import os
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm
from yade import *

HEIGHT, LENGTH, WEIGHT, PHI, PSI = 1., 3., 16e3, math.radians(30), math.radians(10)


def coulomb(friction, passive):
	"""Horizontal part of Coulomb's coefficient of earth pressure, vertical wall and level ground; friction 0 is Rankine's."""
	sign = 1 if passive else -1
	root = math.sqrt(math.sin(PHI + friction)*math.sin(PHI)/math.cos(friction))
	return (math.cos(PHI)/(1 - sign*root))**2


def push(points, friction, passive):
	"""Displacement of the wall [m] and horizontal force on it [N], and the points at the end: position, plastic strain."""
	O.reset()
	spacing = HEIGHT/points
	depth = spacing # contacts as stiff as the sand behind them
	O.materials.append(MohrCoulombMat(label='sand', young=5e6, poisson=.3, density=WEIGHT/10, internalFriction=PHI, dilatancy=PSI, cohesion=20, frictionAngle=friction))
	O.materials.append(FrictMat(label='concrete', young=5e6, poisson=.3, density=2500, frictionAngle=friction))
	rest = lambda x: np.diag([.5, 1, .5])*WEIGHT*(x[1] - HEIGHT)
	sand = mpm.fill(((0, 0), (LENGTH, HEIGHT)), spacing=spacing, thickness=depth, material='sand', stress=rest)
	plate = O.bodies.append(wall((0, 0, 0), axis=0, material='concrete'))
	duration, travel = (4., .04) if passive else (2., .005)
	move = TranslationEngine(ids=[plate], translationAxis=(1 if passive else -1, 0, 0), velocity=0)
	grid = MpmEngine(cellSize=2*spacing, analysis='planeStrain', gravity=(0, -10, 0), damping=.1, timeStepSafety=.4,
		walls=[MpmWall(normal=(0, 1, 0), kind='friction', friction=.577), MpmWall(origin=(LENGTH, 0, 0), normal=(-1, 0, 0), kind='slip')])
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=.3*spacing),
		InteractionLoop([Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		GlobalStiffnessTimeStepper(timestepSafetyCoefficient=.6),
		move,
		grid,
		NewtonIntegrator(),
	]
	rows = []
	samples = 100
	for k in range(samples):
		O.stopAtTime = duration*(k + 1)/samples
		move.velocity = travel/(.9*duration)*min(1, (k + .5)/(.2*samples))
		O.run()
		O.wait()
		rows.append([O.bodies[plate].state.pos[0], -O.forces.f(plate)[0]/depth])
	return np.array(rows), mpm.array('position'), mpm.array('plasticStrain')


def main():
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('out', nargs='?', default='out', help='folder for results')
	parser.add_argument('--points', type=int, default=24, help='material points over the height')
	parser.add_argument('--friction', type=float, default=10, help='angle of wall friction [deg]')
	options = parser.parse_args(sys.argv[1:])
	os.makedirs(options.out, exist_ok=True)
	friction, unit = math.radians(options.friction), .5*WEIGHT*HEIGHT**2

	figure, axes = plt.subplots(2, 2, figsize=(12, 6), width_ratios=(1, 1.6), layout='constrained')
	table = []
	for row, passive in zip(axes, (True, False)):
		name = 'passive' if passive else 'active'
		curve, x, strain = push(options.points, friction, passive)
		moved, force = curve.T
		value = force[-20:].mean()/unit
		rankine, wedge = coulomb(0, passive), coulomb(friction, passive)
		print('%s: horizontal force over gamma H2/2 = %.3f; Coulomb %.3f, Rankine %.3f' % (name, value, wedge, rankine), flush=True)
		table += [[name, *entry, wedge, rankine] for entry in zip(moved, force/unit)]
		row[0].plot(1e3*np.abs(moved), force/unit, label='yade-mpm')
		row[0].axhline(wedge, color='k', lw=.8, label='Coulomb, wall friction %g deg' % options.friction)
		row[0].axhline(rankine, color='k', lw=.8, ls=':', label='Rankine, smooth wall')
		row[0].set(xlabel='displacement of the wall [mm]', ylabel='force over gamma H2/2 [-]', title='%s pressure' % name, ylim=(0, None))
		row[0].legend()
		dots = row[1].scatter(x[:, 0], x[:, 1], c=100*strain, s=6*(32/options.points)**2, cmap='viridis', vmin=0, vmax=np.quantile(100*strain, .98), linewidths=0)
		row[1].axvline(moved[-1], color='.4', lw=3)
		row[1].set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title='plastic strain [%]')
		figure.colorbar(dots, ax=row[1], shrink=.8)
	with open(os.path.join(options.out, 'retaining_wall.csv'), 'w', newline='') as f:
		csv.writer(f).writerows([['case', 'displacement_m', 'coefficient', 'coulomb', 'rankine']] + table)
	figure.savefig(os.path.join(options.out, 'retaining_wall.png'), dpi=120)
	print('results in %s' % os.path.abspath(options.out))


main()
