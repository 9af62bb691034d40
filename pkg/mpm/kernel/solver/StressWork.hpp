// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "PointState.hpp"

namespace yade::mpm {

/* V sigma : d eps over a step at a point, by the trapezoidal rule, and its parts: made before the stress update, added after it. */
template <class S> struct StressWork {
	static constexpr int dim = S::dim;
	Points&              points;
	const Law&           law;
	const std::size_t    p;
	const bool           largeStrain;
	const double* const  strain;
	const double         volume, work, hardening;

	StressWork(Points& all, const Law& l, std::size_t point, bool large, const double* F, const double* de, const double* sigma, const double* internal)
	    : points(all)
	    , law(l)
	    , p(point)
	    , largeStrain(large)
	    , strain(de)
	    , volume(currentVolume<dim>(all, point, F, large))
	    , work(.5 * volume * dot<S>(sigma, de))
	    , hardening(hardeningEnergy<S>(l, internal))
	{
	}
	void add(const double* F, const double* sigma, const double* internal, const Response& response, Energies& sum) const
	{
		const double after = currentVolume<dim>(points, p, F, largeStrain), middle = .5 * (volume + after);
		const double heat = middle * response.dissipation, stored = middle * (hardeningEnergy<S>(law, internal) - hardening);
		sum.dissipation += heat;
		sum.hardening += stored;
		sum.elastic += work + .5 * after * dot<S>(sigma, strain) - heat - stored;
		points.dissipation[p] += heat / points.volume0[p];
	}
};

} // namespace yade::mpm
