# SPDX-License-Identifier: GPL-2.0-or-later
"""Thick cylinders (plane strain) and spheres under internal pressure: solutions, and material points that are to find them.

Radii a = 1 m and b = 2 m, E = 1e7 Pa, nu = 0.3, 1000 kg/m3, perfectly plastic (J2) where there is a yield stress.
"""
import math

import numpy as np
from report import runSampled
from yade import mpm
from yade import *
from yade.minieigenHP import Vector3

A, B, YOUNG, POISSON, DENSITY = 1., 2., 1e7, .3, 1000.


# ---- solutions -------------------------------------------------------------------------------------------------------------

def lame(kind, pressure):
	"""Lame's elastic solution: function of r that gives u, sigma_rr, sigma_hoop, sigma_zz (of the sphere: sigma_hoop once more)."""
	def solution(r):
		if kind == 'sphere':
			k = pressure*A**3/(B**3 - A**3)
			hoop = k*(1 + B**3/(2*r**3))
			return k/YOUNG*r*((1 - 2*POISSON) + (1 + POISSON)*B**3/(2*r**3)), k*(1 - B**3/r**3), hoop, hoop
		k = pressure*A**2/(B**2 - A**2)
		return (1 + POISSON)*k/YOUNG*r*((1 - 2*POISSON) + B**2/r**2), k*(1 - B**2/r**2), k*(1 + B**2/r**2), 2*POISSON*k + 0*r
	return solution


def hill(yieldStress, c):
	"""Hill's sphere, plastic up to r = c, where J2 and Tresca are the same: pressure and solution (as lame)."""
	k = 2*yieldStress*c**3/(3*B**3)
	def solution(r):
		elastic = -k*(B**3/r**3 - 1)
		radial = np.where(r > c, elastic, -2*yieldStress*(np.log(c/r) + (1 - c**3/B**3)/3))
		hoop = np.where(r > c, k*(B**3/(2*r**3) + 1), yieldStress + radial)
		u = np.where(r > c, k/YOUNG*r*((1 - 2*POISSON) + (1 + POISSON)*B**3/(2*r**3)),
			(1 - 2*POISSON)/YOUNG*r*radial + (1 - POISSON)*yieldStress/YOUNG*c**3/r**2)
		return u, radial, hoop, hoop
	return 2*yieldStress*(math.log(c/A) + (1 - c**3/B**3)/3), solution


def radial(kind, yieldStress, pressure, elements=300, increments=30):
	"""J2 under the same pressure by one-dimensional finite elements along r, small strain, backward Euler: solution as lame. For the cylinder,
	whose J2 solution with nu < 1/2 is not closed."""
	m = 2 if kind == 'sphere' else 1
	r = np.linspace(A, B, elements + 1)
	middle, h = .5*(r[1:] + r[:-1]), r[1] - r[0]
	bulk, shear = YOUNG/(3*(1 - 2*POISSON)), YOUNG/(2*(1 + POISSON))
	D = np.zeros((elements, 3, 2))  # strains rr, hoop, zz of an element from its two nodes
	D[:, 0, 0], D[:, 0, 1] = -1/h, 1/h
	D[:, 1] = .5/middle[:, None]
	if m == 2: D[:, 2] = D[:, 1]
	weight = middle**m*h
	deviator, sigma, u = np.eye(3) - 1/3., np.zeros((elements, 3)), np.zeros(elements + 1)
	for k in range(increments):
		trialFrom, start = sigma.copy(), u.copy()
		for iteration in range(30):
			strain = np.einsum('eij,ej->ei', D, np.stack([(u - start)[:-1], (u - start)[1:]], 1))
			trial = trialFrom + bulk*strain.sum(1)[:, None] + 2*shear*strain @ deviator
			s = trial @ deviator
			q = np.sqrt(1.5*(s**2).sum(1))
			theta = np.minimum(1, yieldStress/np.maximum(q, 1e-9*yieldStress))
			sigma = trial - (1 - theta)[:, None]*s
			n = s/np.maximum(np.sqrt((s**2).sum(1)), 1e-300)[:, None]
			C = bulk*np.ones((3, 3)) + 2*shear*(theta[:, None, None]*deviator - np.where(theta < 1, theta, 0)[:, None, None]*n[:, :, None]*n[:, None, :])
			forces, stiffness = np.einsum('eij,ei,e->ej', D, sigma, weight), np.einsum('eki,ekl,elj,e->eij', D, C, D, weight)
			residual, K = np.zeros(elements + 1), np.zeros((elements + 1, elements + 1))
			residual[0] = pressure*(k + 1)/increments*A**m
			for i in 0, 1:
				np.subtract.at(residual, np.arange(elements) + i, forces[:, i])
				for j in 0, 1: np.add.at(K, (np.arange(elements) + i, np.arange(elements) + j), stiffness[:, i, j])
			if abs(residual).max() < 1e-10*pressure: break
			u = u + np.linalg.solve(K, residual)
		else: raise RuntimeError('the radial solution does not converge: %g of the pressure' % (abs(residual).max()/pressure))
	return lambda x: (np.interp(x, r, u),) + tuple(np.interp(x, middle, sigma[:, i]) for i in range(3))


