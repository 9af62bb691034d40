# SPDX-License-Identifier: GPL-2.0-or-later
"""Loading: a scene of another version and a damaged one are refused in one sentence, and the program goes on; a scene that is loaded and
then changed takes the same steps as one that was changed without loading, bit for bit.
"""
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

folder = tempfile.TemporaryDirectory()
path = lambda name: os.path.join(folder.name, name)


def scene():
	O.reset()
	O.materials.append(BoucWenMat(label='steel', young=1e6, poisson=.3, density=1000, yieldStress=1e4, n=5, tangentRatio=.05))
	mpm.fill(((0, 0), (1, 1)), spacing=.25, thickness=.1, material='steel', velocity=(0, -3, 0))
	mpm.fill(((0, 1.5), (.5, 2)), spacing=.25, thickness=.1, material=elastic(), bodies=False)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.5, walls=[MpmWall(normal=(0, 1, 0))]), MpmVtkRecorder(fileName=path('a-'), iterPeriod=10, recorders=['id'])]
	O.dt = .4*mpm.criticalTimeStep()
	O.run(30, True)
	O.save(path('good.xml'))
	return open(path('good.xml')).read()


def load(text):
	with open(path('bad.xml'), 'w') as file: file.write(text)
	O.load(path('bad.xml'))


def message(call):
	try: call()
	except Exception as fault: return '%s: %s' % (type(fault).__name__, fault)
	return ''


good = scene()
right = state()

# ---- versions --------------------------------------------------------------------------------------------------------------
here = mpm.__version__
major, minor, patch = here.split('.')
check('a saved scene holds the version', good.count('<version>yade-mpm %s</version>' % here) >= 2)
load(good.replace('yade-mpm ' + here, 'yade-mpm %s.%s.%d' % (major, minor, int(patch) + 7)))
same('a scene of another patch release loads', state()['position'], right['position'])
for version in '%d.0.0' % (int(major) + 1), '%s.%d.0' % (major, int(minor) + 1), '0.1.0', '':
	said = message(lambda: load(good.replace('yade-mpm ' + here, 'yade-mpm ' + version)))
	check('a scene of version %r is refused in one sentence' % version, 'saved by yade-mpm ' + version in said and here in said and 'load it with that version' in said and '\n' not in said, said)
said = message(lambda: load(re.sub(r'<savedBy>\s*<version>[^<]*</version>\s*</savedBy>', '', good)))
check('a scene from before there were versions', 'saved by yade-mpm before 1.0.0' in said and 'load it with that version' in said, said)

# ---- damage: every column, shorter, longer, empty; indices; the program goes on ----------------------------------------------
begin = re.search('<points class_id[^>]*>', good).start()


def column(tag, start=begin, end=None):
	"""Where the first list of numbers of <tag> lies, and its numbers."""
	m = re.compile('<%s(?: [^>]*)?>' % tag).search(good, start)
	if not m: return None
	close = good.index('</%s>' % tag, m.end())
	n = re.compile(r'<count>(\d+)</count>\s*<item_version>0</item_version>((?:\s*<item>[^<]*</item>)+)').search(good, m.end(), close)
	return (n.start(), n.end(), re.findall('<item>([^<]*)</item>', n.group(2))) if n else None


def put(where, numbers):
	return good[:where[0]] + '<count>%d</count><item_version>0</item_version>' % len(numbers) + ''.join('<item>%s</item>' % n for n in numbers) + good[where[1]:]


def refused(what, text, *parts):
	said = message(lambda: load(text))
	check('%s: refused, by name' % what, all(part in said for part in parts + ('the saved scene is damaged', 'load another copy')) and '\n' not in said, said or 'loaded')
	check('%s: the program goes on' % what, len(O.bodies) == 0 and O.iter == 0)


