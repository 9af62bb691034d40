# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a verification case: printed, checked against bounds, and written into the case's page in doc/verification."""
import os
import re
import sys

import matplotlib
matplotlib.use('Agg')

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..', '..'))
PAGES = os.path.join(ROOT, 'doc', 'verification')
FIGURES = os.path.join(PAGES, 'figures')
DATA = os.path.join(ROOT, 'tests', 'data')


def runSampled(steps, every, sample):
	"""Run `steps` steps and call sample() after every `every`-th: a PyRunner costs microseconds, a call of O.run milliseconds."""
	import __main__
	from yade.wrapper import Omega, PyRunner
	__main__.sampleNow = sample
	O = Omega()
	O.engines = O.engines + [PyRunner(command='sampleNow()', iterPeriod=every)]
	O.run(steps, True)


class Report:
	"""A table, one row a result. finish() puts it between the page's marks and exits with 1 if a bound was passed."""

	def __init__(self, page, *columns):
		self.page, self.rows, self.failures = page, [columns], 0

	def row(self, *cells, bounds=()):
		"""bounds: (what, value, bound) with abs(value) <= bound wanted."""
		for what, value, bound in bounds:
			if not abs(value) <= bound:
				self.failures += 1
				print('FAIL %s: %s is %.4g, beyond its bound %.4g' % (self.page, what, value, bound), flush=True)
		self.rows.append(cells)
		print('  ' + ' | '.join(str(c) for c in cells), flush=True)

	def finish(self):
		lines = ['| ' + ' | '.join(str(c) for c in row) + ' |' for row in self.rows]
		lines.insert(1, '|' + '---|'*len(self.rows[0]))
		path = os.path.join(PAGES, self.page + '.md')
		with open(path) as f: text = f.read()
		marked = re.compile('(<!-- results -->\n).*?(<!-- end of results -->)', re.S)
		if not marked.search(text): raise RuntimeError('%s has no marks <!-- results --> and <!-- end of results -->' % path)
		with open(path, 'w') as f: f.write(marked.sub(lambda m: m.group(1) + '\n'.join(lines) + '\n' + m.group(2), text))
		print('%s: %s' % (self.page, 'all within bounds' if not self.failures else '%d beyond bounds' % self.failures), flush=True)
		sys.stdout.flush()
		os._exit(1 if self.failures else 0)
