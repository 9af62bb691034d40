// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmEngine.hpp"
#include "Action.hpp"
#include "BadInput.hpp"
#include "Materials.hpp"
#include "MpmState.hpp"
#include <algorithm>
#include <core/BodyContainer.hpp>
#include <core/Bound.hpp>
#include <core/EnergyTracker.hpp>
#include <core/ForceContainer.hpp>
#include <core/Interaction.hpp>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/TimeStepper.hpp>
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
	bool isAffine(const std::string& name) { return choose<bool>("transfer", name, { { "flip", false }, { "affine", true } }); }
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
	const bool stepper = checkClocks();
	timeStepSafety > 0 ? adaptStep(control, stepper) : checkStep(control, stepper);
	checkContinuity(control);
	planFilter(control);
	if (TimingInfo::enabled) control.clock = &clock, clock.lap("bodies to points");
	m_solver->step(control);
	writeBodies();
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
	return m_solver->criticalTimeStep(control.scheme, control.fullMass, control.affine);
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

	if (m_checkedEngines.size() != scene->engines.size()
		|| !std::equal(m_checkedEngines.begin(), m_checkedEngines.end(), scene->engines.begin(),
			[](const Checked& a, const shared_ptr<Engine>& b) { return a.engine == b.get() && a.dead == b->dead; }))
		checkEngineOrder();
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
	control.affine      = isAffine(transfer);
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
			"a wall normal to x at x = " + std::to_string(wall.position),
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
				std::to_string(points.position[2][p]) + ", " + std::to_string(points.velocity[2][p]),
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
			"GIMP needs cells at least as large as the points' spacing; between these walls they are " + std::to_string(least) + " m");
}

/* Forces that are applied after this engine and cleared before it runs again would be lost without a word. */
void MpmEngine::checkEngineOrder()
{
	const auto&          engines = scene->engines;
	std::vector<Checked> order;
	const std::size_t    n    = engines.size();
	std::size_t          here = n;
	for (std::size_t k = 0; k < n; ++k) {
		const std::string name = engines[k]->getClassName();
		const Role        role = engines[k].get() == this                             ? Role::self
					 : dynamic_cast<const TimeStepper*>(engines[k].get()) ? Role::stepper
					 : name == "NewtonIntegrator"                         ? Role::newton
					 : name == "InteractionLoop"                          ? Role::loop
											      : Role::other;
		if (role == Role::self) here = k;
		order.push_back({ engines[k].get(), engines[k]->dead, role });
	}
	if (here == n) return;    // asked for its time step outside O.engines
	m_checkedEngines.clear(); // a bad order is complained of each time
	for (const auto& engine : engines)
		if (engine.get() != this && !engine->dead && engine->getClassName() == self)
			throw std::runtime_error(
				"O.engines has two MpmEngines, which would both move the same points; keep one, or set dead = True on the other");
	for (std::size_t k = 0; k < n; ++k) {
		const std::string name = engines[k]->getClassName();
		const bool        partial =
			dynamic_cast<PartialEngine*>(engines[k].get()) && (name.find("Force") != std::string::npos || name.find("Drag") != std::string::npos);
		if (engines[k]->dead || (!partial && name != "InteractionLoop" && !Omega::instance().isInheritingFrom(name, "FieldApplier"))) continue;
		for (std::size_t step = 1; step < n && (k + step) % n != here; ++step)
			if (engines[(k + step) % n]->getClassName() == "ForceResetter" && !engines[(k + step) % n]->dead)
				throw std::runtime_error("O.engines: the forces of " + name + " (place " + std::to_string(k)
							 + ") are cleared by ForceResetter (place " + std::to_string((k + step) % n)
							 + ") before MpmEngine (place " + std::to_string(here)
							 + ") sees them; put ForceResetter first, then the engines that apply forces, then MpmEngine");
	}
	m_checkedEngines = std::move(order);
}

