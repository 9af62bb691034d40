// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../InstructionSet.hpp"
#include "../Kinematics.hpp"
#include "Lanczos.hpp"
#include "../Lanes.hpp"
#include "../laws/LawLanes.hpp"
#include "../transfer/ShapeFunction.hpp"
#include "Solver.hpp"
#include "../boundary/WallMirror.hpp"
#include <cstring>

namespace yade::mpm {

/* Suffixes as in the literature: _p of a point, _i of a node, _ip a weight of point p at node i. */
template <class S, class Shape> class MpmSolver final : public Solver {
public:
	static constexpr int  dim = S::dim, N = S::N;
	static constexpr bool hoop = hasHoop<S>;

	MpmSolver(Analysis analysis, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
	    : m_analysis(analysis)
	    , m_cellSize(cellSize)
	    , m_points(points)
	    , m_laws(laws)
	    , m_walls(walls)
	    , m_instructions(instructionSet())
	{
	}

	/* One step, eqs. 12 to 16 of the paper. Weights are those of the positions at the start of the step throughout. */
	void step(const StepControl& control) override
	{
		if (m_points.count() == 0) return;
		m_control         = control;
		const bool energy = control.trackEnergy;
		if (energy) startEnergies();
		layGrid();
		lap("points sorted into tiles");
		if (energy) m_tracking.tiles.resize(m_grid.tiles().size());

		clearSums();
		if (control.scheme == Scheme::usf) {
			forEachTile([&](std::size_t t) { pointsToGrid<false>(t); });
			startVelocities();
			m_stressControl = control;
			if (averages(control)) {
				clearSums();
				forEachTile([&](std::size_t t) { updateTileStress(t), pointsToGrid<true>(t); });
			} else {
				forEachTile([&](std::size_t t) { stressThenForce(t); });
			}
			checkStress();
		} else if (m_pending) {
			forEachTile([&](std::size_t t) { updateTileStress(t), pointsToGrid<true>(t); });
			m_pending = false;
			checkStress();
		} else {
			forEachTile([&](std::size_t t) { pointsToGrid<true>(t); });
		}
		if (!m_points.touched.empty()) forEachTile([&](std::size_t t) { spreadCouples(t, m_force); });
		if (energy) keepSums();
		lap(control.scheme == Scheme::usf ? "points to nodes, stress" : "stress, points to nodes");
		const bool full = correctsMass(control);
		const bool pic  = control.flip < 1;
		if (pic) m_band.keepMomentum(m_momentum);
		updateNodes();
		m_picWork                  = pic ? addTaken(startOfStep(), (1 - control.flip) / control.dt) : 0;
		const double kineticBefore = energy ? kineticEnergy() : 0;
		if (energy) keepMotion();
		if (full) correctAccelerations();
		lap("nodes");

		if (control.scheme == Scheme::musl) {
			clear(m_velocity);
			forEachTile([&](std::size_t t) { gridToPoints<true>(t, control.flip); });
			fromMomentum(m_velocity);
			if (full) correctVelocities();
		} else {
			forEachTile([&](std::size_t t) { gridToPoints<false>(t, control.flip); });
			std::swap(m_velocity, m_momentum); // the updated velocities themselves
		}
		if (energy) trackWork();
		if (!m_points.touched.empty()) forEachTile([&](std::size_t t) { moveTouchedPoints(t); });
		if (control.filter > 0) filterVelocities();
		lap(control.scheme == Scheme::musl ? "nodes to points and back" : "nodes to points");
		m_stressControl = control;
		m_pending       = true;
		if (control.scheme == Scheme::usf) finishPositions();
		checkPoints();
		if (energy) {
			m_points.energies.kinetic = .5 * (kineticBefore + kineticEnergy());
			finish();
			collectTiles();
		}
	}

	void finish() override
	{
		if (!m_pending) return;
		forEachTile([&](std::size_t t) { updateTileStress(t); });
		m_pending = false;
		checkStress();
	}

	void        pointsChanged() override { m_sorted = m_known = false; }
	std::size_t gridBytes() const override { return m_mass.size() * sizeof(double) * (1 + hoop + 3 * dim); }
	Analysis    analysis() const override { return m_analysis; }
	int         components() const override { return N; }

	GridNodes nodes() const override
	{
		GridNodes nodes;
		for (std::size_t i = 0; i < m_mass.size(); ++i) {
			if (m_mass[i] <= leastMass()) continue;
			nodes.mass.push_back(m_mass[i]);
			int local = int(i % Grid::nodes);
			for (int d = 0; d < 3; ++d) {
				double x = 0, v = 0;
				if (d < dim) {
					const int index = m_grid.blocks()[i / Grid::nodes][d] * Grid::width + local % Grid::width;
					x = m_geometry.origin[d] + index * m_geometry.cell[d], v = m_velocity[d][i];
					local /= Grid::width;
				}
				nodes.position[d].push_back(x), nodes.velocity[d].push_back(v);
			}
		}
		return nodes;
	}

	double acousticTimeStep(Scheme scheme, bool fullMass) override;
	double crossingRate() const override;

private:
	static constexpr double infinity = std::numeric_limits<double>::infinity();
	using Grid                       = TileGrid<dim>;
	static constexpr int support     = Shape::support;
	static constexpr int extent      = Grid::width + support - 1; // nodes along an axis that a tile's points touch
	static constexpr int rows        = ipow(extent, dim - 1);
	static constexpr int local       = rows * extent;
	static constexpr int row         = Shape::row;
	using Tile                       = typename Grid::Tile;
	using Patch                      = double[local + row - support]; // one nodal quantity around a tile

	struct Weights {
		alignas(8 * row) double N_[dim][row], dN[dim][row]; // dN in 1/m; zero beyond the support
		int first;                                          // node of the patch
	};
	using WeightLanes = Weights[lanes];
	struct TileReport {                      // what a pass has to say of a tile
		bool           left   = false;   // a point is no longer the tile's, or worse
		std::ptrdiff_t failed = -1;      // a point whose stress cannot be updated ...
		const char*    why    = nullptr; // ... and what of it
	};

	Analysis                m_analysis;
	double                  m_cellSize;
	Points&                 m_points;
	const std::vector<Law>& m_laws;
	std::vector<Wall>&      m_walls;
	const InstructionSet    m_instructions;
	StepControl             m_control, m_stressControl; // of the current step, and of the one whose stress update is pending
	Geometry<dim>           m_geometry;
	std::vector<Wall::Kind> m_kinds; // of the walls, as the bands have been built for
	Grid                    m_grid;
	WallBand<dim>           m_band;
	Column                  m_mass;
	Column                  m_radialMass;                    // in axisymmetry, see below
	NodeVector<dim>         m_momentum, m_force, m_velocity; // momentum becomes velocity, force becomes dt * acceleration
	std::vector<TileReport> m_reports;
	double                  m_leastMass    = 0;     // nodes with no more are empty but for rounding
	double                  m_wallHalfSize = 0;     // of the point whose shape functions the bands have been built for
	bool                    m_laid         = false; // blocks, node arrays and bands are those of the geometry
	bool                    m_known        = false; // points are in the tiles of m_grid, but where a report says that they have left
	bool                    m_sorted = false, m_pending = false;

	// MeanDilatation.hpp
	static constexpr int      dilating = normals<S>() < 3 ? 0 : hoop ? 3 : dim; // normal strains that change a volume
	static bool               averages(const StepControl& control) { return dilating > 0 && control.meanDilatation; }
	double                    dilatation(const Lanes (&G)[gradients<S>], int l) const;
	std::pair<double, double> volumeAndPressure(std::size_t p) const;
	[[gnu::noinline]] void    elementMeans(const Tile& tile, const Patch* v, Patch& mean) const;
	[[gnu::noinline]] void    takeMeanDilatation(Block block, const WeightLanes& w, const Patch& mean, Lanes (&G)[gradients<S>]) const;
	[[gnu::noinline]] void    takeMeanPressure(
		   Block block, const WeightLanes& w, const Patch& mean, const Lanes& r, Lanes (&fp)[dim], Lanes (&Vs)[dim][dim]) const;

	// RoundTrip.hpp
	void   spreadVelocities(const NodeVector<dim>* v, NodeVector<dim>& momentum);
	void   spreadTileVelocities(const Tile& tile, const NodeVector<dim>* v, NodeVector<dim>& momentum) const;
	void   subtractRoundTrip(NodeVector<dim>& v, const NodeVector<dim>& trip) const;
	void   correct(NodeVector<dim>& v, NodeVector<dim>& trip, bool moving);
	double addTaken(const NodeVector<dim>& v, double rate);
	double reflect(NodeVector<dim>& v, bool moving, double rate);

	// FullMass.hpp, Filter.hpp
	static bool correctsMass(const StepControl& control) { return control.fullMass && control.scheme == Scheme::musl; }
	void        correctAccelerations();
	void        correctVelocities();
	void        filterVelocities();
	double      m_correctionWork = 0, m_picWork = 0; // on moving walls, by what the full mass and PIC add to their reactions

	struct StressWork;
	struct Tracking {                              // empty unless energies are tracked
		std::vector<Energies> tiles;           // what the passes have found, summed in the order of tiles
		NodeVector<dim>       mass;            // of the nodes, not folded
		NodeVector<dim>       force, external; // likewise; all forces, and the external ones
		NodeVector<dim>       damping;         // acceleration that damping takes away
		NodeVector<dim>       start, change;   // nodal velocities at the start of the step, and what is added to them
		Columns               velocity;        // of the points at the start
	};
	Tracking m_tracking;

	void lap(const char* pass) const
	{
		if (m_control.clock) m_control.clock->lap(pass);
	}
	void   startEnergies();
	void   keepSums();
	void   keepMotion();
	void   trackWork();
	void   collectTiles();
	double kineticEnergy() const;

	// ---- the grid -------------------------------------------------------------------------------------------------

	/* Lays the grid through walls and points; what of it still fits is kept. */
	void layGrid()
	{
		const Geometry<dim>     geometry = makeGeometry<dim>(m_cellSize, m_walls);
		std::vector<Wall::Kind> kinds;
		for (const Wall& wall : m_walls)
			kinds.push_back(wall.kind);
		if (m_sorted && geometry == m_geometry && kinds == m_kinds) return;
		finish(); // the pending update belongs to the old grid
		if (geometry != m_geometry || kinds != m_kinds) m_laid = m_known = false;
		m_geometry = geometry, m_kinds = kinds;

		Points& P = m_points;
		if (!m_known) {
			for (std::size_t p = 0; p < P.count(); ++p)
				requireOnGrid(p);
			m_leastMass = Shape::rounding * *std::min_element(P.mass.begin(), P.mass.end());
		}
		auto baseOf = [&](std::size_t p) {
			typename Grid::Index base;
			for (int d = 0; d < dim; ++d)
				base[d] = floorToInt(m_geometry.xi(d, P.position[d][p]) - Shape::shift(halfSize(d, p)));
			return base;
		};
		if (m_grid.sort(P, m_known, m_control.threads, baseOf, [&](std::size_t t) { return !m_reports[t].left; })) m_laid = false;
		m_known = true;
		m_reports.assign(m_grid.tiles().size(), {});
		const double r = P.count() ? halfSize(0, 0) : .5; // of the shape functions at the walls
		if (!m_laid || r != m_wallHalfSize) {
			m_mass.assign(m_grid.nodeCount(), 0);
			if (hoop) m_radialMass.assign(m_grid.nodeCount(), 0);
			for (auto* field : { &m_momentum, &m_force, &m_velocity })
				for (Column& c : *field)
					c.assign(m_grid.nodeCount(), 0);
			double       N0[support], dN0[support];
			const double base = std::floor(-Shape::shift(r));
			Shape::evaluate(0, base, r, N0, dN0);
			m_band.build(m_grid, m_geometry, m_walls, N0[int(-base)], support > 2 ? N0[int(-base) - 1] : 0);
			m_wallHalfSize = r;
			m_laid         = true;
		}
		m_sorted = true;
	}

	/* Throws unless the point is finite, in front of the walls and within the range of node indices. */
	void requireOnGrid(std::size_t p) const
	{
		constexpr double range = 1 << 28, tolerance = 1e-9; // in cells
		for (int d = 0; d < dim; ++d) {
			const double x  = m_points.position[d][p] + (m_pending ? m_points.advance[d][p] : 0);
			const double xi = m_geometry.xi(d, x);
			if (!std::isfinite(x) || !std::isfinite(m_points.velocity[d][p]))
				fail(p, "has a non-finite position or velocity",
					"reduce O.dt (mpm.criticalTimeStep() says how far), or look at the loads on it");
			if (!(xi >= m_geometry.xiMin[d] - tolerance) || !(xi <= m_geometry.xiMax[d] + tolerance))
				fail(p, "has left the walls", "check that walls and points overlap as meant, reduce O.dt, or refine the points");
			if (hoop && d == 0 && !(x > 0))
				fail(p, "is not at a positive radius", "in axisymmetry x is the radius: place points at x > 0, or reduce O.dt");
			if (std::abs(xi) > range) fail(p, "is too far from the origin of the grid", "move the scene nearer to the origin, or enlarge cellSize");
		}
	}
	[[noreturn]] void fail(std::size_t p, const char* what, const char* remedy) const
	{
		std::string where, cell;
		for (int d = 0; d < dim; ++d) {
			const double x = m_points.position[d][p] + (m_pending ? m_points.advance[d][p] : 0), xi = m_geometry.xi(d, x);
			where += (d ? ", " : "") + std::to_string(x);
			cell += (d ? ", " : "") + (std::isfinite(xi) ? std::to_string((long long)(std::floor(xi))) : "none");
		}
		throw StepFailure("material point " + std::to_string(m_points.id[p]) + " " + what + " at time " + std::to_string(m_control.time)
					  + " s, position (" + where + ") m, cell (" + cell + "): " + remedy,
			m_points.id[p]);
	}

	// ---- transfers ------------------------------------------------------------------------------------------------

	double halfSize(int axis, std::size_t p) const { return Shape::usesSize ? .5 * m_points.size[p] / m_geometry.cell[axis] : 0; }

	/* Weights of a point, and those of a block of them at x. */
	Weights weights(const Tile& tile, std::size_t p) const
	{
		Lanes x[dim];
		for (int d = 0; d < dim; ++d)
			load(m_points.position[d], { p, 1 }, x[d]);
		WeightLanes w;
		weights(tile, { p, 1 }, x, w);
		return w[0];
	}
	void weights(const Tile& tile, Block block, const Lanes (&x)[dim], WeightLanes& w) const
	{
		Lanes s[dim], r[dim] {};
		int   first[lanes] {};
		for (int d = dim - 1; d >= 0; --d) {
			const double origin = m_geometry.origin[d], cell = m_geometry.cell[d];
			const int    corner = tile.index[d] * Grid::width;
			if constexpr (Shape::usesSize) {
				load(m_points.size, block, r[d]);
				forLanes([&](int l) { r[d][l] = .5 * r[d][l] / cell; });
			}
#pragma omp simd
			for (int l = 0; l < lanes; ++l) {
				const double xi   = (x[d][l] - origin) / cell;
				const int    base = clamp(floorToInt(xi - Shape::shift(r[d][l])), corner, corner + Grid::width - 1);
				s[d][l]           = xi - base;
				first[l]          = first[l] * extent + (base - corner);
			}
		}
		double perMetre[dim];
		for (int d = 0; d < dim; ++d)
			perMetre[d] = 1 / m_geometry.cell[d];
		for (int l = 0; l < block.count; ++l) {
			w[l].first = first[l];
			for (int d = 0; d < dim; ++d) {
				shapeRow(s[d][l], r[d][l], w[l].N_[d], w[l].dN[d]);
#pragma omp simd
				for (int k = 0; k < row; ++k)
					w[l].dN[d][k] *= perMetre[d];
			}
		}
	}
	static void shapeRow(double s, double r, double* N, double* dN)
	{
		if constexpr (Shape::usesSize || row == support)
			Shape::evaluate(s, 0, r, N, dN);
		else
			Shape::template evaluate<row>(s, 0, r, N, dN);
		for (int k = support; Shape::usesSize && k < row; ++k)
			N[k] = dN[k] = 0;
	}
	/* visit(offset from the first node, c) for every row of nodes along x in a point's support: N_ip = c[0] N_[0][i], and
	grad N_ip = (c[0] dN[0][i], c[1] N_[0][i], c[2] N_[0][i]). */
	template <class Visit> static void forEachRow(const Weights& w, Visit&& visit)
	{
		if constexpr (dim == 1) {
			visit(0, std::array<double, 1> { 1. });
		} else if constexpr (dim == 2) {
			for (int j = 0; j < support; ++j)
				visit(j * extent, std::array<double, 2> { w.N_[1][j], w.dN[1][j] });
		} else {
			for (int k = 0; k < support; ++k)
				for (int j = 0; j < support; ++j)
					visit((k * extent + j) * extent,
						std::array<double, 3> { w.N_[1][j] * w.N_[2][k], w.dN[1][j] * w.N_[2][k], w.N_[1][j] * w.dN[2][k] });
		}
	}
	/* visit(node of the patch, N_ip, grad N_ip) for every node of a point's support. */
	template <class Visit> static void forEachNode(const Weights& w, Visit&& visit)
	{
		if constexpr (dim == 1) {
			for (int i = 0; i < support; ++i)
				visit(w.first + i, w.N_[0][i], std::array<double, 1> { w.dN[0][i] });
		} else if constexpr (dim == 2) {
			for (int j = 0; j < support; ++j)
				for (int i = 0; i < support; ++i)
					visit(w.first + j * extent + i, w.N_[0][i] * w.N_[1][j],
						std::array<double, 2> { w.dN[0][i] * w.N_[1][j], w.N_[0][i] * w.dN[1][j] });
		} else {
			for (int k = 0; k < support; ++k)
				for (int j = 0; j < support; ++j) {
					const double yz = w.N_[1][j] * w.N_[2][k], dyz = w.dN[1][j] * w.N_[2][k], ydz = w.N_[1][j] * w.dN[2][k];
					for (int i = 0; i < support; ++i)
						visit(w.first + (k * extent + j) * extent + i, w.N_[0][i] * yz,
							std::array<double, 3> { w.dN[0][i] * yz, w.N_[0][i] * dyz, w.N_[0][i] * ydz });
				}
		}
	}
	/* visit(offset in the patch, offset in the node arrays, length) for every run of nodes that a tile touches. */
	template <class Visit> static void forEachRun(const typename Grid::Tile& tile, Visit&& visit)
	{
		for (int row = 0; row < rows; ++row) {
			int corner = 0, offset = 0;
			for (int d = 1, rest = row, stride = Grid::width; d < dim; ++d, rest /= extent, stride *= Grid::width) {
				const int k = rest % extent;
				corner |= (k >> Grid::log2Width) << d;
				offset += (k & (Grid::width - 1)) * stride;
			}
			visit(row * extent, std::size_t(tile.blocks[corner]) * Grid::nodes + offset, Grid::width);
			visit(row * extent + Grid::width, std::size_t(tile.blocks[corner | 1]) * Grid::nodes + offset, support - 1);
		}
	}
	static void read(const typename Grid::Tile& tile, const Column& field, Patch& patch)
	{
		for (int k = support; k < row; ++k)
			patch[local + k - support] = 0;
		forEachRun(tile, [&](int at, std::size_t node, int length) { std::memcpy(patch + at, &field[node], length * sizeof(double)); });
	}
	static void add(const typename Grid::Tile& tile, const Patch& patch, Column& field)
	{
		forEachRun(tile, [&](int at, std::size_t node, int length) {
			for (int k = 0; k < length; ++k)
				field[node + k] += patch[at + k];
		});
	}
	/* Tiles of one colour share no node: any number of threads, one result. */
	template <class Work> void forEachTile(Work&& work)
	{
		for (int c = 0; c < Grid::corners; ++c) {
			const std::vector<int>& tiles = m_grid.colour(c);
			const int               count = int(tiles.size());
			if (m_control.threads == 1 || count == 1 || m_points.count() <= 2000) { // a team of one is not free
				for (const int t : tiles)
					work(std::size_t(t));
				continue;
			}
#pragma omp parallel for schedule(dynamic) num_threads(m_control.threads)
			for (int k = 0; k < count; ++k)
				work(std::size_t(tiles[k]));
		}
	}
	/* work(begin, end) for ranges of nodes, whole blocks, that are all nodes together; compiled by run(). */
	template <class Work> void forEachNodeRange(Work&& work) const
	{
		constexpr std::size_t length = 32 * Grid::nodes;
		const std::size_t     count  = m_mass.size();
		if (m_control.threads == 1 || count <= 4 * length) return run(m_instructions, [&work, count] { work(0, count); });
#pragma omp parallel for schedule(static) num_threads(m_control.threads)
		for (std::size_t begin = 0; begin < count; begin += length)
			run(m_instructions, [&work, begin, end = std::min(begin + length, count)] { work(begin, end); });
	}
	void clear(NodeVector<dim>& field) const
	{
		forEachNodeRange([&](std::size_t begin, std::size_t end) {
			for (Column& c : field)
				zero(c, begin, end);
		});
	}
	void clearSums()
	{
		forEachNodeRange([&](std::size_t begin, std::size_t end) {
			zero(m_mass, begin, end);
			if constexpr (hoop) zero(m_radialMass, begin, end);
			for (int d = 0; d < dim; ++d)
				zero(m_momentum[d], begin, end), zero(m_force[d], begin, end);
		});
	}
	static void zero(Column& field, std::size_t begin, std::size_t end) { std::fill(field.data() + begin, field.data() + end, 0.); }

	// ---- steps of the method: each for a tile, compiled by run() once for each instruction set, so that a pass gives the
	// same bits wherever it is called from

	/* Step 1: m_i = sum N_ip m_p, (m v)_i = sum N_ip m_p v_p, f_i = sum N_ip (f_p + m_p g) - V_p sigma_p grad N_ip   (eqs. 12, 13) */
	template <bool force> void pointsToGrid(std::size_t t)
	{
		run(m_instructions, [this, t] { spreadTile<force>(t); });
	}
	template <bool force> void spreadTile(std::size_t t)
	{
		const Tile& tile = m_grid.tiles()[t];
		Patch       m {}, mv[dim] {}, f[dim] {}, pressure;
		const bool  averaged = force && averages(m_control);
		if (averaged) elementMeans(tile, nullptr, pressure);
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes       x[dim], mp, mvp[dim], fp[dim], Vs[dim][dim];
			WeightLanes w;
			loadMotion(block, x, mp, mvp);
			weights(tile, block, x, w);
			if (force) pointForces(block, mp, fp, Vs);
			if constexpr (hoop && force) addHoopForce(block, x[0], fp[0]);
			if (averaged) takeMeanPressure(block, w, pressure, x[0], fp, Vs);
			for (int l = 0; l < block.count; ++l) {
				// along x, all that a row's weights across will multiply
				alignas(8 * row) double rm[row], rmv[dim][row], rf[dim][dim][row];
				const double *          N = w[l].N_[0], *dN = w[l].dN[0];
#pragma omp simd
				for (int i = 0; i < row; ++i) {
					rm[i] = mp[l] * N[i];
					for (int d = 0; d < dim; ++d) {
						rmv[d][i] = mvp[d][l] * N[i];
						if (!force) continue;
						rf[d][0][i] = fp[d][l] * N[i] - Vs[d][0][l] * dN[i];
						for (int e = 1; e < dim; ++e)
							rf[d][e][i] = -Vs[d][e][l] * N[i];
					}
				}
				forEachRow(w[l], [&](int offset, const std::array<double, dim>& c) {
					const int at = w[l].first + offset;
#pragma omp simd
					for (int i = 0; i < row; ++i) {
						m[at + i] += c[0] * rm[i];
						for (int d = 0; d < dim; ++d) {
							mv[d][at + i] += c[0] * rmv[d][i];
							if (!force) continue;
							double sum = f[d][at + i];
							for (int e = 0; e < dim; ++e)
								sum += c[e] * rf[d][e][i];
							f[d][at + i] = sum;
						}
					}
				});
			}
		});
		add(tile, m, m_mass);
		for (int d = 0; d < dim; ++d) {
			add(tile, mv[d], m_momentum[d]);
			if (force) add(tile, f[d], m_force[d]);
		}
		if constexpr (hoop) spreadRadialMass(tile);
	}
	/* In axisymmetry the lumped mass of a node for radial motion is sum N_ip m_p r_p / r_i, with r_i negative behind the axis:
	then a uniform expansion v_r = a r passes from the points to the grid and back unchanged, momentum and energy included.
	With sum N_ip m_p it would be wrong by a third in the cell at the axis. */
	void spreadRadialMass(const Tile& tile)
	{
		Patch mr {};
		for (std::size_t p = tile.begin; p < tile.end; ++p)
			forEachNode(weights(tile, p), [&, mass = m_points.mass[p] * m_points.position[0][p]](
							      int i, double Nip, const std::array<double, dim>&) { mr[i] += Nip * mass; });
		for (int i = 0; i < local; ++i) {
			const double r = m_geometry.origin[0] + (tile.index[0] * Grid::width + i % extent) * m_geometry.cell[0];
			mr[i]          = std::abs(r) > 1e-9 * m_geometry.cell[0] ? mr[i] / r : 0; // on the axis nothing moves
		}
		add(tile, mr, m_radialMass);
	}
	/* -V_p sigma_hoop / r_p, which N_ip brings to the nodes. */
	void addHoopForce(Block block, const Lanes& r, Lanes& fr) const
	{
		Lanes V, sigma, stretch, F[dim * dim];
		load(m_points.volume0, block, V);
		load(m_points.stress[2], block, sigma);
		if (m_control.largeStrain) {
			load(m_points.thicknessStretch, block, stretch);
			for (int k = 0; k < dim * dim; ++k)
				load(m_points.deformation[k], block, F[k]);
			forLanes([&](int l) { V[l] *= determinantOf(F, l) * stretch[l]; });
		}
		forLanes([&](int l) { fr[l] -= V[l] * sigma[l] / r[l]; });
	}
	/* Lumped mass for the motion along axis d. */
	const Column& massOf(int d) const { return hoop && d == 0 ? m_radialMass : m_mass; }
	NodeMass<dim> nodeMass()
	{
		NodeMass<dim> mass;
		mass.fill(&m_mass);
		if constexpr (hoop) mass[0] = &m_radialMass;
		return mass;
	}

