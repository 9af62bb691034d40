# SPDX-License-Identifier: GPL-2.0-or-later
"""Transfers between points and nodes beyond FLIP, tried in NumPy: what each does in the cases of doc/accuracy, as CSV.
  python3 scripts/benchmarks/transfers.py [drift [steps]]

Cubic functions, MUSL, large strain. S takes nodal values to the points, S+ = M^-1 S^T m brings velocities of points to the nodes (M lumped),
Q = S+ S, and B = 1 + (1 - Q) + ... + (1 - Q)^(k-1) approaches the inverse of Q, so that B M^-1 approaches that of the full mass matrix M Q.
What `Body.step` does with them are the transfers."""
import sys
from collections import namedtuple

import numpy as np

# order: k of B. damps: m of the filter (1 - S S+)^m, of which dt/tau is taken off the velocities a step, or all of it.
Transfer = namedtuple('Transfer', 'name kind order damps scaled', defaults=(1, 0, False))
TRANSFERS = (
	Transfer('FLIP', 'FLIP'),
	Transfer('PIC, tau', 'FLIP', 1, 1, True),
	Transfer('XPIC(2)', 'FLIP', 1, 2),
	Transfer('XPIC(5)', 'FLIP', 1, 5),
	Transfer('XPIC(2), tau', 'FLIP', 1, 2, True),
	Transfer('FMPM(2)', 'FMPM', 2),
	Transfer('APIC', 'APIC'),
	Transfer('FLIP, moved after', 'after'),
	Transfer('full mass', 'after', 2),
	Transfer('full mass, k = 4', 'after', 4),
	Transfer('full mass, XPIC(2), tau', 'after', 2, 2, True))