/* Whether a TimeStepper sets O.dt as well. MpmEngine and NewtonIntegrator must move grains and points by the same step: else
what a contact gives the one is not what it takes from the other. */
bool MpmEngine::checkClocks() const
{
	const auto& engines = scene->engines;
	long        here = -1, stepper = -1, newton = -1, loop = -1;
	for (long k = 0; k < long(m_checkedEngines.size()); ++k) {
		const Checked& checked = m_checkedEngines[std::size_t(k)];
		if (checked.dead) continue;
		switch (checked.role) {
			case Role::self: here = k; break;
			case Role::stepper: stepper = static_cast<const TimeStepper*>(checked.engine)->active ? k : stepper; break;
			case Role::newton: newton = k; break;
			case Role::loop: loop = k; break;
			case Role::other: break;
		}
	}
	if (here < 0) return false;
	const auto between = [](long a, long b, long c) { return a >= 0 && c >= 0 && (b - a) * (b - c) < 0; };
	if (timeStepSafety > 0 && newton >= 0 && newton < here)
		throw std::runtime_error("O.engines: MpmEngine (place " + std::to_string(here) + ") sets O.dt (timeStepSafety), which NewtonIntegrator (place "
					 + std::to_string(newton) + ") has used before; put MpmEngine before NewtonIntegrator");
	if (stepper < 0) return false;
	const std::string name = engines[std::size_t(stepper)]->getClassName() + " (place " + std::to_string(stepper) + ")";
	if (between(here, stepper, newton))
		throw std::runtime_error("O.engines: " + name + " changes O.dt between MpmEngine (place " + std::to_string(here)
					 + ") and NewtonIntegrator (place " + std::to_string(newton) + "), which must take the same step; put it before both");
	if (timeStepSafety > 0 && (stepper > here || between(stepper, loop, here)))
		throw std::runtime_error("O.engines: contacts (InteractionLoop) would see the O.dt of " + name + ", which MpmEngine (place "
					 + std::to_string(here) + ", timeStepSafety) shortens only later; put them in the order InteractionLoop, "
					 + engines[std::size_t(stepper)]->getClassName() + ", MpmEngine, NewtonIntegrator");
	return true;
}

/* Whether what the stable step depends on, but for the points' motion, is other than when it was last found. */
bool MpmEngine::stiffnessChanged(const mpm::StepControl& control)
{
	std::vector<Real> now { Real(control.scheme), Real(control.fullMass), Real(control.affine), Real(m_points->count()) };
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
	const Real limit = m_solver->criticalTimeStep(control.scheme, control.fullMass, control.affine);
	if (control.dt > limit)
		refuse("O", "dt", control.dt,
			"the largest stable step of this scene is " + std::to_string(limit * 1e6) + "e-6 s; "
				+ (stepper ? "O.engines has a TimeStepper, which knows of contacts only; set MpmEngine.timeStepSafety = .4 to have the lesser "
					     "of both"
					   : "set O.dt = .4*mpm.criticalTimeStep()"));
	m_checkedStep = control.dt;
}

