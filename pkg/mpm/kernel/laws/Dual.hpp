// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>

namespace yade::mpm {

/* A number and its derivatives with respect to `count` variables (forward automatic differentiation). The update of a law
with Dual in place of double computes its tangent. Comparisons compare values. The derivative of sqrt and abs at 0 is taken as 0. */
template <int count> struct Dual {
	double value = 0, slope[count] {};

	Dual() = default;
	Dual(double v)
	    : value(v)
	{
	}
	/* f(x), of which the derivative is known. */
	static Dual chain(double f, double derivative, const Dual& x)
	{
		Dual result(f);
		for (int k = 0; k < count; ++k)
			result.slope[k] = derivative * x.slope[k];
		return result;
	}
	/* a u + b v beside the value f. */
	static Dual combine(double f, double a, const Dual& u, double b, const Dual& v)
	{
		Dual result(f);
		for (int k = 0; k < count; ++k)
			result.slope[k] = a * u.slope[k] + b * v.slope[k];
		return result;
	}

	friend Dual operator+(const Dual& u, const Dual& v) { return combine(u.value + v.value, 1, u, 1, v); }
	friend Dual operator-(const Dual& u, const Dual& v) { return combine(u.value - v.value, 1, u, -1, v); }
	friend Dual operator*(const Dual& u, const Dual& v) { return combine(u.value * v.value, v.value, u, u.value, v); }
	friend Dual operator/(const Dual& u, const Dual& v)
	{
		const double ratio = u.value / v.value;
		return combine(ratio, 1 / v.value, u, -ratio / v.value, v);
	}
	friend Dual operator-(const Dual& u) { return chain(-u.value, -1, u); }
	Dual&       operator+=(const Dual& v) { return *this = *this + v; }
	Dual&       operator-=(const Dual& v) { return *this = *this - v; }
	Dual&       operator*=(const Dual& v) { return *this = *this * v; }

	friend bool operator<(const Dual& u, const Dual& v) { return u.value < v.value; }
	friend bool operator>(const Dual& u, const Dual& v) { return u.value > v.value; }
	friend bool operator<=(const Dual& u, const Dual& v) { return u.value <= v.value; }
	friend bool operator>=(const Dual& u, const Dual& v) { return u.value >= v.value; }
	friend bool operator==(const Dual& u, const Dual& v) { return u.value == v.value; }
	friend bool operator!=(const Dual& u, const Dual& v) { return u.value != v.value; }

	friend Dual sqrt(const Dual& u)
	{
		const double root = std::sqrt(u.value);
		return chain(root, root > 0 ? .5 / root : 0, u);
	}
	friend Dual pow(const Dual& u, double n) { return chain(std::pow(u.value, n), n * std::pow(u.value, n - 1), u); }
	friend Dual exp(const Dual& u) { return chain(std::exp(u.value), std::exp(u.value), u); }
	friend Dual expm1(const Dual& u) { return chain(std::expm1(u.value), std::exp(u.value), u); }
	friend Dual abs(const Dual& u) { return chain(std::abs(u.value), u.value > 0 ? 1 : u.value < 0 ? -1 : 0, u); }
};

inline double                      valueOf(double x) { return x; }
template <int count> const double& valueOf(const Dual<count>& x) { return x.value; }

} // namespace yade::mpm
