# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate with a hole, read from an STL file, is pulled beyond yield.

	scripts/yade-mpm -n -x scripts/examples/plate_from_stl.py [out]

scripts/examples/plate.stl is a plate of 0.4 x 0.2 x 0.02 m with a hole of radius 0.04 m. Material points fill
its section at z = 0. Plane stress, steel with 5 % hardening. A wall holds the left edge. A force pulls the
right end and grows smoothly in 2 ms to 620 kN; the net section beside the hole yields at 576 kN. Writes
plate_from_stl.png, and files for ParaView, plate-points.pvd.
"""
import os
import sys

root = os.path.dirname(os.path.realpath(sys.argv[0]))

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from yade import mpm, pack
from yade import *

def squares(ax, x, y, values, size, **style):
	"""Draw each point as a square of its size, without gaps between neighbours."""
	corners = size/2*np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
	patches = PolyCollection(np.column_stack((x, y))[:, None] + corners, array=values, edgecolors='face', linewidths=.6, **style)
	ax.add_collection(patches)
	ax.autoscale_view()
	return patches


SPACING, LOAD, END = .004, 620e3, 2e-3
out = sys.argv[1] if len(sys.argv) > 1 else 'out'
os.makedirs(out, exist_ok=True)

O.materials.append(BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05, n=10))
plate = mpm.fill(pack.inGtsSurface(mpm.readStl(os.path.join(root, 'plate.stl'))), spacing=SPACING, thickness=.02, material='steel')
end = [i for i in plate if O.bodies[i].state.pos[0] > .4 - 4*SPACING]  # over two cells
wall = MpmWall(normal=(1, 0, 0), kind='slip')
times = np.linspace(0, END, 101)
loads = LOAD*.5*(1 - np.cos(np.pi*times/END))
curve = []


def record():
	curve.append((np.mean([O.bodies[i].state.displ()[0] for i in end]), wall.force[0]))


O.engines = [
	ForceResetter(),
	InterpolatingDirectedForceEngine(ids=end, times=list(times), magnitudes=list(loads/len(end)), direction=(1, 0, 0)),
	MpmEngine(cellSize=2*SPACING, walls=[wall], damping=.05),
	PyRunner(iterPeriod=20, command='record()'),
	MpmVtkRecorder(fileName=os.path.join(out, 'plate-'), virtPeriod=END/10),
]
O.dt = .5*mpm.criticalTimeStep()
O.run(int(END/O.dt), True)

x, stress, strain = mpm.array('position'), mpm.array('stress')[:, 0, 0], mpm.array('plasticStrain')
displacement, load = np.array(curve).T
figure, axes = plt.subplots(3, 1, figsize=(6, 9.5))
for ax, (values, name) in zip(axes, ((stress/1e6, 'stress along x [MPa]'), (100*strain, 'plastic strain [%]'))):
	dots = squares(ax, x[:, 0], x[:, 1], values, SPACING)
	ax.set(aspect='equal', xlabel='x [m]', ylabel='y [m]', title=name)
	figure.colorbar(dots, ax=ax, shrink=.8)
axes[2].plot(1e3*displacement, load/1e3)
axes[2].set(xlabel='displacement of the loaded end [mm]', ylabel='force on the wall [kN]')
axes[2].grid(alpha=.3)
figure.tight_layout()
figure.savefig(os.path.join(out, 'plate_from_stl.png'), dpi=120)
print('%d points; force on the wall %.0f kN; greatest plastic strain %.2f %%; results in %s'
	% (len(plate), load[-1]/1e3, 100*strain.max(), os.path.abspath(out)))
