#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Points times steps a second [1/s] of a square of points: of the kernel alone and inside YADE's loop.

    throughput.py <folder for throughput.csv and .png> [points along an edge ...]

Columns: where (kernel, loop), points, shape, law, bodies, threads, instructions (the set in use), rate and busy (of
wall and of CPU time, which other work on the machine disturbs less; kernel: the median of five runs; loop: of five parts
of a run), bytes (memory a point, in the loop, from the growth of the process)."""
import csv, json, os, statistics, subprocess, sys

root = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
program = os.path.join(os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build')), 'bin', 'mpm_throughput')
cases = [('linear', 'elastic'), ('quadratic', 'elastic'), ('cubic', 'elastic'), ('cubic', 'yielding')]
sizes = [int(a) for a in sys.argv[2:]] or [19, 32, 100, 316, 1000]
threads = [1] + [2]*(os.cpu_count() > 1)
flags = open('/proc/cpuinfo').read().split()
sets = ['sse2'] + ['avx2']*('avx2' in flags) + ['avx512']*('avx512bw' in flags)


def output(command, **environment):
    return subprocess.run(command, env={**os.environ, **environment}, check=True, capture_output=True, text=True).stdout


def kernel(across, shape, law, count, instructions):
    steps = max(10, 1000000//across**2)
    command = [program, str(across), shape, law, str(count), str(steps)]
    runs = [output(command, MPM_INSTRUCTIONS=instructions).split() for _ in range(5)]
    return statistics.median(float(run[0]) for run in runs), statistics.median(float(run[1]) for run in runs), ''


def loop(across, shape, law, count, bodies):
    command = [os.path.join(root, 'scripts/yade-mpm'), '-j%d' % count, '-n', '-x', os.path.join(root, 'scripts/benchmarks/scene.py'), str(across), shape, law]
    lines = output(command + ['bodies']*bodies).splitlines()
    result = json.loads(next(line for line in lines if line.startswith('{')))
    return result['rate'], result['busy'], result['bytes']


def plot(rows, path):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharex=True)
    for k, (shape, law) in enumerate(cases):
        for count in threads:
            mine = [row for row in rows if row[:1] + row[2:6] == ('loop', shape, law, False, count)]
            style = dict(color='C%d' % k, marker='o', ms=3, ls='-' if count == 1 else '--')
            axes[0].loglog([r[1] for r in mine], [r[1]/r[7] for r in mine], label='%s, %s, %d thread%s' % (shape, law, count, 's'*(count > 1)), **style)
            axes[1].semilogx([r[1] for r in mine], [r[7]/1e6 for r in mine], **style)
    axes[0].set(xlabel='points', ylabel='time of a step [s]')
    axes[1].set(xlabel='points', ylabel='million points x steps / s', ylim=(0, None))
    axes[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90)


rows = []
with open(os.path.join(sys.argv[1], 'throughput.csv'), 'w', newline='') as file:
    table = csv.writer(file)
    table.writerow(['where', 'points', 'shape', 'law', 'bodies', 'threads', 'instructions', 'rate', 'busy', 'bytes'])
    def add(*row):
        rows.append(row)
        table.writerow([*row[:7], '%.3g' % row[7], '%.3g' % row[8], row[9] and '%.0f' % row[9]])
        file.flush()
    for shape, law in cases:
        for across in sizes:
            for count in threads:
                add('loop', across**2, shape, law, False, count, sets[-1], *loop(across, shape, law, count, False))
    for law in 'elastic', 'yielding':
        for across in (19, 100):
            add('loop', across**2, 'cubic', law, True, 1, sets[-1], *loop(across, 'cubic', law, 1, True))
    for shape, law in cases + [('cubic', 'spinning')]:
        for instructions in sets:
            for count in threads:
                add('kernel', 10000, shape, law, False, count, instructions, *kernel(100, shape, law, count, instructions))
plot(rows, os.path.join(sys.argv[1], 'throughput.png'))
