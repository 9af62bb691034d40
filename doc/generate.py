# SPDX-License-Identifier: GPL-2.0-or-later
"""Generates the pages of the manual on classes, functions and examples. scripts/doc runs it:

	scripts/yade-mpm -n -x doc/generate.py <folder>
"""
import ast
import glob
import inspect
import os
import re
import shutil
import sys

root = os.path.join(os.path.dirname(os.path.realpath(sys.argv[0])), '..')
folder = sys.argv[1]

import yade.wrapper
from yade import mpm


def text(doc):
	"""A docstring of YADE's as reStructuredText: its roles resolved, the rest taken literally."""
	doc = re.sub(r' ?:y(attrtype|attrflags|default):`[^`]*`', '', doc or '').strip()
	parts = re.split(r'(:yref:`[^`]*`|``[^`]*``)', doc)
	for k, part in enumerate(parts):
		if part.startswith(':yref:'): parts[k] = part.replace(':yref:', ':py:obj:')
		elif not part.startswith('``'):
			parts[k] = linked(re.sub(r'([*|\\]|_(?=\W|$))', r'\\\1', part), ':doc:`/%s`')
	return ''.join(parts)


def linked(text, link):
	"""doc/<page>.md and doc/<folder> of a docstring as links to pages of the manual."""
	def page(found):
		name = found.group(1)
		for candidate in name, name + '/README':
			if os.path.exists(os.path.join(root, 'doc', candidate + '.md')): return link % candidate
		return found.group(0)
	return re.sub(r'\bdoc/([a-z][a-z/-]*[a-z])(?:\.md)?\b', page, text)


def role(doc, name):
	found = re.search(r':%s:`([^`]*)`' % name, doc or '')
	return found.group(1).strip() if found else ''


def indent(lines, by='   '):
	return '\n'.join(by + line if line.strip() else '' for line in lines.splitlines())


def own(module):
	"""Classes of the plugin, bases first."""
	names = [n for n in re.findall(r'\((\w+)\)', open(os.path.join(root, 'pkg/mpm/Plugin.cpp')).read())]
	return [getattr(module, n) for n in names]


def first(doc):
	"""First sentence of an attribute's docstring, without YADE's roles."""
	plain = re.sub(r' ?:y(attrtype|attrflags|default):`[^`]*`', '', doc or '')
	plain = re.sub(r':y[a-z]+:`([^`]*)`', r'\1', plain)
	plain = re.sub(r':[a-z]+:`([^`]*)`', r'\1', plain).replace('|ycomp|', '').replace('|yupdate|', '')
	return text(re.split(r'(?<=[.\]])\s', ' '.join(plain.split()))[0])


def inherited(cls):
	"""Attributes of YADE's own classes above this one, the nearest first, as a list of definitions."""
	lines = []
	for base in cls.__mro__[1:]:
		if not base.__module__.startswith('yade') or base.__name__ == 'Serializable': break
		for name, item in sorted(vars(base).items()):
			if name.startswith('_') or name.startswith('disp') or not isinstance(item, property): continue
			kind, default = role(item.__doc__, 'yattrtype'), role(item.__doc__, 'ydefault')
			if not kind: continue
			default = re.sub(r'^\(\(void\)"[^"]*",(.*)\)$', r'\1', default)
			lines += ['``%s``: *%s*' % (name, kind) + (', default ``%s``' % default if default else '')]
			lines += [indent('%s (%s)' % (first(item.__doc__), base.__name__)), '']
	if issubclass(cls, yade.wrapper.Material):
		missing = [name for name in ('young', 'poisson', 'density', 'frictionAngle')
			if not any(line.startswith('``%s``' % name) for line in lines)]
		if missing: sys.exit('%s: the manual would not list %s' % (cls.__name__, ', '.join(missing)))
	return ['**Inherited attributes**', ''] + lines if lines else []


def classes():
	page = ['Classes', '=======', '']
	page += ['This page lists the classes of the running program with all attributes. ``help(MpmEngine)`` at the prompt'
		' shows the same text.', '']
	for cls in sorted(own(yade.wrapper), key=lambda c: (c.__name__ not in ('MpmEngine', 'MpmWall'), c.__name__)):
		base = cls.__bases__[0].__name__
		page += [cls.__name__, '-'*len(cls.__name__), '', '.. py:class:: %s(**attributes)' % cls.__name__, '']
		page += [indent('Derived from ``%s``.' % base), '', indent(text(cls.__doc__)), '']
		for name, item in vars(cls).items():
			if name.startswith('_') or name.startswith('disp'): continue
			if callable(item) and not isinstance(item, property):
				doc = [line for line in (item.__doc__ or '').strip().splitlines() if line.strip()]
				plain = ' '.join(line.strip() for line in doc if '->' not in line)
				page += [indent('.. py:method:: %s()' % name), '', indent(text(plain), ' '*6), '']
				continue
			kind, default = role(item.__doc__, 'yattrtype'), role(item.__doc__, 'ydefault')
			page += [indent('.. py:attribute:: %s' % name)] + ([indent('   :type: %s' % kind)] if kind else []) + ['']
			page += [indent(text(item.__doc__) + (' Default: ``%s``.' % default if default else ''), ' '*6), '']
		page += [indent('\n'.join(inherited(cls))), '']
	return '\n'.join(page)


def python():
	page = ['Python: ``from yade import mpm``', '='*32, '', '.. py:module:: mpm', '']
	for name in mpm.__all__:
		item = getattr(mpm, name)
		kind, signature = ('function', str(inspect.signature(item))) if inspect.isfunction(item) else ('class', '')
		doc = linked(re.sub(':yref:', ':py:obj:', inspect.getdoc(item)), ':doc:`/%s`')
		page += ['.. py:%s:: %s%s' % (kind, name, signature), '', indent(doc), '']
	return '\n'.join(page)


def gallery():
	"""Every example with its command and its picture; one without either is an error."""
	page = ['# Gallery', '', 'Each example writes its pictures and tables to the folder `out`.', '']
	os.makedirs(os.path.join(folder, 'gallery'), exist_ok=True)
	for script in sorted(glob.glob(os.path.join(root, 'scripts/examples/*.py'))):
		name = os.path.basename(script)[:-3]
		doc = ast.get_docstring(ast.parse(open(script).read())) or sys.exit('%s has no docstring' % script)
		commands = [line.strip() for line in doc.splitlines() if line.strip().startswith('scripts/')]
		if not commands: sys.exit('%s: its docstring has no command: add a line that starts with scripts/' % script)
		pictures = [p for p in ('gallery/%s.png' % name, 'verification/figures/%s.png' % name)
			if os.path.exists(os.path.join(root, 'doc', p))]
		if not pictures: sys.exit('%s has no picture: put the one that it writes into doc/gallery/%s.png' % (script, name))
		paragraph = lambda part: '\n'.join(line.strip() for line in part.splitlines())
		rest = [paragraph(part) for part in doc.split('\n\n')[1:] if not part.strip().startswith('scripts/')]
		page += ['## %s' % name, '', '**%s**' % paragraph(doc.split('\n\n')[0]), '', '```sh'] + commands
		page += ['```', '', '![%s](%s)' % (name, pictures[0]), '']
		page += [linked('\n\n'.join(rest).replace('*', '\\*'), '[this page](%s.md)'), '']
	return '\n'.join(page)


for name, page in ('classes.rst', classes), ('python.rst', python), ('gallery.md', gallery):
	with open(os.path.join(folder, name), 'w') as file: file.write(page())
