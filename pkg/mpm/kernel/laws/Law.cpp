// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law.hpp"
#include "UpdateStress.hpp"
#include <sstream>

namespace yade::mpm {

template <class Value> static void requireValue(std::string& message, bool good, const char* attribute, Value value, const char* remedy)
{
	if (good || !message.empty()) return;
	std::ostringstream text;
	text << attribute << " = " << value << ": " << remedy;
	message = text.str();
}
void Check::require(bool good, const char* attribute, double value, const char* remedy) { requireValue(message, good, attribute, value, remedy); }
void Check::require(bool good, const char* attribute, const char* value, const char* remedy) { requireValue(message, good, attribute, value, remedy); }
void Check::finiteNotNegative(const char* attribute, double value)
{
	require(value >= 0 && std::isfinite(value), attribute, value, "give a finite number, 0 or more");
}
void Check::yieldStress(double stress, double young)
{
	require(stress > 0 && std::isfinite(stress), "yieldStress", stress, "give a positive stress [Pa]");
	require(stress >= 1e-12 * young, "yieldStress", stress, "give a stress [Pa] of at least 1e-12 young: less is lost in rounding");
}
void Check::hardeningModulus(double modulus)
{
	require(modulus >= 0 && std::isfinite(modulus), "hardening modulus", modulus, "give a tangentRatio from 0 to below 1");
}

std::string validate(const Law& law)
{
	Check        check;
	const Hooke& C = law.elastic;
	check.require(C.young > 0 && std::isfinite(C.young), "young", C.young, "give a positive modulus [Pa]");
	check.require(C.poisson > -1 && C.poisson < .5, "poisson", C.poisson, "give a ratio above -1 and below 0.5");
	law.visit([&](const auto& model) { model.check(C, check); });
	return check.message;
}

template <class S> void updateStress(const Law& law, const double* strain, double* sigma, double* internal, Response* response)
{
	constexpr int N       = S::N;
	const int     columns = Internals::of(law).columns(N);
	Pack<1>       e[N], s[N], state[maxInternals(N)];
	Responses<1>  added;
	for (int k = 0; k < N; ++k)
		e[k][0] = strain[k], s[k][0] = sigma[k];
	for (int k = 0; k < columns; ++k)
		state[k][0] = internal[k];
	updateStressLanes<S>(law, e, s, state, added, response != nullptr);
	for (int k = 0; k < N; ++k)
		sigma[k] = s[k][0];
	for (int k = 0; k < columns; ++k)
		internal[k] = state[k][0];
	if (response) response->dissipation += added.dissipation[0], response->freeStrain += added.freeStrain[0];
}

template <class S> void consistentTangent(const Law& law, const double* strain, const double* sigma, const double* internal, double* tangent)
{
	law.visit([&](const auto& model) { model.template tangent<S>(law.elastic, strain, sigma, internal, tangent); });
}

template void updateStress<Uniaxial>(const Law&, const double*, double*, double*, Response*);
template void updateStress<PlaneStress>(const Law&, const double*, double*, double*, Response*);
template void updateStress<PlaneStrain>(const Law&, const double*, double*, double*, Response*);
template void updateStress<Solid>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<0>>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<1>>(const Law&, const double*, double*, double*, Response*);
template void updateStress<FreeNormals<2>>(const Law&, const double*, double*, double*, Response*);

template void consistentTangent<Uniaxial>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<PlaneStress>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<PlaneStrain>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<Solid>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<FreeNormals<0>>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<FreeNormals<1>>(const Law&, const double*, const double*, const double*, double*);
template void consistentTangent<FreeNormals<2>>(const Law&, const double*, const double*, const double*, double*);

} // namespace yade::mpm
