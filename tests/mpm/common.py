# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests in this folder share: the checks of tests/yade/check.py, small scenes, a second YADE."""
import csv
import os
import subprocess
import sys
import tempfile

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')  # before yade brings a __file__ of its own
sys.path.insert(0, os.path.join(root, 'tests', 'yade'))

import numpy
from check import check, equal, finish, raises
from yade import *
from yade import mpm
from yade.wrapper import *

O = Omega()


def near(what, found, wanted, tolerance):
	"""Every component within an absolute tolerance; NaN fails."""
	found, wanted = numpy.asarray(found, dtype=float), numpy.asarray(wanted, dtype=float)
	if found.shape != wanted.shape: check(what, False, 'shape %s, wanted %s' % (found.shape, wanted.shape))
	else:
		error = numpy.abs(found - wanted).max() if found.size else 0
		check(what, error <= tolerance, 'off by %.3g, admitted %.3g; found %s, wanted %s' % (error, tolerance, found.ravel()[:6], wanted.ravel()[:6]))


def same(what, found, wanted):
	"""Every bit of two arrays."""
	found, wanted = numpy.asarray(found), numpy.asarray(wanted)
	if found.shape != wanted.shape: check(what, False, 'shape %s, wanted %s' % (found.shape, wanted.shape))
	else: check(what, (found == wanted).all(), 'off by up to %.3g' % numpy.abs(found - wanted).max())


def elastic(young=1e6, poisson=.3, density=1000., label='elastic'):
	material = FrictMat(young=young, poisson=poisson, density=density, frictionAngle=.5, label=label)
	O.materials.append(material)
	return material


def block(region=((0, 0), (1, 1)), spacing=.25, thickness=.1, material=None, velocity=(0, 0, 0), bodies=True, courant=.4, axisymmetric=False, before=(), after=(), **engine):
	"""An empty scene but for a block of material points and the engines before, MpmEngine and after. Returns ids and engine."""
	O.reset()
	if isinstance(material, Material): O.materials.append(material)
	ids = mpm.fill(region, spacing=spacing, thickness=thickness, material=material or elastic(), velocity=velocity, bodies=bodies, axisymmetric=axisymmetric)
	engine.setdefault('cellSize', 2*spacing)
	grid = MpmEngine(**engine)
	O.engines = [ForceResetter()] + list(before) + [grid] + list(after)
	if courant: O.dt = courant*mpm.criticalTimeStep()
	return ids, grid


def momentum():
	return mpm.array('mass') @ mpm.array('velocity')


def state():
	"""All that a scene's points are, by name."""
	return {name: mpm.array(name) for name in ('id', 'position', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'vonMises', 'angularVelocity')}


def each_step(call):
	"""Calls after every engine, each step, from the loop."""
	import __main__  # whose names PyRunner sees
	__main__.called = call
	O.engines = O.engines + [PyRunner(iterPeriod=1, initRun=True, command='called()')]


def example(name, *options):
	"""Runs one of scripts/examples, which leaves a table and a picture; its rows, numbers as numbers."""
	out = tempfile.mkdtemp()
	subprocess.run([os.path.join(root, 'scripts', 'yade-mpm'), '-n', '-x', os.path.join(root, 'scripts', 'examples', name + '.py'), out, *options],
		check=True, env=dict(os.environ, OMP_WAIT_POLICY='passive'))
	for suffix in '.csv', '.png': check('%s leaves %s' % (name, suffix), os.path.getsize(os.path.join(out, name + suffix)) > 1000)

	def number(text):
		try: return float(text)
		except ValueError: return text
	with open(os.path.join(out, name + '.csv')) as f: return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(f)]


def another(script, *arguments, threads=1):
	"""Runs a script of this folder in a new YADE; returns whether it ended well, and says what it printed if not."""
	command = [os.path.join(root, 'scripts', 'yade-mpm'), '-n', '-x', '-j%d' % threads, script] + [str(a) for a in arguments]
	done = subprocess.run(command, env=dict(os.environ, OMP_WAIT_POLICY='passive'), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
	if done.returncode: print(done.stdout)
	return done.returncode == 0
