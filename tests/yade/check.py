# SPDX-License-Identifier: GPL-2.0-or-later
"""One PASS or FAIL line per check; finish() ends YADE with the number of failures as exit code (at most 1)."""
import math
import os
import sys

failures = 0


def same(a, b):
    """Equality of what YADE's attributes hold: NaN equals NaN, quaternions and matrices by component."""
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (math.isnan(a) and math.isnan(b))
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b))
    return a == b


def check(what, good, detail=''):
    global failures
    good = bool(good)
    failures += not good
    print('%s %s%s' % ('PASS' if good else 'FAIL', what, '' if good or detail == '' else ': ' + str(detail)), flush=True)


def equal(what, found, wanted):
    check(what, same(found, wanted), 'found %r, wanted %r' % (found, wanted))


def raises(what, exception, part, call):
    try:
        call()
    except Exception as error:
        check(what, isinstance(error, exception) and part in str(error), '%s: %s' % (type(error).__name__, error))
    else:
        check(what, False, 'no exception')


def finish():
    sys.stdout.flush()
    os._exit(1 if failures else 0)
