// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmTraction.hpp"
#include "BadInput.hpp"
#include "kernel/LoadedColumns.hpp"
#include <algorithm>

namespace yade {

void MpmTraction::load(std::size_t number, mpm::Analysis analysis, Real time)
{
	const std::string name = "MpmTraction " + std::to_string(number);
	require(traction.allFinite(), name, "traction", traction.transpose(), "give a finite force an area [Pa]");
	require(std::isfinite(pressure), name, "pressure", pressure, "give a finite pressure [Pa]");
	require(times.size() == factors.size(), name, "factors", std::to_string(factors.size()) + " values",
		"give a factor for each of the " + std::to_string(times.size()) + " times");
	require(face.count() > 0, name, "position", "none", "make a traction with mpm.traction()");
	const int wanted = analysis == mpm::Analysis::solid ? 0 : analysis == mpm::Analysis::axisymmetric ? 2 : 1;
	require(kind == wanted, name, "area", area(),
		std::string(kind == 0   ? "it is a face of a solid"
			    : kind == 1 ? "it is a face of a plane problem"
					: "it is a face of rings")
			+ ", and MpmEngine.analysis is another one; make it anew with mpm.traction("
			+ (wanted == 0        ? "face of three dimensions)"
				: wanted == 1 ? "face, thickness=...)"
					      : "face, axisymmetric=True)"));
	require(wanted == 0 || traction[2] == 0, name, "traction", traction.transpose(),
		"in a plane analysis nothing moves along z; give a traction in x and y");

	Real factor = dead ? 0 : 1;
	if (!times.empty()) {
		for (std::size_t k = 0; k < times.size(); ++k) {
			require(std::isfinite(times[k]) && (k == 0 || times[k] > times[k - 1]), name, "times[" + std::to_string(k) + "]", times[k],
				"give finite times that increase [s]");
			require(std::isfinite(factors[k]), name, "factors[" + std::to_string(k) + "]", factors[k], "give finite factors [-]");
		}
		const auto after = std::upper_bound(times.begin(), times.end(), time);
		const auto k     = std::size_t(after - times.begin());
		if (k == 0)
			factor *= factors.front();
		else if (k == times.size())
			factor *= factors.back();
		else
			factor *= factors[k - 1] + (factors[k] - factors[k - 1]) * (time - times[k - 1]) / (times[k] - times[k - 1]);
	}
	for (int d = 0; d < 3; ++d)
		face.traction[std::size_t(d)] = factor * traction[d];
	face.pressure = factor * pressure, face.factor = factor;
}

void MpmTraction::postLoad(MpmTraction&)
{
	const std::string fault = mpm::faultOf(face);
	if (!fault.empty()) refuseDamaged("MpmTraction." + fault);
}

Vector3r MpmTraction::force() const { return { face.resultant[0], face.resultant[1], face.resultant[2] }; }

Vector3r MpmTraction::displacement() const
{
	if (face.count() == 0) return Vector3r::Zero();
	const auto u = face.displacement();
	return { u[0], u[1], u[2] };
}

Real MpmTraction::area() const
{
	Real sum = 0;
	for (const Real w : face.weight)
		sum += w;
	return sum;
}

std::vector<Vector3r> MpmTraction::position() const
{
	std::vector<Vector3r> places;
	for (std::size_t k = 0; k < face.count(); ++k)
		places.emplace_back(face.position[0][k], face.position[1][k], face.position[2][k]);
	return places;
}

} // namespace yade
