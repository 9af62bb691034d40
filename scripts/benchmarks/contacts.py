# SPDX-License-Identifier: GPL-2.0-or-later
"""Rate of a scene of material points with grains on them, beside either alone, as CSV on the standard output.

    scripts/yade-mpm -n -x -j1 scripts/benchmarks/contacts.py [--points 100000] [--grains 10000] [--steps 20] [--sorted]

A layer of 3D points (elastic, ten deep, weightless) with a layer of spheres that rests on it, each on a point; all move along x at 1 m/s,
so that the collider has work to do. A scene has the engines
that it needs. Columns: scene, material points, grains, contacts, seconds a step (wall, and
processor time of all threads), steps a second, and bodies x steps a second; medians of five runs of --steps steps.
"""
import argparse
import statistics
import sys
import time

from yade import mpm
from yade import *

DEPTH, SPACING, SPEED, G = 10, .1, 1., 9.81


def scene(points, grains):
	O.reset()
	O.materials.append(FrictMat(young=1e7, poisson=.3, density=2000, frictionAngle=.5, label='m'))
	across = max(1, int(round((options.points/DEPTH)**.5)))*SPACING
	if points: mpm.fill(((0, 0, 0), (across, across, DEPTH*SPACING)), spacing=SPACING, material='m')
	side = max(1, int(round(options.grains**.5)))
	pitch = across/side
	radius = .499*SPACING # each on one point, with the overlap that its weight asks for
	ground = DEPTH*SPACING if points else 0
	if grains: O.bodies.append([sphere(((i + .5)*pitch, (j + .5)*pitch, ground + .9996*radius), radius, material='m') for i in range(side) for j in range(side)])
	if grains and not points: O.bodies.append(wall(0, axis=2, material='m'))
	grid = [MpmEngine(cellSize=2*SPACING, analysis='3d', walls=[MpmWall(normal=(0, 0, 1), kind='slip')])] if points else []
	contacts = [
		InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=.1*SPACING),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()],
			loopOnSortedInteractions=options.sorted),
	]
	newton = [NewtonIntegrator(damping=.2, gravity=(0, 0, -G))]
	O.engines = [ForceResetter()] + (contacts + grid + newton if grains else grid)
	for b in O.bodies:
		if not isinstance(b.shape, Wall): b.state.vel = (SPEED, 0, 0)
	O.dt = 2e-4
	O.run(30, True) # until the collider has found its stride


def measure(name, points, grains):
	scene(points, grains)
	walls, processors = [], []
	for repeat in range(5):
		wall, processor = time.perf_counter(), time.process_time()
		O.run(options.steps, True)
		walls.append((time.perf_counter() - wall)/options.steps)
		processors.append((time.process_time() - processor)/options.steps)
	count = len(mpm.array('id')) if points else 0
	contacts = sum(1 for i in O.interactions if i.isReal)
	spheres = sum(isinstance(b.shape, Sphere) for b in O.bodies) - count
	seconds = statistics.median(walls)
	print('%s,%d,%d,%d,%.4g,%.4g,%.4g,%.4g' % (name, count, spheres, contacts, seconds, statistics.median(processors), 1/seconds, (count + spheres)/seconds), flush=True)


parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
parser.add_argument('--points', type=int, default=100000)
parser.add_argument('--grains', type=int, default=10000)
parser.add_argument('--steps', type=int, default=20)
parser.add_argument('--sorted', action='store_true', help='loopOnSortedInteractions, with which a loaded scene goes on bit for bit')
options = parser.parse_args(sys.argv[1:])
print('scene,points,grains,contacts,wall_s,processor_s,steps_per_s,bodies_steps_per_s')
measure('points alone', True, False)
measure('grains alone', False, True)
measure('both', True, True)
