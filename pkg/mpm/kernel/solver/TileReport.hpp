// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace yade::mpm {

/* What a pass reports of a tile, since threads do not throw. */
struct TileReport {
	bool           left   = false;   // a point has left its tile, or is invalid
	std::ptrdiff_t failed = -1;      // a point whose stress cannot be updated ...
	const char*    why    = nullptr; // ... and the reason
	double         spin   = 0;       // greatest mean spin of its points, squared [1/s2], with the affine transfer

	void fail(std::size_t p, const char* reason)
	{
		if (failed < 0) failed = std::ptrdiff_t(p), why = reason;
	}
};

} // namespace yade::mpm
