#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene pays for: instructions a point and step of scenes inside YADE's loop, in the kernel, in MpmEngine around it
and in the rest of the loop, with one thread and AVX2.  costs.py <folder for costs.csv>"""
import csv, os, re, sys
import callgrind

root = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
build = os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build'))
prefix = os.path.join(build, 'prefix') # scripts/yade-mpm has made it
with open(os.path.join(build, 'yade.conf')) as file: yade = dict(re.findall(r"^(\w+)='(.*)'$", file.read(), re.M))
across, steps = 40, 20
solver, engine = r'MpmSolver<.*>::step\(', r'MpmEngine::action\('
solid = r'Solver<yade::mpm::Solid'
block = [('scene.py', '2', 'cubic', law, *what) for what in ((), ('bodies',), ('energy',)) for law in ('elastic', 'yielding')]
block += [('scene.py', '2', 'cubic', 'elastic', what) for what in ('fullMass', 'filter')]


def counted(script, *arguments):
    """Those of the steps between two runs of the script's PyRunner."""
    command = [yade['yadePython'], yade['yadeProgram'], '-j1', '-n', '-x', os.path.join(root, 'scripts/benchmarks', script), *arguments]
    return callgrind.inclusive(command, (solver, engine, solid), ['--toggle-collect=yade::Scene::moveToNextTimeStep()'],
        {'YADE_PREFIX': prefix, 'MPM_BENCHMARK_STEPS': str(steps), 'MPM_INSTRUCTIONS': 'avx2'}, between='yade::PyRunner::action()')


with open(os.path.join(sys.argv[1], 'costs.csv'), 'w', newline='') as file:
    table = csv.writer(file)
    table.writerow(['scene', 'law', 'bodies', 'energies', 'full mass', 'filter', 'kernel', 'engine', 'loop', 'outside the kernel', 'in 3D code'])

    def add(scene, points, n, *what):
        outside = n['all'] - n[solver]
        row = [n[solver], n[engine] - n[solver], n['all'] - n[engine]]
        table.writerow([scene, *what] + ['%.0f' % (x/(steps*points)) for x in row] + ['%.3f' % (outside/n['all']), n[solid]])
        file.flush()

    for script, *arguments in block:
        add('block', across**2, counted(script, str(across), *arguments), arguments[2], *(what in arguments for what in ('bodies', 'energy', 'fullMass', 'filter')))
    add('cantilever', 360, counted('cantilever.py'), 'hysteretic', True, False, False, False)
