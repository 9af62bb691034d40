#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Points times steps a second [1/s] of blocks of points: inside YADE's loop and of the kernel alone.

    throughput.py <folder for throughput.csv and .png>

Columns: where (loop, kernel), dimension, points, shape, law, bodies, threads, instructions (the set in use), rate and busy (of
wall and of CPU time, which other work on the machine disturbs less; loop: the median of five parts of a run; kernel: of five
runs), bytes (memory a point, in the loop, by the growth of the process). MPM_BENCHMARK_UNDER is a command that each
measurement is started under: MPM_BENCHMARK_UNDER='taskset -c 1'."""
import csv, json, os, statistics, subprocess, sys

root = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
program = os.path.join(os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build')), 'bin', 'mpm_throughput')
cases = [(2, 'linear', 'elastic'), (2, 'quadratic', 'elastic'), (2, 'cubic', 'elastic'), (2, 'cubic', 'yielding'), (3, 'quadratic', 'elastic'), (3, 'cubic', 'elastic')]
sizes = {2: [19, 32, 100, 316, 1000], 3: [10, 22, 46, 100]}
usual = {2: 100, 3: 22} # about 1e4 points
threads = [1] + [2]*(os.cpu_count() > 1)
flags = set(open('/proc/cpuinfo').read().split())
sets = ['sse2'] + ['avx2']*('avx2' in flags) + ['avx512']*('avx512bw' in flags)


def output(command, **environment):
    under = os.environ.get('MPM_BENCHMARK_UNDER', '').split()
    return subprocess.run(under + command, env={**os.environ, **environment}, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def kernel(across, dim, shape, law, count, instructions):
    steps = max(10, (1000000 if dim == 2 else 300000)//across**dim)
    command = [program, str(across), str(dim), shape, law, str(count), str(steps)]
    runs = [output(command, MPM_INSTRUCTIONS=instructions).split() for _ in range(5)]
    return statistics.median(float(run[0]) for run in runs), statistics.median(float(run[1]) for run in runs), ''


def loop(across, dim, shape, law, count, instructions, bodies=False):
    command = [os.path.join(root, 'scripts/yade-mpm'), '-j%d' % count, '-n', '-x', os.path.join(root, 'scripts/benchmarks/scene.py'), str(across), str(dim), shape, law]
    lines = output(command + ['bodies']*bodies, MPM_INSTRUCTIONS=instructions).splitlines()
    result = json.loads(next(line for line in lines if line.startswith('{')))
    return result['rate'], result['busy'], result['bytes']


def plot(folder):
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    with open(os.path.join(folder, 'throughput.csv')) as file:
        rows = [row for row in csv.DictReader(file) if row['where'] == 'loop' and row['bodies'] == 'False' and row['instructions'] == sets[-1]]
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharex=True)
    for k, case in enumerate(cases):
        for count in threads:
            mine = [(int(row['points']), float(row['rate'])) for row in rows if (int(row['dimension']), row['shape'], row['law'], int(row['threads'])) == (*case, count)]
            style = dict(color='C%d' % k, marker='o', ms=3, ls='-' if count == 1 else '--')
            axes[0].loglog([n for n, rate in mine], [n/rate for n, rate in mine], **style)
            axes[1].semilogx([n for n, rate in mine], [rate/1e6 for n, rate in mine], **style)
    axes[0].set(xlabel='points', ylabel='time of a step [s]')
    axes[1].set(xlabel='points', ylabel='million points x steps a second', ylim=(0, None))
    for ax in axes: ax.grid(alpha=.3)
    handles = [plt.Line2D([], [], color='C%d' % k, label='%dD %s, %s' % case) for k, case in enumerate(cases)]
    handles += [plt.Line2D([], [], color='k', ls=style, label=name) for style, name in (('-', 'one thread'), ('--', 'two threads'))]
    figure.tight_layout(rect=(0, .14, 1, 1))
    figure.legend(handles=handles, fontsize=8, ncol=4, loc='lower center')
    figure.savefig(os.path.join(folder, 'throughput.png'), dpi=90)


if __name__ == '__main__':
    with open(os.path.join(sys.argv[1], 'throughput.csv'), 'w', newline='') as file:
        table = csv.writer(file)
        table.writerow(['where', 'dimension', 'points', 'shape', 'law', 'bodies', 'threads', 'instructions', 'rate', 'busy', 'bytes'])

        def add(where, across, dim, shape, law, count, instructions, bodies=False):
            rate, busy, memory = loop(across, dim, shape, law, count, instructions, bodies) if where == 'loop' else kernel(across, dim, shape, law, count, instructions)
            table.writerow([where, dim, across**dim, shape, law, bodies, count, instructions, '%.3g' % rate, '%.3g' % busy, memory and '%.0f' % memory])
            file.flush()

        for dim, shape, law in cases:
            for across in sizes[dim]:
                for count in threads:
                    add('loop', across, dim, shape, law, count, sets[-1])
            if 'avx512' in sets: add('loop', usual[dim], dim, shape, law, 1, 'avx2')
        for law in 'elastic', 'yielding':
            add('loop', usual[2], 2, 'cubic', law, 1, sets[-1], bodies=True)
        for dim, shape, law in cases + [(2, 'cubic', 'spinning'), (3, 'cubic', 'yielding')]:
            for instructions in sets:
                add('kernel', usual[dim], dim, shape, law, 1, instructions)
    plot(sys.argv[1])
