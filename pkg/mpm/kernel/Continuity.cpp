// SPDX-License-Identifier: GPL-2.0-or-later
#include "Continuity.hpp"
#include "Text.hpp"
#include "solver/Solver.hpp"
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace yade::mpm {

namespace {
	int dimensionOf(const Points& points) { return points.deformation.size() == 1 ? 1 : points.deformation.size() == 4 ? 2 : 3; }

	Eigen::Vector3d positionOf(const Points& points, std::size_t p) { return { points.position[0][p], points.position[1][p], points.position[2][p] }; }

	/* (F_p + F_q)/2; along axes that the analysis lacks nothing deforms. */
	Eigen::Matrix3d meanDeformation(const Points& points, int dim, std::size_t p, std::size_t q)
	{
		Eigen::Matrix3d mean = Eigen::Matrix3d::Identity();
		for (int d = 0; d < dim; ++d)
			for (int e = 0; e < dim; ++e) {
				const Column& F = points.deformation[std::size_t(d * dim + e)];
				mean(d, e)      = .5 * (F[p] + F[q]);
			}
		return mean;
	}

	/* Which of two neighbours has the other on its list. Oblique, so that no usual lattice has neighbours in the plane. */
	bool isAhead(const Eigen::Vector3d& dX) { return dX.dot(Eigen::Vector3d(1, .41, .17)) > 0; }

	double depth(const Points& points, std::size_t p, const Wall& wall) { return wall.side * (points.position[std::size_t(wall.axis)][p] - wall.position); }
	double stretchAlong(const Points& points, int axis, std::size_t p) { return points.deformation[std::size_t(axis * (dimensionOf(points) + 1))][p]; }

	std::string text(const Points& points, std::size_t p)
	{
		const Eigen::Vector3d x = positionOf(points, p);
		return "(" + number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + ") m";
	}
} // namespace

void Continuity::check(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls, double cellSize, double largest, double time)
{
	const Gap gap = widest(points, laws, walls);
	if (!(gap.opening > largest)) return;
	const bool wall = gap.q == nowhere;
	throw StepFailure("material point " + std::to_string(points.id[gap.p]) + " and "
				  + (wall ? "the fixed wall beside it" : "its neighbour " + std::to_string(points.id[gap.q])) + " have come apart at time "
				  + number(time) + " s, position " + text(points, gap.p) + (wall ? "" : " and " + text(points, gap.q)) + ": they are "
				  + number(gap.distance) + " m from each other, " + number(gap.opening / cellSize)
				  + " cells more than the deformation of the material between them accounts for. This is numerical fracture: points so far "
				    "apart share no "
				    "node. Use larger cells for the same points, shape='cubic', or less load; where the body is meant to come apart, set "
				    "MpmEngine.largestGap = inf",
		points.id[gap.p]);
}

Continuity::Gap Continuity::widest(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls)
{
	const bool known = locate(points);
	if (!known) findNeighbours(points, laws);
	std::vector<int> kinds;
	for (const Wall& wall : walls)
		kinds.insert(kinds.end(), { int(wall.kind), wall.axis, wall.side });
	if (!known || kinds != memory.kinds) findFootings(points, laws, walls);
	memory.kinds            = std::move(kinds);
	const int         dim   = dimensionOf(points);
	const std::size_t links = std::size_t(dim);
	Gap               gap;
	for (std::size_t k = 0; k < memory.neighbours.size(); ++k) {
		const std::size_t slot = k / links, other = memory.neighbours[k], p = m_place[slot], q = m_place[other];
		if (other == slot || p == nowhere || q == nowhere) continue; // none, or erased since
		const double distance = (positionOf(points, q) - positionOf(points, p)).norm();
		if (distance <= gap.opening) continue;
		Eigen::Vector3d dX = Eigen::Vector3d::Zero();
		for (int d = 0; d < dim; ++d)
			dX[d] = memory.dX[k * links + std::size_t(d)];
		const double opening = distance - (meanDeformation(points, dim, p, q) * dX).norm();
		if (opening > gap.opening) gap = { p, q, distance, opening };
	}
	for (std::size_t k = 0; k < memory.footings.size(); ++k) {
		const std::size_t p = m_place[memory.footings[k]];
		if (p == nowhere) continue;
		const Wall&  wall     = walls[memory.walls[k]];
		const double distance = depth(points, p, wall), opening = distance - stretchAlong(points, wall.axis, p) * memory.depths[k];
		if (opening > gap.opening) gap = { p, nowhere, distance, opening };
	}
	return gap;
}

/* Finds the points' places; false where nothing is known, or there is a point that has not been seen before. */
bool Continuity::locate(const Points& points)
{
	const std::size_t n = memory.ids.size();
	if (n == 0 || memory.neighbours.size() != n * std::size_t(dimensionOf(points))) return false; // of points of another dimension
	if (m_place.size() != n) {                                                                    // of a memory that has been loaded
		m_slots.clear();
		for (std::size_t slot = 0; slot < n; ++slot)
			m_slots.emplace_back(memory.ids[slot], Slot(slot));
		std::sort(m_slots.begin(), m_slots.end());
	} else if (points.generation == m_generation && points.count() == m_count)
		return true;
	m_generation = points.generation, m_count = points.count();
	m_place.assign(n, nowhere);
	for (std::size_t p = 0; p < points.count(); ++p) {
		const auto slot = std::lower_bound(m_slots.begin(), m_slots.end(), std::make_pair(points.id[p], Slot(0)));
		if (slot == m_slots.end() || slot->first != points.id[p]) return false;
		m_place[slot->second] = p;
	}
	return true;
}

void Continuity::findNeighbours(const Points& points, const std::vector<Law>& laws)
{
	const std::size_t n = points.count(), links = std::size_t(dimensionOf(points));
	const int         dim = dimensionOf(points);
	memory.ids            = points.id;
	memory.neighbours.resize(n * links), memory.dX.assign(n * links * links, 0);
	for (std::size_t k = 0; k < n * links; ++k)
		memory.neighbours[k] = Slot(k / links);
	m_place.clear(), locate(points);

	constexpr double reach = 1.5; // spacings: neighbours along the axes of a lattice, and next to one
	const double     width = 2 * *std::max_element(points.size.begin(), points.size.end()); // of bins: neighbours may be stretched already
	struct Entry {
		std::array<double, 3> bin; // whole numbers, of any size
		std::size_t           p;
	};
	auto               before = [](const Entry& a, const Entry& b) { return a.bin < b.bin; };
	std::vector<Entry> entries;
	for (std::size_t p = 0; p < n; ++p) {
		if (laws[std::size_t(points.material[p])].hasTensionCutoff()) continue;
		const Eigen::Vector3d x = positionOf(points, p) / width;
		entries.push_back({ { std::floor(x[0]), std::floor(x[1]), std::floor(x[2]) }, p });
	}
	std::sort(entries.begin(), entries.end(), before);

	struct Neighbour {
		double          distance; // in spacings
		std::size_t     q;
		Eigen::Vector3d dX;
	};
	std::vector<Neighbour> found;
	for (const Entry& entry : entries) {
		const std::size_t p = entry.p;
		found.clear();
		for (int row = 0; row < 9; ++row) { // of three bins that follow each other along z
			const int                   across = row / 3 - 1, along = row % 3 - 1;
			const std::array<double, 3> low { entry.bin[0] + across, entry.bin[1] + along, entry.bin[2] - 1 };
			auto                        e = std::lower_bound(entries.begin(), entries.end(), Entry { low, 0 }, before);
			for (; e != entries.end() && e->bin[0] == low[0] && e->bin[1] == low[1] && e->bin[2] <= low[2] + 2; ++e) {
				const std::size_t     q  = e->p;
				const Eigen::Vector3d dx = positionOf(points, q) - positionOf(points, p);
				if (q == p || dx.squaredNorm() > width * width) continue;
				const Eigen::Vector3d dX       = meanDeformation(points, dim, p, q).inverse() * dx;
				const double          distance = 2 * dX.norm() / (points.size[p] + points.size[q]);
				if (distance < reach && isAhead(dX)) found.push_back({ distance, q, dX });
			}
		}
		const std::size_t kept = std::min(found.size(), links);
		std::partial_sort(found.begin(), found.begin() + std::ptrdiff_t(kept), found.end(),
			[](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
		for (std::size_t k = 0; k < kept; ++k) {
			memory.neighbours[p * links + k] = Slot(found[k].q);
			for (std::size_t d = 0; d < links; ++d)
				memory.dX[(p * links + k) * links + d] = float(found[k].dX[int(d)]);
		}
	}
}

void Continuity::findFootings(const Points& points, const std::vector<Law>& laws, const std::vector<Wall>& walls)
{
	memory.footings.clear(), memory.walls.clear(), memory.depths.clear();
	for (std::size_t w = 0; w < walls.size(); ++w) {
		if (walls[w].kind != Wall::Kind::fixed) continue;
		for (std::size_t slot = 0; slot < m_place.size(); ++slot) {
			const std::size_t p = m_place[slot];
			if (p == nowhere || laws[std::size_t(points.material[p])].hasTensionCutoff()) continue;
			const double distance = depth(points, p, walls[w]) / stretchAlong(points, walls[w].axis, p);
			if (distance >= .75 * points.size[p]) continue; // not in the layer next to it
			memory.footings.push_back(Slot(slot)), memory.walls.push_back(Slot(w)), memory.depths.push_back(distance);
		}
	}
}

} // namespace yade::mpm
