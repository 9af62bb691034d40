// SPDX-License-Identifier: GPL-2.0-or-later
// Law updates a second on one core, and the mean number of sub-steps, in plane stress and small strain. A thousand points each
// follow a cycle of 2.5 yield strains, out of phase, with increments of dx yield strains: 1e-3 as in a step of the material point
// method, 1e-1 and 1 as in an impact. In blocks of eight as the engine has them (`alike`: neighbours are close in phase; `mixed`: their
// phases have nothing to do with each other, and the block waits for the point with most sub-steps), and `alone`, point by point.
//
//	mpm_law_benchmark [--benchmark_filter=...]
//	mpm_law_benchmark count LAW dx alike|mixed|alone UPDATES   does so many updates of a point, for callgrind
#include "kernel/laws/LawLanes.hpp"
#include <benchmark/benchmark.h>
#include <cstring>
#include <iostream>
#include <limits>
#include <vector>

using namespace yade::mpm;

namespace {

constexpr double young = 210e9, poisson = .3, yieldStress = 240e6, yieldStrain = yieldStress / young;
constexpr int    points = 1000, N = PlaneStress::N;
using State = PlaneStress;
enum class Order { alike, mixed, alone };
constexpr const char* orderNames[] = { "alike", "mixed", "alone" };

Law lawOf(const Model& model)
{
	Law law;
	law.elastic = { young, poisson };
	law.model   = model;
	return law;
}
Law boucWen(double n)
{
	BoucWen model;
	model.yieldStress = yieldStress, model.hardening = hardeningModulus(young, .05), model.n = n;
	return lawOf(model);
}
Law j2()
{
	J2 model;
	model.yieldStress = yieldStress, model.hardening = hardeningModulus(young, .05);
	return lawOf(model);
}
Law druckerPrager()
{
	DruckerPrager model;
	model.cohesion = yieldStress / 2, model.internalFriction = .5, model.dilatancy = .2;
	return lawOf(model);
}
Law mohrCoulomb()
{
	MohrCoulomb model;
	model.cohesion = yieldStress / 2, model.internalFriction = .5, model.dilatancy = .2;
	return lawOf(model);
}
template <class Change> Law changed(Law law, Change&& change)
{
	change(law);
	return law;
}
const struct {
	const char* name;
	Law         law;
} laws[] = {
	{ "elastic", lawOf(Elastic()) },
	{ "n=2", boucWen(2) },
	{ "n=2.5", boucWen(2.5) },
	{ "n=2.3", boucWen(2.3) }, // by pow
	{ "n=10", boucWen(10) },
	{ "n=25", boucWen(25) },
	{ "n=10,reloading", changed(boucWen(10), [](Law& law) { as<BoucWen>(law).reloading             = std::numeric_limits<double>::infinity(); }) },
	{ "n=10,degradation", changed(boucWen(10), [](Law& law) { as<BoucWen>(law).strengthDegradation= as<BoucWen>(law).stiffnessDegradation = .01; }) },
	{ "n=10,isotropic", changed(boucWen(10), [](Law& law) { as<BoucWen>(law).isotropic.modulus= .02 * young; }) },
	{ "J2", j2() },
	{ "J2,isotropic", changed(j2(), [](Law& law) { as<J2>(law).isotropic.modulus= .02 * young; }) },
	{ "Drucker-Prager", druckerPrager() },
	{ "Mohr-Coulomb", mohrCoulomb() },
	{ "Mohr-Coulomb,cutoff", changed(mohrCoulomb(), [](Law& law) { as<MohrCoulomb>(law).tensionCutoff= yieldStress / 3; }) },
};

class Cloud {
public:
	Cloud(const Law& law, double dx, Order order)
	    : m_law(law)
	    , m_dx(dx)
	    , m_order(order)
	    , m_blocks(points / lanes)
	    , m_phase(points)
	{
		std::memset(static_cast<void*>(m_blocks.data()), 0, m_blocks.size() * sizeof(m_blocks[0]));
		for (int p = 0; p < points; ++p)
			m_phase[std::size_t(p)] = 10. / points * (order == Order::mixed ? p * 389 % points : p);
		m_dx = std::max(dx, .1);
		for (double x = 0; x < 20; x += m_dx) // past the virgin cycle
			step();
		m_dx = dx;
	}
	/* One increment of every point along a triangle wave of amplitude 2.5 and period 10. */
	void step()
	{
		for (std::size_t b = 0; b < m_blocks.size(); ++b) {
			auto& block = m_blocks[b];
			for (int l = 0; l < lanes; ++l) {
				const double e = next(m_phase[b * lanes + std::size_t(l)]);
				block.G[0][l] = e, block.G[3][l] = -.2 * e, block.G[1][l] = block.G[2][l] = .25 * e;
			}
			if (m_order == Order::alone)
				for (int l = 0; l < lanes; ++l)
					alone(block, l);
			else
				updateBlock(instructionSet(), m_law, false, block);
		}
	}
	/* Mean number over a cycle. */
	double subSteps()
	{
		int          count = 0, steps = 0;
		Responses<1> heat;
		for (double x = 0; x < 10; x += m_dx, ++steps)
			for (std::size_t p = 0; p < points; ++p) {
				auto&        block = m_blocks[p / lanes];
				const int    l     = int(p % lanes);
				const double e     = next(m_phase[p]);
				Pack<1>      strain[N] { { e }, { -.2 * e }, { .5 * e } }, sigma[N], internal[maxInternals(N)];
				transfer(
					block, [&](Pack<1>& mine, Lanes& its) { mine[0] = its[l]; }, sigma, internal);
				as<BoucWen>(m_law).update<State>(m_law.elastic, strain, sigma, internal, heat, &count);
				transfer(
					block, [&](Pack<1>& mine, Lanes& its) { its[l] = mine[0]; }, sigma, internal);
			}
		return double(count) / steps / points;
	}

private:
	Law                          m_law;
	double                       m_dx;
	Order                        m_order;
	std::vector<LawBlock<State>> m_blocks;
	std::vector<double>          m_phase;

