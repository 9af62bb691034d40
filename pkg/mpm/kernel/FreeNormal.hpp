// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Response.hpp"
#include "StressState.hpp"
#include <algorithm>

namespace yade::mpm {

/* Carries an isotropic law, known in the components of Solid, over to a stress state whose missing normal stresses are
zero. They all get the same strain increment e, the root of the stress that it causes there, sought between brackets by
the rule of false position with Illinois' correction.

update(strain, sigma, p, response) is the law in Solid; p its one internal variable. */
template <class S, class Update> void updateWithFreeNormals(const Hooke& C, Update&& update, const double* strain, double* sigma, double& p, Response& response)
{
	static_assert(normals<S>() < 3);
	double   s[6], p3 = p;
	Response r;
	auto     freeStress = [&](double e) {
                double full[6] = { e, e, e, 0, 0, 0 };
                std::fill(s, s + 6, 0.);
                for (int k = 0; k < S::N; ++k)
                        full[S::solid[k]] = strain[k], s[S::solid[k]] = sigma[k];
                p3 = p, r = Response {};
                update(full, s, p3, r);
                return s[2];
	};
	double size = 0, stress = 0, b = 0;
	for (int k = 0; k < S::N; ++k)
		size = std::max(size, std::abs(strain[k])), stress = std::max(stress, std::abs(sigma[k]));
	for (int k = 0; k < normals<S>(); ++k)
		b -= (normals<S>() == 1 ? C.poisson : C.poisson / (1 - C.poisson)) * strain[k];

	// from the elastic root outwards until the stress changes sign, then inwards
	const double modulus = C.lame + 2 * C.shear, goal = 1e-14 * modulus * size + 1e-15 * stress;
	double       fb = freeStress(b), a = b, fa = fb, width = std::abs(fb) / modulus;
	while (std::abs(fb) > goal && fb * fa > 0 && std::isfinite(width))
		a = b, fa = fb, b -= std::copysign(width, fa), width *= 2, fb = freeStress(b);
	for (int iteration = 0; iteration < 200 && std::abs(fb) > goal && std::abs(b - a) > 1e-16 * size; ++iteration) {
		const double e = b - fb * (b - a) / (fb - fa), fe = freeStress(e);
		if (fe * fb < 0)
			a = b, fa = fb;
		else
			fa *= .5;
		b = e, fb = fe;
	}
	response.freeStrain += b;
	for (int k = 0; k < S::N; ++k)
		sigma[k] = s[S::solid[k]];
	p = p3;
	response.dissipation += r.dissipation;
}

} // namespace yade::mpm
