// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "BoucWen.hpp"
#include "DruckerPrager.hpp"
#include "Elastic.hpp"
#include "J2.hpp"
#include <string>
#include <variant>

namespace yade::mpm {

/* The list of laws. A law is one struct, in a file of its own (doc/add-a-law.md), and one entry here. */
using Model = std::variant<Elastic, BoucWen, J2, DruckerPrager>;

namespace detail {
	/* work(model) with the law that a Model holds; like std::visit, but the compiler can inline it for an instruction set. */
	template <std::size_t index = 0, class Work> decltype(auto) visitModel(const Model& model, Work&& work)
	{
		if constexpr (index + 1 < std::variant_size_v<Model>)
			if (model.index() != index) return visitModel<index + 1>(model, work);
		return work(*std::get_if<index>(&model));
	}
	template <std::size_t... index> constexpr int maxInternals(int components, std::index_sequence<index...>)
	{
		int most = 0;
		for (const int columns : { std::variant_alternative_t<index, Model>::maxInternals.columns(components)... })
			most = columns > most ? columns : most;
		return most;
	}
} // namespace detail

/* A material as the kernel uses it: density, Hooke's law, and a law with its parameters. */
struct Law {
	double density       = 0; // [kg/m3]
	double frictionAngle = 0; // of contacts between bodies of points [rad]
	Hooke  elastic;
	Model  model;

	template <class Work> decltype(auto) visit(Work&& work) const { return detail::visitModel(model, work); }

	double stiffnessBound() const
	{
		return visit([](const auto& law) { return law.stiffnessBound(); });
	}
	bool keepsVolume() const
	{
		return visit([](const auto& law) { return law.keepsVolume(); });
	}
	bool hasTensionCutoff() const
	{
		return visit([](const auto& law) { return law.hasTensionCutoff(); });
	}
};

/* Whether two laws are the same to the last bit of every parameter. */
inline bool operator==(const Law& a, const Law& b)
{
	return a.density == b.density && a.elastic.young == b.elastic.young && a.elastic.poisson == b.elastic.poisson && a.model == b.model;
}

/* The parameters of a law that is known to be an M. */
template <class M> bool     is(const Law& law) { return std::holds_alternative<M>(law.model); }
template <class M> M&       as(Law& law) { return std::get<M>(law.model); }
template <class M> const M& as(const Law& law) { return std::get<M>(law.model); }

/* Empty, or the first fault of a law's parameters: attribute, value and remedy. */
std::string validate(const Law& law);

inline Internals Internals::of(const Law& law)
{
	return law.visit([](const auto& model) { return model.internals(); });
}
/* The greatest number of internal variables of a law in the list, in a stress state of so many components. */
constexpr int maxInternals(int components) { return detail::maxInternals(components, std::make_index_sequence<std::variant_size_v<Model>>()); }

/* sigma and the internal variables at the end of a step; sigma and all tensors have been turned with the material. Adds
to response, where given. Compiled for the stress states that Law.cpp lists. */
template <class S> void updateStress(const Law& law, const double* strain, double* sigma, double* internal, Response* response = nullptr);

/* The tangent d sigma/d epsilon of updateStress(), N x N and row-major; sigma and internal are those at the start of the step,
turned with the material, and stay as they are. It is the derivative of the update itself, sub-steps included. */
template <class S> void consistentTangent(const Law& law, const double* strain, const double* sigma, const double* internal, double* tangent);

/* Energies a volume [J/m3] that a point holds and can give back. */
template <class S> double elasticEnergy(const Law& law, const double* sigma, const double* internal)
{
	const double growth = law.visit([&](const auto& model) { return model.template complianceGrowth<S>([&](int k) { return internal[k]; }); });
	return .5 * growth * complianceProduct<S>(law.elastic, sigma);
}
template <class S> double hardeningEnergy(const Law& law, const double* internal)
{
	return law.visit([&](const auto& model) { return model.template hardeningEnergy<S>(internal); });
}

} // namespace yade::mpm
