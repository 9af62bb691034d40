#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Describes a YADE program, for CMake:  describe.py PROGRAM [SOURCE_TREE]

Prints one `name=value` per line (lists separated by semicolons) or, if yade-mpm cannot be built for this YADE, one
sentence with the reason and the remedy; the exit code is then 1.

The description comes from the program's own yade/config.py. The start script of YADE is run by its own interpreter up
to its first import of the package yade, so that no library is loaded. A program that is not a Python script (a wrapper)
is started with this file as its script."""
import importlib.machinery
import os
import re
import subprocess
import sys
import tempfile

# The releases whose classes pkg/yade declares, and the features that the layout of these classes assumes.
DECLARED_VERSIONS = ('2023.02a', '2025.2.0', '2026.1.0')
DECLARED_WITH = ('OPENMP', 'MPI', 'QT5', 'FEMLIKE')
DECLARED_WITHOUT = ('SPH', 'LIQMIGRATION', 'DEFORM')

# What YADE's headers ask about the library that they are compiled for: feature -> macros.
# YADE_CGAL is left out: it adds numeric traits for CGAL and nothing that a plugin of this kind uses.
MACROS = {
    'OPENMP': ['YADE_OPENMP'],
    'MPI': ['YADE_MPI'],
    'QT5': ['YADE_OPENGL', 'YADE_QT5', 'QT_NO_KEYWORDS'],
    'QT6': ['YADE_OPENGL', 'YADE_QT6', 'QT_NO_KEYWORDS'],
    'FEMLIKE': ['YADE_FEM'],
    'LOGGER': ['YADE_BOOST_LOG', 'BOOST_LOG_DYN_LINK'],
    'COMPLEX_MP': ['YADE_COMPLEX_MP'],
    'MPFR': ['YADE_MPFR'],
    'VTK': ['YADE_VTK'],
    'GTS': ['YADE_GTS'],
    'LS_DEM': ['YADE_LS_DEM'],
    'SPH': ['YADE_SPH'],
    'DEFORM': ['YADE_DEFORM'],
    'LIQMIGRATION': ['YADE_LIQMIGRATION'],
    'POTENTIAL_PARTICLES': ['YADE_POTENTIAL_PARTICLES'],
    'POTENTIAL_BLOCKS': ['YADE_POTENTIAL_BLOCKS'],
    'PROFILING': ['USE_TIMING_DELTAS', 'ISC_TIMING'],
}

MARK = '@yade-mpm '


class Refusal(Exception):
    """The sentence for the user."""


def facts(config):
    """Inside the program's interpreter: what its config.py and this Python say."""
    import sysconfig
    return dict(
        version=config['version'],
        suffix=config.get('suffix', ''),
        prefix=os.path.abspath(config['prefix']),
        library_dir=os.path.abspath(config['libDir']),
        features=';'.join(sorted(set(feature for feature in config['features'] if feature))),
        real_bits=config.get('highPrecisionBits', 64),
        real_digits=config.get('highPrecisionDecimalPlaces', 15),
        real_name=config.get('highPrecisionName', 'PrecisionDouble'),
        multiple_precisions=int(bool(config.get('highPrecisionMpmath', True))),
        source_root=config.get('sourceRoot', ''),
        python=sys.executable,
        python_version='%d.%d' % sys.version_info[:2],
        python_include=sysconfig.get_path('include'),
        python_library_dir=sysconfig.get_config_var('LIBDIR') or '',
    )


def tell(description):
    for name, value in description.items():
        sys.__stdout__.write('%s%s=%s\n' % (MARK, name, value))
    sys.__stdout__.flush()


class ReachedImport(BaseException):
    """Not an Exception: a start script that expects errors must not catch it."""


class StopAtYade:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if name == 'yade': raise ReachedImport


