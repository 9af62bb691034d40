# SPDX-License-Identifier: GPL-2.0-or-later
"""Who owns what: the thread of the simulation never drops the last reference to an object that Python has made, and a scene that was
reset leaves nothing in memory.

Without Python's lock such a drop ends in an abort, so that reaching the end of this script is part of the test.
"""
import gc
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *


def edited(edit, load=False, bodies=True):
	ids, grid = block(((0, 0), (4, 4)), bodies=bodies)
	O.materials.append(FrictMat(label='other', young=1e6, poisson=.3, density=1000))
	if load:
		O.saveTmp()
		O.loadTmp()
	O.run(2, True)
	for i in ids: edit(O.bodies[i])
	gc.collect()
	O.run(2, True)
	for i in ids[5:]: O.bodies.erase(i)
	gc.collect()
	O.run(2, True)
	return len(mpm.array('id'))


def material(body): body.mat = O.materials['other']
def own_material(body): body.mat = FrictMat(young=1e6, poisson=.3, density=1000)
def shape(body): body.shape = Sphere(radius=.1)
def bound(body): body.bound = Aabb()


for load in False, True:
	for edit in material, own_material, shape, bound: equal('%s from Python, bodies erased%s' % (edit.__name__, ', loaded' if load else ''), edited(edit, load), 5)

# another state, which is a point's no more
ids, grid = block()
O.run(2, True)
for i in ids[5:]: O.bodies[i].state = State()
gc.collect()
O.run(2, True)
equal('states from Python in the place of points\'', len(mpm.array('id')), 5)

# bodies that Python has made, points without bodies whose scene forgets them
ids, grid = block(bodies=False)
O.run(2, True)
O.miscParams = []
mpm.fill(((0, 0), (1, 1)), spacing=.25, thickness=.1, material='elastic', bodies=False)
gc.collect()
O.run(2, True)
equal('points of a scene that has forgotten the ones before', len(mpm.array('id')), 16)


def resident():
	with open('/proc/self/statm') as file: return int(file.read().split()[1])*os.sysconf('SC_PAGE_SIZE')/2.**20


used = []
for _ in range(6):
	block(((0, 0), (10, 10)), spacing=.1, courant=None)
	O.dt = 1e-4
	O.run(3, True)
	mpm.array('stress')
	gc.collect()
	used.append(resident())
growth = (used[-1] - used[2])/3
check('10,000 points a scene leave less than 200 bytes each', growth*2**20 < 200*10000, 'MB in use: %s' % used)

finish()