	/* Position, mass and momentum. */
	void loadMotion(Block block, Lanes (&x)[dim], Lanes& mp, Lanes (&mvp)[dim]) const
	{
		load(m_points.mass, block, mp);
		for (int d = 0; d < dim; ++d) {
			load(m_points.position[d], block, x[d]);
			load(m_points.velocity[d], block, mvp[d]);
			forLanes([&](int l) { mvp[d][l] *= mp[l]; });
		}
	}
	void pointForces(Block block, const Lanes& mp, Lanes (&fp)[dim], Lanes (&Vs)[dim][dim]) const
	{
		Lanes V, F[dim * dim], stretch;
		load(m_points.volume0, block, V);
		if (m_control.largeStrain) {
			for (int k = 0; k < dim * dim; ++k)
				load(m_points.deformation[k], block, F[k]);
			forLanes([&](int l) { V[l] *= determinantOf(F, l); });
			if (!m_points.thicknessStretch.empty()) {
				load(m_points.thicknessStretch, block, stretch);
				forLanes([&](int l) { V[l] *= stretch[l]; });
			}
		}
		for (int d = 0; d < dim; ++d) {
			const double g = m_control.gravity[d];
			if (m_points.force.empty())
				forLanes([&](int l) { fp[d][l] = mp[l] * g; });
			else {
				load(m_points.force[d], block, fp[d]);
				forLanes([&](int l) { fp[d][l] += mp[l] * g; });
			}
			for (int e = 0; e < dim; ++e) {
				load(m_points.stress[component(d, e)], block, Vs[d][e]);
				forLanes([&](int l) { Vs[d][e][l] *= V[l]; });
			}
		}
	}
	static double determinantOf(const Lanes (&F)[dim * dim], int l)
	{
		double f[dim * dim];
		for (int k = 0; k < dim * dim; ++k)
			f[k] = F[k][l];
		return determinant<dim>(f);
	}
	static double nodalForce(int d, double Nip, const std::array<double, dim>& grad, const double (&fp)[dim], const double (&Vs)[dim][dim])
	{
		double f = Nip * fp[d];
		for (int e = 0; e < dim; ++e)
			f -= Vs[d][e] * grad[e];
		return f;
	}
	/* f_p + m_p g and V_p sigma_p, with the current volume in large strain. */
	void pointForces(std::size_t p, double (&fp)[dim], double (&Vs)[dim][dim]) const
	{
		double F[dim * dim];
		for (int k = 0; k < dim * dim; ++k)
			F[k] = m_points.deformation[k][p];
		const double V = volume(p, F);
		for (int d = 0; d < dim; ++d) {
			fp[d] = m_points.mass[p] * m_control.gravity[d] + (m_points.force.empty() ? 0 : m_points.force[d][p]);
			for (int e = 0; e < dim; ++e)
				Vs[d][e] = V * m_points.stress[component(d, e)][p];
		}
	}
	double volume(std::size_t p, const double (&F)[dim * dim]) const
	{
		if (!m_control.largeStrain) return m_points.volume0[p];
		return m_points.volume0[p] * determinant<dim>(F) * (m_points.thicknessStretch.empty() ? 1 : m_points.thicknessStretch[p]);
	}
	/* Where sigma_de stands among the components of the stress state. */
	static constexpr int component(int d, int e)
	{
		if (d == e) return d;
		if (dim == 2) return N - 1;
		return 6 - d - e; // yz 3, zx 4, xy 5
	}

