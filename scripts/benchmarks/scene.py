# SPDX-License-Identifier: GPL-2.0-or-later
"""The blocks of Blocks.hpp inside YADE's loop. Prints one line of JSON: points, point-steps a second of wall and of CPU
time (medians of five parts of the run), and bytes of memory a point, by the growth of the process.

    scripts/yade-mpm -j<threads> -n -x scripts/benchmarks/scene.py across 2|3 shape elastic|yielding [bodies] [energy] [fullMass] [filter]

The motion is that of a wide plate, so that no point leaves its tile: strips of points whose velocities grow with x."""
import json, os, statistics, sys, time
from yade import mpm

across, dim, shape, law = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4]
bodies, energy, full, filtered = (what in sys.argv[5:] for what in ('bodies', 'energy', 'fullMass', 'filter'))
points = across**dim
steps = int(os.environ.get('MPM_BENCHMARK_STEPS', 0)) or max(5, (800000 if dim == 2 else 200000)//points)


def resident():
    return int(open('/proc/self/statm').read().split()[1])*os.sysconf('SC_PAGE_SIZE')


if law == 'yielding':
    for label, strength in ('flows', 24e6), ('holds', 2400e6):
        O.materials.append(BoucWenMat(label=label, young=210e9, poisson=.3, density=7850, yieldStress=strength, n=10, tangentRatio=.05))
else:
    O.materials.append(ElastMat(label='flows', young=210e9, poisson=.3, density=7850))
    O.materials.append(ElastMat(label='holds', young=210e9, poisson=.3, density=7850))
spacing, before = 1/across, resident()
O.dt = .2*2*spacing/5422
low, strips = round(across/3)*spacing, min(across, 100)
depth = dict(thickness=.01) if dim == 2 else {}
for k in range(strips):
    x = [round(i*across/strips)*spacing for i in (k, k + 1)]
    v = (1.5e-6/O.dt*(x[0] + x[1])/2, 0, 0)
    for y0, y1, material in (0, low, 'flows'), (low, 1, 'holds'):
        region = ((x[0], y0), (x[1], y1)) if dim == 2 else ((x[0], y0, 0), (x[1], y1, 1))
        mpm.fill(region, spacing, material, velocity=v, bodies=bodies, **depth)
O.trackEnergy = energy
marks = []
warm = 150 if law == 'yielding' else 10
O.engines = ([ForceResetter()] if bodies else []) + [
    MpmEngine(cellSize=2*spacing, analysis='planeStress' if dim == 2 else '3d', shape=shape, fullMass=full, filterTime=1000*O.dt if filtered else 0, walls=[MpmWall(normal=(1, 0, 0), kind='fixed')]),
    PyRunner(iterPeriod=steps, nDo=6, firstIterRun=warm, command='marks.append((time.perf_counter(), time.process_time()))')]
O.run(warm + 5*steps + 1, True)
assert len(marks) == 6, marks
rate, busy = (points*steps/statistics.median(b[k] - a[k] for a, b in zip(marks, marks[1:])) for k in (0, 1))
print(json.dumps({'points': points, 'rate': rate, 'busy': busy, 'bytes': (resident() - before)/points}))
