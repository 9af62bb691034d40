# SPDX-License-Identifier: GPL-2.0-or-later
"""Counting instructions and floating-point operations with valgrind's callgrind and objdump. Callgrind knows AVX2 at most."""
import collections, os, re, subprocess, tempfile


def run(command, options=(), environment=None, part=''):
    """Runs a command under callgrind; what it has written to its file, or to a part of it, as text."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        subprocess.run(['valgrind', '--tool=callgrind', '--callgrind-out-file=' + out, *options, *command],
                       env={**os.environ, **(environment or {})}, check=True, capture_output=True, text=True)
        with open(out + part) as file:
            return file.read()


def inclusive(command, functions, options=(), environment=None, between=None):
    """Instructions below each of some functions (regular expressions; the greatest match), and in all; with `between` those
    from the second to the third call of that function."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, 'out')
        with open(out, 'w') as file:
            file.write(run(command, [*options, '--dump-before=' + between] if between else options, environment, '.3' if between else ''))
        table = subprocess.run(['callgrind_annotate', '--inclusive=yes', '--threshold=100', out], check=True, capture_output=True, text=True).stdout
    counts = dict.fromkeys(functions, 0)
    for line in table.splitlines():
        match = re.match(r'\s*([\d,]+) \([^)]*\)\s+(.*)', line)
        if not match: continue
        count = int(match[1].replace(',', ''))
        if match[2].startswith('PROGRAM TOTALS'): counts['all'] = count
        for function in functions:
            if re.search(function, match[2]): counts[function] = max(counts[function], count)
    return counts


def perAddress(command, program, within, environment=None):
    """How often each instruction of a program was executed inside a function (name, or pattern): {function: {address: count}}."""
    text = run(command, ('--toggle-collect=' + within, '--dump-instr=yes', '--dump-line=no', '--compress-pos=no', '--compress-strings=no'), environment)
    counts = collections.defaultdict(collections.Counter)
    inside, function, skip = False, None, False
    for line in text.splitlines():
        if line.startswith('ob='): inside = os.path.realpath(line[3:]) == os.path.realpath(program)
        elif line.startswith('fn='): function = line[3:]
        elif line.startswith('calls='): skip = True # the next line is what the called function cost
        elif line.startswith('0x'):
            if inside and not skip:
                address, count = line.split()
                counts[function][int(address, 16)] += int(count)
            skip = False
    return counts


def instructions(program):
    """{address: (mnemonic, operands)} of a program."""
    listing = subprocess.run(['objdump', '-d', '--no-show-raw-insn', '-M', 'att', program], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in listing.splitlines():
        match = re.match(r'\s*([0-9a-f]+):\s+(\S+)\s*(.*)', line)
        if match: found[int(match[1], 16)] = (match[2], match[3])
    return found


arithmetic = re.compile(r'v?(fn?m(?:add|sub)(?:132|213|231)|add|sub|mul|div|sqrt|max|min)([ps])d$')
shuffles = re.compile(r'v?(perm|unpck|shuf|insert|extract|broadcast|blend|pbroadcast|movddup|movhlps|movlhps|hadd|gather|cvt)')


def classify(mnemonic, operands):
    """Kind of an instruction and its floating-point operations in double precision; a fused one counts as two."""
    match = arithmetic.match(mnemonic)
    if match:
        lanes = 1 if match[2] == 's' else 8 if 'zmm' in operands else 4 if 'ymm' in operands else 2
        return 'arithmetic', lanes*(2 if match[1].startswith('f') else 1)
    if shuffles.match(mnemonic): return 'arranging lanes', 0
    if re.match(r'v?mov', mnemonic) and '(' in operands: return 'loads and stores', 0
    if mnemonic.startswith('v') or 'mm' in operands: return 'other vector', 0
    return 'addresses and branches', 0
