# SPDX-License-Identifier: GPL-2.0-or-later
"""Carries out doc/add-a-law.md on a copy of the kernel: writes its files, enters the law in the list, compiles and runs its test.

    add_a_law.py SOURCE_DIR WORK_DIR COMPILER FLAGS...
"""
import os
import re
import shutil
import subprocess
import sys

source, work, compiler, *flags = sys.argv[1:]
page = open(os.path.join(source, 'doc', 'add-a-law.md')).read()
blocks = dict(re.findall(r'^`([\w/.]+)`:\n\n```cpp\n(.*?)^```', page, re.M | re.S))
law, test = 'pkg/mpm/kernel/laws/PerfectlyPlastic.hpp', 'tests/kernel/PerfectlyPlasticTest.cpp'
entry = re.search(r'^using Model = .*;$', page, re.M).group()

shutil.rmtree(work, ignore_errors=True)
shutil.copytree(os.path.join(source, 'pkg/mpm/kernel'), os.path.join(work, 'pkg/mpm/kernel'))
os.makedirs(os.path.join(work, 'tests/kernel'))
for path in law, test:
	with open(os.path.join(work, path), 'w') as file: file.write(blocks[path])

path = os.path.join(work, 'pkg/mpm/kernel/laws/Law.hpp')
text = open(path).read()
old = re.search(r'^using Model = .*;$', text, re.M).group()
names = [re.search(r'<(.*)>', line).group(1).split(', ') for line in (old, entry)]
if names[1] != names[0] + ['PerfectlyPlastic']: sys.exit('doc/add-a-law.md, step 2: the list is not that of Law.hpp and the new law')
text = text.replace(old, entry).replace('#include "J2.hpp"\n', '#include "J2.hpp"\n#include "PerfectlyPlastic.hpp"\n')
with open(path, 'w') as file: file.write(text)

program = os.path.join(work, 'test')
kernel = os.path.join(work, 'pkg/mpm')
subprocess.run([compiler, *flags, '-I' + kernel, os.path.join(work, test), os.path.join(kernel, 'kernel/laws/Law.cpp'),
	os.path.join(kernel, 'kernel/PointDriver.cpp'), '-o', program], check=True)
subprocess.run([program], check=True)
print('doc/add-a-law.md: the example compiles and runs')
