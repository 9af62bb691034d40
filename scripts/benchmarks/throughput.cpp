// SPDX-License-Identifier: GPL-2.0-or-later
// One scene without YADE: throughput across shape motion threads steps. Writes point-steps a second, of wall and of CPU time.
#include "Square.hpp"
#include <chrono>
#include <cstring>
#include <ctime>
#include <iostream>

using namespace yade::mpm;

int main(int count, char** arguments)
{
	if (count != 6) {
		std::cerr << "usage: " << arguments[0] << " across linear|gimp|quadratic|cubic elastic|yielding|spinning threads steps\n";
		return 1;
	}
	ShapeKind shape = ShapeKind::cubic;
	for (ShapeKind s : allShapes)
		if (!std::strcmp(arguments[2], name(s))) shape = s;
	const Motion motion = !std::strcmp(arguments[3], "yielding")   ? Motion::yielding
			      : !std::strcmp(arguments[3], "spinning") ? Motion::spinning
								       : Motion::elastic;
	const int    across = std::atoi(arguments[1]), steps = std::atoi(arguments[5]);
	Scene        s     = square(across, shape, motion, std::atoi(arguments[4]));
	const auto   clock = std::clock();
	const auto   start = std::chrono::steady_clock::now();
	for (int k = 0; k < steps; ++k)
		s.step();
	const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	const double busy    = double(std::clock() - clock) / CLOCKS_PER_SEC;
	std::cout << double(across) * across * steps / seconds << ' ' << double(across) * across * steps / busy << "\n";
}
