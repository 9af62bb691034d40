#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Throughput of the kernel without YADE, as CSV on the standard output.

    throughput.py [build folder]

Columns: points, shape, law, threads, instructions (the set in use), rate [points x steps / s], the median of five runs,
and instructions of the processor a point and step, counted by callgrind where it is installed (which knows AVX2 at most)."""
import os, shutil, statistics, subprocess, sys, tempfile

program = os.path.join(sys.argv[1] if len(sys.argv) > 1 else 'build', 'bin', 'mpm_throughput')
cases = [('linear', 'elastic'), ('quadratic', 'elastic'), ('cubic', 'elastic'), ('cubic', 'yielding'), ('cubic', 'spinning')]


def run(*arguments, prefix=(), instructions=None):
    environment = dict(os.environ)
    if instructions:
        environment['MPM_INSTRUCTIONS'] = instructions
    done = subprocess.run([*prefix, program, *map(str, arguments)], env=environment, check=True, capture_output=True, text=True)
    return done.stdout, done.stderr


def rate(across, shape, law, threads, instructions):
    steps = max(5, 2000000 // across**2)
    return statistics.median(float(run(across, shape, law, threads, steps, instructions=instructions)[0]) for _ in range(5))


def counted(across, shape, law, instructions, steps=20):
    """Instructions a point and step: those of a run less those of one without the steps."""
    def total(n):
        with tempfile.TemporaryDirectory() as folder:
            prefix = ('valgrind', '--tool=callgrind', '--callgrind-out-file=' + os.path.join(folder, 'out'))
            log = run(across, shape, law, 1, n, prefix=prefix, instructions=instructions)[1]
        return int(next(line for line in log.splitlines() if 'Collected' in line).split()[-1])
    return (total(steps) - total(0)) / (steps * across**2)


flags = open('/proc/cpuinfo').read().split()
sets = ['sse2'] + ['avx2'] * ('avx2' in flags) + ['avx512'] * ('avx512bw' in flags)
print('points,shape,law,threads,instructions,rate,instructions_per_point_step')
for shape, law in cases:
    for across in 19, 100, 500, 1000:
        for instructions in sets:
            count = ''
            if across == 100 and instructions != 'avx512' and shutil.which('valgrind'):
                count = '%.0f' % counted(across, shape, law, instructions)
            for threads in sorted({1, min(2, os.cpu_count())}):
                print(across**2, shape, law, threads, instructions, '%.3g' % rate(across, shape, law, threads, instructions),
                      count if threads == 1 else '', sep=',', flush=True)
