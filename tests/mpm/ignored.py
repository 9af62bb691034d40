# SPDX-License-Identifier: GPL-2.0-or-later
"""No input is ignored: what a script changes takes effect, or is refused by name.

Masses after a change are those of density times volume, to rounding; a run with changed mass is compared with one whose points had that
density from the start. Refusals are checked for object, attribute, value and remedy, and that the scene runs on once it is put right.
"""
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

falling = dict(gravity=(0, -10, 0), walls=[MpmWall(normal=(0, 1, 0), kind='slip')])


def refuses(what, *parts, make=block, spoil, repair):
	"""A run is spoilt after two steps and refused; repaired, it runs on."""
	ids, grid = make()
	O.run(2, True)
	spoil(ids, grid)
	before = mpm.array('position')
	for part in parts: raises('%s: %s' % (what, part), RuntimeError, part, lambda: O.run(1, True))
	same(what + ': nothing has moved', mpm.array('position'), before)
	repair(ids, grid)
	step = O.iter
	O.run(1, True)
	equal(what + ': repaired, it runs on', O.iter, step + 1)


# ---- mass ------------------------------------------------------------------------------------------------------------------
def fallen(density, change=None, when=0, **how):
	ids, grid = block(material=elastic(density=1000.), courant=None, **falling, **how)
	O.reset()
	material = elastic(density=density)
	ids = mpm.fill(((0, 0), (1, 1)), spacing=.25, thickness=.1, material=material, velocity=(.1, -1, 0), **how)
	O.engines = [ForceResetter(), MpmEngine(cellSize=.5, **falling)]
	O.dt = 2e-3
	if when: O.run(when, True) # YADE takes 0 for no end
	if change: change(ids, material)
	O.run(20, True)
	return mpm.array('mass'), mpm.array('position')


def denser(ids, material): material.density = 4000.


def heavier(ids, material):
	for i in ids: O.bodies[i].state.mass *= 4


def other(ids, material):
	lead = elastic(density=4000., label='lead')
	for i in ids: O.bodies[i].mat = lead


right = fallen(4000.)
near('mass of the reference', right[0], numpy.full(16, 4000*.25**2*.1), 1e-12)
for what, change in ('density of the material', denser), ('mass of the bodies', heavier), ('another material', other):
	mass, position = fallen(1000., change)
	near('%s, changed after filling: mass' % what, mass, right[0], 1e-9)
	near('%s, changed after filling: motion' % what, position, right[1], 1e-9)
	near('%s, changed in mid-run: mass' % what, fallen(1000., change, when=5)[0], right[0], 1e-9)
near('density, points without bodies', fallen(1000., denser, bodies=False)[1], right[1], 1e-9)
ids, grid = block(velocity=(3, 0, 0))
O.trackEnergy = True
O.run(2, True)
sum_before, kinetic = O.energy.total(), O.energy['mpmKinetic']
O.materials[0].density *= 2
O.run(1, True)
near('kinetic energy of the doubled mass', O.energy['mpmKinetic'], 2*kinetic, 1e-6*kinetic)
near('is external work: the sum stays', O.energy.total(), sum_before, 1e-9*kinetic)
near('the body has its mass', O.bodies[ids[3]].state.mass, mpm.array('mass')[3], 0)
ids, grid = block(timeStepSafety=.4)
O.run(1, True)
step = O.dt
for i in ids: O.bodies[i].state.mass *= 4
O.run(1, True)
near('the stable step follows the mass', O.dt, 2*step, 1e-2*step)


def heavy(value):
	def spoil(ids, grid): O.bodies[ids[3]].state.mass = value
	def repair(ids, grid): O.bodies[ids[3]].state.mass = mpm.array('mass')[3]
	refuses('mass %r' % value, 'O.bodies[3].state.mass', 'mass > 0', spoil=spoil, repair=repair)


for value in float('nan'), 0, -1, float('inf'): heavy(value)