	double next(double& t) const
	{
		t = t + m_dx < 10 ? t + m_dx : t + m_dx - 10;
		return (t < 2.5 || t > 7.5 ? m_dx : -m_dx) * yieldStrain;
	}
	template <class Copy, class Number> void transfer(LawBlock<State>& block, Copy&& copy, Number* sigma, Number* internal) const
	{
		for (int k = 0; k < N; ++k)
			copy(sigma[k], block.sigma[k]);
		for (int k = 0; k < Internals::of(m_law).columns(N); ++k)
			copy(internal[k], block.internal[k]);
	}
	void alone(LawBlock<State>& block, int l) const
	{
		double       sigma[N], internal[maxInternals(N)];
		const double strain[N] = { block.G[0][l], block.G[3][l], block.G[1][l] + block.G[2][l] };
		transfer(
			block, [l](double& mine, Lanes& its) { mine = its[l]; }, sigma, internal);
		updateStress<State>(m_law, strain, sigma, internal);
		transfer(
			block, [l](double& mine, Lanes& its) { its[l] = mine; }, sigma, internal);
	}
};

void updates(benchmark::State& state, const Law& law, double dx, Order order)
{
	Cloud cloud(law, dx, order);
	for (auto _ : state)
		cloud.step();
	state.SetItemsProcessed(state.iterations() * points);
	if (is<BoucWen>(law)) state.counters["substeps"] = cloud.subSteps();
}

int count(const std::string& name, double dx, const std::string& order, long updates)
{
	for (const auto& entry : laws)
		for (int k = 0; k < 3; ++k)
			if (name == entry.name && order == orderNames[k]) {
				Cloud cloud(entry.law, dx, Order(k));
				for (long i = 0; i < updates; i += points)
					cloud.step();
				return 0;
			}
	std::cerr << "no such law or order\n";
	return 1;
}

} // namespace

int main(int argc, char** argv)
{
	if (argc == 6 && !std::strcmp(argv[1], "count")) return count(argv[2], std::stod(argv[3]), argv[4], std::stol(argv[5]));
	for (const auto& entry : laws)
		for (const double dx : { 1e-3, .1, 1. })
			for (const Order order : { Order::alike, Order::mixed, Order::alone }) {
				char dxText[16];
				std::snprintf(dxText, sizeof dxText, "%g", dx);
				benchmark::RegisterBenchmark((std::string(entry.name) + '/' + dxText + '/' + orderNames[int(order)]).c_str(),
					[&law = entry.law, dx, order](benchmark::State& state) { updates(state, law, dx, order); });
			}
	benchmark::Initialize(&argc, argv);
	benchmark::RunSpecifiedBenchmarks();
}
