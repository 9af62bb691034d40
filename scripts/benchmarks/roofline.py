#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Each rate of throughput.csv as a part of what the machine's arithmetic and memory allow, and where the instructions of
the cubic elastic case go.

    roofline.py <folder with throughput.csv, for machine.csv, roofline.csv and .png, profile.csv and .png>

Floating-point operations and instructions are counted (callgrind and the disassembly, AVX2); bytes are those of the arrays
that a step reads and writes when no cache holds them. The bound is the lesser of peak operations and, for 1e6 points, of
bandwidth times operations a byte."""
import collections, csv, datetime, os, re, subprocess, sys
import callgrind
from throughput import cases, root, sets, usual

programs = os.path.join(os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build')), 'bin')
passes = [('stress', r'updateTileStress|updateBlock'), ('points to grid', r'pointsToGrid'), ('grid to points to grid', r'gridToPoints'), ('nodes', r'forEachNodeRange')]
kinds = ['arithmetic', 'loads and stores', 'arranging lanes', 'other vector', 'addresses and branches']
folder = sys.argv[1]
steps = 5


def machine():
    """{(instruction set, threads): measured limits}"""
    found, model = {}, next(line.split(':')[1].strip() for line in open('/proc/cpuinfo') if line.startswith('model name'))
    family = ', '.join('%s %s' % (name, next(line.split(':')[1].strip() for line in open('/proc/cpuinfo') if re.match(name + r'\s*:', line))) for name in ('cpu family', 'model'))
    with open(os.path.join(folder, 'machine.csv'), 'w', newline='') as file:
        table = csv.writer(file)
        table.writerow(['processor', 'date', 'threads', 'instructions', 'flops', 'bytes', 'cycles'])
        for instructions in sets[1:]:
            under = os.environ.get('MPM_BENCHMARK_UNDER', '').split()
            text = subprocess.run(under + [os.path.join(programs, 'mpm_roofline')], check=True, stdout=subprocess.PIPE, text=True, env={**os.environ, 'MPM_INSTRUCTIONS': instructions}).stdout
            for row in csv.DictReader(text.splitlines()):
                found[instructions, row['threads']] = {name: float(row[name]) for name in ('flops', 'bytes', 'cycles')}
                table.writerow(['%s (%s)' % (model, family), datetime.date.today().isoformat(), row['threads'], instructions] + ['%.3g' % float(row[name]) for name in ('flops', 'bytes', 'cycles')])
    return found


def counted(dim, shape, law):
    """{(pass, kind): (instructions, operations)} a point and step."""
    program = os.path.join(programs, 'mpm_throughput')
    code = callgrind.instructions(program)
    sums = collections.defaultdict(lambda: [0, 0])
    command = [program, str(usual[dim]), str(dim), shape, law, '1', str(steps)]
    for function, addresses in callgrind.perAddress(command, program, 'measured(*', {'MPM_INSTRUCTIONS': 'avx2'}).items():
        name = next((name for name, pattern in passes if re.search(pattern, function)), 'other')
        for address, count in addresses.items():
            kind, operations = callgrind.classify(*code[address])
            sums[name, kind][0] += count/(steps*usual[dim]**dim)
            sums[name, kind][1] += count*operations/(steps*usual[dim]**dim)
    return sums


def bytesOf(dim, law):
    """Bytes a point and step from and to memory, without bodies: columns that are read, and written."""
    stress, internal = (3, 4) if dim == 2 else (6, 7)
    if law == 'elastic': internal = 0
    first = (3*dim + 2 + dim**2 + stress + internal, 2*dim + dim**2 + stress + internal) # position, velocity, advance, mass, volume, F, stress; of these written: position, advance, F, stress
    second = (3*dim + 1, 2*dim) # position, velocity, mass, advance (before it is written); velocity, advance
    # of a node: all fields cleared, mass, momentum and force added to (read, written) and updated, momentum and force read by the
    # second pass, new velocities added to and divided, read by the next first pass
    nodes = ((1 + 3*dim) + 2*(1 + 2*dim) + (1 + 4*dim) + 2*dim + 2*dim + (1 + 2*dim) + dim)/2**dim
    return 8*(sum(first) + sum(second) + nodes) + 4 # index of the material


limits = machine()
with open(os.path.join(folder, 'throughput.csv')) as file:
    rates = list(csv.DictReader(file))
shown, profile = [], {}
with open(os.path.join(folder, 'roofline.csv'), 'w', newline='') as file, open(os.path.join(folder, 'profile.csv'), 'w', newline='') as parts:
    table, profiles = csv.writer(file), csv.writer(parts)
    table.writerow(['where', 'dimension', 'points', 'shape', 'law', 'threads', 'set', 'rate', 'instructions', 'operations', 'bytes', 'instructions a cycle',
        'part of peak operations', 'part of bandwidth', 'bound'])
    profiles.writerow(['dimension', 'shape', 'law', 'pass', 'kind', 'instructions', 'operations'])
    for case in cases:
        dim, shape, law = case
        sums = profile[case] = counted(*case)
        for (name, kind), (n, operations) in sorted(sums.items()):
            if n >= .5: profiles.writerow([*case, name, kind, '%.0f' % n, '%.0f' % operations])
        n, operations = (sum(s[k] for s in sums.values()) for k in (0, 1))
        for row in rates:
            large = row['points'] == '1000000'
            if (int(row['dimension']), row['shape'], row['law'], row['bodies']) != (*case, 'False') or row['instructions'] == 'sse2': continue
            if not large and int(row['points']) != usual[dim]**dim: continue
            limit, rate = limits[row['instructions'], row['threads']], float(row['busy' if row['threads'] == '1' else 'rate'])
            compute, memory = rate*operations/limit['flops'], rate*bytesOf(dim, law)/limit['bytes']
            table.writerow([row['where'], dim, row['points'], shape, law, row['threads'], row['instructions'], '%.3g' % rate, '%.0f' % n, '%.0f' % operations, '%.0f' % bytesOf(dim, law),
                '%.2f' % (rate*n/limit['cycles']/int(row['threads'])) if row['instructions'] == 'avx2' else '', '%.2f' % compute, '%.2f' % memory if large else '',
                'memory' if large and memory > compute else 'arithmetic'])
            if row['threads'] == '1' and row['where'] == 'loop' and row['instructions'] == sets[-1]: shown.append((case, large, operations/bytesOf(dim, law), rate*operations))

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy
figure, axes = plt.subplots(figsize=(6, 4))
intensity = numpy.geomspace(.25, 64, 50)
for (instructions, threads), limit in limits.items():
    if threads != '1': continue
    axes.loglog(intensity, numpy.minimum(limit['flops'], intensity*limit['bytes'])/1e9, 'k', ls='-' if instructions == 'avx512' else '--', lw=1, label='one core, ' + instructions)
for case, large, x, y in shown:
    axes.loglog(x, y/1e9, 'os'[large], color='C%d' % cases.index(case), label='%dD %s, %s, 1e%d points' % (*case, 6 if large else 4))
axes.set(xlabel='operations a byte of memory', ylabel='1e9 operations / s')
axes.legend(fontsize=6)
axes.grid(alpha=.3)
figure.tight_layout()
figure.savefig(os.path.join(folder, 'roofline.png'), dpi=90)

figure, both = plt.subplots(1, 2, figsize=(10, 3.2))
for axes, dim in zip(both, (2, 3)):
    sums = profile[dim, 'cubic', 'elastic']
    names = [name for name, _ in passes] + ['other']
    left = numpy.zeros(len(names))
    for kind in kinds:
        width = numpy.array([sums.get((name, kind), (0, 0))[0] for name in names])
        axes.barh(names, width, left=left, label=kind)
        left += width
    axes.invert_yaxis()
    axes.set(xlabel='instructions a point and step (AVX2)', title='%dD, cubic, elastic' % dim)
both[0].legend(fontsize=7)
figure.tight_layout()
figure.savefig(os.path.join(folder, 'profile.png'), dpi=90)