# ---- what a point cannot do ------------------------------------------------------------------------------------------------
refuses('a torque without contact', 'O.forces.t(5)', '0 0 2', 'couple', spoil=lambda ids, grid: O.forces.setPermT(5, (0, 0, 2)), repair=lambda ids, grid: O.forces.setPermT(5, (0, 0, 0)))
refuses('a clump', 'clumpId = 64', 'clump', 'O.bodies.erase(64)', make=lambda: block(((0, 0, 0), (1, 1, 1)), thickness=None, analysis='3d'),
	spoil=lambda ids, grid: O.bodies.clump(ids[:4]), repair=lambda ids, grid: O.bodies.erase(O.bodies[ids[0]].clumpId))
refuses('a subdomain of yade.mpy', 'O.bodies[7].subdomain', 'yade.mpy', 'one process', spoil=lambda ids, grid: setattr(O.bodies[7], 'subdomain', 1),
	repair=lambda ids, grid: setattr(O.bodies[7], 'subdomain', O.bodies[6].subdomain))
refuses('a scene of rank 1', 'O.subdomain = 1', 'yade.mpy', spoil=lambda ids, grid: setattr(O._sceneObj, 'subdomain', 1), repair=lambda ids, grid: setattr(O._sceneObj, 'subdomain', 0))
refuses('a scene that yade.mpy has split, on its rank 0', 'O.engines has isendRecvForcesRunner', 'yade.mpy', 'one process',
	spoil=lambda ids, grid: setattr(O, 'engines', O.engines + [PyRunner(iterPeriod=1, command='pass', label='isendRecvForcesRunner')]),
	repair=lambda ids, grid: setattr(O, 'engines', O.engines[:-1]))
refuses('density scaling', 'O.bodies[2].state.densityScaling', 'NewtonIntegrator.densityScaling = False', spoil=lambda ids, grid: setattr(O.bodies[2].state, 'densityScaling', .5),
	repair=lambda ids, grid: setattr(O.bodies[2].state, 'densityScaling', -1))
refuses('more threads than any machine has', 'MpmEngine.ompThreads = 200000', 'one a core', spoil=lambda ids, grid: setattr(grid, 'ompThreads', 200000),
	repair=lambda ids, grid: setattr(grid, 'ompThreads', 1))

# ---- contacts that YADE cannot compute -----------------------------------------------------------------------------------------
def touching(material, poisson=0):
	"""Points of a material under a grain that touches them."""
	O.reset()
	O.materials.append(material)
	O.materials.append(FrictMat(label='grain', young=1e6, poisson=poisson, density=1000))
	mpm.fill(((0, 0, 0), (1, 1, .5)), spacing=.25, material=0)
	O.bodies.append(utils.sphere((.5, .5, .7), .25, material='grain'))
	O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
		[Law2_ScGeom_FrictPhys_CundallStrack()]), MpmEngine(cellSize=.5, analysis='3d', gravity=(0, 0, -10)), NewtonIntegrator()]
	O.dt = 1e-4
	O.run(20, True)


for part in "ElastMat 'soft'", 'give the points a FrictMat': raises('ElastMat beside an InteractionLoop', RuntimeError, part, lambda: touching(ElastMat(label='soft', young=1e6, poisson=.3, density=1000)))
for part in 'O.forces.f(', 'poisson = 0', 'give one of them a small': raises('a contact of two materials with poisson = 0', RuntimeError, part, lambda: touching(FrictMat(label='soft', young=1e6, poisson=0, density=1000)))
touching(FrictMat(label='soft', young=1e6, poisson=1e-3, density=1000), poisson=1e-3)
equal('with a small poisson it runs', O.iter, 20)

# ---- kinematics ------------------------------------------------------------------------------------------------------------
pressed = lambda **how: block(velocity=(0, -3, 0), walls=[MpmWall(normal=(0, 1, 0), kind='slip')], **how)
for start in True, False:
	refuses('largeStrain from %s, switched in mid-run' % start, 'MpmEngine.largeStrain = %d' % (not start), 'before the first step', make=lambda: pressed(largeStrain=start),
		spoil=lambda ids, grid: (O.run(20, True), setattr(grid, 'largeStrain', not start)), repair=lambda ids, grid: setattr(grid, 'largeStrain', start))