/* O.dt for this step. The eigenvalue is worth many steps and changes slowly; velocities are followed at every step. */
void MpmEngine::adaptStep(mpm::StepControl& control, bool stepper)
{
	constexpr long interval = 500;
	if (stiffnessChanged(control) || scene->iter % interval == 0) 
		acousticLimit = m_solver->acousticTimeStep(control.scheme, control.fullMass, control.affine);
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

// ---- bodies -------------------------------------------------------------------------------------------------------------

/* Whether the point's body still is in O.bodies, looked up anew. */
bool MpmEngine::link(std::size_t p)
{
	const auto  id     = std::size_t(m_points->points.id[p]);
	const auto& bodies = scene->bodies->body;
	m_links.resize(std::max(bodies.size(), id + 1));
	m_links[id] = {};
	if (!m_points->bodyOf(p, *scene->bodies)) return false;
	m_links[id] = { bodies[id], bodies[id]->state };
	return true;
}

/* What scripts and other engines have done to the points' bodies since the last step: forces, and state that differs from
what this engine wrote. */
void MpmEngine::readBodies()
{
	if (m_bodies == 0) return;
	scene->forces.sync();
	std::vector<std::size_t> moved;
	const bool               erased = m_points->points.force.size() == 2 ? readStates<2>(moved) : readStates<3>(moved);
	if (moved.empty() && !erased) return;

	mpm::Points& points = m_points->points;
	m_points->finish();
	for (const std::size_t p : moved)
		for (int d = 0; d < 3; ++d)
			points.position[std::size_t(d)][p] = m_links[std::size_t(points.id[p])].state->pos[d];
	if (erased) m_points->dropErased(*scene->bodies);
	if (!moved.empty()) continuity.forget();
	m_solver->pointsChanged();
	checkPoints(analysisOf(analysis));
}

/* Fetches force, velocity, blockedDOFs, material and contact of every body. Notes the points whose positions are no longer
theirs, and returns whether bodies have been erased. In a small scene this loop is what YADE costs: it complains of bad input
after it has passed. */
template <int dim> bool MpmEngine::readStates(std::vector<std::size_t>& moved)
{
	mpm::Points&      points = m_points->points;
	const auto&       bodies = scene->bodies->body;
	auto&             forces = scene->forces;
	const std::size_t n      = points.count();
	double *          f[dim], *v[dim];
	const double *    x[dim], *u[dim];
	for (std::size_t d = 0; d < dim; ++d)
		f[d] = points.force[d].data(), v[d] = points.velocity[d].data(), x[d] = points.position[d].data(), u[d] = points.advance[d].data();
	const int* const ids       = points.id.data();
	const auto*      materials = m_points->materials.data();

	const bool rotates = !points.angularVelocity.empty();

	bool erased   = false;
	bool refused  = false;
	Real offPlane = 0;
	for (std::size_t p = 0; p < n; ++p) {
		if (ids[p] < 0) continue;
		const auto id = std::size_t(ids[p]);
		// what MpmPoints::bodyOf has once said holds as long as body and state stay
		const Body* body   = id < m_links.size() && id < bodies.size() ? m_links[id].body.get() : nullptr;
		const bool  linked = body && body == bodies[id].get() && body->state.get() == m_links[id].state.get();
		if (!linked && !link(p)) {
			erased = true;
			continue;
		}
		body                  = m_links[id].body.get();
		State&          state = *m_links[id].state.get();
		const Vector3r &force = forces.getForce(ids[p]), &position = state.se3.position, &velocity = state.vel;
		const Real      sum = force[0] + force[1] + force[2] + position[0] + position[1] + position[2] + velocity[0] + velocity[1] + velocity[2];
		if (!(sum - sum == 0)) {
			refused = true;
			continue;
		}
		const bool before = !points.touched.empty() && points.touched[p]; // then it shows another velocity than its own
		Real       gone   = 0;
		if (before || rotates || points.energies.started) takeVelocity(p, before, state);
		for (int d = 0; d < dim; ++d) {
			f[d][p] = force[d];
			if (!before) v[d][p] = velocity[d];
			gone += std::abs(position[d] - (x[d][p] + u[d][p]));
		}
		if (dim == 2) offPlane += std::abs(position[2]) + std::abs(velocity[2]);
		if (gone != 0) moved.push_back(p);
		if (const auto fixed = std::uint8_t(state.blockedDOFs & 7); fixed || !points.fixed.empty()) {
			points.fixed.resize(n, 0);
			points.fixed[p] = fixed;
		}
		// interactions without geometry and physics are the collider's guesses, which a saved scene lacks
		const auto real    = [](const auto& i) { return i.second->geom && i.second->phys; };
		const bool touched = !body->intrs.empty() && std::any_of(body->intrs.begin(), body->intrs.end(), real);
		if (touched || before) readContact(p, touched, state);
		if (body->material.get() != materials[points.material[p]].get()) {
			m_points->finish();
			m_points->changeMaterial(p, body->material);
			continuity.forget(); // of some laws points are left out
			prepareSolver();
			materials = m_points->materials.data();
		}
	}
	if (offPlane != 0 || refused) refuseStates(dim);
	return erased;
}

/* What a script has changed of the velocity that a body shows is changed of its own, and what it gives in kinetic energy is external work. The
solver finds the rotation of a free point that has been given another velocity. */
void MpmEngine::takeVelocity(std::size_t p, bool touched, const State& state)
{
	mpm::Points&    points  = m_points->points;
	const Vector3r& shown   = state.vel;
	bool            changed = false;
	for (std::size_t d = 0; d < points.force.size(); ++d) {
		Real&      v   = points.velocity[d][p];
		const Real old = v;
		v              = touched ? old + (shown[int(d)] - points.moving[d][p]) : shown[int(d)];
		points.energies.external += .5 * points.mass[p] * (old * old - v * v);
		changed |= v != old;
	}
	if (!changed || points.angularVelocity.empty() || (state.blockedDOFs & 7)) return;
	points.spinUnknown.resize(points.count(), 0);
	points.spinUnknown[p] = 1;
}

/* Complains of the first body whose force, position or velocity cannot be. */
void MpmEngine::refuseStates(int dim) const
{
	for (const int id : m_points->points.id) {
		if (id < 0) continue;
		const State* state = m_links[std::size_t(id)].state.get();
		if (!state) continue;
		const std::string body  = "O.bodies[" + std::to_string(id) + "].state";
		const Vector3r&   force = scene->forces.getForce(id);
		require(force.allFinite(), "O.forces", "f(" + std::to_string(id) + ")", force.transpose(),
			"look at the engine, contact or script that applies it");
		require(state->vel.allFinite(), body, "vel", state->vel.transpose(), "give a finite velocity [m/s]");
		require(state->pos.allFinite(), body, "pos", state->pos.transpose(), "give a finite position [m]");
		require(dim == 3 || (state->pos[2] == 0 && state->vel[2] == 0), body, "pos, vel", state->pos[2],
			"in a plane analysis points lie at z = 0 and stay there");
	}
}

/* Torque on a point that touches another body; one that does so no more shows its own velocity again. */
void MpmEngine::readContact(std::size_t p, bool touched, State& state)
{
	mpm::Points& points = m_points->points;
	if (points.touched.empty()) points.prepareContacts();
	points.touched[p] = touched;
	if (touched) {
		const Vector3r& torque = scene->forces.getTorque(points.id[p]);
		if (!torque.allFinite())
			refuse("O.forces", "t(" + std::to_string(points.id[p]) + ")", torque.transpose(),
				"look at the engine, contact or script that applies it");
		for (std::size_t k = 0, turns = points.torque.size(); k < turns; ++k)
			points.torque[k][p] = torque[turns == 3 ? int(k) : 2];
	} else {
		for (std::size_t d = 0; d < points.moving.size(); ++d)
			state.vel[int(d)] = points.velocity[d][p];
		state.angVel = Vector3r::Zero();
	}
}

void MpmEngine::writeBodies()
{
	if (m_bodies == 0) return;
	const mpm::Points& points = m_points->points;
	const std::size_t  dim    = points.advance.size();
	bool               outrun = false;
	for (std::size_t p = 0; p < points.count(); ++p) {
		if (points.id[p] < 0) continue;
		const Link& link    = m_links[std::size_t(points.id[p])];
		State&      state   = *link.state;
		const bool  touched = !points.touched.empty() && points.touched[p];
		for (std::size_t d = 0; d < dim; ++d) {
			state.se3.position[int(d)] = points.position[d][p] + points.advance[d][p];
			state.vel[int(d)]          = (touched ? points.moving : points.velocity)[d][p];
		}
		for (std::size_t k = 0, turns = points.spin.size(); k < turns && touched; ++k)
			state.angVel[turns == 3 ? int(k) : 2] = points.spin[k][p];
		// only NewtonIntegrator tells the collider of bodies that outrun their bounds, and it does not see these
		if (const Bound* bound = link.body->bound.get()) outrun |= (state.pos - bound->refPos).squaredNorm() > bound->sweepLength * bound->sweepLength;
	}
	if (outrun) scene->doSort = true;
}

} // namespace yade
