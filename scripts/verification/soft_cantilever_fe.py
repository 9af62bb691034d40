# SPDX-License-Identifier: GPL-2.0-or-later
"""References of the soft cantilever (V6): explicit finite elements with the law and kinematics of the kernel.

	python3 scripts/verification/soft_cantilever_fe.py 16 tests/data/soft_cantilever_fe.csv                                        (elements across the height)
	python3 scripts/verification/soft_cantilever_fe.py 8 tests/data/soft_cantilever_fe_3s.csv --time 3
	python3 scripts/verification/soft_cantilever_fe.py 6 tests/data/soft_cantilever_fe_6.csv --time 3 --gravity 6 --degree 2

4 x 1 m, E = 1 MPa, nu = 0.3, 1050 kg/m3, plane strain, clamped at x = 0, gravity at once. Squares of four nodes, four Gauss points, or with --degree 2 of
nine nodes, nine Gauss points; mass lumped at the nodes by Lobatto's weights, leapfrog at 0.4 h/c; strain increments and rotations of Hughes & Winget (1980) at
mid-step, Hooke's law for the increments. No points move through this mesh: what it shares with the material point method are the equations. Writes
the displacement of the material point (3.9, 0.5) every 0.01 s. Where the beam is folded up below its clamp elements turn inside out if they are fine
enough and gravity is 10 m/s2: of four nodes from ten across on, at 1.97 s, with twelve at 1.56 s, with sixteen at 1.2 s. The run ends there.
"""
import argparse
import csv
import sys

import numpy as np

YOUNG, POISSON, DENSITY, LENGTH, HEIGHT, WATCHED = 1e6, .3, 1050., 4., 1., (3.9, .5)
LAME, SHEAR = YOUNG*POISSON/(1 + POISSON)/(1 - 2*POISSON), YOUNG/2/(1 + POISSON)

parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
parser.add_argument('across', type=int, help='elements across the height')
parser.add_argument('file')
parser.add_argument('--gravity', type=float, default=10, help='[m/s2]')
parser.add_argument('--time', type=float, default=1.1, help='[s]')
parser.add_argument('--degree', type=int, choices=(1, 2), default=1, help='of the shape functions along an axis')
options = parser.parse_args()

DEGREE = options.degree
LINE = np.linspace(-1, 1, DEGREE + 1)
SHAPES = [np.poly1d(LINE[LINE != a], True)/np.prod(a - LINE[LINE != a]) for a in LINE]
LUMPED = np.array(((1, 1), (1, 4, 1))[DEGREE - 1])/(2, 6)[DEGREE - 1]


def product(along, across): return np.outer(along, across).ravel()  # the nodes of an element, those of a column one after the other


def slopes(x, y):
	"""dN_a/d(xi, eta)"""
	return np.stack([product([N.deriv()(x) for N in SHAPES], [N(y) for N in SHAPES]), product([N(x) for N in SHAPES], [N.deriv()(y) for N in SHAPES])], 1)


GAUSS = [(slopes(x, y), a*b) for x, a in zip(*np.polynomial.legendre.leggauss(DEGREE + 1)) for y, b in zip(*np.polynomial.legendre.leggauss(DEGREE + 1))]


def gradients(x, slopes):
	"""grad N_a and the Jacobian's determinant for elements with nodes at x (elements, nodes, 2)."""
	J = np.einsum('eai,ak->eik', x, slopes, optimize=True)
	det = J[:, 0, 0]*J[:, 1, 1] - J[:, 0, 1]*J[:, 1, 0]
	if det.min() <= 0: sys.exit('an element has turned inside out')
	return slopes @ (np.stack([J[:, 1, 1], -J[:, 0, 1], -J[:, 1, 0], J[:, 0, 0]], 1).reshape(-1, 2, 2)/det[:, None, None]), det


def update(s, G):
	"""Stress xx, yy, xy after the displacement gradient G of a step, of mid-step."""
	xx, yy, xy, half = G[:, 0, 0], G[:, 1, 1], .5*(G[:, 0, 1] + G[:, 1, 0]), .25*(G[:, 0, 1] - G[:, 1, 0])
	c, n = (1 - half**2)/(1 + half**2), 2*half/(1 + half**2)  # tan(angle/2) = half
	a, b, d = s.T
	turned = np.stack([c*c*a + 2*c*n*d + n*n*b, n*n*a - 2*c*n*d + c*c*b, c*n*(b - a) + (c*c - n*n)*d], 1)
	return turned + np.stack([LAME*(xx + yy) + 2*SHEAR*xx, LAME*(xx + yy) + 2*SHEAR*yy, 2*SHEAR*xy], 1)


def run(across):
	h = HEIGHT/across
	nx, ny = int(round(LENGTH/h)), across*DEGREE + 1  # elements, nodes
	X = np.stack(np.meshgrid(np.arange(nx*DEGREE + 1)*h/DEGREE, np.arange(ny)*h/DEGREE, indexing='ij'), 2).reshape(-1, 2)
	first = DEGREE*(np.arange(nx)[:, None]*ny + np.arange(across)).ravel()
	nodes = first[:, None] + (np.arange(DEGREE + 1)[:, None]*ny + np.arange(DEGREE + 1)).ravel()
	mass = np.bincount(nodes.ravel(), np.tile(DENSITY*h*h*product(LUMPED, LUMPED), len(nodes)))[:, None]
	free = X[:, :1] > .1*h
	weight = mass*(0, -options.gravity)
	e = int(WATCHED[0]/h)*across + min(int(WATCHED[1]/h), across - 1)
	watched = product(*([N(z) for N in SHAPES] for z in 2*(np.array(WATCHED) - X[nodes[e, 0]])/h - 1))

	dt = .4*h/DEGREE/((LAME + 2*SHEAR)/DENSITY)**.5
	every = int(np.ceil(.01/dt))
	dt = .01/every
	x, stress, history = X.copy(), np.zeros((len(GAUSS), len(nodes), 3)), [(0., 0., 0.)]
	v = .5*dt*weight/mass*free
	for step in range(1, int(round(options.time/dt)) + 1):
		middle, x = (x + .5*dt*v)[nodes], x + dt*v
		force = weight.copy()
		for k, (slope, part) in enumerate(GAUSS):
			B, _ = gradients(middle, slope)
			stress[k] = update(stress[k], dt*(v[nodes].transpose(0, 2, 1) @ B))
			B, det = gradients(x[nodes], slope)
			xx, yy, xy = stress[k].T[:, :, None]*(part*det)[:, None]
			for d, f in enumerate((B[:, :, 0]*xx + B[:, :, 1]*xy, B[:, :, 0]*xy + B[:, :, 1]*yy)):
				force[:, d] -= np.bincount(nodes.ravel(), f.ravel())
		v += dt*force/mass*free
		if step % every == 0: history.append((step*dt,) + tuple(watched @ (x - X)[nodes[e]]))
	return history


history = run(options.across)
with open(options.file, 'w') as f:
	out = csv.writer(f, lineterminator='\n')
	out.writerow(('t', 'ux', 'uy'))
	out.writerows(('%.2f' % t, '%.5f' % ux, '%.5f' % uy) for t, ux, uy in history)
lowest = min(history, key=lambda row: row[2])
print('lowest: %.4f m at %.2f s' % (lowest[2], lowest[0]))
