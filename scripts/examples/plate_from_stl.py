# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate with a hole, cut from an STL file by GTS, pulled beyond yield.

	scripts/yade-mpm -n -x scripts/examples/plate_from_stl.py [out]

The file, scripts/examples/plate.stl, is a plate of 0.4 x 0.2 x 0.02 m with a hole of radius 0.04 m. Material points fill its section
at z = 0. Plane stress, steel with 5 % hardening; the left edge is held by a wall, the right edge pulled at
0.16 m/s after a smooth start for 3 ms. Leaves in the folder out: plate_from_stl.png, and files for ParaView, plate-points.pvd.
"""
import os
import sys

root = os.path.dirname(os.path.realpath(sys.argv[0]))

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from yade import mpm, pack
from yade import *

SPACING, SPEED, START, END = .004, .16, .5e-3, 3e-3
out = sys.argv[1] if len(sys.argv) > 1 else 'out'
os.makedirs(out, exist_ok=True)

O.materials.append(BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05, n=10))
plate = mpm.fill(pack.inGtsSurface(mpm.readStl(os.path.join(root, 'plate.stl'))), spacing=SPACING, thickness=.02, material='steel')
edge = [i for i in plate if O.bodies[i].state.pos[0] > .4 - SPACING]
for i in edge: O.bodies[i].state.blockedDOFs = 'x'
wall = MpmWall(normal=(1, 0, 0), kind='slip')
curve = []


def pull():
	for i in edge: O.bodies[i].state.vel = (SPEED*min(1, O.time/START), O.bodies[i].state.vel[1], 0)
	curve.append((O.bodies[edge[0]].state.displ()[0], -wall.force[0]))


O.engines = [
	ForceResetter(),
	PyRunner(iterPeriod=1, initRun=True, command='pull()'),
	MpmEngine(cellSize=2*SPACING, walls=[wall], damping=.02),
	MpmVtkRecorder(fileName=os.path.join(out, 'plate-'), virtPeriod=END/10),
]
O.dt = .5*mpm.criticalTimeStep()
O.run(int(END/O.dt), True)

x, stress, strain = mpm.array('position'), mpm.array('stress')[:, 0, 0], mpm.array('plasticStrain')
displacement, load = np.array(curve).T
figure, axes = plt.subplots(3, 1, figsize=(6, 9.5))
for ax, (values, name) in zip(axes, ((stress/1e6, 'stress along x [MPa]'), (100*strain, 'plastic strain [%]'))):
	dots = ax.scatter(x[:, 0], x[:, 1], c=values, s=6, marker='s', linewidths=0)
	ax.set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title=name)
	figure.colorbar(dots, ax=ax, shrink=.8)
axes[2].plot(1e3*displacement, load/1e3)
axes[2].set(xlabel='displacement of the edge [mm]', ylabel='force on the wall [kN]')
axes[2].grid(alpha=.3)
figure.tight_layout()
figure.savefig(os.path.join(out, 'plate_from_stl.png'), dpi=120)
print('%d points; force %.0f kN, yield of the net section %.0f kN; greatest plastic strain %.2f %%; results in %s'
	% (len(plate), load[-20:].mean()/1e3, 240e6*.02*.12/1e3, 100*strain.max(), os.path.abspath(out)))
