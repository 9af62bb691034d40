# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples of grains and material points run, with few grains and steps, and leave what they say.

A handful of grains dents the plate, the rebound of a stiff block is complete to 1 %, the column rests on the grains with part of
its weight and has begun to sink.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

rows = example('grains_on_plate', '--grains', '6', '--time', '.02')
check('grains have dented the plate', rows[-1]['deflection_m'] > 1e-3 and rows[-1]['mpmDissipation_J'] > 0 and max(r['contacts'] for r in rows) > 0, rows[-1])
check('they have lost energy to it', rows[-1]['grainsKinetic_J'] < .95*rows[0]['grainsKinetic_J'], (rows[0], rows[-1]))
rows = example('sphere_rebound', '--young', '1e7', '--time', '.1')
near('a sphere rebounds from a stiff block', rows[-1]['velocity_m_s'], .986, .005)
total = lambda r: r['sphere_J'] + r['contact_J'] + r['blockKinetic_J'] + r['blockElastic_J']
near('and energy is kept', total(rows[-1])/total(rows[0]), 1, .01)
rows = example('column_on_grains', '--points', '8', '--time', '.3')
check('the column sinks and spreads', rows[-1]['height_m'] < .95 and rows[-1]['front_m'] > .52, rows[-1])
weight = 1800*.5*.1*9.81
check('the grains carry its weight', .5*weight < sum(r['forceOnSoil_N'] for r in rows[5:])/len(rows[5:]) < 1.5*weight, [r['forceOnSoil_N'] for r in rows])
finish()
