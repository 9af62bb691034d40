# SPDX-License-Identifier: GPL-2.0-or-later
"""Bad values of every attribute and argument: attributes.py SEED [COUNT].

A seed picks a class or function of the Python face, one of its attributes or arguments, and a value that it is not meant to have: None, a
string, NaN, infinities, negative, zero, huge, tiny, a wrong shape, a whole number beyond 32 and 64 bits. The value is given before the first
step or in mid-run. It may be refused, at once or by the step, by a complaint that names object, attribute and remedy, or take effect: then
the scene runs, without NaN. It may be of the wrong type altogether; then the assignment refuses it.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
import inspect
import tempfile

import numpy
from harness import complaint, main
from yade import *
from yade import mpm
from yade.wrapper import *

O = Omega()
nan, inf = float('nan'), float('inf')
values = [None, 'abc', '', nan, inf, -inf, -1, 0, 1e300, -1e300, 1e-300, 2**31, 2**40, 2**70, True, (), [], {}, (1,), (1, 2, 3), (nan, 0, 0), (0, inf, 0), (1e300, 0, 0), [None], ['abc'],
	[[1, 2], [3, 4]], ((0, 0), (1, 1)), ((0, 0, 0), (1, 1, 1)), ((0, 0), (nan, 1)), ((1, 1), (0, 0)), numpy.zeros((2, 2)), numpy.full((3, 3, 3), nan), object(), lambda *a: 1, -5, 200000, 'xyz', b'abc', 1j]


def scene(material, analysis='planeStress', **how):
	O.reset()
	O.materials.append(material)
	flat = {} if analysis == '3d' else {'thickness': .1}
	size = 3 if analysis == '3d' else 2
	ids = mpm.fill(((0,)*size, (.5,)*size), spacing=.25, material=0, velocity=(0, -1, 0), **flat)
	engine = MpmEngine(cellSize=.5, analysis=analysis, walls=[MpmWall(normal=(0, 1, 0), origin=(0, -.02, 0), kind='friction', friction=.2), MpmWall(normal=(1, 0, 0), kind='slip')], **how)
	recorder = MpmVtkRecorder(fileName=os.path.join(tempfile.mkdtemp(prefix='fuzz-', dir='/tmp'), 'a-'), iterPeriod=1, recorders=['velocity', 'grid'])
	O.engines = [ForceResetter(), engine, recorder]
	O.dt = 1e-6
	O.dt = .3*mpm.criticalTimeStep()
	return ids, engine, recorder


materials = dict(boucWen=lambda: BoucWenMat(young=1e6, poisson=.3, density=1000, yieldStress=1e4, n=3, tangentRatio=.05, label='m'), j2=lambda: J2Mat(young=1e6, poisson=.3, density=1000, yieldStress=1e4, label='m'),
	cone=lambda: DruckerPragerMat(young=1e6, poisson=.3, density=1000, internalFriction=.5, cohesion=1e3, label='m'), pyramid=lambda: MohrCoulombMat(young=1e6, poisson=.3, density=1000, internalFriction=.5, cohesion=1e3, tensionCutoff=500, label='m'),
	elastic=lambda: FrictMat(young=1e6, poisson=.3, density=1000, label='m'))
yade_own = {'label', 'id', 'dict', 'dead', 'initRun', 'realPeriod', 'virtPeriod', 'iterPeriod', 'nDo', 'nDone', 'firstIterRun', 'virtLast', 'realLast', 'iterLast', 'frictionAngle'}  # YADE's, which takes anything


def attributes(thing):
	return sorted(name for name in thing.dict() if name not in yade_own)


def functions():
	"""Calls of the functions of mpm with one argument replaced: name, call(value)."""
	region = ((0, 0), (.5, .5))
	fill = dict(region=region, spacing=.25, material=0, thickness=.1, velocity=(0, 0, 0), bodies=True)
	drive = dict(material=0, strain=numpy.zeros((4, 3, 3)), free=())
	calls = [('fill', mpm.fill, fill), ('drive', mpm.drive, drive), ('array', mpm.array, dict(name='stress')), ('color', mpm.color, dict(quantity='vonMises', limits=None, colormap='viridis')), ('readStl', mpm.readStl, dict(file='none.stl'))]
	for name, call, arguments in calls:
		for argument in sorted(set(arguments) | set(inspect.signature(call).parameters)):
			yield 'mpm.%s' % name, argument, lambda value, call=call, arguments=arguments, argument=argument: call(**dict(arguments, **{argument: value}))


def case(random):
	kind = random.choice(['boucWen', 'j2', 'cone', 'elastic'])
	ids, engine, recorder = scene(materials[kind](), analysis=random.choice(['planeStress', 'planeStrain', '3d']))
	if random.random() < .5: O.run(3, True)
	material, wall, state = O.materials[0], engine.walls[0], O.bodies[ids[1]].state
	targets = [(type(thing).__name__, name, lambda value, thing=thing, name=name: setattr(thing, name, value)) for thing in (engine, wall, recorder, material) for name in attributes(thing)]
	targets += [('MpmState', name, lambda value, name=name: setattr(state, name, value)) for name in ('pos', 'vel', 'mass', 'blockedDOFs')]
	targets += [('O', name, lambda value, name=name: setattr(O, name, value)) for name in ('dt',)]
	targets += list(functions())*2
	who, name, give = random.choice(targets)
	value = random.choice(values)
	said = '%s.%s = %r' % (who, name, value)
	try: give(value)
	except (RuntimeError, ValueError, TypeError, KeyError, MemoryError, OverflowError, AttributeError, IndexError, FileNotFoundError, PermissionError) as fault:
		if who == 'O': return  # YADE's own check, of YADE's own attribute
		if who.startswith('mpm.'):
			lacks = complaint(fault) if not isinstance(fault, (AttributeError, OverflowError, IndexError)) else 'refused by a %s: %s' % (type(fault).__name__, fault)
			if lacks or who not in str(fault): return '%s: %s' % (said, lacks or 'the complaint does not name the function: %s' % fault)
		elif not isinstance(fault, (TypeError, AttributeError, OverflowError)) and (complaint(fault) or name not in str(fault)): return '%s: %s' % (said, complaint(fault) or 'the complaint does not name the attribute: %s' % fault)
		return
	try: O.run(3, True)
	except (RuntimeError, ValueError, TypeError) as fault:
		lacks = complaint(fault)
		if lacks: return '%s: %s' % (said, lacks)
		if who.startswith('mpm.') or name in str(fault) or 'material point' in str(fault) or 'O.dt' in str(fault): return
		return '%s: the complaint does not name the attribute: %s' % (said, fault)
	for quantity in 'position', 'velocity', 'stress', 'F', 'mass', 'volume':
		if not numpy.isfinite(mpm.array(quantity)).all(): return '%s: NaN in %s, silently' % (said, quantity)


main(case)
