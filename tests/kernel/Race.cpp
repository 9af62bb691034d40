// SPDX-License-Identifier: GPL-2.0-or-later
/* Negative control of the preset `threads`: a loop over threads without a race, and with an argument one with a race, which
ThreadSanitizer must report. */
#include <cstdio>
#include <vector>

int main(int argc, char**)
{
	constexpr int       n = 1000;
	std::vector<double> values(n, 1);
	double              sum    = 0;
	int                 shared = 0;
	for (int round = 0; round < 3; ++round) {
#pragma omp parallel for num_threads(4)
		for (int i = 0; i < n; ++i)
			values[std::size_t(i)] += i;
		for (const double value : values)
			sum += value;
	}
	if (argc > 1) {
#pragma omp parallel for num_threads(4)
		for (int i = 0; i < n; ++i)
			shared += i;
	}
	std::printf("%g %d\n", sum, shared);
}
