# SPDX-License-Identifier: GPL-2.0-or-later
"""Damaged scenes: files.py SEED [COUNT].

A seed makes a small scene, saves it, and damages what this project's classes have saved in one to three places: a number, an entry more or less,
a count, a text, a whole element. The file is loaded, looked at, run and saved again. It may run, or end in an error; the error must be
one of Python's, and after it another scene must load and run.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import re
import shutil
import tempfile

from harness import main
from yade import *
from yade import mpm
from yade.wrapper import *

O = Omega()
numbers = ['-1', '0', '1', '7', '99999', '2147483647', '-2147483648', '4294967295', '1e308', '-1e308', 'nan', 'inf', '-inf', '1e-300', '', 'x', '9999999999999']


def saved(random, file):
	O.reset()
	O.materials.append(BoucWenMat(label='s', young=1e6, poisson=.3, density=1000, yieldStress=1e4, n=5, tangentRatio=.05))
	O.materials.append(DruckerPragerMat(label='c', young=1e6, poisson=.3, density=1000, internalFriction=.5))
	analysis = random.choice(['planeStress', 'planeStrain', 'axisymmetric', '3d'])
	size = 3 if analysis == '3d' else 2
	how = {} if analysis == '3d' else {'axisymmetric': True} if analysis == 'axisymmetric' else {'thickness': .1}
	for label, at, bodies in ('s', 0, True), ('c', 1.5, False):
		low = [.25, at, 0][:size]
		mpm.fill((low, [x + .5 for x in low]), spacing=.25, material=label, velocity=(0, -3, 0), bodies=bodies, **how)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.5, analysis=analysis, largestGap=random.choice([2, float('inf')]), timeStepSafety=random.choice([0, .3]), walls=[MpmWall(normal=(0, 1, 0), kind=random.choice(['fixed', 'slip', 'friction']))]),
		MpmVtkRecorder(fileName=file + '-', iterPeriod=5, recorders=['id', 'grid'])]
	O.trackEnergy = random.random() < .5
	O.dt = 1e-6
	O.dt = .3*mpm.criticalTimeStep()
	steps = random.choice([0, 1, 15])
	if steps: O.run(steps, True)  # YADE takes 0 for no end
	O.save(file)
	return open(file).read()


def damaged(random, text):
	"""The text with one place of ours changed, and what was done."""
	parts = [(m.start(), m.end()) for m in re.finditer(r'<points class_id.*?</densities>|<savedBy>.*?</walls>|<MpmVtkRecorder.*?</gridTimes>', text, re.S)]
	if not parts: return text, 'nothing'
	begin, end = random.choice(parts)
	part = text[begin:end]
	how = random.choice(['number', 'number', 'number', 'entry gone', 'entry twice', 'count', 'element gone', 'bytes', 'list empty'])
	if how == 'number': places = list(re.finditer(r'(?<=>)[^<>\s][^<>]*(?=<)', part))
	elif how in ('entry gone', 'entry twice'): places = list(re.finditer(r'<item>[^<]*</item>\s*', part))
	elif how == 'count': places = list(re.finditer(r'(?<=<count>)\d+(?=<)', part))
	elif how == 'element gone': places = list(re.finditer(r'<(\w+)>[^<]*</\1>\s*', part))
	elif how == 'list empty': places = list(re.finditer(r'<count>\d+</count>\s*<item_version>0</item_version>(\s*<item>[^<]*</item>)+', part))
	else: places = [re.compile(r'.', re.S).match(part, random.randrange(len(part)))]
	if not places: return text, how + ': no place'
	m = random.choice(places)
	put = {'number': random.choice(numbers), 'entry gone': '', 'entry twice': 2*m.group(0), 'count': random.choice(['0', '1', '3', '1000000', '4294967295']), 'element gone': '',
		'list empty': '<count>0</count><item_version>0</item_version>', 'bytes': chr(random.randrange(32, 127))}[how]
	line = part[:m.start()].rsplit('\n', 1)[-1][-40:]
	return text[:begin] + part[:m.start()] + put + part[m.end():] + text[end:], '%s %r -> %r after %r' % (how, m.group(0)[:40], put[:40], line)


def case(random):
	folder = tempfile.mkdtemp(prefix='fuzz-')
	try:
		file = os.path.join(folder, 'scene.xml')
		text = saved(random, file)
		whole, what = text, []
		for _ in range(random.choice([1, 1, 2, 3])):
			text, did = damaged(random, text)
			what.append(did)
		if random.random() < .05: text = text[:random.randrange(len(text))]
		with open(file, 'w') as f: f.write(text)
		try:
			O.load(file)
			for name in 'id', 'material', 'position', 'velocity', 'stress', 'strain', 'F', 'plasticStrain', 'backStress', 'volume', 'mass', 'displacement', 'dissipation': mpm.array(name)
			for body in O.bodies: body.state.stress, body.state.plasticStrain
			O.run(20, True)
			mpm.fill(((5, 5, 0), (5.5, 5.5, .5)) if grid().analysis == '3d' else ((5, 5), (5.5, 5.5)), spacing=.25, material=0, bodies=False,
				**({} if grid().analysis == '3d' else {'axisymmetric': True} if grid().analysis == 'axisymmetric' else {'thickness': .1}))
			O.run(2, True)
			O.save(file + '.again.xml')
		except Exception as fault:
			if not str(fault) and not isinstance(fault, MemoryError): return '%s: an error without a word, %r' % ('; '.join(what), fault)
		with open(file, 'w') as f: f.write(whole)  # the program goes on
		try:
			O.load(file)
			shutil.rmtree(folder, ignore_errors=True), os.mkdir(folder)
			O.run(2, True)
		except Exception as fault: return '%s: and then the whole scene fails: %s' % ('; '.join(what), fault)
	finally: shutil.rmtree(folder, ignore_errors=True)


def grid(): return [e for e in O.engines if isinstance(e, MpmEngine)][0]


main(case)
