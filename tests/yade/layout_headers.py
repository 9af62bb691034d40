# SPDX-License-Identifier: GPL-2.0-or-later
"""pkg/yade against YADE's own headers: what the compiler makes of either (Layout.cpp) must be the same, line by line."""
import ctypes
import os
import sys

sys.path.insert(0, os.environ['YADE_MPM_TESTS'])
from check import check, equal, finish


def layout(which):
    library = ctypes.CDLL(os.path.join(os.environ['YADE_MPM_BUILD'], 'tests', 'yade', 'layout_%s.so' % which))
    library.layoutOfYade.restype = ctypes.c_char_p
    return library.layoutOfYade().decode().splitlines()


def differences(one, other):
    return [(a, b) for a, b in zip(one, other) if a != b] + [(None, line) for line in (one[len(other):] or other[len(one):])]


declared, real = layout('declared'), layout('real')
for kind, least in dict(size=25, offset=100, slot=200, type=70, value=15).items():
    found = [pair for pair in differences(declared, real) if (pair[0] or pair[1]).startswith(kind + ' ')]
    count = sum(line.startswith(kind + ' ') for line in real)
    check('at least %d lines of %ss' % (least, kind), count >= least, count)
    check('%d %ss are the same in pkg/yade and in YADE\'s headers' % (count, kind), not found, found)
    # and a difference would be seen: one line of this kind altered
    i = next(i for i, line in enumerate(real) if line.startswith(kind + ' '))
    equal('an altered %s is found' % kind, len(differences(real[:i] + [real[i] + '0'] + real[i + 1:], real)), 1)
equal('as many lines', len(declared), len(real))
finish()
