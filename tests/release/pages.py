#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Check the Markdown pages: links lead to files, and lines have at most 110 characters. README has at most 120 lines.

Tables that scripts write between <!-- name --> and <!-- end of name --> may be wider.
"""
import os
import re
import sys

root = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..')
pages = [os.path.relpath(os.path.join(folder, name), root) for folder, folders, names in os.walk(root)
	for name in names if name.endswith('.md') and not re.search(r'/(build|out|\.git)(/|$)', folder)]
faults = []
for page in sorted(pages):
	with open(os.path.join(root, page), encoding='utf-8') as file: text = file.read()
	prose = re.sub(r'^```.*?^```|^(?:    |\t).*?$|`[^`\n]*`', '', text, flags=re.M | re.S)
	for target in re.findall(r'\]\(([^)\s]+)\)', prose) + re.findall(r'^\[\d+\]: (\S+)', prose, re.M):
		path = target.split('#')[0]
		if path and '://' not in path and not os.path.exists(os.path.join(root, os.path.dirname(page), path)):
			faults.append('%s: link to %s: there is no such file' % (page, target))
	generated = False
	for number, line in enumerate(text.splitlines(), 1):
		if line.startswith('<!-- '): generated = not line.startswith('<!-- end of ')
		if len(line) > 110 and not generated: faults.append('%s:%d: %d characters; at most 110' % (page, number, len(line)))
with open(os.path.join(root, 'README.md')) as file: lines = len(file.readlines())
if lines > 120: faults.append('README.md: %d lines; at most 120' % lines)
print('\n'.join(faults) or '%d pages' % len(pages))
sys.exit(bool(faults))
