// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "Kinematics.hpp"
#include "Lanczos.hpp"
#include "ShapeFunction.hpp"
#include "Solver.hpp"
#include "WallBand.hpp"
#include <cstring>

namespace yade::mpm {

/* Suffixes as in the literature: _p of a point, _i of a node, _ip a weight of point p at node i. */
template <class S, class Shape> class MpmSolver final : public Solver {
public:
	static constexpr int dim = S::dim, N = S::N;

	MpmSolver(Analysis analysis, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
	    : m_analysis(analysis)
	    , m_cellSize(cellSize)
	    , m_points(points)
	    , m_laws(laws)
	    , m_walls(walls)
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
		if (energy) m_tracking.tiles.resize(m_grid.tiles().size());

		clear(m_mass), clear(m_momentum), clear(m_force);
		if (control.scheme == Scheme::usf) {
			forEachTile([&](std::size_t t) { pointsToGrid<false, false>(t); });
			startVelocities();
			m_stressControl = control;
			forEachTile([&](std::size_t t) { stressThenForce(t); });
			checkStress();
		} else if (m_pending) {
			forEachTile([&](std::size_t t) { pointsToGrid<true, true>(t); });
			m_pending = false;
			checkStress();
		} else {
			forEachTile([&](std::size_t t) { pointsToGrid<false, true>(t); });
		}
		if (energy) keepSums();
		updateNodes();
		const double kineticBefore = energy ? kineticEnergy() : 0;
		if (energy) trackWork();

		clear(m_velocity);
		if (control.scheme == Scheme::musl) {
			forEachTile([&](std::size_t t) { gridToPoints<true>(t); });
			remapVelocities();
		} else {
			forEachTile([&](std::size_t t) { gridToPoints<false>(t); });
			std::swap(m_velocity, m_momentum); // the updated velocities themselves
		}
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

	void        pointsChanged() override { m_sorted = false; }
	std::size_t gridBytes() const override { return m_mass.size() * sizeof(double) * (1 + 3 * dim); }
	Analysis    analysis() const override { return m_analysis; }
	int         components() const override { return N; }

	double acousticTimeStep(Scheme scheme) override;
	double crossingRate() const override;

private:
	using Grid                   = TileGrid<dim>;
	static constexpr int support = Shape::support;
	static constexpr int extent  = Grid::width + support - 1; // nodes along an axis that a tile's points touch
	static constexpr int rows    = ipow(extent, dim - 1);
	static constexpr int local   = rows * extent;
	using Patch                  = double[local]; // one nodal quantity around a tile

	struct Weights {
		int    first;                              // node of the patch
		double N_[dim][support], dN[dim][support]; // dN in 1/m
	};
	struct TileReport {                    // what a pass has to say of a tile
		bool           left   = false; // a point is no longer the tile's, or worse
		std::ptrdiff_t failed = -1;    // a point whose volume is not positive
	};

	Analysis                m_analysis;
	double                  m_cellSize;
	Points&                 m_points;
	const std::vector<Law>& m_laws;
	std::vector<Wall>&      m_walls;
	StepControl             m_control, m_stressControl; // of the current step, and of the one whose stress update is pending
	Geometry<dim>           m_geometry;
	std::vector<Wall::Kind> m_kinds; // of the walls, as the bands have been built for
	Grid                    m_grid;
	WallBand<dim>           m_band;
	Column                  m_mass;
	NodeVector<dim>         m_momentum, m_force, m_velocity; // momentum becomes velocity, force becomes dt * acceleration
	std::vector<TileReport> m_reports;
	bool                    m_sorted = false, m_pending = false;

	struct StressWork;
	struct Tracking {                              // empty unless energies are tracked
		std::vector<Energies> tiles;           // what the passes have found, summed in the order of tiles
		Column                mass;            // of the nodes, not folded
		NodeVector<dim>       force, external; // likewise; all forces, and the external ones
		NodeVector<dim>       damping;         // acceleration that damping takes away
	};
	Tracking m_tracking;

	void   startEnergies();
	void   keepSums();
	void   trackWork();
	void   collectTiles();
	double kineticEnergy() const;

	// ---- the grid -------------------------------------------------------------------------------------------------

	/* Lays the grid through walls and points; what of it still fits is kept. */
	void layGrid()
	{
		const Geometry<dim> geometry = makeGeometry<dim>(m_cellSize, m_walls);
		std::vector<Wall::Kind> kinds;
		for (const Wall& wall : m_walls)
			kinds.push_back(wall.kind);
		if (m_sorted && geometry == m_geometry && kinds == m_kinds) return;
		finish(); // the pending update belongs to the old grid
		m_geometry = geometry, m_kinds = kinds;

		Points&                           P = m_points;
		std::array<std::vector<int>, dim> bases;
		for (int d = 0; d < dim; ++d) {
			bases[d].resize(P.count());
			for (std::size_t p = 0; p < P.count(); ++p) {
				requireOnGrid(p);
				bases[d][p] = int(std::floor(m_geometry.xi(d, P.position[d][p]) - Shape::shift(halfSize(d, p))));
			}
		}
		m_grid.sort(P, bases);
		m_mass.assign(m_grid.nodeCount(), 0);
		for (auto* field : { &m_momentum, &m_force, &m_velocity })
			for (Column& c : *field)
				c.assign(m_grid.nodeCount(), 0);
		m_reports.assign(m_grid.tiles().size(), {});
		double       N0[support], dN0[support];
		const double r = P.count() ? halfSize(0, 0) : .5, base = std::floor(-Shape::shift(r));
		Shape::evaluate(0, base, r, N0, dN0);
		m_band.build(m_grid, m_geometry, m_walls, N0[int(-base)], support > 2 ? N0[int(-base) - 1] : 0);
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

	Weights weights(const typename Grid::Tile& tile, std::size_t p) const
	{
		Weights w;
		w.first = 0;
		for (int d = dim - 1; d >= 0; --d) {
			const double xi = m_geometry.xi(d, m_points.position[d][p]), r = halfSize(d, p), base = std::floor(xi - Shape::shift(r));
			Shape::evaluate(xi, base, r, w.N_[d], w.dN[d]);
			for (int k = 0; k < support; ++k)
				w.dN[d][k] /= m_geometry.cell[d];
			w.first = w.first * extent + (int(base) - tile.index[d] * Grid::width);
		}
		return w;
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
#pragma omp parallel for schedule(dynamic) num_threads(m_control.threads) if (m_control.threads > 1 && count > 1)
			for (int k = 0; k < count; ++k)
				work(std::size_t(tiles[k]));
		}
	}
	static void clear(Column& field) { std::fill(field.begin(), field.end(), 0.); }
	static void clear(NodeVector<dim>& field)
	{
		for (Column& c : field)
			clear(c);
	}

	// ---- steps of the method --------------------------------------------------------------------------------------

	/* Step 1: m_i = sum N_ip m_p, (m v)_i = sum N_ip m_p v_p, f_i = sum N_ip (f_p + m_p g) - V_p sigma_p grad N_ip   (eqs. 12, 13)
	With stress, after step 5 of the step before. */
	template <bool stress, bool force> void pointsToGrid(std::size_t t)
	{
		const auto& tile = m_grid.tiles()[t];
		if (stress) updateTileStress(t);
		Patch m {}, mv[dim] {}, f[dim] {};
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const Weights w  = weights(tile, p);
			const double  mp = m_points.mass[p];
			double        mvp[dim], fp[dim], Vs[dim][dim];
			for (int d = 0; d < dim; ++d)
				mvp[d] = mp * m_points.velocity[d][p];
			if (force) pointForces(p, fp, Vs);
			forEachNode(w, [&](int i, double Nip, const std::array<double, dim>& grad) {
				m[i] += Nip * mp;
				for (int d = 0; d < dim; ++d) {
					mv[d][i] += Nip * mvp[d];
					if (force) f[d][i] += nodalForce(d, Nip, grad, fp, Vs);
				}
			});
		}
		add(tile, m, m_mass);
		for (int d = 0; d < dim; ++d) {
			add(tile, mv[d], m_momentum[d]);
			if (force) add(tile, f[d], m_force[d]);
		}
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
		m_band.fold(m_walls, m_mass, m_momentum, m_force, m_control.dt);
		const double      dt = m_control.dt, damping = m_control.damping, least = leastMass();
		const std::size_t count  = m_mass.size();
		const bool        energy = m_control.trackEnergy;
#pragma omp parallel for schedule(static) num_threads(m_control.threads) if (m_control.threads > 1 && count > 20000)
		for (std::size_t i = 0; i < count; ++i)
			for (int d = 0; d < dim; ++d) {
				double &v = m_momentum[d][i], &dv = m_force[d][i];
				if (!(m_mass[i] > least)) {
					v = dv = 0;
					continue;
				}
				const double start = v / m_mass[i], a = dv / m_mass[i], trend = a * (start + .5 * dt * a);
				const double braking = damping * a * ((trend > 0) - (trend < 0));
				dv                   = dt * (a - braking);
				if (energy) m_tracking.damping[d][i] = braking;
				v = start + dv;
			}
		m_band.unfold(m_walls, m_momentum, true);
		m_band.unfold(m_walls, m_force, false);
	}
	/* Nodes with less than this part of a point's mass are empty but for rounding. */
	double leastMass() const { return 1e-14 * m_points.mass.front(); }

	/* Step 3: v_p += sum N_ip dt a_i (FLIP), displacement dt sum N_ip v_i   (eq. 15)
	Step 4 (remap): (m v)_i = sum N_ip m_p v_p with the new velocities. */
	template <bool remap> void gridToPoints(std::size_t t)
	{
		const auto&  tile = m_grid.tiles()[t];
		const double dt = m_control.dt, flip = m_control.flip;
		Patch        v[dim], dv[dim], mv[dim] {};
		for (int d = 0; d < dim; ++d)
			read(tile, m_momentum[d], v[d]), read(tile, m_force[d], dv[d]);
		bool left = false;
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			const Weights w = weights(tile, p);
			double        vp[dim] {}, dvp[dim] {}, mvp[dim];
			forEachNode(w, [&](int i, double Nip, const std::array<double, dim>&) {
				for (int d = 0; d < dim; ++d)
					vp[d] += Nip * v[d][i], dvp[d] += Nip * dv[d][i];
			});
			for (int d = 0; d < dim; ++d) {
				double& velocity = m_points.velocity[d][p];
				if (!m_points.fixed.empty() && m_points.fixed[p] >> d & 1)
					vp[d] = velocity;
				else
					velocity = flip == 1 ? velocity + dvp[d] : flip * (velocity + dvp[d]) + (1 - flip) * vp[d];
				m_points.advance[d][p] = dt * vp[d];
				mvp[d]                 = m_points.mass[p] * velocity;
				const double xi        = m_geometry.xi(d, m_points.position[d][p] + dt * vp[d]);
				const double inTile    = xi - Shape::shift(halfSize(d, p)) - tile.index[d] * Grid::width;
				left |= !(inTile >= 0 && inTile < Grid::width && xi >= m_geometry.xiMin[d] && xi <= m_geometry.xiMax[d]
					  && std::isfinite(velocity));
			}
			if (remap)
				forEachNode(w, [&](int i, double Nip, const std::array<double, dim>&) {
					for (int d = 0; d < dim; ++d)
						mv[d][i] += Nip * mvp[d];
				});
		}
		m_reports[t].left = left;
		if (remap)
			for (int d = 0; d < dim; ++d)
				add(tile, mv[d], m_velocity[d]);
	}

