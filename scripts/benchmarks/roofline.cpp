// SPDX-License-Identifier: GPL-2.0-or-later
// What this machine can do: fused multiplications and additions without memory, a triad on arrays that no cache holds, and
// cycles. Writes CSV: threads, instruction set, flop/s, byte/s, cycles/s, the best of several trials.
#include "kernel/InstructionSet.hpp"
#include <algorithm>
#include <chrono>
#include <iostream>
#include <omp.h>
#include <vector>

using namespace yade::mpm;

namespace {

constexpr int lanes = 96; // in 12 registers of AVX-512 or 24 of AVX2, of which 16 exist: see accumulate()

template <class Work> double seconds(Work&& work)
{
	double best = 1e9;
	for (int k = 0; k < 7; ++k) {
		const auto start = std::chrono::steady_clock::now();
		work();
		best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	}
	return best;
}

/* x = a x + b on `count` doubles; as many chains as hide the latency of an operation. */
template <int count> double accumulate(long rounds, double a, double b)
{
	double x[count];
	for (int k = 0; k < count; ++k)
		x[k] = k;
	for (long r = 0; r < rounds; ++r)
#pragma GCC unroll 96
		for (int k = 0; k < count; ++k)
			x[k] = a * x[k] + b;
	double sum = 0;
	for (double v : x)
		sum += v;
	return sum;
}

double flops(int threads)
{
	const InstructionSet set    = instructionSet();
	const long           rounds = 4000000;
	const int            count  = set == InstructionSet::avx512 ? lanes : set == InstructionSet::avx2 ? lanes / 2 : lanes / 4;
	volatile double      sink   = 0;
	const double         time   = seconds([&] {
#pragma omp parallel num_threads(threads)
		{
			double result = 0;
			run(set, [&] {
				result = count == lanes       ? accumulate<lanes>(rounds, .999, 1e-3)
					 : count == lanes / 2 ? accumulate<lanes / 2>(rounds, .999, 1e-3)
							      : accumulate<lanes / 4>(rounds, .999, 1e-3);
			});
#pragma omp critical
			sink = sink + result;
		}
	});
	return 2. * count * double(rounds) * threads / time;
}

double bandwidth(int threads)
{
	const long          count = 1 << 24; // three arrays of 128 MiB
	std::vector<double> a(count), b(count, 1.), c(count, 2.);
	const double        time = seconds([&] {
#pragma omp parallel for schedule(static) num_threads(threads)
		for (long i = 0; i < count; ++i)
			a[i] = b[i] + 3. * c[i];
	});
	return 4. * 8 * double(count) / time; // a is read before it is written
}

/* By two operations of one cycle each that wait for each other. */
double clockRate()
{
	const long             rounds = 200000000;
	volatile unsigned long seed = 12345, sink = 0;
	const double           time = seconds([&] {
                const unsigned long r = seed;
                unsigned long       x = seed + 1;
                for (long k = 0; k < rounds; ++k)
                        x = (x ^ r) + r;
                sink = x;
        });
	return 2. * double(rounds) / time;
}

} // namespace

int main()
{
	const double clock = clockRate();
	std::cout << "threads,instructions,flops,bytes,cycles\n";
	for (int threads : { 1, 2 })
		if (threads <= omp_get_num_procs())
			std::cout << threads << ',' << name(instructionSet()) << ',' << flops(threads) << ',' << bandwidth(threads) << ',' << clock
				  << std::endl;
}
