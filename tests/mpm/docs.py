# SPDX-License-Identifier: GPL-2.0-or-later
"""What a user finds in Python: every class, attribute and function says what it is, and numbers say their unit.

The names are those of the project's fixed Python face; the scene in the module's own docstring must run as printed.
"""
import inspect
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

# the names that users rely on
face = {
	MpmEngine: 'cellSize analysis shape scheme flip gravity damping largeStrain walls',
	MpmWall: 'origin normal kind friction velocity force extent along angularVelocity torque',
	BoucWenMat: 'yieldStress n beta gamma tangentRatio tolerance',
	MpmState: 'stress strain backStress F plasticStrain volume',
}
for cls, names in face.items():
	for name in names.split(): check('%s.%s is there' % (cls.__name__, name), hasattr(cls, name))
for cls, base in (MpmEngine, GlobalEngine), (MpmState, State), (BoucWenMat, FrictMat), (MpmWall, Serializable):
	check('%s is a %s' % (cls.__name__, base.__name__), issubclass(cls, base))
for name in 'MpmEngine', 'MpmWall', 'BoucWenMat', 'MpmState':
	check('%s is among the names of a script' % name, name in dir(yade.wrapper) and hasattr(yade, name))

# defaults
d = MpmEngine().dict()
equal('defaults of MpmEngine', {k: d[k] for k in ('analysis', 'shape', 'scheme', 'flip', 'damping', 'largeStrain', 'walls')},
	{'analysis': 'planeStress', 'shape': 'cubic', 'scheme': 'MUSL', 'flip': 1., 'damping': 0., 'largeStrain': True, 'walls': []})
d = BoucWenMat().dict()
equal('defaults of BoucWenMat', {k: d[k] for k in ('beta', 'gamma', 'tangentRatio')}, {'beta': .5, 'gamma': .5, 'tangentRatio': 0.})
equal('defaults of MpmWall', {k: v for k, v in MpmWall().dict().items() if k in ('kind', 'friction', 'velocity', 'force')}, {'kind': 'fixed', 'friction': 0., 'velocity': Vector3(0, 0, 0), 'force': Vector3(0, 0, 0)})

numbers = {'Real', 'int', 'long', 'size_t', 'Vector3r', 'Vector2r', 'Matrix3r', 'std::vector<Real>'}
ours = [cls for name, cls in vars(yade.wrapper).items() if inspect.isclass(cls) and (name.startswith('Mpm') or name in ('BoucWenMat', 'J2Mat', 'DruckerPragerMat'))]
check('all classes of the plugin', len(ours) >= 5, ours)
for cls in ours:
	check('%s has a docstring' % cls.__name__, cls.__doc__ and len(cls.__doc__) > 20, cls.__doc__)
	for name, item in vars(cls).items():
		if name.startswith('_') or name in ('dispIndex', 'dispHierarchy'): continue
		doc = item.__doc__ or ''
		what = '%s.%s' % (cls.__name__, name)
		check('%s has a docstring' % what, len(re.sub(':y[a-z]+:`[^`]*`', '', doc).strip()) > 10, doc)
		kind = re.search(':yattrtype:`([^`]*)`', doc)
		if isinstance(item, property) and (kind is None or kind.group(1) in numbers):
			check('%s says its unit' % what, re.search(r'\[(-|m|m/s2?|m2|m3|s|Pa|N|J|kg|kg/m3|bytes|rad|rad/s|Nm)\]', doc), doc)

for name in mpm.__all__:
	item = getattr(mpm, name)
	check('mpm.%s has a docstring' % name, item.__doc__ and len(item.__doc__) > 20)
	if not inspect.isfunction(item): continue
	for parameter in inspect.signature(item).parameters:
		check('mpm.%s explains %s' % (name, parameter), re.search(r':param [^:]*\b%s:' % parameter, item.__doc__))
for name in 'fill', 'array', 'criticalTimeStep': check('mpm.%s is public' % name, name in mpm.__all__)
for name in ('id', 'position', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'vonMises'):
	check("mpm.array explains '%s'" % name, "'%s'" % name in mpm.array.__doc__)

# an object is shown as a script makes it: only what is not as it comes, and it makes the same again
for cls in ours:
	if cls not in (MpmPoints, MpmState, MpmVtkRecorder): equal('repr of %s' % cls.__name__, (repr(cls()), str(cls())), ('%s()' % cls.__name__, '%s()' % cls.__name__))
wall = MpmWall(normal=(1, 0, 0), kind='friction', friction=.3)
equal('repr of a wall', repr(wall), "MpmWall(normal=Vector3(1,0,0), kind='friction', friction=0.3)")
grid = MpmEngine(cellSize=.25, analysis='3d', gravity=(0, 0, -10), walls=[wall], label='grid')
equal('repr of the engine', repr(grid), "MpmEngine(cellSize=0.25, analysis='3d', gravity=Vector3(0,0,-10), walls=[%r], label='grid')" % wall)
equal('evaluates to the same', repr(eval(repr(grid))), repr(grid))
check('O.engines shows it', repr(grid) in repr([ForceResetter(), grid]))
equal('dir(mpm) is what there is to call', sorted(dir(mpm)), sorted(mpm.__all__))
for name in mpm.__all__: check('the docstring of mpm names %s' % name, re.search(r'\b%s\b' % name, mpm.__doc__))

# one version, that of the CMakeLists.txt at the root
with open(os.path.join(os.path.dirname(os.path.realpath(sys.argv[0])), '../../CMakeLists.txt')) as file:
	declared = re.search(r'project\(yade-mpm VERSION (\S+)', file.read()).group(1)
equal('mpm.__version__', mpm.__version__, declared)

# the scene of the docstring, as printed; Python 3.13 expands its tabs
scene = [line[8:] for line in mpm.__doc__.expandtabs().splitlines() if line.startswith(8*' ')]
check('the scene has about ten lines', 6 <= len(scene) <= 12, scene)
O.reset()
names = dict({k: v for k, v in vars(yade.wrapper).items() if not k.startswith('_')}, O=O)
exec('\n'.join(scene), names)
equal('it has run', (O.iter, names['sigma'].shape), (1000, (360, 3, 3)))
check('and is at rest, nothing having loaded it', (names['sigma'] == 0).all())

finish()