class Body:
	"""Points on a lattice, in one dimension or two: position x, velocity v and, for APIC, its gradient C; stress; deformation gradient F.

	tau is the time of a transfer that has one. velocity(x) gives the velocities, law(stress, strain increment) the new stress. walls: pairs of a plane and the side, 1 or -1, that the
	material is on, frictionless, in one dimension; splines are folded there (doc/method.md)."""

	def __init__(self, transfer, tau, x, velocity, spacing, h, density, law, walls=()):
		self.transfer, self.tau = transfer, tau
		self.x, self.start, self.h, self.law, self.walls = x.copy(), x, h, law, walls
		count, self.dim = x.shape
		self.volume, self.mass = np.full(count, spacing**self.dim), np.full((count, 1), density*spacing**self.dim)
		self.v, one, small = velocity(x), np.eye(self.dim), 1e-6*h
		self.C = np.stack([(velocity(x + small*e) - velocity(x - small*e))/(2*small) for e in one], 2)
		self.affine = h**2/3 if transfer.kind == 'APIC' else 0  # second moment of the spline, that goes with C
		self.F, self.stress, self.time = np.tile(one, (count, 1, 1)), np.zeros((count, self.dim, self.dim)), 0

	def weigh(self):
		"""Per axis the splines, their slopes and first moments N (x_i - x), arrays of points and nodes; nodal masses."""
		self.weights = []
		for e in range(self.dim):
			xi = self.x[:, e]/self.h
			nodes = np.arange(np.floor(xi.min()) - 1, np.floor(xi.max()) + 3)
			r = nodes - xi[:, None]
			far, near = np.maximum(2 - abs(r), 0), np.maximum(1 - abs(r), 0)
			N = far**3/6 - near**3*(2/3)
			self.weights.append([N, np.sign(r)*(far**2/2 - 2*near**2)/self.h, N*r*self.h])
		if self.walls:
			even, odd = self.fold(nodes)
			mass = (N @ even).T @ self.mass
			self.weights[0] = [w @ odd for w in self.weights[0]]
		else:
			mass = self.toNodes(self.mass)
		self.inverseMass = np.divide(1, mass, out=np.zeros_like(mass), where=mass > 1e-14*self.mass.min())

	def fold(self, nodes):
		at = {node: k for k, node in enumerate(nodes)}
		even, odd = np.eye(len(nodes)), np.eye(len(nodes))
		for plane, side in self.walls:
			wall = round(plane/self.h)
			for behind in (node for node in nodes if (node - wall)*side < 0):
				ghost, image = at[behind], at[2*wall - behind]
				even[ghost, ghost] = odd[ghost, ghost] = 0
				even[ghost, image], odd[ghost, image] = 1, -1
			if wall in at: odd[at[wall], at[wall]] = 0
		return even, odd

	def chosen(self, kind, axis):
		return [w[kind if e == axis else 0] for e, w in enumerate(self.weights)]

	def toNodes(self, q, kind=0, axis=0):
		"""Sums over the points of weight times q, (points, columns); kind 1: slope along the axis, 2: moment."""
		W = self.chosen(kind, axis)
		if self.dim == 1: return W[0].T @ q
		return (W[0].T @ (W[1][:, :, None]*q[:, None, :]).reshape(len(q), -1)).reshape(-1, q.shape[1])

	def toPoints(self, g, kind=0, axis=0):
		W = self.chosen(kind, axis)
		if self.dim == 1: return W[0] @ g
		columns = W[1].shape[1]
		return (W[1][:, None, :] @ (W[0] @ g.reshape(-1, columns*g.shape[1])).reshape(len(self.x), columns, -1))[:, 0]

	def velocities(self, v):
		"""S+ v; in APIC of the affine fields v + C (x_i - x) about the points."""
		p = self.toNodes(self.mass*v)
		if self.affine: p += sum(self.toNodes(self.mass*self.C[:, :, e], 2, e) for e in range(self.dim))
		return self.inverseMass*p

	def rest(self, v):
		"""What the grid does not see of the velocities, (1 - S S+) v."""
		return v - self.toPoints(self.velocities(v))

	def sharpen(self, g, order):
		"""B g."""
		term = total = g
		for _ in range(order - 1):
			term = term - self.velocities(self.toPoints(term))
			total = total + term
		return total

	def step(self, dt, force=None, damping=0):
		_, kind, order, damps, scaled = self.transfer
		axes = range(self.dim)
		self.weigh()
		V = self.volumes()[:, None]
		f = -sum(self.toNodes(V*self.stress[:, :, e], 1, e) for e in axes)
		if force is not None: f += self.toNodes(self.mass*force)
		w, a = self.velocities(self.v), self.inverseMass*f
		if damping: a = a - damping*abs(a)*np.sign(w + .5*dt*a)

		if kind in ('FLIP', 'after'):
			change = dt*self.toPoints(self.sharpen(a, order))
			if damps:
				unseen = self.v
				for _ in range(damps): unseen = self.rest(unseen)
				change -= (dt/self.tau if scaled else 1)*unseen
			self.v = self.v + change
			seen = self.sharpen(self.velocities(self.v), order)
			moved = self.toPoints(seen if kind == 'after' else w + dt*a)
		else:
			g = self.sharpen(w + dt*a, order)
			self.v = moved = self.toPoints(g)
			if kind == 'APIC': self.C = np.stack([self.toPoints(g, 2, e) for e in axes], 2)/self.affine
			seen = self.velocities(self.v)
		self.strain(dt*np.stack([self.toPoints(seen, 1, e) for e in axes], 2))
		self.x += dt*moved
		self.time += dt

	def strain(self, G):
		"""Stress, turned and updated, and F for the gradient G of the displacements of a step; doc/method.md, Large strain."""
		self.F = self.F + G @ self.F
		if self.dim == 1:
			self.stress = self.law(self.stress, G/(1 + G/2))
			return
		A = G @ np.linalg.inv(np.eye(2) + G/2)
		half = (A[:, 0, 1] - A[:, 1, 0])/4
		c, s = (1 - half**2)/(1 + half**2), 2*half/(1 + half**2)
		R = np.stack([c, s, -s, c], 1).reshape(-1, 2, 2)
		self.stress = self.law(R @ self.stress @ R.transpose(0, 2, 1), (A + A.transpose(0, 2, 1))/2)

	def volumes(self): return self.volume*(np.linalg.det(self.F) if self.dim > 1 else self.F[:, 0, 0])
	def kinetic(self): return .5*np.sum(self.mass*self.v**2) + .5*self.affine*np.sum(self.mass[:, :, None]*self.C**2)
	def stored(self, E, nu, volumes):
		"""By the formula of small strain."""
		s = self.stress
		return np.sum(volumes*(1 + nu)/(2*E)*(np.sum(s**2, (1, 2)) - nu*np.trace(s, axis1=1, axis2=2)**2))
	def angularMomentum(self):
		x, v, C = self.x, self.v, self.C
		return np.sum(self.mass[:, 0]*(x[:, 0]*v[:, 1] - x[:, 1]*v[:, 0] + self.affine*(C[:, 1, 0] - C[:, 0, 1])))
	def widestGap(self, across):
		"""Greatest distance of neighbours over what F makes of it, in cells: doc/method.md, Numerical fracture."""
		i, gap = np.arange(across*across).reshape(across, across), 0
		for p, q in ((i[:, 1:], i[:, :-1]), (i[1:], i[:-1])):
			meant = np.einsum('...ij,...j', .5*(self.F[p] + self.F[q]), self.start[p] - self.start[q])
			gap = max(gap, np.max(np.linalg.norm(self.x[p] - self.x[q], axis=-1) - np.linalg.norm(meant, axis=-1)))
		return gap/self.h


