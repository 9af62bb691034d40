// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "EnergyBalance.hpp"
#include "FaceLoads.hpp"
#include "NullSpaceFilter.hpp"
#include "PointChecks.hpp"
#include "StableStep.hpp"
#include "StressUpdate.hpp"

namespace yade::mpm {

/* The method on one scene: eqs. 12 to 16 of Sofianos & Koumousis, COMPDYN 2017. Each equation has a file of its own in this
folder; here stand their order and the state between steps.

Suffixes as in the literature: _p of a point, _i of a node, _ip a weight of point p at node i. Weights are those of the
positions at the start of the step throughout. The stress update that ends a step of MUSL and USL is deferred: it shares a
pass over the points with the sums that begin the next step, or finish() carries it out. */
template <class S, class Shape> class MpmSolver final : public Solver {
public:
	static constexpr int dim = S::dim;

	MpmSolver(Analysis analysis, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls)
	    : m_analysis(analysis)
	    , m_cellSize(cellSize)
	    , m_laws(laws)
	    , m_walls(walls)
	    , m_d { { points }, NodeConstraints<dim>(walls) }
	{
	}

	void step(const StepControl& control) override
	{
		if (points().count() == 0) return;
		m_control = control, m_d.transfer.threads = control.threads;
		m_shown.reset();
		if (control.trackEnergy && !points().energies.started) finish(), m_balance.start(m_d, m_analysis, m_laws, control.largeStrain);
		layGrid();
		lap("points sorted into tiles");
		switch (control.scheme) {
			case Scheme::musl: musl(); break;
			case Scheme::usl: usl(); break;
			case Scheme::usf: usf(); break;
		}
		checkPoints();
		if (control.trackEnergy) finish(), m_balance.finish(points());
	}

	void finish() override
	{
		if (!m_stressDue) return;
		m_d.transfer.forEachTile([this](std::size_t t) { updateStress(t); });
		m_stressDue = false;
		checkStress();
	}

	double acousticTimeStep(const StepControl& control) override
	{
		if (points().count() == 0) return std::numeric_limits<double>::infinity();
		finish();
		if (!isLaid()) m_shown = nodes();
		m_control.time = control.time; // layGrid() names it in its complaints
		layGrid();
		return StableStep<D>(m_d, m_laws, control).value(control.scheme, control.fullMass);
	}
	double crossingRate() const override
	{
		const auto cell     = makeGeometry<dim>(m_cellSize, m_walls).cell;
		double     crossing = 0;
		for (std::size_t d = 0; d < std::size_t(dim); ++d)
			for (const double v : points().velocity[d])
				crossing = std::max(crossing, std::abs(v) / cell[d]);
		return crossing;
	}

	void        pointsChanged() override { m_sorted = m_known = false; }
	std::size_t gridBytes() const override { return m_d.fields.bytes(); }
	Analysis    analysis() const override { return m_analysis; }
	int         components() const override { return S::N; }

	GridNodes nodes() const override
	{
		if (m_shown) return *m_shown;
		GridNodes   shown;
		const auto& fields = m_d.fields;
		const auto& g      = m_d.transfer.geometry;
		if (fields.mass.size() != m_d.transfer.grid.nodeCount()) return shown;
		m_d.transfer.grid.forEachNode([&](const auto& node, std::ptrdiff_t at) {
			const std::size_t i = std::size_t(at);
			if (fields.mass[i] <= fields.leastMass) return;
			shown.mass.push_back(fields.mass[i]);
			for (std::size_t d = 0; d < 3; ++d) {
				const bool moves = d < std::size_t(dim);
				shown.position[d].push_back(moves ? g.origin[d] + node[d] * g.cell[d] : 0);
				shown.velocity[d].push_back(moves ? fields.velocity[d][i] : 0);
			}
		});
		return shown;
	}

private:
	using D = Discretization<S, Shape>;

	const Analysis           m_analysis;
	const double             m_cellSize;
	const std::vector<Law>&  m_laws;
	std::vector<Wall>&       m_walls;
	D                        m_d;
	StepControl              m_control, m_stressControl; // of the current step, and of the one whose stress update is due
	std::vector<TileReport>  m_reports;
	EnergyBalance<D>         m_balance;
	AddedWallWork            m_added;
	FaceLoads<D>             m_faces;
	NodeVector<dim>          m_roundTrip;            // scratch of the mass correction
	std::optional<GridNodes> m_shown;                // nodes of the last step, once the grid has been laid anew
	std::vector<Wall::Kind>  m_kinds;                // of the walls, as the constraints have been built for
	double                   m_wallHalfSize = 0;     // of the point whose shape functions they have been built for
	bool                     m_laid         = false; // blocks, fields and constraints are those of the geometry
	bool                     m_known        = false; // points are in the tiles of the grid, unless a report marks a tile as left
	bool                     m_sorted       = false; // all of them are
	bool                     m_stressDue    = false;

	Points&       points() { return m_d.transfer.points; }
	const Points& points() const { return m_d.transfer.points; }

	// ---- the schemes ------------------------------------------------------------------------------------------------

	/* Stress last, with velocities mapped once more from the points (Sulsky, Zhou & Schreyer, CPC 87 (1995) 236). */
	void musl()
	{
		sumPoints();        // 12, 13, after the deferred 16
		updateVelocities(); // 14
		sumOverTiles(
			m_d.transfer, [this](std::size_t t) { moveTile<true>(t); }, m_d.fields.momentum); // 15, second mapping
		velocityFromMomentum(m_d, m_d.fields.momentum, m_d.fields.velocity, Motion::velocity);
		if (correctsMass(m_control)) correctVelocities(m_d, m_control, m_roundTrip, m_reports);
		endMotion();
		lap("nodes to points and back");
		deferStress(); // 16
	}
	/* Stress last, with the nodal velocities that eq. 14 ends with. */
	void usl()
	{
		sumPoints();                                                             // 12, 13, after the deferred 16
		updateVelocities();                                                      // 14
		m_d.transfer.forEachTile([this](std::size_t t) { moveTile<false>(t); }); // 15
		endMotion();
		lap("nodes to points");
		deferStress(); // 16
	}
	/* Stress first, with the velocities that the points bring to the nodes. */
	void usf()
	{
		finish();            // of a step of another scheme
		sum<Sums::motion>(); // 12
		startVelocities();
		deferStress(), finish(); // 16
		sum<Sums::forces>();     // 13
		lap("points to nodes, stress");
		updateVelocities();                                                      // 14
		m_d.transfer.forEachTile([this](std::size_t t) { moveTile<false>(t); }); // 15
		endMotion();
		lap("nodes to points");
		takeDisplacements();
	}

	// ---- their parts -------------------------------------------------------------------------------------------------

	/* Eqs. 12 and 13; tile by tile after the stress update that is due. */
	void sumPoints()
	{
		if (m_stressDue)
			sum<Sums::all>([this](std::size_t t) { updateStress(t); });
		else
			sum<Sums::all>();
		m_stressDue = false;
		checkStress();
		lap("stress, points to nodes");
	}
	template <Sums sums> void sum()
	{
		sum<sums>([](std::size_t) {});
	}
	/* Sums of the points, each tile after before(t). */
	template <Sums sums, class Before> void sum(Before&& before)
	{
		auto& fields = m_d.fields;
		auto  work   = [&](std::size_t t) {
                        before(t);
                        pointsToGrid<sums>(m_d.transfer, fields, m_control, t);
                        if (sums != Sums::motion && !points().inContact.empty()) spreadTorques(m_d.transfer, t, fields.force);
		};
		if constexpr (sums == Sums::motion)
			sumOverTiles(m_d.transfer, work, fields.mass, fields.radialMass, fields.momentum);
		else if constexpr (sums == Sums::forces)
			sumOverTiles(m_d.transfer, work, fields.force);
		else
			sumOverTiles(m_d.transfer, work, fields.mass, fields.radialMass, fields.momentum, fields.force);
	}
	/* USF: velocities of the points as they are. The sums stay raw for the update of the nodes. */
	void startVelocities()
	{
		NodeFields<S> sums = m_d.fields;
		clear(m_d.transfer, sums.force);
		m_d.constraints.afterSums(sums.masses(), sums.momentum, sums.force, m_control.dt);
		divideByMass(m_d.transfer, sums, sums.momentum, m_d.fields.velocity);
		m_d.constraints.afterUpdate(m_d.fields.velocity, Motion::velocity);
	}
	/* Eq. 14 with the options that act on the nodes. */
	void updateVelocities()
	{
		const bool energies = m_control.trackEnergy, pic = m_control.flip < 1;
		const bool faces = !points().tractions.empty();
		if (faces) m_faces.locate(m_d, m_control.time), m_faces.spread(m_d, m_d.fields.force);
		if (energies) m_balance.keepSums(m_d, m_control);
		if (energies && faces) m_faces.spread(m_d, m_balance.external());
		if (pic) m_d.constraints.keepMomentum(m_d.fields.momentum);
		updateNodes(m_d, m_control, energies ? m_balance.damping() : nullptr);
		const double share = pic ? m_d.constraints.addMomentumLoss(velocityAtStart(m_d.fields), (1 - m_control.flip) / m_control.dt, m_control.dt) : 0;
		if (energies) m_balance.keepMotion(m_d);
		m_added = correctsMass(m_control) ? correctIncrements(m_d, m_control, m_roundTrip) : AddedWallWork {};
		m_added.pic += share;
		lap("nodes");
	}
	/* Eq. 15, with MUSL's second mapping where remap. */
	template <bool remap> void moveTile(std::size_t t) { gridToPoints<remap>(m_d, m_control.dt, m_control.flip, t, m_reports[t]); }

	/* When the points have their new velocities: work of the forces, points in contact, filter. */
	void endMotion()
	{
		if (m_control.trackEnergy) m_balance.addWork(m_d, m_control, m_added, m_roundTrip);
		if (!points().tractions.empty()) m_faces.move(m_d, m_control.dt, m_control.largeStrain);
		if (!points().inContact.empty()) m_d.transfer.forEachTile([this](std::size_t t) { moveContactPoints(m_d, m_control.dt, t, m_reports[t]); });
		if (m_control.filter > 0) filterVelocities(m_d, m_control);
	}
	void deferStress() { m_stressControl = m_control, m_stressDue = true; }
	void updateStress(std::size_t t)
	{
		StressUpdate<D> update { m_d, m_laws, m_stressControl, m_stressControl.trackEnergy ? m_balance.tiles() : nullptr };
		update.updateTile(t, m_reports[t]);
	}
	/* Moves the points, where no stress update does. */
	void takeDisplacements()
	{
		for (std::size_t d = 0; d < std::size_t(dim); ++d)
			for (std::size_t p = 0; p < points().count(); ++p) {
				points().position[d][p] += points().displacementIncrement[d][p];
				points().displacementIncrement[d][p] = 0;
			}
	}
	void lap(const char* pass) const
	{
		if (m_control.clock) m_control.clock->lap(pass);
	}

	// ---- the grid ----------------------------------------------------------------------------------------------------

	std::vector<Wall::Kind> wallKinds() const
	{
		std::vector<Wall::Kind> kinds;
		for (const Wall& wall : m_walls)
			kinds.push_back(wall.kind);
		return kinds;
	}
	bool isLaid() const { return m_sorted && makeGeometry<dim>(m_cellSize, m_walls) == m_d.transfer.geometry && wallKinds() == m_kinds; }

	/* Lays the grid through walls and points; unchanged parts are reused. */
	void layGrid()
	{
		if (isLaid()) return;
		auto&               transfer = m_d.transfer;
		const Geometry<dim> geometry = makeGeometry<dim>(m_cellSize, m_walls);
		finish(); // the stress update that is due belongs to the old grid
		if (geometry != transfer.geometry || wallKinds() != m_kinds) m_laid = m_known = false;
		transfer.geometry = geometry, m_kinds = wallKinds();

		Points& P = points();
		if (!m_known) {
			for (std::size_t p = 0; p < P.count(); ++p)
				checks().requireOnGrid(p, hasHoop<S>, m_control.time);
			m_d.fields.leastMass = Shape::rounding * *std::min_element(P.mass.begin(), P.mass.end());
		}
		auto baseOf = [&](std::size_t p) {
			typename D::T::Grid::Index base;
			for (int d = 0; d < dim; ++d)
				base[std::size_t(d)] = floorToInt(geometry.xi(d, P.position[std::size_t(d)][p]) - Shape::shift(transfer.halfSize(d, p)));
			return base;
		};
		if (transfer.grid.sort(P, m_known, transfer.threads, baseOf, [&](std::size_t t) { return !m_reports[t].left; })) m_laid = false;
		m_known = true;
		m_reports.assign(transfer.grid.tiles().size(), {});
		m_balance.resize(transfer.grid.tiles().size());
		const double r = P.count() ? transfer.halfSize(0, 0) : .5; // of the shape functions at the walls
		if (!m_laid || r != m_wallHalfSize) {
			m_d.fields.resize(transfer.grid.nodeCount());
			double       N0[Shape::support], dN0[Shape::support];
			const double base = std::floor(-Shape::shift(r));
			Shape::evaluate(0, base, r, N0, dN0);
			m_d.constraints.build(transfer.grid, geometry, N0[int(-base)], Shape::support > 2 ? N0[int(-base) - 1] : 0);
			m_wallHalfSize = r;
			m_laid         = true;
		}
		m_sorted = true;
	}

	// ---- checks ------------------------------------------------------------------------------------------------------

	PointChecks<dim, Shape> checks() const { return PointChecks<dim, Shape>(m_d.transfer); }

	void checkStress()
	{
		for (TileReport& report : m_reports)
			if (report.failed >= 0) {
				const std::size_t p = std::size_t(report.failed);
				report.failed       = -1;
				checks().fail(p, report.why, StressUpdate<D>::remedy(report.why), m_control.time);
			}
	}
	/* Points that have left their tile have to be sorted anew; those that have left the scene stop the run. */
	void checkPoints()
	{
		for (std::size_t t = 0; t < m_reports.size(); ++t) {
			if (!m_reports[t].left) continue;
			m_sorted = m_known = false;
			for (std::size_t p = m_d.transfer.grid.tiles()[t].begin; p < m_d.transfer.grid.tiles()[t].end; ++p)
				checks().requireOnGrid(p, hasHoop<S>, m_control.time);
			m_known = true;
		}
	}
};

} // namespace yade::mpm
