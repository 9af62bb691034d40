# SPDX-License-Identifier: GPL-2.0-or-later
"""Order of accuracy in large deformation, through the engine: a manufactured solution in plane stress.

Unit square between slip walls, E = 1e7 Pa, nu = 0.3, rho = 1000 kg/m3, c = sqrt(E/rho) = 100 m/s; with amplitude G

	u = G sin(pi X) sin(pi c t),   v = G sin(pi Y) sin(pi c t + pi),   Fx = 1 + du/dX,   Fy = 1 + dv/dY

The law is hypoelastic, sigma_xx = E/(1-nu^2) (ln Fx + nu ln Fy), the thickness is kept, so P_xx = sigma_xx Fy and the body
force a unit mass that makes it so is b_x = pi^2 u [E Fy/(rho (1-nu^2) Fx) - c^2], b_y with x and y exchanged. The forces come as a
user's would: a PyRunner hands m b to O.forces each step. Two points a cell and axis, dt = 0.2 h/c, one period T = 0.02 s, MUSL, FLIP,
cubic splines. error = greatest over the steps of sqrt(sum V_p |x_p - x_exact|^2) [m2] (unit thickness), V_p current.

After the one-dimensional problem of Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628. The rows are an independent
NumPy implementation's, which sums strains by forward Euler; this one takes them at mid-step. At G = 0.05 they differ by
the error of that sum, which vanishes with the time step: 1.1 % at h = 1/16. So 2 %; at G = 1e-4 there is no such
difference and 0.1 % holds. Second order: halving h divides the error by four; on these coarse grids by 2^1.9 at least
from h = 1/8 to 1/16. With fullMass the order is four.
"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(sys.argv[0])))
from common import *

E, nu, rho, c, pi = 1e7, .3, 1000., 100., math.pi


def error(cells, G, **engine):
	h = 1./cells
	ids, grid = block(spacing=h/2, thickness=1., material=FrictMat(young=E, poisson=nu, density=rho), cellSize=h, courant=None, **engine,
		before=[PyRunner(iterPeriod=1, initRun=True, command='load()')],
		walls=[MpmWall(normal=n, origin=o, kind='slip') for n, o in (((1, 0, 0), (0, 0, 0)), ((-1, 0, 0), (1, 0, 0)), ((0, 1, 0), (0, 0, 0)), ((0, -1, 0), (0, 1, 0)))])
	O.dt = .2*h/c
	X, mass, sign = mpm.array('position')[:, :2], mpm.array('mass')[:, None], numpy.array([1, -1])
	for i, v in zip(ids, sign*pi*c*G*numpy.sin(pi*X)): O.bodies[i].state.vel = Vector3(v[0], v[1], 0)

	def displacement(t): return sign*G*math.sin(pi*c*t)*numpy.sin(pi*X)

	def load():
		u, F = displacement(O.time), 1 + pi*sign*G*math.sin(pi*c*O.time)*numpy.cos(pi*X)
		force = mass*pi**2*u*(E*F[:, ::-1]/(rho*(1 - nu**2)*F) - c**2)
		for i, f in zip(ids, force.tolist()): O.forces.addF(i, Vector3(f[0], f[1], 0))

	errors = []

	def look():
		wrong = mpm.array('position')[:, :2] - X - displacement(O.time + O.dt)  # the step's end: O.time is counted after the engines
		errors.append(math.sqrt((mpm.array('volume')[:, None]*wrong**2).sum()))

	import __main__
	__main__.load = load
	each_step(look)
	steps = round(.02/O.dt)
	O.run(steps, True)
	equal('h = 1/%d, G = %g: all steps are looked at' % (cells, G), len(errors), steps)
	return max(errors)


for G, wanted, tolerance in (1e-4, (1.0040e-4, 3.0662e-5, 7.7388e-6), .001), (.05, (5.1450e-2, 1.5697e-2, 3.8817e-3), .02):
	found = [error(cells, G) for cells in (4, 8, 16)]
	for cells, f, w in zip((4, 8, 16), found, wanted): near('h = 1/%d, G = %g: error %.4e' % (cells, G, f), f, w, tolerance*w)
	order = math.log2(found[1]/found[2])
	check('G = %g: order %.3f' % (G, order), 1.9 < order < 2.1)

# the full mass: order four
for G, part in (1e-4, .008), (.05, .014):
	lumped, found = error(16, G), [error(cells, G, fullMass=True) for cells in (4, 8, 16)]
	orders = [math.log2(a/b) for a, b in zip(found, found[1:])]
	check('G = %g, full mass: orders %.2f, %.2f' % (G, *orders), min(orders) > 3.5)
	check('G = %g, full mass: error %.3e of %.3e' % (G, found[-1], lumped), found[-1] < part*lumped)

finish()
