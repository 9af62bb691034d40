# SPDX-License-Identifier: GPL-2.0-or-later
"""The loop of scripts/examples/cantilever_static.py with its 360 points, to count its instructions: the load rises to the
example's 28 kN in 0.3 s, here linearly. A PyRunner runs every MPM_BENCHMARK_STEPS steps, six times."""
import os
from yade import mpm

steps = int(os.environ.get('MPM_BENCHMARK_STEPS', 100))
spacing = .1/6
O.materials.append(BoucWenMat(label='steel', young=210e9, poisson=.3, density=7850, yieldStress=240e6, tangentRatio=0, n=25, reloading=2))
beam = mpm.fill(((0, -.05), (1, .05)), spacing=spacing, thickness=.05, material='steel')
columns = [[i for i in beam if 1 - (k + 1)*spacing < O.bodies[i].state.pos[0] < 1 - k*spacing] for k in (0, 1)]
O.engines = [
    ForceResetter(),
    *[InterpolatingDirectedForceEngine(ids=ids, times=[0, .3], magnitudes=[0, weight*28e3/len(ids)], direction=(0, -1, 0))
        for ids, weight in zip(columns, (1.14, -.14))],
    MpmEngine(cellSize=2*spacing, analysis='planeStress', walls=[MpmWall(normal=(1, 0, 0), kind='fixed')], damping=.005),
    PyRunner(iterPeriod=steps, nDo=6, command='pass'),
]
O.dt = .7*mpm.criticalTimeStep()
O.run(5*steps + 1, True)