def inside(program):
    """Runs the start script as far as its import of yade, finds the package where the script would, reads its config.py."""
    import runpy
    sys.meta_path.insert(0, StopAtYade)
    sys.argv = [program, '-n', '-x']
    sys.stdout = sys.stderr
    try:
        runpy.run_path(program, run_name='__main__')
    except ReachedImport:
        pass
    else:
        raise RuntimeError('it does not import yade')
    sys.meta_path.remove(StopAtYade)
    package = importlib.machinery.PathFinder.find_spec('yade', sys.path)
    if package is None or not package.origin: raise RuntimeError('its Python package yade is missing')
    config = os.path.join(os.path.dirname(package.origin), 'config.py')
    if not os.path.isfile(config): raise RuntimeError(config + ' is missing')
    tell(facts(runpy.run_path(config)))


def describe(program):
    if not os.path.isfile(program):
        raise Refusal('there is no YADE program %s: install YADE (apt-get install yade python3-yade libyade), or name the program with -DYADE=<path>' % program)
    if not os.access(program, os.X_OK): raise Refusal('%s cannot be executed: name a YADE program with -DYADE=<path>' % program)
    with open(program, 'rb') as file:
        first = file.readline(300).decode(errors='replace')
    shebang = re.match(r'#!\s*(\S+(?:\s+\S*python\S*)?)', first)
    if shebang and 'python' in shebang.group(1):
        command = shebang.group(1).split() + [os.path.abspath(__file__), '--inside', program]
    else:
        command = [program, '-n', '-x', os.path.abspath(__file__)]
    with tempfile.TemporaryDirectory() as home:
        # config.py makes or moves folders in the user's home: not for a question.
        environment = dict(os.environ, HOME=home, XDG_CONFIG_HOME=home, PYTHONDONTWRITEBYTECODE='1')
        environment.pop('YADE_PREFIX', None)
        environment.pop('DISPLAY', None)
        try:
            done = subprocess.run(command, env=environment, cwd=home, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors='replace', timeout=120)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Refusal('the YADE program %s cannot be started (%s): install it anew, or name another with -DYADE=<path>' % (program, error))
    found = dict(line[len(MARK):].split('=', 1) for line in done.stdout.splitlines() if line.startswith(MARK))
    if 'version' not in found:
        reason = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        raise Refusal('%s does not start as a YADE program (%s): install YADE completely (apt-get install yade python3-yade libyade), or name another with -DYADE=<path>'
            % (program, reason[-1].rstrip('.') if reason else 'exit code %d, no message' % done.returncode))
    found['program'] = os.path.abspath(program)
    return found