def elastic(E, nu=0):
	"""Uniaxial stress, or plane strain."""
	lame, shear = E*nu/((1 + nu)*(1 - 2*nu)), E/(2*(1 + nu))
	def law(stress, strain): return stress + 2*shear*strain + lame*np.trace(strain, axis1=1, axis2=2)[:, None, None]*np.eye(strain.shape[1])
	return law


def hysteretic(E, yieldStress, ratio, reloading):
	"""The smooth law, n = 2, beta = gamma: dz/dx = 1 - z^2 where it loads and 1 where it unloads, solved exactly. With reloading elastic up to
	the z that it has unloaded from, or four times the least since."""
	state = {}
	def law(stress, strain):
		dx = strain[:, 0, 0]*E/yieldStress
		z, limit = state.get('z', np.zeros_like(dx)), state.get('limit', np.zeros_like(dx))
		turns = z*dx < 0
		free = np.where(turns, np.minimum(abs(z), abs(dx)), 0)  # part of |dx| down to z = 0
		z, left, sign = z + np.sign(dx)*free, abs(dx) - free, np.sign(dx)
		if reloading:
			limit = np.where(turns, np.minimum(np.maximum(limit, abs(z) + free), 4*abs(z)), limit)
			free = np.where(left > 0, np.minimum(left, np.maximum(limit - abs(z), 0)), 0)
			z, left = z + sign*free, left - free
		rise = np.tanh(sign*left)
		z = (z + rise)/(1 + z*rise)
		state['z'], state['limit'] = z, np.maximum(limit, abs(z)) if reloading else limit
		elasticPart = state.get('elastic', 0) + ratio*E*strain[:, 0, 0]
		state['elastic'] = elasticPart
		return (elasticPart + (1 - ratio)*yieldStress*z)[:, None, None]
	return law


def line(count, length): return ((np.arange(count) + .5)*length/count)[:, None]
def plane(across, length, corner):
	"""By rows; the corner is the lower left one."""
	x, y = np.meshgrid(*((np.arange(across) + .5)*length/across + c for c in corner))
	return np.stack([x.ravel(), y.ravel()], 1)


def manufactured(amplitude, cells, courant, transfer):
	"""V1 with the hypoelastic law, one period of 0.02 s: greatest root mean square error of the positions."""
	E, density, c, h = 1e7, 1000., 100., 1/cells
	X = line(2*cells, 1)
	body = Body(transfer, .1, X, lambda x: np.pi*c*amplitude*np.sin(np.pi*x), h/2, h, density, elastic(E), ((0, 1), (1, -1)))
	dt, worst = courant*h/c, 0
	for _ in range(round(.02/dt)):
		wave = amplitude*np.sin(np.pi*c*body.time)
		body.step(dt, np.pi**2*wave*np.sin(np.pi*X)*(E/(density*(1 + np.pi*wave*np.cos(np.pi*X))) - c*c))
		error = body.x - X - amplitude*np.sin(np.pi*c*body.time)*np.sin(np.pi*X)
		worst = max(worst, np.sqrt(np.sum(body.volume*body.F[:, 0, 0]*error[:, 0]**2)))
	return worst


