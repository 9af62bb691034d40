# SPDX-License-Identifier: GPL-2.0-or-later
"""The material point method in YADE: material points as bodies of the scene.

	from yade import mpm
	O.materials.append(BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=.05))
	beam = mpm.fill(((0, 0), (1, .1)), spacing=1/60., thickness=.05, material='steel')
	O.engines = [ForceResetter(), MpmEngine(cellSize=1/30., walls=[MpmWall(normal=(1, 0, 0))])]
	O.dt = .4*mpm.criticalTimeStep()
	O.run(1000, True)
	sigma = mpm.array('stress')

fill makes points of a region, points makes them from arrays, setStress gives them a stress to start with, traction loads a face; array
looks at them, color shows them in the 3D view, criticalTimeStep says how far a step may go; drive takes a single point through strains
(PointHistory), readStl reads a surface to fill, readMesh a mesh; wall makes a wall for points and grains, reaction is the force on
gripped points. Classes: MpmEngine, MpmWall, MpmTraction, MpmState, MpmVtkRecorder, and the materials BoucWenMat, J2Mat, DruckerPragerMat. help() of any of them says more.

Units are SI, tension is positive.
"""
import yade
import yade.wrapper

if hasattr(yade, 'mpmRefusal'): raise ImportError(yade.mpmRefusal)

from .contact import reaction, wall
from .driver import PointHistory, drive
from .load import traction
from .mesh import readMesh
from .points import array, criticalTimeStep, fill, points, setStress
from .surface import readStl
from .view import color

__version__ = yade.wrapper.MpmPoints.version()
__all__ = ['PointHistory', 'array', 'color', 'criticalTimeStep', 'drive', 'fill', 'points', 'reaction', 'readMesh', 'readStl', 'setStress',
	'traction', 'wall']


def __dir__(): return __all__
