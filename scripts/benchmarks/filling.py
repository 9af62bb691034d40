# SPDX-License-Identifier: GPL-2.0-or-later
"""Seconds that it takes to fill a square with points, without and with bodies, and to save and load it after a step. Prints CSV.

    scripts/yade-mpm -n -x scripts/benchmarks/filling.py"""
import os, tempfile, time
from yade import mpm


def timed(what, points, work):
    start = time.perf_counter()
    work()
    print('%s,%d,%.2f' % (what, points, time.perf_counter() - start), flush=True)


def square(across, bodies):
    O.reset()
    O.materials.append(ElastMat(label='steel', young=210e9, poisson=.3, density=7850))
    timed('filling with bodies' if bodies else 'filling without bodies', across**2,
        lambda: mpm.fill(((0, 0), (1, 1)), 1/across, 'steel', thickness=.01, bodies=bodies))


print('what,points,seconds')
square(316, True)
square(1000, False)
O.engines = [MpmEngine(cellSize=2/1000, analysis='planeStress', walls=[MpmWall(normal=(1, 0, 0), kind='fixed')])]
O.dt = 1e-9
O.step()
with tempfile.TemporaryDirectory() as folder:
    name = os.path.join(folder, 'scene.yade')
    timed('O.save', 1000000, lambda: O.save(name))
    O.reset()
    timed('O.load', 1000000, lambda: O.load(name))
assert len(mpm.array('id')) == 1000000