def bar(transfer):
	for amplitude, name in ((1e-4, 'bar, strain 3e-4'), (.05, 'bar, strain 0.16')):
		errors = [manufactured(amplitude, n, .2, transfer) for n in (8, 16, 32, 64)]
		yield name, 'error, 16 cells', errors[1]
		yield name, 'error, 32 cells', errors[2]
		yield name, 'order, 32 to 64 cells', np.log2(errors[2]/errors[3])
	errors = [manufactured(1e-4, n, 1.6/n, transfer) for n in (16, 32)]
	yield 'bar, strain 3e-4', 'order with dt in proportion to h^2, 16 to 32 cells', np.log2(errors[0]/errors[1])


def vibratingBar(transfer):
	"""V3, ten periods."""
	L, E, c = 25., 100., 10.
	for v0, name in ((.1, 'vibrating bar'), (.75, 'vibrating bar, large')):
		for cells in (16, 32):
			h = L/cells
			body = Body(transfer, 50, line(2*cells, L), lambda x: v0*np.sin(.5*np.pi*x/L), h/2, h, 1, elastic(E), ((0, 1),))
			def energy(): return body.kinetic() + np.sum(body.volume*E*(body.F*np.log(body.F) - body.F + 1)[:, 0, 0])
			start, dt, worst = energy(), .1*h/c, 0
			for _ in range(round(100/dt)):
				body.step(dt)
				worst = max(worst, abs(body.v.mean()/(v0*2/np.pi) - np.cos(.5*np.pi*c/L*body.time)))
			yield name, 'velocity error, %d cells' % cells, worst
			yield name, 'energy kept, %d cells' % cells, energy()/start


def nullSpace(transfer):
	"""Velocities that alternate from point to point on top of those of a vibrating bar: part of them left after ten periods."""
	cells, c, ringing = 32, 100., 1e-3
	h = 1/cells
	body = Body(transfer, .2, line(2*cells, 1), lambda x: .01*np.sin(.5*np.pi*x), h/2, h, 1000, elastic(1e7), ((0, 1),))
	sign = (-1.)**np.arange(2*cells)
	body.v += ringing*sign[:, None]
	for _ in range(round(.4*c/(.2*h))): body.step(.2*h/c)
	v = body.v[:, 0]
	yield 'null space', 'alternating velocities left', np.mean((sign[1:-1]*.5*(v[1:-1] - .5*(v[:-2] + v[2:])))[3:-4])/ringing


def impact(transfer):
	"""A bar strikes a wall at half the wave speed: mean force over that of the jump conditions, from the momentum."""
	cells, E, density, c, ratio = 64, 1e7, 1000., 100., .5
	h, shock = 1/cells, 1.
	for _ in range(200): shock = .5*(shock - np.log(1 - ratio/shock)/ratio)
	body = Body(transfer, .2, line(2*cells, 1), lambda x: np.full_like(x, -ratio*c), h/2, h, density, elastic(E), ((0, 1),))
	def momentum(): return np.sum(body.mass*body.v)
	dt, end = .34*h/c, .8/(shock*c)
	while body.time + dt < .1*end: body.step(dt)
	begin, before = body.time, momentum()
	while body.time < end: body.step(dt)
	force = (momentum() - before)/(body.time - begin)
	yield 'impact at half the wave speed', 'wall force', force/(E*shock*ratio)


def ratcheting(transfer):
	"""A bar of the smooth law under its weight, 0.9 sigma_y at the wall, vibrates: creep of its tip in forty periods over its displacement."""
	cells, c, E, yieldStress = 16, 100., 1e7, 1e4
	h, ramp = 1/cells, 4000
	for reloading in (False, True):
		body = Body(transfer, .2, line(2*cells, 1), np.zeros_like, h/2, h, 1000, hysteretic(E, yieldStress, .05, reloading), ((0, 1),))
		weight, dt = .9*yieldStress/1000, .2*h/c
		for k in range(2*ramp): body.step(dt, np.full_like(body.x, weight*min(1, (k + 1)/ramp)), .05)
		body.v += .05*np.sin(.5*np.pi*body.x)
		tips = []
		for _ in range(6*3200):
			body.step(dt, np.full_like(body.x, weight))
			tips.append(body.x[-1, 0] - 1)
		mean = np.mean(np.reshape(tips, (6, -1)), 1)
		yield 'ratcheting by noise', 'creep%s' % (', elastic reloading' if reloading else ''), (mean[5] - mean[1])/mean[1]


