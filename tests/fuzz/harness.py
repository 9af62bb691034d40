# SPDX-License-Identifier: GPL-2.0-or-later
"""What the three fuzzers share: a case runs in a process of its own, under limits of time and memory; a signal, a hang or a fault that
the case reports is a finding. A case is a function of its seed alone: SCRIPT SEED runs one, SCRIPT SEED COUNT runs so many in a row.
"""
import os
import random
import re
import resource
import select
import signal
import sys
import time
import traceback

seconds, memory = 30, 4 << 30  # of a case


def isolated(case, seed):
	"""What is wrong with this case, or an empty text."""
	reader, writer = os.pipe()
	pid = os.fork()
	if pid == 0:
		said = 'ended without a word'
		try:
			os.close(reader)
			resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
			resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
			null = os.open(os.devnull, os.O_WRONLY)
			os.dup2(null, 1), os.dup2(null, 2)
			said = case(random.Random(seed)) or ''
		except BaseException: said = traceback.format_exc()
		finally:
			os.write(writer, said.encode(errors='replace')[:60000])
			os._exit(0)
	os.close(writer)
	text, until = b'', time.monotonic() + seconds
	while True:
		ready, _, _ = select.select([reader], [], [], max(0, until - time.monotonic()))
		if not ready:
			os.kill(pid, signal.SIGKILL)
			os.waitpid(pid, 0)
			os.close(reader)
			return 'hangs: more than %d s' % seconds
		part = os.read(reader, 65536)
		if not part: break
		text += part
	os.close(reader)
	_, status = os.waitpid(pid, 0)
	if os.WIFSIGNALED(status): return 'signal %d (%s)' % (os.WTERMSIG(status), signal.Signals(os.WTERMSIG(status)).name)
	return text.decode(errors='replace')


def main(case):
	"""Runs the seeds that the command line names, prints each finding, and leaves with status 1 if there were any."""
	first, count = int(sys.argv[1]) if len(sys.argv) > 1 else 0, int(sys.argv[2]) if len(sys.argv) > 2 else 1
	found = 0
	for seed in range(first, first + count):
		fault = isolated(case, seed)
		if not fault: continue
		found += 1
		print('FINDING %s seed %d: %s' % (os.path.basename(sys.argv[0]), seed, fault), flush=True)
	print('%s: %d cases from seed %d, %d findings' % (os.path.basename(sys.argv[0]), count, first, found), flush=True)
	sys.stdout.flush()
	os._exit(1 if found else 0)


# Complaints must name an object, an attribute or point, and say what to do.
_objects = re.compile(r"(MpmEngine|MpmWall|MpmPoints|MpmVtkRecorder|MpmState|mpm\.\w+|O\.\w+|material point|BoucWenMat|J2Mat|DruckerPragerMat|MohrCoulombMat|FrictMat|ElastMat|Material)")
_remedies = re.compile(r'\b(give|choose|set|use|put|reduce|check|make|place|turn|load|fill|look|move|enlarge|keep|run|release|apply|leave|append|start|add)\b', re.I)


def complaint(fault):
	"""What an exception's text lacks, or an empty text."""
	text = str(fault)
	if isinstance(fault, MemoryError): return ''
	if 'C++ signature' in text or 'No registered converter' in text or isinstance(fault, (AttributeError, OverflowError)): return ''  # a value of the wrong type, refused by the assignment
	lacks = [what for what, there in (('an object', _objects.search(text)), ('a remedy', _remedies.search(text))) if not there]
	return 'the complaint lacks %s: %s: %s' % (' and '.join(lacks), type(fault).__name__, text) if lacks else ''
