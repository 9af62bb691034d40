# SPDX-License-Identifier: GPL-2.0-or-later
"""Reference of the soft cantilever (V6): explicit finite elements with the law and kinematics of the kernel.

	python3 scripts/verification/soft_cantilever_fe.py 16 tests/data/soft_cantilever_fe.csv     (elements across the height)

4 x 1 m, E = 1 MPa, nu = 0.3, 1050 kg/m3, plane strain, clamped at x = 0, gravity of 10 m/s2 at once, 1.1 s: down to its lowest place. Squares of four nodes, four
Gauss points, lumped mass, leapfrog at 0.4 h/c; strain increments and rotations of Hughes & Winget (1980) at mid-step, Hooke's law for the
increments. No points move through this mesh: what it shares with the material point method are the equations. Writes the
displacement of the material point (3.9, 0.5) every 0.01 s. It ends there because elements below the clamp, where the beam is folded up, turn inside
out next, from ten across the height on: at 1.2 s with sixteen.
"""
import csv
import sys

import numpy as np

YOUNG, POISSON, DENSITY, GRAVITY, LENGTH, HEIGHT, TIME, WATCHED = 1e6, .3, 1050., 10., 4., 1., 1.1, (3.9, .5)
LAME, SHEAR = YOUNG*POISSON/(1 + POISSON)/(1 - 2*POISSON), YOUNG/2/(1 + POISSON)
SIDE_X, SIDE_Y = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
GAUSS = [(x/3**.5, y/3**.5) for y in (-1, 1) for x in (-1, 1)]
SLOPES = [np.stack([SIDE_X*(1 + SIDE_Y*y)/4, SIDE_Y*(1 + SIDE_X*x)/4], 1) for x, y in GAUSS]  # dN_a/d(xi, eta)


def gradients(x, slopes):
	"""grad N_a and the Jacobian's determinant for elements with nodes at x (elements, 4, 2)."""
	J = np.einsum('eai,ak->eik', x, slopes)
	det = J[:, 0, 0]*J[:, 1, 1] - J[:, 0, 1]*J[:, 1, 0]
	if det.min() <= 0: sys.exit('an element has turned inside out')
	inverse = np.stack([J[:, 1, 1], -J[:, 0, 1], -J[:, 1, 0], J[:, 0, 0]], 1).reshape(-1, 2, 2)/det[:, None, None]
	return np.einsum('ak,eki->eai', slopes, inverse), det


def update(s, G):
	"""Stress xx, yy, xy after the displacement gradient G of a step, of mid-step."""
	xx, yy, xy, half = G[:, 0, 0], G[:, 1, 1], .5*(G[:, 0, 1] + G[:, 1, 0]), .25*(G[:, 0, 1] - G[:, 1, 0])
	c, n = (1 - half**2)/(1 + half**2), 2*half/(1 + half**2)  # tan(angle/2) = half
	a, b, d = s.T
	turned = np.stack([c*c*a + 2*c*n*d + n*n*b, n*n*a - 2*c*n*d + c*c*b, c*n*(b - a) + (c*c - n*n)*d], 1)
	return turned + np.stack([LAME*(xx + yy) + 2*SHEAR*xx, LAME*(xx + yy) + 2*SHEAR*yy, 2*SHEAR*xy], 1)


def run(across):
	h = HEIGHT/across
	nx = int(round(LENGTH/h))
	X = np.stack(np.meshgrid(np.arange(nx + 1)*h, np.arange(across + 1)*h, indexing='ij'), 2).reshape(-1, 2)
	first = (np.arange(nx)[:, None]*(across + 1) + np.arange(across)).ravel()
	nodes = np.stack([first, first + across + 1, first + across + 2, first + 1], 1)
	mass = np.bincount(nodes.ravel(), np.full(nodes.size, DENSITY*h*h/4))[:, None]
	free = X[:, :1] > .5*h
	weight = mass*(0, -GRAVITY)
	e = int(WATCHED[0]/h)*across + min(int(WATCHED[1]/h), across - 1)
	place = 2*(np.array(WATCHED) - X[nodes[e, 0]])/h - 1
	watched = (1 + SIDE_X*place[0])*(1 + SIDE_Y*place[1])/4

	dt = .4*h/((LAME + 2*SHEAR)/DENSITY)**.5
	every = int(np.ceil(.01/dt))
	dt = .01/every
	x, stress, history = X.copy(), np.zeros((4, len(nodes), 3)), [(0., 0., 0.)]
	v = .5*dt*weight/mass*free
	for step in range(1, int(round(TIME/dt)) + 1):
		middle, x = (x + .5*dt*v)[nodes], x + dt*v
		force = weight.copy()
		for k, slopes in enumerate(SLOPES):
			B, _ = gradients(middle, slopes)
			stress[k] = update(stress[k], dt*np.einsum('eai,eak->eik', v[nodes], B))
			B, det = gradients(x[nodes], slopes)
			xx, yy, xy = stress[k].T[:, :, None]*det[:, None]
			for d, f in enumerate((B[:, :, 0]*xx + B[:, :, 1]*xy, B[:, :, 0]*xy + B[:, :, 1]*yy)):
				force[:, d] -= np.bincount(nodes.ravel(), f.ravel())
		v += dt*force/mass*free
		if step % every == 0: history.append((step*dt,) + tuple(watched @ (x - X)[nodes[e]]))
	return history


with open(sys.argv[2], 'w') as f:
	out = csv.writer(f, lineterminator='\n')
	out.writerow(('t', 'ux', 'uy'))
	history = run(int(sys.argv[1]))
	out.writerows(('%.2f' % t, '%.5f' % ux, '%.5f' % uy) for t, ux, uy in history)
lowest = min(history, key=lambda row: row[2])
print('lowest: %.4f m at %.2f s' % (lowest[2], lowest[0]))
