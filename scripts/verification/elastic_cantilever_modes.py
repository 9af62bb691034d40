# SPDX-License-Identifier: GPL-2.0-or-later
"""Reference of the elastic cantilever (example 4.2 without yield): finite elements, small strain, all modes superposed.

	python3 scripts/verification/elastic_cantilever_modes.py 4 4 tests/data/cantilever/dynamic_elastic.csv     (elements across the height, halvings)

1 x 0.2 m, 0.02 m thick, plane stress, clamped at x = 0, shear 75 kN sin(2 pi f t) spread over the end face, f = 50 and 20 Hz, from rest.
Rectangles of nine nodes with the consistent mass, halved again and again towards the corners at the clamp, where the stress is singular; each mode follows the load exactly, q = F/(w2 - W2) (sin W t - W/w sin w t). Writes the mean displacement of
the end face along the load every 0.1 ms for two periods of the slower load.
"""
import argparse
import csv

import numpy as np

YOUNG, POISSON, DENSITY, LENGTH, HEIGHT, THICKNESS, FORCE = 210e9, .3, 7850., 1., .2, .02, 75e3
LINE = np.array((-1., 0, 1))
SHAPES = [np.poly1d(LINE[LINE != a], True)/np.prod(a - LINE[LINE != a]) for a in LINE]


def element(hx, hy):
	"""Stiffness and mass of a rectangle."""
	C = YOUNG/(1 - POISSON**2)*np.array(((1, POISSON, 0), (POISSON, 1, 0), (0, 0, (1 - POISSON)/2)))
	K, M = np.zeros((18, 18)), np.zeros((18, 18))
	for x, a in zip(*np.polynomial.legendre.leggauss(3)):
		for y, b in zip(*np.polynomial.legendre.leggauss(3)):
			X, Y, dX, dY = ([f(z) for f in fs] for fs, z in ((SHAPES, x), (SHAPES, y), ([s.deriv() for s in SHAPES], x), ([s.deriv() for s in SHAPES], y)))
			N, slope = np.outer(X, Y).ravel(), np.array((2/hx*np.outer(dX, Y).ravel(), 2/hy*np.outer(X, dY).ravel()))
			B = np.zeros((3, 18))
			B[0, ::2], B[1, 1::2], B[2, ::2], B[2, 1::2] = slope[0], slope[1], slope[1], slope[0]
			weight = a*b*hx*hy/4*THICKNESS
			K += weight*B.T @ C @ B
			M += DENSITY*weight*np.kron(np.outer(N, N), np.eye(2))
	return K, M


def modes(across, halvings):
	"""Angular frequencies, and the part that the end load has in each mode."""
	h = HEIGHT/across
	fine = h/2.**np.arange(halvings, 0, -1)
	xs = np.concatenate(([0], fine, np.arange(1, round(LENGTH/h) + 1)*h))
	ys = np.concatenate(([0], fine, np.arange(1, across)*h, HEIGHT - fine[::-1], [HEIGHT]))
	nx, ny = len(xs) - 1, 2*len(ys) - 1
	K, M = np.zeros((2, 2*(2*nx + 1)*ny, 2*(2*nx + 1)*ny))
	for i, hx in enumerate(np.diff(xs)):
		for j, hy in enumerate(np.diff(ys)):
			nodes = ((2*i + np.arange(3))[:, None]*ny + 2*j + np.arange(3)).ravel()
			dofs = (2*nodes[:, None] + (0, 1)).ravel()
			k, m = element(hx, hy)
			K[np.ix_(dofs, dofs)] += k
			M[np.ix_(dofs, dofs)] += m
	load = np.zeros(len(K))
	for j, hy in enumerate(np.diff(ys)): load[2*(2*nx*ny + 2*j + np.arange(3)) + 1] += np.array((1, 4, 1))/6*hy/HEIGHT
	K, M, load = K[2*ny:, 2*ny:], M[2*ny:, 2*ny:], load[2*ny:]
	L = np.linalg.cholesky(M)
	A = np.linalg.solve(L, np.linalg.solve(L, K).T)
	w2, Q = np.linalg.eigh(.5*(A + A.T))
	return np.sqrt(w2), Q.T @ np.linalg.solve(L, load)


def history(w, part, frequency, t):
	W = 2*np.pi*frequency
	return ((part**2*FORCE/(w**2 - W**2))[:, None]*(np.sin(W*t) - (W/w)[:, None]*np.sin(np.outer(w, t)))).sum(0)


if __name__ == '__main__':
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('across', type=int)
	parser.add_argument('halvings', type=int)
	parser.add_argument('file')
	options = parser.parse_args()
	w, part = modes(options.across, options.halvings)
	print('frequencies [Hz]:', (w[:4]/2/np.pi).round(3))
	t = np.linspace(0, .1, 1001)
	fast, slow = history(w, part, 50, t), history(w, part, 20, t)
	print('peaks [mm]:', 1e3*abs(fast).max(), 1e3*abs(slow).max())
	with open(options.file, 'w') as f:
		out = csv.writer(f, lineterminator='\n')
		out.writerow(('time_s', 'displacement_50_Hz_m', 'displacement_20_Hz_m'))
		out.writerows(('%.4f' % a, '%.9e' % b, '%.9e' % c) for a, b, c in zip(t, fast, slow))