# ---- material points -------------------------------------------------------------------------------------------------------------

class Shell:
	"""A predicate as those of yade.pack: A < r < B where all coordinates are positive, r taken over some axes."""

	def __init__(self, axes): self.axes = axes
	def aabb(self): return (0, 0, 0), [B if d in self.axes else 0 for d in range(3)]
	def __call__(self, x, pad): return A < math.sqrt(sum(x[d]**2 for d in self.axes)) < B


def fill(kind, analysis, spacing):
	"""The part between planes of symmetry, and the walls there."""
	slip = lambda axis, side=1, at=0: MpmWall(normal=[side*(d == axis) for d in range(3)], origin=[at*(d == axis) for d in range(3)], kind='slip')
	if analysis == '3d': return mpm.fill(Shell((0, 1, 2)), spacing, 'wall'), [slip(0), slip(1), slip(2)]
	if analysis == 'planeStrain': return mpm.fill(Shell((0, 1)), spacing, 'wall', thickness=1.), [slip(0), slip(1)]
	if kind == 'sphere': return mpm.fill(Shell((0, 1)), spacing, 'wall', axisymmetric=True), [slip(1)]
	return mpm.fill(((A, 0), (B, 4*spacing)), spacing, 'wall', axisymmetric=True), [slip(1), slip(1, -1, 4*spacing)]


def faces(ids, analysis, spacing):
	"""(id, force for a unit of pressure) of the points that carry the load. Every point is a square or a cube, and the pressure acts on those of its faces
	that border on the cavity: their areas sum up to the projections of the curved surface, whatever stairs they make. A point's centre is half a spacing
	behind its face; so it takes 3/2 of the force, and the point behind it -1/2, whose resultant is at the face."""
	x = np.array([O.bodies[i].state.pos for i in ids])
	at = {tuple(k): n for n, k in enumerate(np.rint(x/spacing - .5).astype(int))}
	load = np.zeros((len(ids), 3))
	for k, n in at.items():
		for d in range(3 if analysis == '3d' else 2):
			beside = lambda by: tuple(index + by*(e == d) for e, index in enumerate(k))
			if k[d] == 0 or beside(-1) in at: continue  # a plane of symmetry, or material
			area = spacing**2 if analysis == '3d' else spacing*(2*math.pi*(x[n, 0] - .5*spacing*(d == 0)) if analysis == 'axisymmetric' else 1)
			load[n, d] += 1.5*area
			load[at[beside(1)], d] -= .5*area
	return [(i, Vector3(*f)) for i, f in zip(ids, load) if f.any()]


def pressurise(kind, analysis, cells, pressure, yieldStress=None, shape='cubic', periods=12):
	"""Raise the pressure slowly, in some periods of the wall's breathing, with damping: positions before, displacements, stresses, volumes. cells: to a
	length A, with two points a cell and axis."""
	O.reset()
	spacing = A/(2*cells)
	law = dict(label='wall', young=YOUNG, poisson=POISSON, density=DENSITY)
	O.materials.append(J2Mat(yieldStress=yieldStress, **law) if yieldStress else ElastMat(**law))
	ids, walls = fill(kind, analysis, spacing)
	loads, start = faces(ids, analysis, spacing), mpm.array('position')
	O.engines = [ForceResetter(), MpmEngine(cellSize=2*spacing, analysis=analysis, shape=shape, damping=.4, walls=walls)]
	O.dt = .5*mpm.criticalTimeStep()
	steps = int(periods*math.pi*(A + B)/math.sqrt(YOUNG/DENSITY)/O.dt)

	def load():
		x = min(1, 1.6*O.iter/steps)
		for i, f in loads: O.forces.setPermF(i, pressure*x*x*(3 - 2*x)*f)
	runSampled(steps, max(1, steps//200), load)
	return start, mpm.array('position') - start, mpm.array('stress'), mpm.array('volume')


def errors(kind, analysis, result, solution):
	"""Of the result of pressurise() against a solution: root mean squares over the volume, relative; of the displacement, and of the stress in the middle half
	of the wall."""
	start, moved, stress, volume = result
	axis = None if kind == 'sphere' else 1 if analysis == 'axisymmetric' else 2
	x = start*[d != axis for d in range(3)]
	r = np.linalg.norm(x, axis=1)
	e = x/r[:, None]
	u, rr, hoop, zz = solution(r)
	normal = e[:, :, None]*e[:, None, :]
	exact = rr[:, None, None]*normal + hoop[:, None, None]*(np.eye(3) - normal)
	if axis is not None: exact[:, axis, axis] = zz
	mean = lambda difference, whole, where: math.sqrt(np.tensordot(volume*where, difference**2, 1).sum()/np.tensordot(volume*where, whole**2, 1).sum())
	return mean(moved - u[:, None]*e, u[:, None]*e, r > 0), mean(stress - exact, exact, abs(r - .5*(A + B)) < .25*(B - A))
