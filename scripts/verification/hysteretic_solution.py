# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks the manufactured solution of the hysteretic bar (tests/kernel/Manufactured.hpp) by computer algebra: that the stress obeys the
law, loading and unloading, and that the body force balances momentum.  scripts/verify hysteretic_solution"""
import sympy as sp

X, t, G, T, E, a, y, rho = sp.symbols('X t G T E alpha sigma_y rho', positive=True)
s = (1 - sp.cos(sp.pi*t/T))/2
u = G*s*sp.sin(sp.pi*X)
F = 1 + sp.diff(u, X)
strain, peak = sp.log(F), sp.log(F.subs(t, T))
slope, slopePeak = -sp.pi**2*u/F, (-sp.pi**2*u/F).subs(t, T)
values = {G: sp.Rational(1, 50), T: sp.Rational(1, 50), E: 10**7, a: sp.Rational(1, 20), y: 5*10**5, rho: 1000}


def zero(name, expression, time):
	worst = max(abs(sp.N(expression.subs(values).subs({X: x, t: sp.Rational(time)*values[T]}), 40)) for x in map(sp.Rational, ('1/10', '3/7', '5/6')))
	print('%-45s %.1e' % (name, worst))
	assert worst < 1e-25


def rate(z, sign):
	"""The law: dz/dx = 1 - abs(z)^2 (1 + sign)/2, sign 1 where loading."""
	return (1 - z**2*(1 + sign)/2)*E/y*sp.diff(strain, t)


zero('d ln F/dX', sp.diff(strain, X) - slope, '3/10')
sech2 = lambda e: 1/sp.cosh(E*e/y)**2
for name, z, sign, gradient, times in (
	('loading', sp.tanh(E*strain/y), 1, a*E*slope + (1 - a)*E*sech2(strain)*slope, ('1/10', '7/10')),
	('unloading', sp.tanh(E*peak/y) + E*(strain - peak)/y, -1,
		a*E*slope + (1 - a)*E*(sech2(peak)*slopePeak + slope - slopePeak), ('11/10', '13/10'))):
	sigma = a*E*strain + (1 - a)*y*z
	b = G*sp.pi**2/(2*T**2)*sp.cos(sp.pi*t/T)*sp.sin(sp.pi*X) - gradient/rho
	for time in times:
		zero('%s, the law at %s T' % (name, time), (sp.diff(z, t) - rate(z, sign))*T, time)
		zero('%s, momentum at %s T' % (name, time), (rho*sp.diff(u, t, 2) - sp.diff(sigma, X) - rho*b)/E, time)
for x in ('0', '1/10', '2/5', '9/10'):
	where = {X: sp.Rational(x), t: sp.Rational(27, 20)*values[T]}
	end, top = (sp.N((sp.tanh(E*peak/y) + E*(strain - peak)/y).subs(values).subs(where)), sp.N(sp.tanh(E*peak/y).subs(values).subs(where)))
	assert end*top > 0, 'unloading passes f = 0 at X = ' + x
print('holds')
