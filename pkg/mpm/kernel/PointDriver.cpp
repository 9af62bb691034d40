// SPDX-License-Identifier: GPL-2.0-or-later
#include "PointDriver.hpp"
#include <sstream>
#include <stdexcept>

namespace yade::mpm {

namespace {
	/* Row and column of Solid's components. */
	constexpr int row[6] = { 0, 1, 2, 1, 0, 0 }, column[6] = { 0, 1, 2, 2, 2, 1 };

	/* axes: those of the stress state, in terms of the path's. */
	template <class S>
	PointHistory drive(const Law& law, const std::vector<double>& strain, const std::array<int, 3>& axes, const std::function<void()>& pause)
	{
		const Internals     layout = Internals::of(law);
		const std::size_t   count  = strain.size() / 9;
		std::vector<double> internal(std::size_t(layout.columns(S::N)), 0.);
		double              sigma[S::N] {}, before[S::N] {};
		Response            response;
		PointHistory        history;
		for (std::vector<double>* tensors : { &history.stress, &history.backStress, &history.strain })
			tensors->reserve(9 * count);

		constexpr std::size_t chunk = 256; // entries between two pauses
		for (std::size_t i = 0; i < count; ++i) {
			if (i % chunk == 0) {
				if (pause) pause();
				for (std::vector<double>* tensors : { &history.stress, &history.backStress, &history.strain })
					tensors->resize(9 * std::min(count, i + chunk), 0.);
			}
			auto   at = [&](int r, int c) { return 9 * i + std::size_t(3 * axes[std::size_t(r)] + axes[std::size_t(c)]); };
			double increment[S::N];
			for (int k = 0; k < S::N; ++k) {
				const int    c     = S::voigtIndex[std::size_t(k)];
				const double total = strain[at(row[c], column[c])] + strain[at(column[c], row[c])]; // engineering shear, twice the normal
				const double value = c < 3 ? .5 * total : total;
				increment[k] = value - before[k], before[k] = value;
			}
			updateStress<S>(law, increment, sigma, internal.data(), &response);
			if (!std::all_of(sigma, sigma + S::N, [](double s) { return std::isfinite(s); }))
				throw std::invalid_argument(
					"strain of entry " + std::to_string(i)
					+ ": the law cannot follow a step of this size from the entry before; put entries between the two, or "
					  "look at the material (yieldStress in Pa?)");

			for (int k = 0; k < S::N; ++k) {
				const int c = S::voigtIndex[std::size_t(k)];
				for (const std::size_t entry : { at(row[c], column[c]), at(column[c], row[c]) }) {
					history.stress[entry] = sigma[k];
					history.strain[entry] = strain[entry];
					if (layout.tensors > 0) history.backStress[entry] = internal[std::size_t(k)];
				}
			}
			for (int d = normals<S>(); d < 3; ++d)
				history.strain[at(d, d)] = response.freeStrain;
			history.plasticStrain.push_back(layout.scalars > 0 ? internal[std::size_t(layout.tensors * S::N)] : 0);
			history.dissipation.push_back(response.dissipation);
		}
		return history;
	}

	void requirePath(const std::vector<double>& strain, const std::array<bool, 3>& free, const std::function<void()>& pause)
	{
		if (strain.size() % 9 != 0)
			throw std::invalid_argument("strain has " + std::to_string(strain.size()) + " numbers: give nine, a 3x3 tensor, an entry of the path");
		for (std::size_t i = 0; i < strain.size(); i += 9) {
			if (pause && i % (9 * 4096) == 0) pause();
			for (std::size_t r = 0; r < 3; ++r)
				for (std::size_t c = 0; c < 3; ++c) {
					if (r == c && free[r]) continue;
					const double e = strain[i + 3 * r + c], transposed = strain[i + 3 * c + r];
					const char   axes[] = { "xyz"[r], "xyz"[c], 0 };
					const bool   finite = std::isfinite(e);
					if (finite && !(std::abs(e - transposed) > 1e-12 * (std::abs(e) + std::abs(transposed)))) continue;
					std::ostringstream text;
					text << "strain " << axes << " of entry " << i / 9 << " is " << e;
					if (finite)
						text << " but its transpose differs by " << transposed - e
						     << ": give symmetric tensors, with half the engineering shear";
					else
						text << ": give a finite number";
					throw std::invalid_argument(text.str());
				}
		}
	}
} // namespace

PointHistory drivePoint(const Law& law, const std::vector<double>& strain, const std::array<bool, 3>& free, const std::function<void()>& pause)
{
	const std::string error = validate(law);
	if (!error.empty()) throw std::invalid_argument(error);
	requirePath(strain, free, pause);
	if (!law.sharesFreeStrain() && std::count(free.begin(), free.end(), true) > 1)
		for (std::size_t i = 0; i < strain.size(); ++i)
			if (i % 9 % 4 != 0 && strain[i] != 0) {
				std::ostringstream text;
				text << "strain "
				     << "xyz"[i % 9 / 3] << "xyz"[i % 3] << " of entry " << i / 9 << " is " << strain[i]
				     << ": under shear the stress-free normal components of this material differ in strain; free one of them at most, or give "
					"no shear";
				throw std::invalid_argument(text.str());
			}
	std::array<int, 3> axes {};
	std::size_t        kept = 0;
	for (const bool wanted : { false, true })
		for (int d = 0; d < 3; ++d)
			if (free[std::size_t(d)] == wanted) axes[kept++] = d;
	switch (std::count(free.begin(), free.end(), true)) {
		case 0: return drive<Solid>(law, strain, axes, pause);
		case 1: return drive<FreeNormals<2>>(law, strain, axes, pause);
		case 2: return drive<FreeNormals<1>>(law, strain, axes, pause);
		default: return drive<FreeNormals<0>>(law, strain, axes, pause);
	}
}

} // namespace yade::mpm