	/* Step 2: a_i = f_i / m_i, Cundall's damping, v_i += dt a_i, walls   (eq. 14) */
	void updateNodes()
	{
		m_band.fold(m_walls, nodeMass(), m_momentum, m_force, m_control.dt);
		forEachNodeRange([this](std::size_t begin, std::size_t end) {
			const double dt = m_control.dt, damping = m_control.damping, least = leastMass();
			const bool   energy = m_control.trackEnergy;
			for (int d = 0; d < dim; ++d) {
				const double* mass = massOf(d).data();
				double *      v = m_momentum[d].data(), *dv = m_force[d].data(), *lost = energy ? m_tracking.damping[d].data() : nullptr;
#pragma omp simd
				for (std::size_t i = begin; i < end; ++i) {
					const double over = inverseOf(mass[i], least), start = v[i] * over, a = dv[i] * over, trend = a * (start + .5 * dt * a);
					const double braking = trend > 0 ? damping * a : trend < 0 ? -damping * a : 0;
					dv[i]                = dt * (a - braking);
					v[i]                 = start + dv[i];
					if (lost) lost[i] = braking;
				}
			}
		});
		m_band.unfold(m_walls, m_momentum, true);
		m_band.unfold(m_walls, m_force, false);
	}
	/* Nodal velocities before the update. */
	NodeVector<dim> startOfStep() const
	{
		NodeVector<dim> v = m_momentum;
		for (int d = 0; d < dim; ++d)
			for (std::size_t i = 0; i < m_mass.size(); ++i)
				v[d][i] -= m_force[d][i];
		return v;
	}
	double        leastMass() const { return m_leastMass; }
	static double inverseOf(double mass, double least) { return mass > least ? 1 / mass : 0; }

