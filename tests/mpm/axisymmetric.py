# SPDX-License-Identifier: GPL-2.0-or-later
"""Axisymmetry in YADE: volumes of rings, the axis without a wall, wall forces, hoop stress, save and load.

A solid cylinder (R = 1 m, H = 0.5 m) between a top plate that comes down, a floor and no side: sigma_zz = E eps and the plate
carries pi R^2 times it. An unloaded point's F has the hoop stretch in zz.
"""
import math
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

R, H, E, NU = 1., .5, 1e7, .3
ids, grid = block(region=((0, 0), (R, H)), spacing=1/16., thickness=None, axisymmetric=True, material=elastic(E, NU), analysis='axisymmetric', damping=.2,
	walls=[MpmWall(normal=(0, 1, 0), kind='slip'), MpmWall(normal=(0, -1, 0), origin=(0, H, 0), kind='slip')])
near('the volume of the cylinder', mpm.array('volume').sum(), math.pi*R*R*H, 1e-12)
near('its mass', mpm.array('mass').sum(), 1000*math.pi*R*R*H, 1e-9)
near('a ring', mpm.array('volume')[0], 2*math.pi*mpm.array('position')[0, 0]/256, 1e-15)
strain, steps = 1e-3, 900
grid.walls[1].velocity = (0, -strain*H/(O.dt*steps/3), 0)
O.run(steps//3, True)
grid.walls[1].velocity = (0, 0, 0)
O.run(2*steps//3, True)
eps = grid.walls[1].origin[1]/H - 1
near('axial strain', eps, -strain, 1e-9)
stress, x = mpm.array('stress'), mpm.array('position')
inside = x[:, 0] < R - .2
near('axial stress is E eps', stress[inside, 1, 1]/(E*eps), numpy.ones(inside.sum()), .02)
near('no radial stress', stress[inside, 0, 0]/(E*eps), numpy.zeros(inside.sum()), .02)
near('no hoop stress', stress[inside, 2, 2]/(E*eps), numpy.zeros(inside.sum()), .02)
near('the hoop stretch is in F', mpm.array('F')[inside, 2, 2] - 1, numpy.full(inside.sum(), -NU*eps), .03*NU*abs(eps))
near('the plate carries it', grid.walls[1].force[1]/(-E*eps*math.pi*R*R), 1, .02)
near('and so does the floor', grid.walls[0].force[1]/(E*eps*math.pi*R*R), 1, .02)
equal('two walls of two', len(grid.walls), 2)

before = state()
path = os.path.join(tempfile.mkdtemp(), 'axisymmetric.xml.gz')
O.save(path)
O.run(20, True)
after = state()
O.load(path)
for name in before: same('%s is loaded' % name, state()[name], before[name])
O.run(20, True)
for name in after: same('%s goes on from the file' % name, state()[name], after[name])
finish()
