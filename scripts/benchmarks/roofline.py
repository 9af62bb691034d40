#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Each rate of throughput.csv as a part of what the machine's arithmetic and memory allow, and where the instructions of
the cubic elastic case go.

    roofline.py <folder with throughput.csv, for machine.csv, roofline.csv, profile.csv and roofline.png>

Floating-point operations and instructions are counted (callgrind and the disassembly, AVX2), bytes are those of the arrays
that a step reads and writes when no cache holds them."""
import collections, csv, os, re, subprocess, sys
import callgrind

root = os.path.realpath(os.path.join(os.path.dirname(__file__), '..', '..'))
programs = os.path.join(os.environ.get('YADE_MPM_BUILD', os.path.join(root, 'build')), 'bin')
cases = [('linear', 'elastic'), ('quadratic', 'elastic'), ('cubic', 'elastic'), ('cubic', 'yielding')]
passes = [('stress', r'updateTileStress'), ('points to grid', r'pointsToGrid'), ('grid to points to grid', r'gridToPoints'), ('nodes', r'forEachNodeRange')]
folder = sys.argv[1]
across, steps = 100, 20


def machine():
    text = subprocess.run([os.path.join(programs, 'mpm_roofline')], check=True, capture_output=True, text=True).stdout
    with open(os.path.join(folder, 'machine.csv'), 'w') as file:
        file.write(text)
    return {int(row['threads']): row for row in csv.DictReader(text.splitlines())}


def counted(shape, law):
    """{(pass, kind): (instructions, operations)} a point and step."""
    program = os.path.join(programs, 'mpm_throughput')
    code = callgrind.instructions(program)
    sums = collections.defaultdict(lambda: [0, 0])
    for n, sign in (steps, 1), (0, -1):
        for function, addresses in callgrind.perAddress([program, str(across), shape, law, '1', str(n)], program, {'MPM_INSTRUCTIONS': 'avx2'}).items():
            name = next((name for name, pattern in passes if re.search(pattern, function)), 'other')
            for address, count in addresses.items():
                kind, operations = callgrind.classify(*code[address])
                sums[name, kind][0] += sign*count/(steps*across**2)
                sums[name, kind][1] += sign*count*operations/(steps*across**2)
    return sums


def bytesOf(law):
    """Bytes a point and step from and to memory, in plane stress without bodies: columns that are read, and written."""
    internal = 4 if law == 'yielding' else 0
    first = 2 + 2 + 2 + 1 + 1 + 4 + 3 + internal, 2 + 2 + 4 + 3 + internal # position, velocity, advance, mass, volume, F, stress; written but mass, velocity, volume
    second = 2 + 2 + 1, 2 + 2 # position, velocity, mass; velocity, advance
    grid = (7 + 7 + 5 + 4 + 4 + 2 + 2 + 3 + 2)*.25 # cleared, summed (read, written), updated, read by pass 2, new velocities summed and divided, read by pass 1
    return 8*(sum(first) + sum(second) + 2 + grid) + 4 # advance is read before it is written; index of the material


limits = machine()
with open(os.path.join(folder, 'throughput.csv')) as file:
    rates = list(csv.DictReader(file))
shown = []
with open(os.path.join(folder, 'roofline.csv'), 'w', newline='') as file, open(os.path.join(folder, 'profile.csv'), 'w', newline='') as profile:
    table, parts = csv.writer(file), csv.writer(profile)
    table.writerow(['where', 'points', 'shape', 'law', 'threads', 'rate', 'instructions', 'operations', 'bytes', 'part of peak operations', 'part of bandwidth', 'bound', 'part of bound'])
    parts.writerow(['shape', 'law', 'pass', 'kind', 'instructions', 'operations'])
    for shape, law in cases:
        sums = counted(shape, law)
        for (name, kind), (n, operations) in sorted(sums.items()):
            if n >= .5: parts.writerow([shape, law, name, kind, '%.0f' % n, '%.0f' % operations])
        n, operations = (sum(s[k] for s in sums.values()) for k in (0, 1))
        for row in rates:
            if (row['shape'], row['law'], row['bodies']) != (shape, law, 'False') or row['points'] not in ('10000', '1000000') or row['instructions'] == 'sse2': continue
            limit, rate = limits[int(row['threads'])], float(row['busy' if row['threads'] == '1' else 'rate'])
            compute, memory = rate*operations/float(limit['flops']), rate*bytesOf(law)/float(limit['bytes'])
            bound = 'memory' if memory > compute and row['points'] == '1000000' else 'arithmetic'
            part = memory if bound == 'memory' else compute
            table.writerow([row['where'], row['points'], shape, law, row['threads'], '%.3g' % rate, '%.0f' % n, '%.0f' % operations, '%.0f' % bytesOf(law),
                '%.2f' % compute, '%.2f' % memory, bound, '%.2f' % part])
            if row['threads'] == '1' and row['where'] == 'loop': shown.append((shape, law, row['points'], operations/bytesOf(law), rate*operations))

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy
figure, axes = plt.subplots(figsize=(6, 4))
intensity = numpy.geomspace(.25, 64, 50)
axes.loglog(intensity, numpy.minimum(float(limits[1]['flops']), intensity*float(limits[1]['bytes']))/1e9, 'k', label='one core')
for k, (shape, law, points, x, y) in enumerate(shown):
    axes.loglog(x, y/1e9, 'os'[points == '1000000'], color='C%d' % cases.index((shape, law)), label='%s, %s, %s points' % (shape, law, points))
axes.set(xlabel='operations a byte of memory', ylabel='1e9 operations / s')
axes.legend(fontsize=7)
figure.tight_layout()
figure.savefig(os.path.join(folder, 'roofline.png'), dpi=90)
