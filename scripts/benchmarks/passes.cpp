// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of whole scenes without YADE: items are points times steps.
#include "Blocks.hpp"
#include "kernel/InstructionSet.hpp"
#include <benchmark/benchmark.h>

using namespace yade::mpm;

namespace {

void step(benchmark::State& state, ShapeKind shape, Motion motion)
{
	const int across = int(state.range(0));
	Scene     s      = block(2, across, shape, motion, int(state.range(1)));
	for (auto _ : state)
		s.step();
	state.SetItemsProcessed(state.iterations() * across * across);
	state.SetLabel(name(instructionSet()));
}

void sizes(benchmark::internal::Benchmark* b)
{
	for (int threads : { 1, 2 })
		for (int across : { 19, 100, 500, 1000 })
			b->Args({ across, threads });
	b->ArgNames({ "across", "threads" })->UseRealTime();
}

BENCHMARK_CAPTURE(step, linear / elastic, ShapeKind::linear, Motion::elastic)->Apply(sizes);
BENCHMARK_CAPTURE(step, quadratic / elastic, ShapeKind::quadratic, Motion::elastic)->Apply(sizes);
BENCHMARK_CAPTURE(step, cubic / elastic, ShapeKind::cubic, Motion::elastic)->Apply(sizes);
BENCHMARK_CAPTURE(step, cubic / yielding, ShapeKind::cubic, Motion::yielding)->Apply(sizes);
BENCHMARK_CAPTURE(step, cubic / spinning, ShapeKind::cubic, Motion::spinning)->Apply(sizes);

} // namespace