def sourceVersion(tree):
    """As YADE's own build forms it: the file RELEASE, or date and hash of the last commit."""
    try:
        with open(os.path.join(tree, 'RELEASE')) as file:
            return file.read().strip()
    except OSError:
        pass
    if os.path.exists(os.path.join(tree, '.git')):
        try:
            log = subprocess.run(['git', '-c', 'safe.directory=*', '-C', tree, 'log', '-n1', '--format=%ad.git-%H', '--date=format:%Y-%m-%d'], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            stamp = re.match(r'(.*\.git-.{7})', log.stdout)
            if stamp: return stamp.group(1)
        except OSError:
            pass
    return 'Unknown'


def isSourceTree(folder):
    return all(os.path.isfile(os.path.join(folder, *path)) for path in (('core', 'GlobalEngine.hpp'), ('lib', 'serialization', 'Serializable.hpp')))


def judge(found, source):
    """Refuses what the plugin cannot be built for, and adds how to compile: the source tree ('' for pkg/yade) and macros."""
    program, version, features = found['program'], found['version'], found['features'].split(';')
    for library in ('libyade.so', 'libpkg_common.so'):
        if not os.path.isfile(os.path.join(found['library_dir'], library)):
            raise Refusal('YADE %s is installed in part only: %s/%s is missing; install it (apt-get install libyade), or name another program with -DYADE=<path>'
                % (version, found['library_dir'], library))
    if found['real_bits'] != '64':
        raise Refusal('%s computes with numbers of %s bits (%s), and yade-mpm needs double, 64 bits: name a YADE of double precision with -DYADE=<path>'
            % (program, found['real_bits'], found['real_name']))
    for feature, option, why in (
            ('MPI', '-DENABLE_MPI=ON', 'bodies without it have no subdomain'),
            ('VTK', '-DENABLE_VTK=ON', 'MpmVtkRecorder uses its libraries')):
        if feature not in features:
            raise Refusal('%s (YADE %s) was built without %s, and yade-mpm needs it (%s): build YADE with %s, or name another program with -DYADE=<path>'
                % (program, version, feature, why, option))
    if 'VECTORIZE' in features:
        raise Refusal('%s (YADE %s) was built with vectorised Eigen types, whose memory layout yade-mpm does not share: build YADE without -DVECTORIZE=ON' % (program, version))
    if 'MASK_ARBITRARY' in features:
        raise Refusal('%s (YADE %s) was built with arbitrary masks, whose size its config.py does not hold: build YADE without -DENABLE_MASK_ARBITRARY=ON' % (program, version))

    if source and not isSourceTree(source):
        raise Refusal('%s is no source tree of YADE: it has no core/GlobalEngine.hpp and lib/serialization/Serializable.hpp; name the tree that %s was built from' % (source, program))
    if not source and found['source_root'] and isSourceTree(found['source_root']): source = found['source_root']
    if source:
        source = os.path.abspath(source)
        if sourceVersion(source) != version:
            raise Refusal('%s is YADE %s and the source tree %s is of version %s: name the tree that this program was built from, or build YADE anew from it'
                % (program, version, source, sourceVersion(source)))
        macros = ['YADE_REAL_BIT=' + found['real_bits'], 'YADE_REAL_DEC=' + found['real_digits'], 'YADE_ODEINT', 'MAX_LOG_LEVEL=5']
        for feature in features:
            macros += MACROS.get(feature, [])
        if found['multiple_precisions'] == '0': macros.append('YADE_DISABLE_REAL_MULTI_HP')
        found['macros'] = ';'.join(macros)
    else:
        remedy = 'name the source tree that it was built from with -DYADE_SOURCE_DIR=<path>'
        if version not in DECLARED_VERSIONS:
            raise Refusal('%s is YADE %s, and pkg/yade declares the classes of %s: %s, or port pkg/yade (see its README)'
                % (program, version, ', '.join(DECLARED_VERSIONS), remedy))
        lacking = [feature for feature in DECLARED_WITH if feature not in features]
        foreign = [feature for feature in DECLARED_WITHOUT if feature in features]
        if lacking or foreign:
            raise Refusal('%s (YADE %s) was built %s, which changes the classes that pkg/yade declares: %s'
                % (program, version, ' and '.join(['without ' + feature for feature in lacking] + ['with ' + feature for feature in foreign]), remedy))
        found['macros'] = ''
    found['source'] = source
    # one number to compare in pkg/yade: 2023.02a -> 202302, 2025.2.0 -> 202502; 0: none of the releases declared there
    number = re.match(r'(\d+)\.(\d+)', version) if version in DECLARED_VERSIONS else None
    found['declared_version'] = '%d%02d' % (int(number.group(1)), int(number.group(2))) if number else '0'


def main(arguments):
    if arguments[:1] == ['--inside']:
        inside(arguments[1])
        return 0
    if not 1 <= len(arguments) <= 2: sys.exit(__doc__)
    try:
        found = describe(arguments[0])
        judge(found, arguments[1] if len(arguments) > 1 else '')
    except Refusal as refusal:
        sys.stderr.write('yade-mpm: %s.\n' % refusal)
        return 1
    for name, value in found.items():
        print('%s=%s' % (name, value))
    return 0


if 'yade.config' in sys.modules and '--inside' not in sys.argv: # started as a script of the program
    tell(facts(vars(sys.modules['yade.config'])))
elif __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
