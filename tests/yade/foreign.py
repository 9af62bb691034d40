# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs in a YADE that says it is version 2099.01a."""
import os
import sys

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish

import yade
from yade import *

equal('the version is a foreign one', yade.config.version, '2099.01a')
check('classes of the plugin are not there', 'ProbeEngine' not in yade.system.childClasses('GlobalEngine') and not hasattr(yade.wrapper, 'ProbeEngine'))
check('YADE works without them', O.bodies.append(sphere((0, 0, 0), 1)) == 0)
check('Python can ask why', '2099.01a' in yade.mpmRefusal)
finish()
