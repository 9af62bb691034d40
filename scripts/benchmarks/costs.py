#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene pays for: instructions a point and step of scenes inside YADE's loop, in the kernel, in MpmEngine around it
and in the rest of the loop, with one thread and AVX2.  costs.py <folder for costs.csv>"""
import csv, os, sys
import callgrind

root = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
across, steps = 40, 20
solver, engine = r'MpmSolver<.*>::step\(', r'MpmEngine::action\('
solid = r'Solver<yade::mpm::Solid'
cases = [('elastic',), ('yielding',), ('elastic', 'bodies'), ('elastic', 'energy'), ('yielding', 'bodies'), ('yielding', 'energy')]


def counted(*case):
    """Those of a step: of a run less those of a shorter one."""
    def total(n):
        command = ['/usr/bin/python3.11', '/usr/bin/yade', '-j1', '-n', '-x', os.path.join(root, 'scripts/benchmarks/scene.py'), str(across), 'cubic', *case]
        return callgrind.inclusive(command, (solver, engine, solid), ['--toggle-collect=yade::Scene::moveToNextTimeStep()'],
            {'YADE_PREFIX': prefix, 'MPM_BENCHMARK_STEPS': str(n), 'MPM_INSTRUCTIONS': 'avx2'})
    long, short = total(2*steps), total(steps)
    return {name: (long[name] - short[name])/(5*steps*across**2) for name in long}


build = os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build'))
prefix = os.path.join(build, 'prefix') # scripts/yade-mpm has made it
with open(os.path.join(sys.argv[1], 'costs.csv'), 'w', newline='') as file:
    table = csv.writer(file)
    table.writerow(['law', 'bodies', 'energies', 'kernel', 'engine', 'loop', 'in 3D code'])
    for case in cases:
        n = counted(*case)
        table.writerow([case[0], 'bodies' in case, 'energy' in case] + ['%.0f' % x for x in (n[solver], n[engine] - n[solver], n['all'] - n[engine], n[solid])])
        file.flush()
