// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmEngine.hpp"
#include "Action.hpp"
#include "BadInput.hpp"
#include "Materials.hpp"
#include "kernel/LoadedColumns.hpp"
#include "kernel/Text.hpp"
#include <algorithm>
#include <atomic>
#include <core/EnergyTracker.hpp>
#include <core/Omega.hpp>
#include <omp.h>

namespace yade {

namespace {
	const char* const self                = "MpmEngine";
	constexpr long    longestLookInterval = 1000; // steps between two looks at the gaps

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
	const Attached   attached = attach();
	mpm::StepControl control  = prepare();
	if (m_points->count() == 0) return;
	readBodies();
	if (m_points->count() == 0) return; // the last ones have been erased
	checkValues();
	m_order.checkMotions(*scene->bodies, mpm::dimension(m_points->runtime.solver->analysis()));
	checkPrescribed();
	const bool stepper = m_order.checkClocks(timeStepSafety > 0);
	timeStepSafety > 0 ? adaptStep(control, stepper) : checkStep(control, stepper);
	checkContinuity(control);
	planFilter(control);
	if (TimingInfo::enabled) control.clock = &clock, clock.lap("bodies to points");
	m_points->runtime.failed = true; // unless it comes to its end
	m_points->runtime.solver->step(control);
	m_points->runtime.failed = false;
	if (m_bodies > 0) links().write(*scene, m_points->points);
	if (control.trackEnergy) reportEnergies();
	if (TimingInfo::enabled) clock.lap("points to bodies");
	wallsLeft.resize(walls.size());
	for (std::size_t w = 0; w < walls.size(); ++w) {
		const mpm::Wall& wall = m_points->runtime.walls[w];
		for (int d = 0; d < 3; ++d)
			walls[w]->force[d] = wall.force[std::size_t(d)], walls[w]->torque[d] = wall.torque[std::size_t(d)];
		walls[w]->move(scene->dt);
		wallsLeft[w] = walls[w]->origin;
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
	scene                           = Omega::instance().getScene().get(); // the loop sets it before a step, and there may have been none
	const Attached         attached = attach();
	const mpm::StepControl control  = prepare();
	readBodies();
	checkValues();
	return m_points->runtime.solver->criticalTimeStep(control);
}

std::size_t MpmEngine::gridBytes() const
{
	const shared_ptr<MpmPoints> points = MpmPoints::of(*Omega::instance().getScene());
	return points && points->runtime.solver ? points->runtime.solver->gridBytes() : 0;
}

/* Finds the scene's points and keeps Python's thread off them. They are the scene's: the engine keeps them for no longer than a step. */
MpmEngine::Attached MpmEngine::attach()
{
	shared_ptr<MpmPoints> points = MpmPoints::of(*scene);
	if (!points) throw std::runtime_error("MpmEngine: the scene has no material points; make them with mpm.fill() before the first step");
	m_points = points.get();
	return { points, std::unique_lock<std::mutex>(points->mutex) };
}

void MpmEngine::postLoad(MpmEngine&)
{
	if (!(untilLook >= 0 && untilLook <= lookInterval && lookInterval <= longestLookInterval))
		refuseDamaged("MpmEngine.untilLook = " + std::to_string(untilLook) + " with lookInterval = " + std::to_string(lookInterval) + " cannot be");
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

	constexpr int fewest = 64;
	const int     most   = std::max(fewest, 4 * omp_get_num_procs());
	require(ompThreads <= most, self, "ompThreads", ompThreads,
		"give at most " + std::to_string(most) + " threads, one a core of the processor is best; -1 takes the number of -j");
	require(scene->subdomain == 0, "O", "subdomain", scene->subdomain, EngineOrder::oneProcess);

	m_order.check(scene->engines, *this);
	checkKinematics(analysisKind);
	if (!scene->trackEnergy) m_points->points.energies.started = false;
	m_points->updateLaws();
	if (m_order.hasContacts()) m_points->requireContactLaw();
	if (m_points->updateMasses()) forgetStep();
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

/* Strain of points that have been deformed means something else after these switches: volumes would jump. */
void MpmEngine::checkKinematics(mpm::Analysis kind)
{
	mpm::Points& points = m_points->points;
	const bool   other = m_points->large != largeStrain, ends = !points.thicknessStretch.empty() && !stretches(kind);
	if (!other && points.thicknessStretch.empty() != stretches(kind)) return;
	m_points->finish();
	const auto differs = [](const mpm::Column& column, double from) {
		return std::any_of(column.begin(), column.end(), [=](double x) { return x != from; });
	};
	bool deformed = false;
	for (std::size_t k = 0, n = points.deformation.size(), row = n == 9 ? 4 : 3; other && k < n; ++k)
		deformed = deformed || differs(points.deformation[k], k % row == 0 ? 1 : 0);
	require(!deformed, self, "largeStrain", largeStrain, "the points have been deformed with the other setting; choose it before the first step");
	require(!ends || !differs(points.thicknessStretch, 1), self, "thinning", thinning,
		"the thickness of the points has changed already, and would jump back; choose it before the first step");
	m_points->large = largeStrain;
}

void MpmEngine::prepareWalls(int dim, bool axisymmetric)
{
	std::vector<mpm::Wall> kernelWalls = m_points->runtime.walls; // replaced only when all walls have been accepted
	kernelWalls.resize(walls.size());
	for (std::size_t w = 0; w < walls.size(); ++w) {
		if (!walls[w]) refuse(self, "walls[" + std::to_string(w) + "]", "None", "give an MpmWall");
		kernelWalls[w] = walls[w]->toKernel(w, dim);
		for (std::size_t v = 0; v < w; ++v) {
			if (!walls[v]->extent.empty() || !walls[w]->extent.empty()) continue;
			const Real cosine = walls[v]->normal.normalized().dot(walls[w]->normal.normalized());
			require(cosine < 1 - 1e-12, self, "walls", "walls " + std::to_string(v) + " and " + std::to_string(w),
				"two walls face the same way; give one wall a side");
			require(cosine > -1 + 1e-12 || (walls[w]->origin - walls[v]->origin).dot(walls[v]->normal) > 0, self, "walls",
				"walls " + std::to_string(v) + " and " + std::to_string(w),
				"two walls face each other with no room between them; normals point into the material");
		}
	}
	bool inner = !axisymmetric;
	for (const mpm::Wall& wall : kernelWalls) {
		if (!axisymmetric || !wall.mirrors() || wall.axis != 0) continue;
		inner = inner || wall.side > 0;
		require(wall.position > 0 || (wall.position == 0 && wall.side > 0 && wall.kind == mpm::Wall::Kind::slip), self, "walls",
			"a wall normal to x at x = " + mpm::number(wall.position),
			"in axisymmetry x is the radius and the axis is a plane of symmetry without a wall; place radial walls at x > 0");
	}
	if (!inner) {
		mpm::Wall axis;
		axis.kind = mpm::Wall::Kind::slip;
		kernelWalls.push_back(axis);
	}
	m_points->runtime.walls = std::move(kernelWalls);
}

void MpmEngine::prepareSolver()
{
	mpm::Points&        points       = m_points->points;
	const mpm::Analysis analysisKind = analysisOf(analysis);
	const auto          key          = std::make_tuple(analysis, shape, cellSize);
	const std::size_t   columns      = std::size_t(mpm::stressComponents(analysisKind));
	auto&               runtime      = m_points->runtime;
	if (!runtime.solver || m_solver != runtime.solverNumber || key != m_solverFor) {
		static std::atomic<long> solvers { 0 };
		m_points->finish();
		require(points.stress.empty() || points.stress.size() == columns, self, "analysis", "'" + analysis + "'",
			"the points already carry the stress of another analysis; make new points");
		runtime.solver       = mpm::makeSolver(analysisKind, shapeOf(shape), cellSize, points, runtime.laws, runtime.walls);
		runtime.solverNumber = m_solver = ++solvers;
		m_solverFor                     = key;
		m_checkedCount                  = 0;
	}
	if (points.count() != m_checkedCount || m_points->filled) {
		checkPoints(analysisKind);
		if (m_points->filled) m_points->continuity.forget(), forgetStep(); // ids of erased bodies are given again
		m_checkedCount   = points.count();
		m_valuesDue      = true;
		m_points->filled = false;
	}
	if (shape == "gimp") checkGimp();

	int  internals  = 0;
	bool freeNormal = false;
	for (const mpm::Law& law : runtime.laws) {
		freeNormal = freeNormal || (analysisKind == mpm::Analysis::planeStress && !law.keepsVolume());
		internals  = std::max(internals, mpm::Internals::of(law).columns(int(columns)));
	}
	m_bodies = std::size_t(std::count_if(points.id.begin(), points.id.end(), [](int id) { return id >= 0; }));
	points.prepare(mpm::dimension(analysisKind), int(columns), internals, stretches(analysisKind), m_bodies > 0, scene->trackEnergy, freeNormal);
	m_points->takeInitialStress(analysisKind);
	m_points->loadFaces(analysisKind, scene->time);
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
		require(points.size[p] > 0 && std::isfinite(points.size[p]), name, "size", points.size[p], "give mpm.fill() a spacing > 0");
		require(points.volume0[p] > 0 && std::isfinite(points.volume0[p]), name, "volume", points.volume0[p],
			"give mpm.fill() a spacing > 0 and a thickness > 0");
		if (kind == mpm::Analysis::axisymmetric) {
			require(points.thickness[p] < 0, name, "thickness", points.thickness[p],
				"an axisymmetric analysis needs rings: mpm.fill(..., axisymmetric=True)");
			require(points.position[0][p] > 0, name, "position[0]", points.position[0][p], "x is the radius; place points at x > 0 [m]");
		} else if (dim == 2)
			require(points.thickness[p] > 0, name, "thickness", points.thickness[p],
				"a plane analysis needs points with a thickness: mpm.fill(..., thickness=...) [m]; points without one (0) are of a solid: set "
				"MpmEngine.analysis = '3d'; < 0 are rings: 'axisymmetric'");
		else
			require(points.thickness[p] == 0, name, "thickness", points.thickness[p],
				"points of a 3d analysis have no thickness; fill them with thickness=None, or choose a plane analysis");
		if (dim == 2)
			require(points.position[2][p] == 0 && points.velocity[2][p] == 0, name, "position[2], velocity[2]",
				mpm::number(points.position[2][p]) + ", " + mpm::number(points.velocity[2][p]),
				"in a plane analysis points lie at z = 0 and stay there; set z and the velocity along it to 0, or choose analysis = '3d'");
	}
	for (std::size_t f = 0; f < walls.size(); ++f)
		for (std::size_t c = 0; c < walls.size(); ++c)
			if (walls[f]->kind == "fixed" && walls[c]->kind == "friction") checkCorner(f, c);
}

/* A bond holds what it touches: where it meets a contact, no law of friction can act. */
void MpmEngine::checkCorner(std::size_t fixed, std::size_t contact) const
{
	const mpm::Points& points = m_points->points;
	const auto         near   = [&](const MpmWall& wall, std::size_t p) {
                const Vector3r r(Vector3r(points.position[0][p], points.position[1][p], points.position[2][p]) - wall.origin), n(wall.normal.normalized());
                const Real     height = r.dot(n), reach = wall.extent.empty() ? std::numeric_limits<Real>::infinity() : wall.extent[0];
                return std::abs(height) < .6 * points.size[p] && (r - height * n).norm() < reach;
	};
	for (std::size_t p = 0; p < points.count(); ++p)
		if (near(*walls[fixed], p) && near(*walls[contact], p))
			refuse(self, "walls", "walls " + std::to_string(fixed) + " and " + std::to_string(contact),
				"a body touches the fixed wall and the friction wall in their corner: the one holds what would slide along the other; make "
				"both of "
				"one kind, or end the friction wall before the corner by its extent");
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

/* Numbers that come from a file and are not finite; bodies have been read already, so that a script may have put them right. */
void MpmEngine::checkValues()
{
	if (!m_valuesDue) return;
	const std::string fault = mpm::nonFiniteValue(m_points->points);
	if (!fault.empty()) throw std::runtime_error("MpmEngine: " + fault + ": the saved scene is damaged, or its last step has failed; load an earlier one");
	m_valuesDue = false;
}

/* A motion that is prescribed for every point leaves nothing to solve. */
void MpmEngine::checkPrescribed() const
{
	const auto& fixed = m_points->points.prescribedDofs;
	const auto  all   = std::uint8_t((1 << m_points->points.displacementIncrement.size()) - 1);
	if (fixed.empty() || !std::all_of(fixed.begin(), fixed.end(), [all](std::uint8_t bits) { return (bits & all) == all; })) return;
	refuse("O.bodies", "blockedDOFs", "all translations of all material points", "the motion of every point is prescribed; leave some of them free");
}

/* The stable step is another one than that which has been found. */
void MpmEngine::forgetStep()
{
	acousticFor.clear();
	checkedStep = 0;
}

/* Whether the scene has changed in something that the stable step depends on, other than the motion of the points. */
bool MpmEngine::stiffnessChanged(const mpm::StepControl& control)
{
	std::vector<Real> now { Real(control.scheme), Real(control.fullMass), Real(m_points->count()), Real(analysisOf(analysis)), Real(shapeOf(shape)),
		cellSize };
	const auto&       kernelWalls = m_points->runtime.walls;
	for (const double cell : mpm::makeGeometry<3>(cellSize, kernelWalls).cell)
		now.push_back(std::round(20 * std::log(cell / cellSize))); // walls stretch cells; in steps of 5 %
	for (const mpm::Wall& wall : kernelWalls)
		now.insert(now.end(), { Real(wall.kind), Real(wall.axis), Real(wall.side) });
	for (const mpm::Law& law : m_points->runtime.laws)
		now.insert(now.end(), { law.elastic.young, law.elastic.poisson, law.density, law.stiffnessBound() });
	if (now == acousticFor) return false;
	acousticFor = std::move(now);
	return true;
}

void MpmEngine::checkStep(const mpm::StepControl& control, bool stepper)
{
	require(control.dt > 0 && std::isfinite(control.dt), "O", "dt", control.dt, "give a step > 0 [s], e.g. O.dt = .4*mpm.criticalTimeStep()");
	const bool changed = stiffnessChanged(control);
	if (changed) acousticLimit = NaN; // for adaptStep(), which may be switched on later
	if (!changed && control.dt <= checkedStep) return;
	checkedStep      = 0;
	const Real limit = m_points->runtime.solver->criticalTimeStep(control);
	if (control.dt > limit)
		refuse("O", "dt", control.dt,
			"the largest stable step of this scene is " + mpm::number(limit) + " s; "
				+ (stepper ? "O.engines has a TimeStepper, which knows of contacts only; set MpmEngine.timeStepSafety = .4 to have the lesser "
					     "of both"
					   : "set O.dt = .4*mpm.criticalTimeStep()"));
	checkedStep = control.dt;
}

/* O.dt for this step. The eigenvalue is worth many steps and changes slowly; velocities are followed at every step. */
void MpmEngine::adaptStep(mpm::StepControl& control, bool stepper)
{
	constexpr long interval = 500;
	if (stiffnessChanged(control) || scene->iter % interval == 0 || !(acousticLimit > 0))
		acousticLimit = m_points->runtime.solver->acousticTimeStep(control);
	const Real step = timeStepSafety / (1 / acousticLimit + m_points->runtime.solver->crossingRate());
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
	if (!std::equal(walls.begin(), walls.end(), wallsLeft.begin(), wallsLeft.end(), stands)) m_points->continuity.forget(); // put elsewhere by a script
	if (untilLook > 0) {
		--untilLook;
		return;
	}
	m_points->finish(); // a scene that is loaded here has no stress update pending, and must see the same gaps
	m_points->continuity.check(m_points->points, m_points->runtime.laws, m_points->runtime.walls, cellSize, largestGap * cellSize, control.time);
	const Real crossing = m_points->runtime.solver->crossingRate() * control.dt;
	untilLook = lookInterval = std::min(2 * lookInterval, long(std::clamp(.25 / crossing, 10., Real(longestLookInterval))));
}

BodyLinks& MpmEngine::links()
{
	auto& links = m_points->runtime.links;
	if (!links) links = std::make_shared<BodyLinks>();
	return *links;
}

/* Takes from the points' bodies what scripts and other engines have done since the last step. */
void MpmEngine::readBodies()
{
	m_points->restoreForces();
	if (m_bodies == 0) return;
	const BodyLinks::Changes changes = links().read(*scene, *m_points);
	for (const std::size_t p : changes.otherMaterial) {
		m_points->finish();
		const shared_ptr<Body>& body    = (*scene->bodies)[unsigned(m_points->points.id[p])];
		const bool              bounded = dynamic_cast<const FrictMat*>(m_points->materials[std::size_t(m_points->points.material[p])].get());
		m_points->changeMaterial(p, body->material);
		if (!bounded && dynamic_cast<const FrictMat*>(body->material.get())) body->flags |= Body::FLAG_BOUNDED; // it can have contacts now
		m_points->continuity.forget(); // points of some laws are left out of its check
		forgetStep();
		prepareSolver();
	}
	for (const std::size_t p : changes.otherMass) {
		const int  id   = m_points->points.id[p];
		const Real mass = links().body(id).state->mass;
		require(mass > 0 && std::isfinite(mass), "O.bodies[" + std::to_string(id) + "].state", "mass", mass, "give a material point a mass > 0 [kg]");
		m_points->finish();
		m_points->setMass(p, mass);
		forgetStep();
	}
	if (changes.moved.empty() && !changes.erased) return;

	mpm::Points& points = m_points->points;
	m_points->finish();
	for (const std::size_t p : changes.moved)
		for (int d = 0; d < 3; ++d)
			points.position[std::size_t(d)][p] = links().body(points.id[p]).state->pos[d];
	if (changes.erased) m_points->dropErased(*scene->bodies);
	if (!changes.moved.empty()) m_points->continuity.forget();
	m_points->runtime.solver->pointsChanged();
	checkPoints(m_points->runtime.solver->analysis());
}

} // namespace yade
