// SPDX-License-Identifier: GPL-2.0-or-later
// Law updates a second on one core, and the mean number of sub-steps, in plane stress. A thousand points each follow a
// cycle of 2.5 yield strains, out of phase, with increments of dx yield strains: 1e-3 as in a step of the material point
// method, 1e-1 and 1 as in an impact.
#include "kernel/Law.hpp"
#include <benchmark/benchmark.h>
#include <limits>
#include <vector>

using namespace yade::mpm;

namespace {

constexpr double young = 210e9, poisson = .3, yieldStress = 240e6, yieldStrain = yieldStress / young;
constexpr int    points = 1000, N = PlaneStress::N;

Law elasticLaw()
{
	Law law;
	law.elastic = { young, poisson };
	return law;
}
Law boucWenLaw(double n)
{
	Law law                 = elasticLaw();
	law.kind                = Law::Kind::boucWen;
	law.boucWen.elastic     = law.elastic;
	law.boucWen.yieldStress = yieldStress, law.boucWen.n = n;
	law.boucWen.hardening = BoucWenParameters::hardeningModulus(young, .05);
	return law;
}
Law compatibleLaw(double n)
{
	Law law               = boucWenLaw(n);
	law.boucWen.reloading = std::numeric_limits<double>::infinity();
	return law;
}
Law j2Law()
{
	Law law            = elasticLaw();
	law.kind           = Law::Kind::j2;
	law.j2.elastic     = law.elastic;
	law.j2.yieldStress = yieldStress;
	law.j2.hardening   = BoucWenParameters::hardeningModulus(young, .05);
	return law;
}

struct Cloud {
	std::vector<double> sigma, internal, phase;
	int                 columns;

	explicit Cloud(const Law& law)
	    : sigma(points * N, 0.)
	    , columns(Internals::of(law).columns(N))
	{
		internal.assign(std::size_t(points * columns), 0.);
		for (int p = 0; p < points; ++p)
			phase.push_back(10. * p / points);
	}
	/* visit(strain increment, sigma, internal) of every point; dx along a triangle wave of amplitude 2.5 and period 10. */
	template <class Visit> void step(double dx, Visit&& visit)
	{
		for (std::size_t p = 0; p < points; ++p) {
			double& t      = phase[p];
			t              = t + dx < 10 ? t + dx : t + dx - 10;
			const double e = (t < 2.5 || t > 7.5 ? dx : -dx) * yieldStrain, strain[N] = { e, -.2 * e, .5 * e };
			visit(strain, &sigma[p * N], &internal[p * std::size_t(columns)]);
		}
	}
};

void updates(benchmark::State& state, const Law& law, double dx)
{
	Cloud cloud(law);
	auto  update = [&](const double* strain, double* sigma, double* internal) { updateStress<PlaneStress>(law, strain, sigma, internal); };
	for (double x = 0; x < 20; x += dx) // past the virgin cycle
		cloud.step(dx, update);
	for (auto _ : state) {
		cloud.step(dx, update);
		benchmark::DoNotOptimize(cloud.sigma.data());
	}
	state.SetItemsProcessed(state.iterations() * points);
	if (law.kind == Law::Kind::boucWen) {
		int subSteps = 0, steps = 0;
		for (double x = 0; x < 10; x += dx, ++steps)
			cloud.step(dx, [&](const double* strain, double* sigma, double* internal) {
				boucWenUpdate<PlaneStress>(law.boucWen, strain, sigma, internal, nullptr, &subSteps);
			});
		state.counters["substeps"] = double(subSteps) / steps / points;
	}
}

#define LAW_BENCHMARK(name, law)                                                                                                                               \
	BENCHMARK_CAPTURE(updates, name / 0.001, law, 1e-3);                                                                                                   \
	BENCHMARK_CAPTURE(updates, name / 0.1, law, .1);                                                                                                       \
	BENCHMARK_CAPTURE(updates, name / 1, law, 1.)

LAW_BENCHMARK(elastic, elasticLaw());
LAW_BENCHMARK(hysteretic n = 2, boucWenLaw(2));
LAW_BENCHMARK(hysteretic n = 2.5, boucWenLaw(2.5));
LAW_BENCHMARK(hysteretic n = 2.3 with pow, boucWenLaw(2.3));
LAW_BENCHMARK(hysteretic n = 10, boucWenLaw(10));
LAW_BENCHMARK(hysteretic n = 25, boucWenLaw(25));
LAW_BENCHMARK(hysteretic n = 10 compatible, compatibleLaw(10));
LAW_BENCHMARK(J2, j2Law());

} // namespace
