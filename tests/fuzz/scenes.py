# SPDX-License-Identifier: GPL-2.0-or-later
"""Random scenes through the Python face: scenes.py SEED [COUNT].

A seed makes a scene and a list of things that happen to it: runs, edits, queries. They happen four times: as they stand; with the scene
saved and loaded between any two of them, at random; with two threads; with queries of everything. All four must go through the same
states, bit for bit, and end at the same step with the same complaint, if with any. Beside that: no NaN, the momentum of a scene that
nothing acts on to 1e-12, a complaint that names an object and a remedy.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import math
import random

import numpy
from harness import complaint, main
from yade import *
from yade import mpm
from yade.wrapper import *

O = Omega()
names = 'id', 'position', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain'


def material(random, label):
	young = 10**random.uniform(5, 7)
	common = dict(label=label, young=young, poisson=random.choice([0, .2, .3, .45]), density=10**random.uniform(2.7, 3.5), frictionAngle=.5)
	kind = random.choice(['elastic', 'elastic', 'boucWen', 'j2', 'cone', 'pyramid'])
	if kind == 'boucWen': return BoucWenMat(yieldStress=young*random.choice([.01, .1]), n=random.choice([2, 3.5, 10]), tangentRatio=random.choice([0, .05]),
		saturationStress=random.choice([0, .001*young]), saturationRate=5, **common)
	if kind == 'j2': return J2Mat(yieldStress=young*random.choice([.01, .1]), tangentRatio=random.choice([0, .05]), isotropicModulus=random.choice([0, .01*young]), **common)
	if kind == 'cone': return DruckerPragerMat(cohesion=young*random.choice([0, .01]), internalFriction=.5, dilatancy=random.choice([0, .2]), **common)
	if kind == 'pyramid': return MohrCoulombMat(cohesion=young*.01, internalFriction=.5, dilatancy=random.choice([0, .2]), tensionCutoff=random.choice([0, .005*young, float('inf')]), **common)
	return FrictMat(**common)


class Scene:
	def __init__(self, random):
		self.seed = random.random()
		self.analysis = random.choice(['planeStress', 'planeStrain', 'axisymmetric', '3d'])
		self.solid, self.ring = self.analysis == '3d', self.analysis == 'axisymmetric'
		self.dim = 3 if self.solid else 2
		self.bodies = random.random() < .7
		self.contacts = self.solid and self.bodies and random.random() < .5
		self.steps = 0

	def vector(self, random, size):
		v = [random.uniform(-size, size) for _ in range(3)]
		if self.dim == 2: v[2] = 0
		if self.ring: v[0] = 0
		return tuple(v)

	def fill(self, random, label, at=0.):
		size = [random.choice([1, 2, 3])*.25 for _ in range(self.dim)]
		low = [.5 if self.ring and d == 0 else at if d == 1 else 0. for d in range(self.dim)]
		region = tuple(low), tuple(l + s for l, s in zip(low, size))
		how = {} if self.solid else {'axisymmetric': True} if self.ring else {'thickness': .1}
		return mpm.fill(region, spacing=.25 if not self.solid else .25, material=label, velocity=self.vector(random, random.choice([0, 1, 5])), bodies=self.bodies, **how)

	def engine(self, random):
		plane = self.analysis == 'planeStress'
		how = dict(cellSize=random.choice([.3, .5, .6]), analysis=self.analysis, shape=random.choice(['linear', 'gimp', 'quadratic', 'cubic', 'cubic']),
			scheme=random.choice(['USF', 'USL', 'MUSL', 'MUSL', 'MUSL']), flip=random.choice([1, 1, 1, .9, 0]), damping=random.choice([0, 0, .1]),
			largeStrain=random.random() < .8, largestGap=random.choice([2, float('inf')]), timeStepSafety=random.choice([0, 0, .4]))
		how['thinning'] = plane and how['largeStrain'] and random.random() < .3
		how['meanDilatation'] = not plane and random.random() < .3
		how['fullMass'] = how['scheme'] == 'MUSL' and random.random() < .3
		how['filterTime'] = random.choice([0, 0, 0, 1e-2])
		if random.random() < .5: how['gravity'] = (0, -10, 0)
		how['walls'] = []
		for axis in range(1 if self.ring else 0, self.dim):
			for side in 1, -1:
				if random.random() > .3: continue
				normal, origin = [0]*3, [0]*3
				normal[axis], origin[axis] = side, -.1*side if side > 0 else 3.
				kind = random.choice(['fixed', 'slip', 'friction'])
				wall = MpmWall(normal=tuple(normal), origin=tuple(origin), kind=kind)
				if kind == 'friction': wall.friction = random.choice([0, .3])
				if random.random() < .3: wall.velocity = tuple(.5*n for n in normal)
				how['walls'].append(wall)
		return MpmEngine(**how)

	def build(self, threads):
		"""The scene, from its own seed."""
		r = random.Random(self.seed)
		O.reset()
		for label in 'ab': O.materials.append(material(r, label))
		self.fill(r, 'a')
		if r.random() < .4: self.fill(r, 'b', at=1.)
		engine = self.engine(r)
		engine.ompThreads = threads
		others = [InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()], loopOnSortedInteractions=True)] if self.contacts else []
		O.engines = [ForceResetter()] + others + [engine] + ([NewtonIntegrator()] if self.contacts else [])
		if self.contacts:
			O.materials.append(FrictMat(label='grain', young=1e6, poisson=.3, density=2000, frictionAngle=.4))
			O.bodies.append(utils.sphere((.2, -.18, .2), .2, material='grain'))
		O.trackEnergy = r.random() < .5
		O.dt = 1e-6
		O.dt = r.choice([.3, .6, .95])*mpm.criticalTimeStep()*(.2 if self.contacts else 1)
		self.free = not engine.walls and engine.gravity == Vector3(0, 0, 0) and not self.contacts and engine.damping == 0 and not self.ring


def grid(): return [e for e in O.engines if isinstance(e, MpmEngine)][0]


def point(random, ids):
	left = [i for i in ids if i >= 0 and i < len(O.bodies) and O.bodies[i] is not None and isinstance(O.bodies[i].state, MpmState)]
	return O.bodies[random.choice(left)] if left else None


def edit(scene, r):
	"""One thing that a script may do between two steps. It leaves scene.free where momentum still has to stay."""
	kinds = ['cellSize', 'shape', 'scheme', 'flip', 'gravity', 'young', 'density', 'walls', 'fill', 'gap', 'energy', 'safety', 'filter', 'damping']
	if scene.bodies: kinds += ['velocity', 'move', 'erase', 'block', 'force', 'mass', 'material', 'velocity']
	kind = r.choice(kinds)
	engine, ids, body = grid(), mpm.array('id').tolist(), None
	if kind in ('velocity', 'move', 'erase', 'block', 'force', 'mass', 'material'):
		body = point(r, ids)
		if body is None: return kind
	value = r.random()
	if kind == 'cellSize': engine.cellSize = r.choice([.3, .4, .6])
	if kind == 'shape': engine.shape = r.choice(['linear', 'quadratic', 'cubic'])
	if kind == 'scheme': engine.scheme, engine.fullMass = r.choice(['USF', 'USL', 'MUSL']), False
	if kind == 'flip': engine.flip = r.choice([1, .5, 0])
	if kind == 'damping': engine.damping, scene.free = r.choice([0, .2]), False
	if kind == 'gravity': engine.gravity, scene.free = (0, r.choice([0, -20]), 0), False
	if kind == 'young': O.materials['ab'[r.randrange(2)]].young *= r.choice([.5, 1.5])
	if kind == 'density': O.materials['a'].density *= r.choice([.5, 2]); scene.free = False
	if kind == 'gap': engine.largestGap = r.choice([1, 2, float('inf')])
	if kind == 'energy': O.trackEnergy = not O.trackEnergy
	if kind == 'safety': engine.timeStepSafety = r.choice([0, .3, .5])
	if kind == 'filter': engine.filterTime = r.choice([0, 1e-3])
	if kind == 'walls' and engine.walls:
		wall = r.choice(engine.walls)
		if value < .4: wall.origin = tuple(x + .02*n for x, n in zip(wall.origin, wall.normal))
		elif value < .7: wall.velocity = (0, 0, 0)
		else: wall.kind, wall.friction = r.choice(['fixed', 'slip']), 0
	if kind == 'fill': scene.fill(r, r.choice('ab'), at=r.choice([1.5, 2.])); scene.free = False
	if kind == 'velocity': body.state.vel = scene.vector(r, 2); scene.free = False
	if kind == 'move': body.state.pos += Vector3(*scene.vector(r, .01)); scene.free = False
	if kind == 'erase': O.bodies.erase(body.id); scene.free = False
	if kind == 'block': body.state.blockedDOFs = r.choice(['', 'x', 'xy']); scene.free = False
	if kind == 'force': O.forces.setPermF(body.id, scene.vector(r, 10)); scene.free = False
	if kind == 'mass': body.state.mass *= r.choice([.5, 2]); scene.free = False
	if kind == 'material': body.mat = O.materials['ab'[r.randrange(2)]]; scene.free = False
	return kind


def look(): return {name: mpm.array(name) for name in names}


def momentum(): return mpm.array('mass') @ mpm.array('velocity'), mpm.array('mass') @ abs(mpm.array('velocity'))


def live(scene, seed, threads=1, save=False, query=False):
	"""All states that the scene goes through, the complaint that it ends with, and a fault of its own."""
	r, other = random.Random(seed), random.Random(seed + 1)
	states, log = [], []
	try:
		scene.build(threads)
		for _ in range(r.randrange(2, 7)):
			if r.random() < .6: log.append(edit(scene, r))
			if save and other.random() < .5:
				O.saveTmp(), O.loadTmp()
				grid().ompThreads = threads
				log.append('saved and loaded')
			if query and other.random() < .5: look(), mpm.criticalTimeStep()
			before = momentum()
			O.run(r.choice([1, 2, 10, 30]), True)
			after = momentum()
			states.append(dict(look(), step=O.iter, time=O.time, dt=O.dt, energies=sorted(O.energy.items()) if O.trackEnergy else 0))
			for name in names:
				if not numpy.isfinite(states[-1][name]).all(): return states, '', 'NaN in %s after %s' % (name, log)
			if scene.free and abs(after[0] - before[0]).max() > 1e-12*max(1e-3, after[1].max()): return states, '', 'momentum off by %s of %s after %s' % (after[0] - before[0], after[1], log)
	except (RuntimeError, ValueError, KeyError, TypeError) as fault: return states, '%s at step %d' % (fault, O.iter), complaint(fault)
	return states, '', ''


def differ(one, two):
	for k, (a, b) in enumerate(zip(one, two)):
		for name in a:
			if name in names:
				if a[name].shape != b[name].shape or not (a[name] == b[name]).all(): return 'part %d: %s differs by %s' % (k, name, abs(a[name] - b[name]).max() if a[name].shape == b[name].shape else 'its shape')
			elif repr(a[name]) != repr(b[name]):  # YADE's own elastPotential is NaN where a contact has no tangential stiffness
				return 'part %d: %s is %s instead of %s' % (k, name, b[name], a[name])
	return '' if len(one) == len(two) else '%d parts instead of %d' % (len(two), len(one))


def case(random):
	scene, seed = Scene(random), random.randrange(1 << 30)
	states, end, fault = live(scene, seed)
	if fault: return fault
	for what, how in ('saved and loaded', dict(save=True)), ('with two threads', dict(threads=2)), ('queried', dict(query=True)):
		again, ended, fault = live(scene, seed, **how)
		fault = fault or differ(states, again) or ('' if end == ended else 'it ends with %r instead of %r' % (ended, end))
		if fault: return '%s: %s' % (what, fault)


main(case)
