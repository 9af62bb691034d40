# SPDX-License-Identifier: GPL-2.0-or-later
"""Reference of a solid bar in bending and in torsion: finite elements, small strain.

	python3 scripts/verification/bar_fe.py 4 3 tests/data/bar.csv     (elements across the section, halvings towards its edges and the clamp)

1 x 0.2 x 0.2 m, E = 10 MPa, nu = 0.3, clamped at x = 0; on the end face a uniform shear of 1 kPa along -y, or the traction 10 kPa/m (0, -z, y) about its
middle. Bricks of 27 nodes; a plane of nodes after the other is eliminated. Writes the mean deflection of the end face and its mean twist,
the integral of (y w - z v) over that of y2 + z2.
"""
import argparse
import csv

import numpy as np

YOUNG, POISSON, LENGTH, SIDE, SHEAR, TORSION = 10e6, .3, 1., .2, 1e3, 1e4
LINE = np.array((-1., 0, 1))
SHAPES = [np.poly1d(LINE[LINE != a], True)/np.prod(a - LINE[LINE != a]) for a in LINE]
GAUSS = list(zip(*np.polynomial.legendre.leggauss(3)))


def edges(length, h, halvings, both):
	inner = h/2.**np.arange(halvings, 0, -1)
	middle = np.arange(1, round(length/h) + (not both))*h
	return np.concatenate(([0], inner, middle, length - inner[::-1] if both else [], [length] if both else []))


def stiffness(h):
	"""Of a brick with sides h: 27 nodes, the last axis fastest, 3 components each."""
	lame, shear = YOUNG*POISSON/(1 + POISSON)/(1 - 2*POISSON), YOUNG/2/(1 + POISSON)
	C = np.diag([2*shear]*3 + [shear]*3)
	C[:3, :3] += lame
	K = np.zeros((81, 81))
	for x, a in GAUSS:
		for y, b in GAUSS:
			for z, c in GAUSS:
				N = [[s(t) for s in SHAPES] for t in (x, y, z)]
				d = [[s.deriv()(t)*2/h[k] for s in SHAPES] for k, t in enumerate((x, y, z))]
				slope = [np.einsum('i,j,k', *(d[m] if m == n else N[m] for m in range(3))).ravel() for n in range(3)]
				B = np.zeros((6, 81))
				for n in range(3): B[n, n::3] = slope[n]
				B[3, 1::3], B[3, 2::3] = slope[2], slope[1]
				B[4, 0::3], B[4, 2::3] = slope[2], slope[0]
				B[5, 0::3], B[5, 1::3] = slope[1], slope[0]
				K += a*b*c*np.prod(h)/8*B.T @ C @ B
	return K


def solve(across, halvings):
	xs, ys = edges(LENGTH, SIDE/across, halvings, False), edges(SIDE, SIDE/across, halvings, True)
	n = 2*len(ys) - 1
	place = np.interp(np.arange(n)/2, np.arange(len(ys)), ys) - SIDE/2
	loads = np.zeros((3*n*n, 2))
	for j, hy in enumerate(np.diff(ys)):
		for k, hz in enumerate(np.diff(ys)):
			for y, b in GAUSS:
				for z, c in GAUSS:
					N = np.outer([s(y) for s in SHAPES], [s(z) for s in SHAPES])
					nodes = (2*j + np.arange(3))[:, None]*n + 2*k + np.arange(3)
					at = np.array((ys[j] + hy*(1 + y)/2, ys[k] + hz*(1 + z)/2)) - SIDE/2
					weight = b*c*hy*hz/4*N
					np.add.at(loads[:, 0], 3*nodes + 1, -weight*SHEAR)
					np.add.at(loads[:, 1], 3*nodes + 1, -weight*at[1]*TORSION)
					np.add.at(loads[:, 1], 3*nodes + 2, weight*at[0]*TORSION)
	plane = 3*n*n
	carried = np.zeros((plane, plane))  # stiffness that the planes eliminated so far leave on the next one
	for e, hx in enumerate(np.diff(xs)):
		K = np.zeros((3*plane, 3*plane))
		for j, hy in enumerate(np.diff(ys)):
			for k, hz in enumerate(np.diff(ys)):
				nodes = (np.arange(3)[:, None, None]*n + 2*j + np.arange(3)[:, None])*n + 2*k + np.arange(3)
				dofs = (3*nodes.ravel()[:, None] + np.arange(3)).ravel()
				K[np.ix_(dofs, dofs)] += stiffness((hx, hy, hz))
		if e == 0: inner = np.arange(plane, 2*plane)  # the first plane is clamped
		else:
			K[:plane, :plane] += carried
			inner = np.arange(2*plane)
		last = np.arange(2*plane, 3*plane)
		carried = K[np.ix_(last, last)] - K[np.ix_(last, inner)] @ np.linalg.solve(K[np.ix_(inner, inner)], K[np.ix_(inner, last)])
	u = np.linalg.solve(carried, loads)
	polar = loads[:, 1]/TORSION  # integrates y w - z v
	return loads[:, 0] @ u[:, 0]/(SHEAR*SIDE**2), polar @ u[:, 1]/(SIDE**4/6)


if __name__ == '__main__':
	parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
	parser.add_argument('across', type=int)
	parser.add_argument('halvings', type=int)
	parser.add_argument('file')
	options = parser.parse_args()
	deflection, twist = solve(options.across, options.halvings)
	print('deflection %.8g m, twist %.8g' % (deflection, twist))
	with open(options.file, 'w') as f:
		out = csv.writer(f, lineterminator='\n')
		out.writerow(('deflection_m', 'twist_rad'))
		out.writerow(('%.7g' % deflection, '%.7g' % twist))