for tag in 'id', 'material', 'mass', 'volume0', 'size', 'thickness', 'position', 'velocity', 'stress', 'internal', 'deformation':
	where = column(tag)
	name = 'MpmPoints.' + ('material' if tag == 'id' else tag)
	for how, numbers in ('empty', []), ('shorter', where[2][:-1]), ('longer', where[2] + where[2][-1:]):
		refused('%s %s' % (tag, how), put(where, numbers), name, 'for %d points' % len(numbers) if tag == 'id' else 'points')
for tag, values in ('material', ('-1', '2', '99999')), ('id', ('1', '-2147483648')):
	for value in values:
		where = column(tag)
		if value == '-2147483648': refused('id %s' % value, put(where, where[2][:-1] + [value]), 'nextBodyless')
		else: refused('%s %s' % (tag, value), put(where, [value] + where[2][1:]), 'MpmPoints.', 'material of point' if tag == 'material' else 'two points have the id 1')
start = good.index('<continuity')
for tag, bound in ('ids', None), ('neighbours', 20), ('dX', None), ('footings', 20), ('walls', 1), ('depths', None):
	where = column(tag, good.index('<' + tag, start))
	refused('continuity.%s longer' % tag, put(where, where[2] + where[2][-1:]), 'MpmPoints.continuity.')
	if bound: refused('continuity.%s out of range' % tag, put(where, ['99999'] + where[2][1:]), 'MpmPoints.continuity.' + tag, '99999')
refused('nextBodyless', re.sub('<nextBodyless>[^<]*<', '<nextBodyless>3<', good), 'MpmPoints.nextBodyless = 3')
refused('untilLook', re.sub('<untilLook>[^<]*<', '<untilLook>1000000000000<', good), 'MpmEngine.untilLook')
where = column('times', good.index('<times'))
refused('times of the recorder', put(where, where[2][1:]), 'MpmVtkRecorder.times')

# numbers that are not finite: of the points' own columns, found before the first step
for tag in 'mass', 'volume0', 'size', 'stress', 'internal', 'deformation':
	for value in 'nan', 'inf', '-inf':
		where = column(tag)
		load(put(where, [value] + where[2][1:]))
		said = message(lambda: O.run(1, True))
		check('%s %s: refused before the first step' % (tag, value), 'material point' in said and tag.rstrip('0') in said and value in said and O.iter == 30, said or 'ran')
where = column('id')
load(put(where, ['99999'] + where[2][1:]))
equal('a point whose body there is not is one whose body has been erased', len(mpm.array('id')), 20)
O.run(1, True)
equal('and leaves with the next step', len(mpm.array('id')), 19)
load(good)
for name in right: same('the whole scene: ' + name, state()[name], right[name])
O.run(10, True)

# ---- loaded and changed, changed without loading ----------------------------------------------------------------------------
def twins(what, change, steps=40, law=None, **how):
	"""The same change without saving, before saving and after loading: same steps of time, same state, same refusal at the same step."""
	ends = []
	for loaded in '', 'before', 'after':
		material = law() if law else None  # anew, as the change is one of the material itself
		ids, grid = block(velocity=(0, -3, 0), material=material, **dict(dict(analysis='planeStrain', walls=[MpmWall(normal=(0, 1, 0))]), **how))
		O.run(25, True)
		if loaded == 'after': O.saveTmp(), O.loadTmp()
		change(ids, [e for e in O.engines if isinstance(e, MpmEngine)][0])
		if loaded == 'before': O.saveTmp(), O.loadTmp()
		said = message(lambda: O.run(steps, True))
		ends.append((loaded, (said, O.iter, O.time, O.dt), state()))
	one = ends[0]
	for loaded, end, points in ends[1:]:
		equal('%s, %s: same steps, same refusal' % (what, loaded), end, one[1])
		for name in points: same('%s, %s: %s' % (what, loaded, name), points[name], one[2][name])
	return one[1][0]


twins('no change', lambda ids, grid: None)
for bodies in True, False:
	twins('points added, bodies=%s' % bodies, lambda ids, grid: mpm.fill(((3, 0), (3.5, .5)), spacing=.25, thickness=.1, material='elastic', bodies=bodies), bodies=bodies)