refuses('thinning, switched off in mid-run', 'MpmEngine.thinning = 0', 'before the first step', make=lambda: pressed(thinning=True),
	spoil=lambda ids, grid: (O.run(20, True), setattr(grid, 'thinning', False)), repair=lambda ids, grid: setattr(grid, 'thinning', True))
ids, grid = block()
mpm.criticalTimeStep()
grid.largeStrain = False
O.run(2, True)
equal('before the first step largeStrain may be chosen', O.iter, 2)

# ---- the stable step of an engine that is switched to set it ---------------------------------------------------------------
ids, grid = block()
O.run(2, True)
limit = mpm.criticalTimeStep()
grid.timeStepSafety = .3
O.run(1, True)
near('timeStepSafety given in mid-run', O.dt, .3*limit, 1e-2*limit)
ids, grid = block(timeStepSafety=.3)
O.materials.append(FrictMat(label='stiff', young=1e8, poisson=.3, density=1000))
O.bodies[ids[0]].mat = O.materials['stiff']
O.run(2, True)
one = O.dt
O.bodies[ids[0]].mat = O.materials['elastic']
O.run(2, True)
check('the step follows points that change between materials in use', O.dt > 3*one, (one, O.dt))
O.bodies[ids[5]].mat = O.materials['stiff']
O.run(2, True)
check('and back', O.dt < 1.5*one, (one, O.dt))

# ---- yade.mpy: two processes that share a scene both end, with the error -----------------------------------------------------
def twoProcesses():
	"""What a run of mpy on two processes prints, or None where there is no MPI."""
	try:
		import yade.mpy
	except Exception: return None
	if not shutil.which('mpirun'): return None
	folder = tempfile.mkdtemp()
	with open(os.path.join(folder, 'scene.py'), 'w') as file: file.write('''
from yade import mpm, mpy
O.materials.append(FrictMat(label='e', young=1e6, poisson=.25, density=1500, frictionAngle=.5))
mpm.fill(((0, 0, 0), (.4, .4, .2)), spacing=.1, material='e')
for i in range(4): O.bodies.append(sphere((.05 + .1*i, .2, .26), .05, material='e'))
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()], label='collider'),
	InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()], label='interactionLoop'),
	MpmEngine(cellSize=.2, analysis='3d'), NewtonIntegrator(label='newton')]
O.dt = 1e-4
mpy.DOMAIN_DECOMPOSITION = True
mpy.mpirun(10, 2)
print('mpy has run to its end')
''')
	env = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', OMPI_MCA_rmaps_base_oversubscribe='1')
	try:
		return subprocess.run(['mpirun', '-n', '2', sys.executable, shutil.which('yade'), '-n', '-x', os.path.join(folder, 'scene.py')], cwd=folder, env=env, timeout=60,
			stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout.decode(errors='replace')
	except subprocess.TimeoutExpired: return 'hangs'


said = twoProcesses()
if said is None: print('not checked: yade.mpy on two processes (no mpirun, or no mpi4py)')
else:
	check('yade.mpy on two processes: rank 1 refuses', 'O.subdomain = 1' in said, said)
	check('yade.mpy on two processes: so does rank 0, and none hangs', 'O.engines has isendRecvForcesRunner' in said and 'to its end' not in said, said)

# ---- two engines -----------------------------------------------------------------------------------------------------------
ids, grid = block(spacing=.125)
right = mpm.criticalTimeStep()
other = MpmEngine(cellSize=1, dead=True)
for engines in [other, grid], [grid, other]:
	O.engines = [ForceResetter()] + engines
	near('mpm.criticalTimeStep() is that of the engine that is not dead', mpm.criticalTimeStep(), right, 1e-9)
O.engines = [ForceResetter(), grid, other]
sizes = []
for k in range(6):
	for live, idle, cell in (grid, other, .26 + .01*k), (other, grid, 1):
		live.dead, idle.dead, live.cellSize = False, True, cell
		O.run(1, True)
		sizes.append(live.gridBytes)
check('engines in turn have grids of their own', len(set(sizes[1::2])) == 1 and min(sizes[0::2]) > sizes[1], sizes)

finish()
