# SPDX-License-Identifier: GPL-2.0-or-later
"""The check at load tells layouts apart: it is given expectations that the running YADE does not meet."""
import os
import sys

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish

import yade
from yade import *

probe = ProbeEngine()
equal('the running YADE fits', probe.layoutMismatch('', 0, 0), '')
equal('the version fits', probe.versionMismatch(yade.config.version, yade.config.version), '')
check('another version does not', '2099.01a' in probe.versionMismatch('2099.01a', yade.config.version))
for name in ('Engine', 'PartialEngine', 'PeriodicEngine', 'Scene', 'Body', 'State', 'FrictMat', 'Sphere', 'BodyContainer'):
    for extra in (-16, 16):
        check('a size of %s off by %d' % (name, extra), 'yade::%s does not have the expected size' % name in probe.layoutMismatch(name, extra, 0))
for name in ('Scene', 'TimeStepper', 'PeriodicEngine', 'Body', 'State', 'FrictMat', 'Sphere'):
    check('a virtual function more in %s' % name, 'yade::%s has a vtable of' % name in probe.layoutMismatch(name, 0, 8))
seconds = min(probe.secondsOfLoadCheck() for i in range(5))
check('the check takes less than 5 ms', seconds < 5e-3, seconds)
check('modules beside the plugin are found', yade.__path__[-1].endswith('/mpm-py'), yade.__path__)
check('nothing was refused', not hasattr(yade, 'mpmRefusal'))
finish()
