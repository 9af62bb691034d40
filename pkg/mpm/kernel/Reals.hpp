// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

/* One number of each of several points that are worked on at once, a lane a point. What is written for W lanes is, with
W = 1, the same for one point. */
template <int W> struct alignas(8 * W) Reals {
	double  value[W];
	double& operator[](int l) { return value[l]; }
	double  operator[](int l) const { return value[l]; }
};

/* work(l) for every lane, in vector instructions where it neither branches nor calls. */
template <int W, class Work> void forLanes(Work&& work)
{
#pragma omp simd
	for (int l = 0; l < W; ++l)
		work(l);
}
/* Whether test(l) holds in some lane; all lanes are asked. */
template <int W, class Test> bool anyLane(Test&& test)
{
	int any = 0;
#pragma omp simd reduction(| : any)
	for (int l = 0; l < W; ++l)
		any |= int(test(l));
	return any;
}

} // namespace yade::mpm
