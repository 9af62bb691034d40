// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <chrono>
#include <exception>
#include <thread>

namespace yade {

/* What an engine does in a step. YADE loses the exception of a loop that ends before O.run(n, True) has begun to wait for it:
an exception waits a little before it leaves. */
template <class Work> void act(Work&& work)
{
	try {
		work();
	} catch (const std::exception&) {
		std::this_thread::sleep_for(std::chrono::milliseconds(50));
		throw;
	}
}

} // namespace yade