def spin(transfer):
	"""A square turns three times, 0.28 c at its corners."""
	rate = 100.
	for across in (16, 32):
		h = .8/across
		body = Body(transfer, .035, plane(across, .4, (-.2, -.2)), lambda x: rate*np.stack([-x[:, 1], x[:, 0]], 1), h/2, h, 1000, elastic(1e7, .3))
		start, dt = body.angularMomentum(), 1.5e-4*16/across
		for _ in range(int(3*2*np.pi/rate/dt)): body.step(dt)
		yield 'spinning square', 'angular momentum kept, %d cells' % (across//2), body.angularMomentum()/start
		yield 'spinning square', 'widest gap [cells], %d cells' % (across//2), body.widestGap(across)


def disks(transfer):
	"""V5 at t = 3.5 s."""
	h = .05
	x = plane(40, 1, (0, 0))
	left, right = (np.hypot(*(x - centre).T) < .2 for centre in (.2, .8))
	x = x[left | right]
	def velocity(at): return np.where(at[:, :1] + at[:, 1:] < 1, .1, -.1)*np.ones(2)
	body = Body(transfer, 2.5, x, velocity, h/2, h, 1000, elastic(1000, .3))
	start, one, worst = body.kinetic(), .1*body.mass.sum()/2, 0
	for _ in range(3500):
		body.step(1e-3)
		worst = max(worst, np.max(abs(np.sum(body.mass*body.v, 0)))/one)
	yield 'two disks', 'kinetic energy recovered', body.kinetic()/start
	yield 'two disks', 'energy kept', (body.kinetic() + body.stored(1000, .3, body.volumes()))/start
	yield 'two disks', 'momentum over that of a disk', worst


def stableStep(transfer):
	"""By bisection on runs of 400 steps: small random velocities of a free body must not grow by 10^4."""
	h, c = .25, 100.
	lattices = {'bar': [line(16, 2) + shift*h for shift in (0, .1, .25)], 'square': [plane(8, 1, (.1*h, .3*h))]}
	for name, bodies in lattices.items():
		def stable(step):
			for x in bodies:
				body = Body(transfer, 50*h/c, x, np.zeros_like, h/2, h, 1000, elastic(1e7, .3*(x.shape[1] - 1)))
				body.v = np.random.default_rng(2017).uniform(-1e-7, 1e-7, x.shape)
				start = body.kinetic()
				for _ in range(400):
					body.step(step*h/c)
					if body.kinetic() > 1e4*start: return False
			return True
		low, high = .5, 4.
		while high > 1.01*low:
			middle = np.sqrt(low*high)
			if stable(middle): low = middle
			else: high = middle
		yield 'stable step', '%s [h/c]' % name, low


def drift(transfer, steps):
	"""The free square that breathes: energy, mean over 500 steps, over that of the first 500."""
	h, E, nu, c = .25, 1e7, .3, 100.
	for part, name in ((.01, 'free square'), (.001, 'free square, a tenth of the motion')):
		middle = np.array([.5 + .1*h, .5 + .3*h])
		body = Body(transfer, .1, plane(8, 1, (.1*h, .3*h)), lambda x: part*c*np.sin(np.pi*(x - middle)), h/2, h, 1000, elastic(E, nu))
		done, centre = 0, body.x.mean(0)
		for to in (500, 10000, 100000, 1000000):
			if to > steps: break
			for _ in range(done, to - 500): body.step(.2*h/c)
			energy = 0
			for _ in range(500):
				body.step(.2*h/c)
				energy += (body.kinetic() + body.stored(E, nu, body.volume))/500
			done = to
			if to == 500: start = energy
			else: yield name, 'energy after %d steps' % to, energy/start
		yield name, 'centre of mass has moved by [cells]', np.linalg.norm(body.x.mean(0) - centre)/h


def main():
	if sys.argv[1:2] == ['drift']:
		steps = int(sys.argv[2]) if len(sys.argv) > 2 else 100000
		cases = [lambda transfer: drift(transfer, steps)]
	else:
		cases = [bar, vibratingBar, nullSpace, impact, ratcheting, spin, disks, stableStep]
	print('case,quantity,transfer,value')
	for case in cases:
		for transfer in TRANSFERS:
			for name, quantity, value in case(transfer):
				print('"%s","%s","%s",%.6g' % (name, quantity, transfer.name, value), flush=True)


if __name__ == '__main__': main()