	/* Step 3: v_p += sum N_ip dt a_i (FLIP), displacement dt sum N_ip v_i   (eq. 15)
	Step 4 (remap): (m v)_i = sum N_ip m_p v_p with the new velocities. */
	template <bool remap> void gridToPoints(std::size_t t, double flip)
	{
		run(m_instructions, [this, t, flip] { moveTile<remap>(t, flip); });
	}
	template <bool remap> void moveTile(std::size_t t, double flip)
	{
		const Tile& tile = m_grid.tiles()[t];
		Patch       v[dim], dv[dim], mv[dim] {};
		for (int d = 0; d < dim; ++d)
			read(tile, m_momentum[d], v[d]), read(tile, m_force[d], dv[d]);
		bool left = false;
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes       x[dim], mp, mvp[dim], vp[dim], dvp[dim];
			WeightLanes w;
			for (int d = 0; d < dim; ++d)
				load(m_points.position[d], block, x[d]);
			weights(tile, block, x, w);
			for (int l = 0; l < lanes; ++l) {
				const int from = std::min(l, block.count - 1);
				for (int d = 0; d < dim; ++d)
					vp[d][l] = gather(w[from], v[d]), dvp[d][l] = gather(w[from], dv[d]);
			}
			load(m_points.mass, block, mp);
			for (int d = 0; d < dim; ++d)
				left |= movePoints(tile, block, d, flip, x[d], mp, vp[d], dvp[d], mvp[d]);
			if (remap) spreadMomentum(w, block, mvp, mv);
		});
		m_reports[t].left = left;
		if (remap)
			for (int d = 0; d < dim; ++d)
				add(tile, mv[d], m_velocity[d]);
	}
	/* (m v)_i += N_ip m_p v_p. */
	static void spreadMomentum(const WeightLanes& w, Block block, const Lanes (&mvp)[dim], Patch (&mv)[dim])
	{
		for (int l = 0; l < block.count; ++l) {
			alignas(8 * row) double rmv[dim][row];
#pragma omp simd
			for (int i = 0; i < row; ++i)
				for (int d = 0; d < dim; ++d)
					rmv[d][i] = mvp[d][l] * w[l].N_[0][i];
			forEachRow(w[l], [&](int offset, const std::array<double, dim>& c) {
				const int at = w[l].first + offset;
#pragma omp simd
				for (int i = 0; i < row; ++i)
					for (int d = 0; d < dim; ++d)
						mv[d][at + i] += c[0] * rmv[d][i];
			});
		}
	}
	/* sum N_ip field_i for the point with weights w. */
	static double gather(const Weights& w, const double* field)
	{
		const double*           nodes = field + w.first;
		alignas(8 * row) double part[row];
#pragma omp simd
		for (int i = 0; i < row; ++i)
			part[i] = w.N_[0][i] * acrossRows<-1>(w, nodes + i);
		return sumOfRow(part);
	}
	/* sum grad N_ip field_i. */
	static void gatherGradient(const Weights& w, const double* field, double (&gradient)[dim])
	{
		const double*           nodes = field + w.first;
		alignas(8 * row) double part[dim][row];
#pragma omp simd
		for (int i = 0; i < row; ++i) {
			part[0][i] = w.dN[0][i] * acrossRows<-1>(w, nodes + i);
			if constexpr (dim > 1) part[1][i] = w.N_[0][i] * acrossRows<1>(w, nodes + i);
			if constexpr (dim > 2) part[2][i] = w.N_[0][i] * acrossRows<2>(w, nodes + i);
		}
		for (int e = 0; e < dim; ++e)
			gradient[e] = sumOfRow(part[e]);
	}
	/* Sum over the rows of a support, at one place along them, with the weights across: those of the derivative along axis e. */
	template <int e> static double acrossRows(const Weights& w, const double* nodes)
	{
		if constexpr (dim == 1)
			return *nodes;
		else if constexpr (dim == 2)
			return acrossPlane(e == 1 ? w.dN[1] : w.N_[1], nodes);
		else {
			double sum = 0;
			for (int k = 0; k < support; ++k)
				sum += (e == 2 ? w.dN[2] : w.N_[2])[k] * acrossPlane(e == 1 ? w.dN[1] : w.N_[1], nodes + k * extent * extent);
			return sum;
		}
	}
	static double acrossPlane(const double* weights, const double* nodes)
	{
		double sum = 0;
		for (int j = 0; j < support; ++j)
			sum += weights[j] * nodes[j * extent];
		return sum;
	}
	static double sumOfRow(const double (&x)[row])
	{
		if constexpr (row == 2)
			return x[0] + x[1];
		else
			return (x[0] + x[2]) + (x[1] + x[3]);
	}
	/* New velocities and displacements along axis d; whether a point leaves the tile. */
	bool movePoints(const Tile& tile, Block block, int d, double flip, const Lanes& x, const Lanes& mp, const Lanes& vp, const Lanes& dvp, Lanes& mvp)
	{
		const double dt = m_control.dt, origin = m_geometry.origin[d], cell = m_geometry.cell[d];
		const double lower = m_geometry.xiMin[d], upper = m_geometry.xiMax[d], corner = tile.index[d] * Grid::width;
		Lanes        velocity, advance, r {};
		load(m_points.velocity[d], block, velocity);
		const Lanes old = velocity;
		if (Shape::usesSize) load(m_points.size, block, r);
		forLanes([&](int l) { advance[l] = dt * vp[l]; });
		if (flip == 1)
			forLanes([&](int l) { velocity[l] += dvp[l]; });
		else
			forLanes([&](int l) { velocity[l] = flip * (velocity[l] + dvp[l]) + (1 - flip) * vp[l]; });
		for (int l = 0; !m_points.fixed.empty() && l < block.count; ++l)
			if (m_points.fixed[block.first + std::size_t(l)] >> d & 1) velocity[l] = old[l], advance[l] = dt * old[l];
		int inside = 1;
#pragma omp simd reduction(& : inside)
		for (int l = 0; l < lanes; ++l) {
			const double xi = (x[l] + advance[l] - origin) / cell, inTile = xi - Shape::shift(.5 * r[l] / cell) - corner;
			mvp[l] = mp[l] * velocity[l];
			inside &= (inTile >= 0) & (inTile < Grid::width) & (xi >= lower) & (xi <= upper) & (std::abs(velocity[l]) < infinity);
		}
		store(velocity, block, m_points.velocity[d]);
		store(advance, block, m_points.advance[d]);
		return !inside;
	}

	/* Step 4, at the nodes: v_i = (m v)_i / m_i, walls again. Of an increment (not moving), which vanishes at the walls, likewise. */
	void fromMomentum(NodeVector<dim>& v, bool moving = true)
	{
		if (moving)
			m_band.foldMomentum(m_walls, nodeMass(), v);
		else
			m_band.foldMomentumAtRest(v);
		divideByMass(v);
		m_band.unfold(m_walls, v, moving);
	}
	/* Points in contact move with the velocities that the stress sees, and turn with the material: spin = curl v / 2. A
	contact's force follows the points' motion; any other velocity would lose energy (doc/method.md). */
	void moveTouchedPoints(std::size_t t)
	{
		const Tile& tile   = m_grid.tiles()[t];
		bool        loaded = false;
		Patch       v[dim];
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			if (!m_points.touched[p]) continue;
			for (int d = 0; d < dim && !loaded; ++d)
				read(tile, m_velocity[d], v[d]);
			loaded          = true;
			const Weights w = weights(tile, p);
			double        grad[dim][dim];
			for (int d = 0; d < dim; ++d)
				gatherGradient(w, v[d], grad[d]);
			for (int k = 0; k < turns; ++k)
				m_points.spin[k][p] = .5 * (grad[to(k)][from(k)] - grad[from(k)][to(k)]);
			for (int d = 0; d < dim; ++d) {
				const bool fixed      = !m_points.fixed.empty() && m_points.fixed[p] >> d & 1;
				m_points.moving[d][p] = fixed ? m_points.velocity[d][p] : gather(w, v[d]);
				if (fixed) continue;
				m_points.advance[d][p] = m_control.dt * m_points.moving[d][p];
				const double xi        = m_geometry.xi(d, m_points.position[d][p] + m_points.advance[d][p]);
				const double inTile    = xi - Shape::shift(halfSize(d, p)) - tile.index[d] * Grid::width;
				m_reports[t].left |= !(inTile >= 0 && inTile < Grid::width && xi >= m_geometry.xiMin[d] && xi <= m_geometry.xiMax[d]);
			}
		}
	}
	/* Torques on points in contact: f_i += T_p x grad N_ip / 2, which has no resultant, the moment T_p and the power T_p . spin. */
	void spreadCouples(std::size_t t, NodeVector<dim>& field)
	{
		const Tile& tile  = m_grid.tiles()[t];
		bool        found = false;
		Patch       f[dim];
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			if (!m_points.touched[p]) continue;
			for (int d = 0; d < dim && !found; ++d)
				std::fill(std::begin(f[d]), std::end(f[d]), 0.);
			found = true;
			forEachNode(weights(tile, p), [&](int i, double, const std::array<double, dim>& grad) {
				for (int k = 0; k < turns; ++k) {
					f[to(k)][i] += .5 * m_points.torque[k][p] * grad[from(k)];
					f[from(k)][i] -= .5 * m_points.torque[k][p] * grad[to(k)];
				}
			});
		}
		for (int d = 0; d < dim && found; ++d)
			add(tile, f[d], field[d]);
	}
	/* Rotation k turns axis from(k) towards to(k): about x, y, z in space, about z in the plane. */
	static constexpr int turns = dim == 3 ? 3 : dim - 1;
	static constexpr int from(int k) { return dim == 3 ? (k + 1) % 3 : 0; }
	static constexpr int to(int k) { return dim == 3 ? (k + 2) % 3 : dim - 1; }
	void                 divideByMass(NodeVector<dim>& field) const
	{
		forEachNodeRange([&](std::size_t begin, std::size_t end) {
			const double least = leastMass();
			for (int d = 0; d < dim; ++d) {
				const double* m = massOf(d).data();
				double*       v = field[d].data();
#pragma omp simd
				for (std::size_t i = begin; i < end; ++i)
					v[i] *= inverseOf(m[i], least);
			}
		});
	}

	/* Step 5: grad v = sum v_i grad N_ip, strain increment, rotation, law, deformation; then the point moves   (eq. 16) */
	void updateTileStress(std::size_t t)
	{
		run(m_instructions, [this, t] { strainTile(t); });
	}
	void strainTile(std::size_t t)
	{
		const Tile& tile = m_grid.tiles()[t];
		Patch       v[dim], dilatations;
		for (int d = 0; d < dim; ++d)
			read(tile, m_velocity[d], v[d]);
		if (averages(m_stressControl)) elementMeans(tile, v, dilatations);
		forEachBlock(tile.begin, tile.end, [&](Block block) { updateStressAndMove(t, tile, block, v, dilatations); });
	}
	void updateStressAndMove(std::size_t t, const Tile& tile, Block block, const Patch (&v)[dim], const Patch& dilatations)
	{
		Lanes       x[dim], advance, G[gradients<S>];
		WeightLanes w;
		for (int d = 0; d < dim; ++d)
			load(m_points.position[d], block, x[d]);
		weights(tile, block, x, w);
		for (int l = 0; l < lanes; ++l)
			displacementGradient(w[std::min(l, block.count - 1)], v, x[0][l], l, G);
		if (averages(m_stressControl)) takeMeanDilatation(block, w, dilatations, G);
		if (!areModerate(G) || !updateBlockStress(t, block, G))
			for (int l = 0; l < block.count; ++l) {
				double Gp[gradients<S>];
				for (int k = 0; k < gradients<S>; ++k)
					Gp[k] = G[k][l];
				updatePointStress(t, block.first + std::size_t(l), Gp);
			}
		for (int d = 0; d < dim; ++d) {
			load(m_points.advance[d], block, advance);
			forLanes([&](int l) { x[d][l] += advance[l], advance[l] = 0; });
			store(x[d], block, m_points.position[d]);
			store(advance, block, m_points.advance[d]);
		}
	}
	/* dt grad v of the point with weights w. */
	void displacementGradient(const Weights& w, const Patch* v, double r, int l, Lanes (&G)[gradients<S>]) const
	{
		for (int d = 0; d < dim; ++d) {
			double gradient[dim];
			gatherGradient(w, v[d], gradient);
			for (int e = 0; e < dim; ++e)
				G[d * dim + e][l] = m_stressControl.dt * gradient[e];
		}
		if constexpr (hoop) G[dim * dim][l] = m_stressControl.dt * gather(w, v[0]) / r;
	}
	/* Whether no point is deformed by as much as its own size in this step. Beyond, the run has failed, and a law would take
	sub-steps for ever. */
	static bool areModerate(const Lanes (&G)[gradients<S>])
	{
		int moderate = 1;
		for (int k = 0; k < gradients<S>; ++k)
#pragma omp simd reduction(& : moderate)
			for (int l = 0; l < lanes; ++l)
				moderate &= std::abs(G[k][l]) <= 1;
		return moderate;
	}
	void reportFailure(std::size_t t, std::size_t p, const char* why)
	{
		if (m_reports[t].failed < 0) m_reports[t].failed = std::ptrdiff_t(p), m_reports[t].why = why;
	}
	static constexpr const char*     noVolume = "has a volume that is not positive";
	static constexpr const char*     noStress = "is strained by more than its law can follow in a step";
	template <int count> static bool isFinite(const double* x)
	{
		return std::all_of(x, x + count, [](double value) { return std::isfinite(value); });
	}
	/* The stress update of a block at once, where the points share a law; else returns false and does nothing. */
	bool updateBlockStress(std::size_t t, Block block, const Lanes (&G)[gradients<S>])
	{
		const int material = m_points.material[block.first];
		if (m_stressControl.trackEnergy) return false;
		for (int l = 1; l < block.count; ++l)
			if (m_points.material[block.first + std::size_t(l)] != material) return false;

		const Law&  law      = m_laws[material];
		const int   columns  = Internals::of(law).columns(N);
		const bool  thinning = std::is_same_v<S, PlaneStress> && m_stressControl.thinning, follows = !m_points.freeStrain.empty();
		LawBlock<S> b;
		b.respond = thinning || follows;
		std::copy(G, G + gradients<S>, b.G);
		for (int k = 0; k < N; ++k)
			load(m_points.stress[k], block, b.sigma[k]);
		for (int k = 0; k < columns; ++k)
			load(m_points.internal[k], block, b.internal[k]);
		for (int k = 0; k < dim * dim; ++k)
			load(m_points.deformation[k], block, b.F[k]);

		updateBlock(m_instructions, law, m_stressControl.largeStrain, b);
		int sound = 1;
#pragma omp simd reduction(& : sound)
		for (int l = 0; l < lanes; ++l) {
			double sum = 0;
			for (int k = 0; k < N; ++k)
				sum += b.sigma[k][l];
			sound &= (sum - sum == 0) & (determinantOf(b.F, l) > 0);
		}
		if (!sound) reportBlock(t, block, b);

		for (int k = 0; k < N; ++k)
			store(b.sigma[k], block, m_points.stress[k]);
		for (int k = 0; k < columns; ++k)
			store(b.internal[k], block, m_points.internal[k]);
		for (int k = 0; k < dim * dim; ++k)
			store(b.F[k], block, m_points.deformation[k]);
		if constexpr (hoop)
			for (int l = 0; l < block.count; ++l)
				advanceHoop(block.first + std::size_t(l), G[dim * dim][l]);
		for (int l = 0; l < block.count && b.respond; ++l) {
			const std::size_t p = block.first + std::size_t(l);
			const double      e = b.response.freeStrain[l];
			if (follows) m_points.freeStrain[p] += e;
			if (thinning) m_points.thicknessStretch[p] *= (1 + .5 * e) / (1 - .5 * e);
		}
		return true;
	}
	/* What has failed in a block; where it is the law, the point keeps its stress. */
	[[gnu::noinline]] void reportBlock(std::size_t t, Block block, LawBlock<S>& b)
	{
		for (int l = 0; l < block.count; ++l) {
			const std::size_t p = block.first + std::size_t(l);
			double            sigma[N];
			for (int k = 0; k < N; ++k)
				sigma[k] = b.sigma[k][l];
			if (!(determinantOf(b.F, l) > 0))
				reportFailure(t, p, noVolume);
			else if (!isFinite<N>(sigma))
				reportFailure(t, p, noStress);
			if (isFinite<N>(sigma)) continue;
			for (int k = 0; k < N; ++k)
				b.sigma[k][l] = m_points.stress[k][p];
			for (std::size_t k = 0; k < m_points.internal.size(); ++k)
				b.internal[k][l] = m_points.internal[k][p];
			b.response.freeStrain[l] = 0;
		}
	}
	void advanceHoop(std::size_t p, double g)
	{
		double& stretch = m_points.thicknessStretch[p];
		stretch += m_stressControl.largeStrain ? g * stretch : g;
	}
	static void displacementGradient(const Weights& w, const Patch (&v)[dim], double r, double dt, double (&G)[gradients<S>])
	{
		std::fill(G, G + gradients<S>, 0.);
		forEachNode(w, [&](int i, double Nip, const std::array<double, dim>& grad) {
			for (int d = 0; d < dim; ++d)
				for (int e = 0; e < dim; ++e)
					G[d * dim + e] += v[d][i] * grad[e];
			if constexpr (hoop) G[dim * dim] += v[0][i] * Nip / r;
		});
		for (double& g : G)
			g *= dt;
	}
	[[gnu::noinline]] void updatePointStress(std::size_t t, std::size_t p, const double (&G)[gradients<S>])
	{
		const Law&      law     = m_laws[m_points.material[p]];
		const Internals layout  = Internals::of(law);
		const int       columns = layout.columns(N);
		double          sigma[N], internal[Internals::most(N)], F[dim * dim];
		for (int k = 0; k < N; ++k)
			sigma[k] = m_points.stress[k][p];
		for (int k = 0; k < columns; ++k)
			internal[k] = m_points.internal[k][p];
		for (int k = 0; k < dim * dim; ++k)
			F[k] = m_points.deformation[k][p];
		if (!std::all_of(G, G + gradients<S>, [](double g) { return std::abs(g) <= 1; })) {
			advanceDeformation<dim>(G, m_stressControl.largeStrain, F);
			return reportFailure(t, p, determinant<dim>(F) > 0 ? "is deformed by more than its own size in a step" : noVolume);
		}
		Increment<S> increment;
		if (m_stressControl.largeStrain) {
			increment.large(G);
			increment.rotate(sigma);
			for (int k = 0; k < layout.tensors; ++k)
				increment.rotate(internal + k * N);
		} else
			increment.small(G);
		const bool thinning = std::is_same_v<S, PlaneStress> && m_stressControl.thinning;
		if (m_stressControl.trackEnergy || thinning || !m_points.freeStrain.empty()) {
			Response         response;
			const StressWork work(*this, law, p, F, increment.strain, sigma, internal);
			updateStress<LawState<S>>(law, increment.strain, sigma, internal, &response);
			if (!isFinite<N>(sigma)) return reportFailure(t, p, noStress);
			if (!m_points.freeStrain.empty()) m_points.freeStrain[p] += response.freeStrain;
			if (thinning) m_points.thicknessStretch[p] *= (1 + .5 * response.freeStrain) / (1 - .5 * response.freeStrain);
			if constexpr (hoop) advanceHoop(p, G[dim * dim]);
			advanceDeformation<dim>(G, m_stressControl.largeStrain, F);
			if (m_stressControl.trackEnergy) work.add(F, sigma, internal, response, m_tracking.tiles[t]);
		} else {
			updateStress<LawState<S>>(law, increment.strain, sigma, internal);
			if (!isFinite<N>(sigma)) return reportFailure(t, p, noStress);
			if constexpr (hoop) advanceHoop(p, G[dim * dim]);
			advanceDeformation<dim>(G, m_stressControl.largeStrain, F);
		}
		for (int k = 0; k < N; ++k)
			m_points.stress[k][p] = sigma[k];
		for (int k = 0; k < columns; ++k)
			m_points.internal[k][p] = internal[k];
		for (int k = 0; k < dim * dim; ++k)
			m_points.deformation[k][p] = F[k];
		if (!(determinant<dim>(F) > 0)) reportFailure(t, p, noVolume);
	}

	/* USF: v_i from the points as they are, walls. */
	void startVelocities()
	{
		// on copies: the step that follows folds the raw sums itself
		const Column      mass = m_mass, radial = m_radialMass;
		NodeVector<dim>   none  = m_force;
		std::vector<Wall> walls = m_walls;
		m_velocity              = m_momentum;
		m_band.fold(walls, nodeMass(), m_velocity, none, m_control.dt);
		divideByMass(m_velocity);
		m_mass = mass, m_radialMass = radial;
		m_band.unfold(m_walls, m_velocity, true);
	}
	void stressThenForce(std::size_t t)
	{
		const auto& tile = m_grid.tiles()[t];
		Patch       v[dim], f[dim] {};
		for (int d = 0; d < dim; ++d)
			read(tile, m_velocity[d], v[d]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const Weights w = weights(tile, p);
			double        G[gradients<S>], fp[dim], Vs[dim][dim];
			displacementGradient(w, v, m_points.position[0][p], m_stressControl.dt, G);
			updatePointStress(t, p, G);
			pointForces(p, fp, Vs);
			if constexpr (hoop) {
				Lanes fr, r;
				load(m_points.position[0], { p, 1 }, r), forLanes([&](int l) { fr[l] = fp[0]; });
				addHoopForce({ p, 1 }, r, fr);
				fp[0] = fr[0];
			}
			forEachNode(w, [&](int i, double Nip, const std::array<double, dim>& grad) {
				for (int d = 0; d < dim; ++d)
					f[d][i] += nodalForce(d, Nip, grad, fp, Vs);
			});
		}
		for (int d = 0; d < dim; ++d)
			add(tile, f[d], m_force[d]);
	}
	void finishPositions()
	{
		for (int d = 0; d < dim; ++d)
			for (std::size_t p = 0; p < m_points.count(); ++p) {
				m_points.position[d][p] += m_points.advance[d][p];
				m_points.advance[d][p] = 0;
			}
		m_pending = false;
	}

	// ---- checks ---------------------------------------------------------------------------------------------------

	void checkStress()
	{
		for (TileReport& report : m_reports)
			if (report.failed >= 0) {
				const std::size_t p = std::size_t(report.failed);
				report.failed       = -1;
				fail(p, report.why,
					report.why == noStress ? "reduce O.dt or the load, or look at its material (yieldStress in Pa?)"
							       : "reduce O.dt or the load, or use more points a cell");
			}
	}
	/* Points that have left their tile ask for a new sorting; those that have left the scene stop the run. */
	void checkPoints()
	{
		for (std::size_t t = 0; t < m_reports.size(); ++t) {
			if (!m_reports[t].left) continue;
			m_sorted = m_known = false;
			for (std::size_t p = m_grid.tiles()[t].begin; p < m_grid.tiles()[t].end; ++p)
				requireOnGrid(p);
			m_known = true;
		}
	}
};

} // namespace yade::mpm

#include "EnergyBalance.hpp"
#include "NullSpaceFilter.hpp"
#include "MassCorrection.hpp"
#include "MeanDilatation.hpp"
#include "RoundTrip.hpp"
#include "StableStep.hpp"