	/* Step 4, at the nodes: v_i = (m v)_i / m_i, walls again. */
	void remapVelocities()
	{
		m_band.foldMomentum(m_walls, m_mass, m_velocity);
		divideByMass(m_mass, m_velocity);
		m_band.unfold(m_walls, m_velocity, true);
	}
	void divideByMass(const Column& mass, NodeVector<dim>& field) const
	{
		const double least = leastMass();
		for (Column& c : field)
			for (std::size_t i = 0; i < mass.size(); ++i)
				c[i] = mass[i] > least ? c[i] / mass[i] : 0;
	}

	/* Step 5: grad v = sum v_i grad N_ip, strain increment, rotation, law, deformation; then the point moves   (eq. 16) */
	void updateTileStress(std::size_t t)
	{
		const auto& tile = m_grid.tiles()[t];
		Patch       v[dim];
		for (int d = 0; d < dim; ++d)
			read(tile, m_velocity[d], v[d]);
		for (std::size_t p = tile.begin; p < tile.end; ++p) {
			double G[dim * dim];
			displacementGradient(weights(tile, p), v, m_stressControl.dt, G);
			updatePointStress(t, p, G);
			for (int d = 0; d < dim; ++d) {
				m_points.position[d][p] += m_points.advance[d][p];
				m_points.advance[d][p] = 0;
			}
		}
	}
	static void displacementGradient(const Weights& w, const Patch (&v)[dim], double dt, double (&G)[dim * dim])
	{
		std::fill(G, G + dim * dim, 0.);
		forEachNode(w, [&](int i, double, const std::array<double, dim>& grad) {
			for (int d = 0; d < dim; ++d)
				for (int e = 0; e < dim; ++e)
					G[d * dim + e] += v[d][i] * grad[e];
		});
		for (double& g : G)
			g *= dt;
	}
	void updatePointStress(std::size_t t, std::size_t p, const double (&G)[dim * dim])
	{
		constexpr int   maxInternal = 64;
		const Law&      law         = m_laws[m_points.material[p]];
		const Internals layout      = Internals::of(law);
		const int       columns     = layout.columns(N);
		double          sigma[N], internal[maxInternal], F[dim * dim];
		for (int k = 0; k < N; ++k)
			sigma[k] = m_points.stress[k][p];
		for (int k = 0; k < columns; ++k)
			internal[k] = m_points.internal[k][p];
		for (int k = 0; k < dim * dim; ++k)
			F[k] = m_points.deformation[k][p];
		Increment<S> increment;
		if (m_stressControl.largeStrain) {
			increment.large(G);
			increment.rotate(sigma);
			for (int k = 0; k < layout.tensors; ++k)
				increment.rotate(internal + k * N);
		} else
			increment.small(G);
		const bool thinning = std::is_same_v<S, PlaneStress> && m_stressControl.thinning;
		if (m_stressControl.trackEnergy || thinning) {
			Response         response;
			const StressWork work(*this, law, p, F, increment.strain, sigma, internal);
			updateStress<S>(law, increment.strain, sigma, internal, &response);
			if (thinning) m_points.thicknessStretch[p] *= (1 + .5 * response.freeStrain) / (1 - .5 * response.freeStrain);
			advanceDeformation<dim>(G, m_stressControl.largeStrain, F);
			if (m_stressControl.trackEnergy) work.add(F, sigma, internal, response, m_tracking.tiles[t]);
		} else {
			updateStress<S>(law, increment.strain, sigma, internal);
			advanceDeformation<dim>(G, m_stressControl.largeStrain, F);
		}
		for (int k = 0; k < N; ++k)
			m_points.stress[k][p] = sigma[k];
		for (int k = 0; k < columns; ++k)
			m_points.internal[k][p] = internal[k];
		for (int k = 0; k < dim * dim; ++k)
			m_points.deformation[k][p] = F[k];
		if (!(determinant<dim>(F) > 0) && m_reports[t].failed < 0) m_reports[t].failed = std::ptrdiff_t(p);
	}

	/* USF: v_i from the points as they are, walls. */
	void startVelocities()
	{
		// on copies: the step that follows folds the raw sums itself
		Column            mass  = m_mass;
		NodeVector<dim>   none  = m_force;
		std::vector<Wall> walls = m_walls;
		m_velocity              = m_momentum;
		m_band.fold(walls, mass, m_velocity, none, m_control.dt);
		divideByMass(mass, m_velocity);
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
			double        G[dim * dim], fp[dim], Vs[dim][dim];
			displacementGradient(w, v, m_stressControl.dt, G);
			updatePointStress(t, p, G);
			pointForces(p, fp, Vs);
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
				fail(p, "has a volume that is not positive", "reduce O.dt or the load, or use more points a cell");
			}
	}
	/* Points that have left their tile ask for a new sorting; those that have left the scene stop the run. */
	void checkPoints()
	{
		for (std::size_t t = 0; t < m_reports.size(); ++t) {
			if (!m_reports[t].left) continue;
			m_sorted = false;
			for (std::size_t p = m_grid.tiles()[t].begin; p < m_grid.tiles()[t].end; ++p)
				requireOnGrid(p);
		}
	}
};

} // namespace yade::mpm

#include "EnergyBalance.hpp"
#include "StableStep.hpp"