for what, change in ('cellSize', lambda ids, grid: setattr(grid, 'cellSize', .4)), ('shape', lambda ids, grid: setattr(grid, 'shape', 'linear')), \
		('scheme', lambda ids, grid: setattr(grid, 'scheme', 'USL')), ('wall', lambda ids, grid: setattr(grid.walls[0], 'kind', 'slip')), \
		('a second wall, which stretches the cells', lambda ids, grid: setattr(grid, 'walls', grid.walls + [MpmWall(normal=(0, -1, 0), origin=(0, 1.2, 0), kind='slip')])):
	twins(what + ' changed', change)
	twins(what + ' changed, where the engine sets the step', change, timeStepSafety=.4)
twins('a stiffer material', lambda ids, grid: setattr(O.materials[0], 'young', 3e6), timeStepSafety=.4)
twins('a stiffer material, refused', lambda ids, grid: setattr(O.materials[0], 'young', 1e9))
twins('a stiffer material, small strain', lambda ids, grid: setattr(O.materials[0], 'young', 3e6), timeStepSafety=.4, largeStrain=False)
for what, change in ('softer', lambda ids, grid: setattr(O.materials[0], 'young', 3e5)), ('poisson', lambda ids, grid: setattr(O.materials[0], 'poisson', .1)):
	twins('a material changed: ' + what, change)
steel = lambda: BoucWenMat(label='steel', young=1e6, poisson=.3, density=1000, yieldStress=1e4, n=5, tangentRatio=.05)
for name, value in ('yieldStress', 2e4), ('n', 2), ('tangentRatio', .2), ('beta', -.2), ('tolerance', 1e-6):
	def change(ids, grid, name=name, value=value):
		setattr(O.materials[0], name, value)
		if name == 'beta': O.materials[0].gamma = 1.2
	twins('a material changed: ' + name, change, law=steel)
for name, value in ('isotropicModulus', 1e5), ('stiffnessDegradation', .1), ('reloading', 2):
	said = twins('a material changed: ' + name, lambda ids, grid: setattr(O.materials[0], name, value), law=steel)
	if name != 'isotropicModulus': check(name + ' needs other internal variables: refused', 'other internal variables' in said, said)
twins('a heavier point', lambda ids, grid: setattr(O.bodies[ids[3]].state, 'mass', 1e-5*O.bodies[ids[3]].state.mass), timeStepSafety=.1)
twins('a larger step, refused', lambda ids, grid: setattr(O, 'dt', 4*O.dt))
twins('a step near the limit that grows shorter', lambda ids, grid: None, courant=.98, steps=200)

def forced(ids, grid):
	# set before the save, of the twin that is saved: twins() saves before it calls change
	for i in ids[:3]: O.forces.setPermF(i, (40, 0, 0))


def forces(change):
	"""Positions after a run in which permanent forces are set before saving, and changed after loading."""
	ends = []
	for loaded in False, True:
		ids, grid = block(walls=[MpmWall(normal=(0, 1, 0))])
		forced(ids, grid)
		O.run(20, True)
		if loaded: O.saveTmp(), O.loadTmp()
		change(ids)
		O.run(20, True)
		ends.append(state()['position'])
	return ends


at_once = forces(lambda ids: None)
check('permanent forces move the points', abs(at_once[0][:3, 0] - at_once[0][3, 0]).min() > 1e-5, at_once[0])
same('permanent forces stay over save and load', at_once[1], at_once[0])
released = forces(lambda ids: [O.forces.setPermF(i, (0, 0, 0)) for i in ids[:3]])
same('a script that sets permanent forces after loading is in charge of them', released[1], released[0])
check('and they have gone', abs(released[0] - at_once[0]).max() > 1e-6)
later = forces(lambda ids: (mpm.array('id'), O.forces.setPermF(ids[5], (0, 30, 0))))
same('once the points have been looked at the forces are back, and can be added to', later[1], later[0])
twins('points erased', lambda ids, grid: [O.bodies.erase(i) for i in ids[:3]])

finish()
