# SPDX-License-Identifier: GPL-2.0-or-later
"""Lame's and Hill's thick cylinder and sphere in axisymmetry, plane strain and 3D, on coarse grids: a pressure on curved surfaces, put on as forces.

The same functions as scripts/verify thick_walled uses, which has finer grids; bounds from there (doc/verification/thick-walled.md), with a tenth to spare.
"""
import os
import sys

sys.path[:0] = [os.path.dirname(os.path.realpath(sys.argv[0])), os.path.join(os.path.dirname(os.path.realpath(sys.argv[0])), '..', '..', 'scripts', 'verification')]
from common import *
from vessels import errors, hill, lame, pressurise, radial

YIELD = 1e3
pressure, sphere = hill(YIELD, 1.5)
r = numpy.linspace(1, 2, 21)
near('the radial solution is that of Hill in the sphere', radial('sphere', YIELD, pressure)(r)[0]/sphere(r)[0], numpy.ones(21), 1e-4)
near('and that of Lame in a cylinder that does not yield', radial('cylinder', YIELD, 100)(r)[0]/lame('cylinder', 100)(r)[0], numpy.ones(21), 1e-4)
cylinder = radial('cylinder', YIELD, .7*YIELD)
for kind, analysis, cells, elasticBounds, plasticBounds in (('cylinder', 'axisymmetric', 16, (.002, .004), (.002, .005)), ('cylinder', 'planeStrain', 8, (.023, .039), (.066, .088)),
		('sphere', 'axisymmetric', 8, (.031, .062), (.073, .087)), ('sphere', '3d', 4, (.05, .115), (.08, .125))):
	found = errors(kind, analysis, pressurise(kind, analysis, cells, 100), lame(kind, 100))
	for what, error, bound in zip(('displacement', 'stress'), found, elasticBounds): near('%s, %s, elastic: %s' % (kind, analysis, what), error, 0, bound)
	found = errors(kind, analysis, pressurise(kind, analysis, cells, pressure if kind == 'sphere' else .7*YIELD, YIELD), sphere if kind == 'sphere' else cylinder)
	for what, error, bound in zip(('displacement', 'stress'), found, plasticBounds): near('%s, %s, yielding: %s' % (kind, analysis, what), error, 0, bound)
	check('%s, %s: has yielded' % (kind, analysis), mpm.array('plasticStrain').max() > 1e-4)
finish()
