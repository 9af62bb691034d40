// SPDX-License-Identifier: GPL-2.0-or-later
// One scene without YADE: throughput across dimension shape motion threads steps. Writes point-steps a second, of wall and of
// CPU time.
#include "Blocks.hpp"
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <iostream>

using namespace yade::mpm;

/* What roofline.py counts the instructions of. */
[[gnu::noinline]] void measured(Scene& s, int steps)
{
	for (int k = 0; k < steps; ++k)
		s.step();
}

int main(int count, char** arguments)
{
	if (count != 7) {
		std::cerr << "usage: " << arguments[0] << " across 2|3 linear|gimp|quadratic|cubic elastic|yielding|spinning threads steps\n";
		return 1;
	}
	ShapeKind shape = ShapeKind::cubic;
	for (ShapeKind s : allShapes)
		if (!std::strcmp(arguments[3], name(s))) shape = s;
	const Motion motion = !std::strcmp(arguments[4], "yielding")   ? Motion::yielding
			      : !std::strcmp(arguments[4], "spinning") ? Motion::spinning
								       : Motion::elastic;
	const int    across = std::atoi(arguments[1]), dim = std::atoi(arguments[2]), steps = std::atoi(arguments[6]);
	Scene        s     = block(dim, across, shape, motion, std::atoi(arguments[5]));
	const auto   clock = std::clock();
	const auto   start = std::chrono::steady_clock::now();
	measured(s, steps);
	const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	const double busy    = double(std::clock() - clock) / CLOCKS_PER_SEC;
	const double work    = std::pow(across, dim) * steps;
	std::cout << work / seconds << ' ' << work / busy << "\n";
}
