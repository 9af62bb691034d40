// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

/* One number of each of several points that are updated together, a lane a point. Code for W lanes is, with W = 1, the code
for one point. The number is a double, or a Dual where derivatives are computed. */
template <int W, class T = double> struct alignas(8 * W) Pack {
	T  value[W];
	T& operator[](int l) { return value[l]; }
	T  operator[](int l) const { return value[l]; }
};

/* work(l) for every lane, in vector instructions where it neither branches nor calls. */
template <int W, class Work> void forLanes(Work&& work)
{
#pragma omp simd
	for (int l = 0; l < W; ++l)
		work(l);
}
/* Whether test(l) holds in some lane; the test is evaluated in all lanes. */
template <int W, class Test> bool anyLane(Test&& test)
{
	int any = 0;
#pragma omp simd reduction(| : any)
	for (int l = 0; l < W; ++l)
		any |= int(test(l));
	return any;
}

} // namespace yade::mpm
