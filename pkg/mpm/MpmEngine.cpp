// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmEngine.hpp"
#include "Action.hpp"
#include "BadInput.hpp"
#include "Materials.hpp"
#include "kernel/Text.hpp"
#include <algorithm>
#include <core/EnergyTracker.hpp>
#include <core/Omega.hpp>
#include <omp.h>

namespace yade {

namespace {
	const char* const self = "MpmEngine";

	template <class Value> Value choose(const char* attribute, const std::string& given, std::initializer_list<std::pair<const char*, Value>> choices)
	{
		for (const auto& [name, value] : choices)
			if (given == name) return value;
		std::string names;
		for (const auto& [name, value] : choices)
			names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
		refuse(self, attribute, "'" + given + "'", "choose one of " + names);
	}

	mpm::Analysis analysisOf(const std::string& name)
	{
		return choose<mpm::Analysis>("analysis", name,
			{ { "planeStress", mpm::Analysis::planeStress }, { "planeStrain", mpm::Analysis::planeStrain },
				{ "axisymmetric", mpm::Analysis::axisymmetric }, { "3d", mpm::Analysis::solid } });
	}
	mpm::ShapeKind shapeOf(const std::string& name)
	{
		return choose<mpm::ShapeKind>("shape", name,
			{ { "linear", mpm::ShapeKind::linear }, { "gimp", mpm::ShapeKind::gimp }, { "quadratic", mpm::ShapeKind::quadratic },
				{ "cubic", mpm::ShapeKind::cubic } });
	}
	mpm::Scheme schemeOf(const std::string& name)
	{
		return choose<mpm::Scheme>("scheme", name, { { "USF", mpm::Scheme::usf }, { "USL", mpm::Scheme::usl }, { "MUSL", mpm::Scheme::musl } });
	}
} // namespace

void MpmEngine::action()
{
	act([this] { step(); });
}

void MpmEngine::step()
{
	struct Clock : mpm::PassClock {
		TimingDeltas& deltas;
		explicit Clock(TimingDeltas& d)
		    : deltas(d)
		{
		}
		void lap(const char* pass) override { deltas.checkpoint(pass); }
	} clock(*timingDeltas);

	timingDeltas->start();
	const auto       lock    = attach();
	mpm::StepControl control = prepare();
	if (m_points->count() == 0) return;
	readBodies();
	if (m_points->count() == 0) return; // the last ones have been erased
	const bool stepper = m_order.checkClocks(timeStepSafety > 0);
	timeStepSafety > 0 ? adaptStep(control, stepper) : checkStep(control, stepper);
	checkContinuity(control);
	planFilter(control);
	if (TimingInfo::enabled) control.clock = &clock, clock.lap("bodies to points");
	m_solver->step(control);
	if (m_bodies > 0) m_links.write(*scene, m_points->points);
	if (control.trackEnergy) reportEnergies();
	if (TimingInfo::enabled) clock.lap("points to bodies");
	wallsLeft.resize(walls.size());
	for (std::size_t w = 0; w < walls.size(); ++w) {
		const mpm::Wall& wall = m_points->runtime.walls[w];
		for (int d = 0; d < 3; ++d)
			walls[w]->force[d] = wall.force[std::size_t(d)];
		wallsLeft[w] = walls[w]->origin += scene->dt * walls[w]->velocity;
	}
}

/* Terms of the balance under their names in O.energy; O.energy.total() adds them up. */
void MpmEngine::reportEnergies() const
{
	const mpm::Energies& e = m_points->points.energies;
	for (const auto& [name, value] :
		std::initializer_list<std::pair<const char*, Real>> { { "mpmKinetic", e.kinetic }, { "mpmElastic", e.elastic }, { "mpmHardening", e.hardening },
			{ "mpmDissipation", e.dissipation }, { "mpmExternal", e.external }, { "mpmDamping", e.damping }, { "mpmWalls", e.walls } })
		scene->energy->setItem_py(name, value);
}

Real MpmEngine::criticalTimeStep()
{
	scene                          = Omega::instance().getScene().get(); // the loop sets it before a step, and there may have been none
	const auto             lock    = attach();
	const mpm::StepControl control = prepare();
	readBodies();
	return m_solver->criticalTimeStep(control.scheme, control.fullMass);
}

/* Finds the scene's points and keeps Python's thread off them. */
std::unique_lock<std::mutex> MpmEngine::attach()
{
	m_points = MpmPoints::of(*scene);
	if (!m_points) throw std::runtime_error("MpmEngine: the scene has no material points; make them with mpm.fill() before the first step");
	return std::unique_lock<std::mutex>(m_points->mutex);
}

// ---- what the scene says ------------------------------------------------------------------------------------------------

mpm::StepControl MpmEngine::prepare()
{
	require(cellSize > 0 && std::isfinite(cellSize), self, "cellSize", cellSize,
		"give the edge of a grid cell > 0 [m], e.g. twice the spacing of mpm.fill");
	require(flip >= 0 && flip <= 1, self, "flip", flip, "give a value in [0, 1]; 1 is pure FLIP");
	require(damping >= 0 && damping < 1, self, "damping", damping, "give a value in [0, 1)");
	require(timeStepSafety >= 0 && timeStepSafety <= 1, self, "timeStepSafety", timeStepSafety,
		"give a part of the stable step, e.g. 0.4, or 0 to set O.dt yourself");
	require(largestGap > 0, self, "largestGap", largestGap, "give a number of cells > 0, e.g. 2, or inf to have none looked for");
	require(gravity.allFinite(), self, "gravity", gravity.transpose(), "give a finite acceleration [m/s2]");
	if (scene->isPeriodic) refuse("O", "periodic", true, "MpmEngine works in scenes that are not periodic; set O.periodic = False");
	const mpm::Analysis analysisKind = analysisOf(analysis);
	const int           dim          = mpm::dimension(analysisKind);
	require(dim == 3 || gravity[2] == 0, self, "gravity", gravity.transpose(), "in a plane analysis nothing moves along z; give a gravity in x and y");
	require(analysisKind != mpm::Analysis::axisymmetric || gravity[0] == 0, self, "gravity", gravity.transpose(),
		"in axisymmetry x is the radius; give a gravity along y, the axis");
	require(!thinning || (analysisKind == mpm::Analysis::planeStress && largeStrain), self, "thinning", thinning,
		"only large-strain plane stress has a thickness that can follow the strain; set thinning = False");
	require(!meanDilatation || analysisKind != mpm::Analysis::planeStress, self, "meanDilatation", meanDilatation,
		"in plane stress the thickness is free to keep the volume, and nothing locks; set meanDilatation = False");

	require(!fullMass || scheme == "MUSL", self, "fullMass", fullMass, "only MUSL has a step for the full mass; set scheme = 'MUSL' or fullMass = False");
	require(filterTime >= 0, self, "filterTime", filterTime, "give a time > 0 [s], e.g. some periods of the slowest vibration, or 0 for no filter");

	m_order.check(scene->engines, *this);
	if (m_points->large != largeStrain || m_points->points.thicknessStretch.empty() == stretches(analysisKind)) m_points->finish();
	m_points->large = largeStrain;
	if (!scene->trackEnergy) m_points->points.energies.started = false;
	m_points->updateLaws();
	prepareWalls(dim, analysisKind == mpm::Analysis::axisymmetric);
	prepareSolver();

	mpm::StepControl control;
	control.dt = scene->dt, control.time = scene->time;
	for (std::size_t d = 0; d < 3; ++d)
		control.gravity[d] = gravity[int(d)];
	control.damping = damping, control.flip = flip;
	control.scheme      = schemeOf(scheme);
	control.largeStrain = largeStrain, control.thinning = thinning;
	control.trackEnergy = scene->trackEnergy, control.meanDilatation = meanDilatation, control.fullMass = fullMass;
	control.threads = ompThreads > 0 ? ompThreads : omp_get_max_threads();
	return control;
}

void MpmEngine::prepareWalls(int dim, bool axisymmetric)
{
	std::vector<mpm::Wall>& kernelWalls = m_points->runtime.walls;
	kernelWalls.resize(walls.size());
	for (std::size_t w = 0; w < walls.size(); ++w) {
		if (!walls[w]) refuse(self, "walls[" + std::to_string(w) + "]", "None", "give an MpmWall");
		kernelWalls[w] = walls[w]->toKernel(w, dim);
		for (std::size_t v = 0; v < w; ++v) {
			const mpm::Wall &a = kernelWalls[v], &b = kernelWalls[w];
			if (a.axis != b.axis) continue;
			require(a.side != b.side, self, "walls", "walls " + std::to_string(v) + " and " + std::to_string(w),
				"two walls face the same way; give one wall a side");
			require((b.position - a.position) * a.side > 0, self, "walls", "walls " + std::to_string(v) + " and " + std::to_string(w),
				"two walls face each other with no room between them; normals point into the material");
		}
	}
	if (!axisymmetric) return;
	bool inner = false;
	for (const mpm::Wall& wall : kernelWalls) {
		if (wall.axis != 0) continue;
		inner = inner || wall.side > 0;
		require(wall.position > 0 || (wall.position == 0 && wall.side > 0 && wall.kind == mpm::Wall::Kind::slip), self, "walls",
			"a wall normal to x at x = " + mpm::number(wall.position),
			"in axisymmetry x is the radius and the axis is a plane of symmetry without a wall; place radial walls at x > 0");
	}
	if (inner) return;
	mpm::Wall axis;
	axis.kind = mpm::Wall::Kind::slip;
	kernelWalls.push_back(axis);
}

void MpmEngine::prepareSolver()
{
	mpm::Points&        points       = m_points->points;
	const mpm::Analysis analysisKind = analysisOf(analysis);
	const auto          key          = std::make_tuple(analysis, shape, cellSize);
	const std::size_t   columns      = std::size_t(mpm::stressComponents(analysisKind));
	auto&               runtime      = m_points->runtime;
	if (!m_solver || m_solver != runtime.solver.get() || key != m_solverFor) {
		m_points->finish();
		if (m_solver) acousticFor.clear(), continuity.forget(); // else it comes from a file, with what it knows of the points
		require(points.stress.empty() || points.stress.size() == columns, self, "analysis", "'" + analysis + "'",
			"the points already carry the stress of another analysis; make new points");
		runtime.solver = mpm::makeSolver(analysisKind, shapeOf(shape), cellSize, points, runtime.laws, runtime.walls);
		m_solver       = runtime.solver.get();
		m_solverFor    = key;
		m_checkedCount = 0;
	}
	if (points.count() != m_checkedCount || m_points->filled) {
		checkPoints(analysisKind);
		if (m_points->filled) continuity.forget(), acousticFor.clear(); // ids of erased bodies are given again
		m_checkedCount   = points.count();
		m_points->filled = false;
	}
	if (shape == "gimp") checkGimp();

	int  internals  = 0;
	bool freeNormal = false;
	for (const mpm::Law& law : runtime.laws) {
		freeNormal = freeNormal || (analysisKind == mpm::Analysis::planeStress && !mpm::keepsVolume(law));
		internals  = std::max(internals, mpm::Internals::of(law).columns(int(columns)));
	}
	m_bodies = std::size_t(std::count_if(points.id.begin(), points.id.end(), [](int id) { return id >= 0; }));
	points.prepare(mpm::dimension(analysisKind), int(columns), internals, stretches(analysisKind), m_bodies > 0, scene->trackEnergy, freeNormal);
}

/* Whether points carry a stretch normal to the plane: of their thickness, or of the rings that they stand for. */
bool MpmEngine::stretches(mpm::Analysis kind) const { return thinning || kind == mpm::Analysis::axisymmetric; }

void MpmEngine::checkPoints(mpm::Analysis kind) const
{
	const int          dim    = mpm::dimension(kind);
	const mpm::Points& points = m_points->points;
	for (std::size_t p = 0; p < points.count(); ++p) {
		const std::string name = "material point " + std::to_string(points.id[p]);
		require(points.mass[p] > 0 && std::isfinite(points.mass[p]), name, "mass", points.mass[p], "give its material a density > 0 before mpm.fill()");
		require(points.volume0[p] > 0 && std::isfinite(points.volume0[p]), name, "volume", points.volume0[p],
			"give mpm.fill() a spacing > 0 and a thickness > 0");
		if (kind == mpm::Analysis::axisymmetric) {
			require(points.thickness[p] < 0, name, "thickness", points.thickness[p],
				"an axisymmetric analysis needs rings: mpm.fill(..., axisymmetric=True)");
			require(points.position[0][p] > 0, name, "position[0]", points.position[0][p], "x is the radius; place points at x > 0 [m]");
		} else if (dim == 2)
			require(points.thickness[p] > 0, name, "thickness", points.thickness[p],
				"a plane analysis needs points with a thickness: mpm.fill(..., thickness=...) [m] (< 0 here: rings of an axisymmetric one)");
		else
			require(points.thickness[p] == 0, name, "thickness", points.thickness[p], "a 3d analysis needs points filled without thickness");
		if (dim == 2)
			require(points.position[2][p] == 0 && points.velocity[2][p] == 0, name, "position[2], velocity[2]",
				mpm::number(points.position[2][p]) + ", " + mpm::number(points.velocity[2][p]),
				"in a plane analysis points lie at z = 0 and stay there");
	}
}

/* Cells may be stretched between walls, and walls may move. */
void MpmEngine::checkGimp() const
{
	const auto   cells = mpm::makeGeometry<3>(cellSize, m_points->runtime.walls).cell;
	const double least = *std::min_element(cells.begin(), cells.end());
	for (const double size : m_points->points.size)
		require(size <= least * (1 + 1e-12), self, "cellSize", cellSize,
			"GIMP needs cells at least as large as the points' spacing; between these walls they are " + mpm::number(least) + " m");
}

/* Whether what the stable step depends on, but for the points' motion, is other than when it was last found. */
bool MpmEngine::stiffnessChanged(const mpm::StepControl& control)
{
	std::vector<Real> now { Real(control.scheme), Real(control.fullMass), Real(m_points->count()) };
	for (const mpm::Law& law : m_points->runtime.laws)
		now.insert(now.end(), { law.elastic.young, law.elastic.poisson, law.density, law.stiffnessBound() });
	if (now == acousticFor) return false;
	acousticFor = std::move(now);
	return true;
}

void MpmEngine::checkStep(const mpm::StepControl& control, bool stepper)
{
	require(control.dt > 0 && std::isfinite(control.dt), "O", "dt", control.dt, "give a step > 0 [s], e.g. O.dt = .4*mpm.criticalTimeStep()");
	if (!stiffnessChanged(control) && control.dt <= m_checkedStep) return;
	m_checkedStep    = 0;
	const Real limit = m_solver->criticalTimeStep(control.scheme, control.fullMass);
	if (control.dt > limit)
		refuse("O", "dt", control.dt,
			"the largest stable step of this scene is " + mpm::number(limit) + " s; "
				+ (stepper ? "O.engines has a TimeStepper, which knows of contacts only; set MpmEngine.timeStepSafety = .4 to have the lesser "
					     "of both"
					   : "set O.dt = .4*mpm.criticalTimeStep()"));
	m_checkedStep = control.dt;
}

/* O.dt for this step. The eigenvalue is worth many steps and changes slowly; velocities are followed at every step. */
void MpmEngine::adaptStep(mpm::StepControl& control, bool stepper)
{
	constexpr long interval = 500;
	if (stiffnessChanged(control) || scene->iter % interval == 0) acousticLimit = m_solver->acousticTimeStep(control.scheme, control.fullMass);
	const Real step = timeStepSafety / (1 / acousticLimit + m_solver->crossingRate());
	scene->dt = control.dt = stepper ? std::min(scene->dt, step) : step;
}

/* What the step filters: all that would have faded since the last time. */
void MpmEngine::planFilter(mpm::StepControl& control)
{
	constexpr Real part = .02; // of filterTime, at least, between two times
	unfiltered          = filterTime > 0 ? unfiltered + control.dt : 0;
	if (filterTime == 0 || unfiltered < part * filterTime) return;
	control.filter = -std::expm1(-unfiltered / filterTime);
	unfiltered     = 0;
}

/* Looks for gaps when two points can have gone half a cell apart since the last look, at the velocities that they had then, and at the
latest after twice as many steps as before it: they may speed up. */
void MpmEngine::checkContinuity(const mpm::StepControl& control)
{
	if (largestGap == std::numeric_limits<Real>::infinity()) return;
	const auto stands = [](const shared_ptr<MpmWall>& wall, const Vector3r& origin) { return wall->origin == origin; };
	if (!std::equal(walls.begin(), walls.end(), wallsLeft.begin(), wallsLeft.end(), stands)) continuity.forget(); // put elsewhere by a script
	if (untilLook > 0) {
		--untilLook;
		return;
	}
	continuity.check(m_points->points, m_points->runtime.laws, m_points->runtime.walls, cellSize, largestGap * cellSize, control.time);
	untilLook = lookInterval = std::min(2 * lookInterval, long(std::clamp(.25 / (m_solver->crossingRate() * control.dt), 10., 1000.)));
}

/* Takes from the points' bodies what scripts and other engines have done since the last step. */
void MpmEngine::readBodies()
{
	if (m_bodies == 0) return;
	const BodyLinks::Changes changes = m_links.read(*scene, *m_points);
	for (const std::size_t p : changes.otherMaterial) {
		m_points->finish();
		m_points->changeMaterial(p, m_links.body(m_points->points.id[p]).material);
		continuity.forget(); // points of some laws are left out of its check
		prepareSolver();
	}
	if (changes.moved.empty() && !changes.erased) return;

	mpm::Points& points = m_points->points;
	m_points->finish();
	for (const std::size_t p : changes.moved)
		for (int d = 0; d < 3; ++d)
			points.position[std::size_t(d)][p] = m_links.body(points.id[p]).state->pos[d];
	if (changes.erased) m_points->dropErased(*scene->bodies);
	if (!changes.moved.empty()) continuity.forget();
	m_solver->pointsChanged();
	checkPoints(m_solver->analysis());
}

} // namespace yade
