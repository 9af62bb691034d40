// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmPoints.hpp"
#include "BadInput.hpp"
#include "Buffers.hpp"
#include "Materials.hpp"
#include "MpmState.hpp"
#include "kernel/LoadedColumns.hpp"
#include "kernel/PointDriver.hpp"
#include <Eigen/Eigenvalues>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Omega.hpp>
#include <numeric>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

namespace py = ::boost::python;

namespace {
	const char* const incompatible = "': its law keeps other internal variables than the points carry (plastic strain, back stress; reloading, "
					 "strengthDegradation, stiffnessDegradation, pinching and loadingRule of a BoucWenMat add to them); give points a "
					 "law of the same kind and options, or make new points";
}

shared_ptr<MpmPoints> MpmPoints::of(const Scene& scene)
{
	for (const auto& item : scene.miscParams)
		if (auto points = boost::dynamic_pointer_cast<MpmPoints>(item)) return points;
	return {};
}

shared_ptr<MpmPoints> MpmPoints::ofScene()
{
	Scene&                scene  = *Omega::instance().getScene();
	shared_ptr<MpmPoints> points = of(scene);
	if (points) return points;
	points.reset(new MpmPoints);
	scene.miscParams.push_back(points);
	return points;
}

void MpmPoints::finish()
{
	try {
		if (runtime.solver) runtime.solver->finish();
	} catch (const mpm::StepFailure&) {
		if (runtime.failed) return;
		runtime.failed = true;
		throw;
	}
}

void MpmPoints::updateLaws()
{
	runtime.laws.resize(materials.size());
	for (std::size_t m = 0; m < materials.size(); ++m) {
		mpm::Law law;
		try {
			law = lawOf(*materials[m]);
			if (!runtime.layoutsDue && law == runtime.laws[m]) continue;
			const bool   saved  = runtime.layoutsDue && 3 * m + 2 < layouts.size();
			const Layout before = saved ? Layout { layouts[3 * m], layouts[3 * m + 1], layouts[3 * m + 2] } : layoutOf(runtime.laws[m]);
			if (!keepsInternals(before, layoutOf(law)) && inUse(m))
				throw std::runtime_error(materials[m]->getClassName() + " '" + materials[m]->label + incompatible);
		} catch (const std::runtime_error&) {
			if (inUse(m)) throw;
			continue;
		}
		finish(); // the step that is past was one of the old law
		runtime.laws[m] = law;
	}
	runtime.layoutsDue = false;
}

void MpmPoints::restoreForces()
{
	if (!runtime.forcesDue) return;
	runtime.forcesDue             = false;
	const shared_ptr<Scene> scene = Omega::instance().getScene();
	if (scene->forces.getPermForceUsed()) return;
	for (std::size_t k = 0; k < forcedBodies.size(); ++k) {
		const int id = forcedBodies[k];
		if (std::size_t(id) >= scene->bodies->size() || !(*scene->bodies)[unsigned(id)]) continue;
		if (!permanentForces[k].isZero()) scene->forces.setPermForce(id, permanentForces[k]);
		if (!permanentTorques[k].isZero()) scene->forces.setPermTorque(id, permanentTorques[k]);
	}
}

void MpmPoints::requireContactLaw() const
{
	for (std::size_t m = 0; m < materials.size(); ++m)
		if (!dynamic_cast<const FrictMat*>(materials[m].get()) && inUse(m))
			throw std::runtime_error(materials[m]->getClassName() + " '" + materials[m]->label
						 + "': O.engines has an InteractionLoop, and YADE aborts at a contact of this material; give the points a "
						   "FrictMat, which is as elastic");
}

bool MpmPoints::updateMasses()
{
	bool changed = false;
	for (std::size_t m = 0; m < materials.size(); ++m) {
		const Real density = materials[m]->density;
		densities.resize(materials.size(), NaN);
		if (densities[m] == density || !(density > 0)) continue;
		densities[m] = density;
		for (std::size_t p = 0; p < points.count(); ++p) {
			const Real mass = density * points.volume0[p];
			if (points.material[p] != int(m) || std::abs(mass - points.mass[p]) <= 1e-12 * mass) continue;
			finish();
			setMass(p, mass);
			changed = true;
		}
	}
	return changed;
}

void MpmPoints::setMass(std::size_t p, Real mass)
{
	const BodyContainer& bodies = *Omega::instance().getScene()->bodies;
	Real&                now    = points.mass[p];
	State* const         state  = bodyOf(p, bodies) ? bodies[unsigned(points.id[p])]->state.get() : nullptr;
	if (state && state->mass == now) state->mass = mass;
	if (points.energies.started)
		for (const mpm::Column& v : points.velocity)
			points.energies.external -= .5 * (mass - now) * v[p] * v[p];
	now = mass;
	if (runtime.solver) runtime.solver->pointsChanged(); // the least mass of a node follows that of the points
}

/* Whether what points have of internal variables means the same to another law; a law without any leaves none behind. */
bool MpmPoints::keepsInternals(const Layout& before, const Layout& after) const
{
	return points.internal.empty() || before[1] + before[2] == 0 || before == after;
}

MpmPoints::Layout MpmPoints::layoutOf(const mpm::Law& law)
{
	const mpm::Internals internals = mpm::Internals::of(law);
	return { int(law.model.index()), internals.tensors, internals.scalars };
}

void MpmPoints::changeMaterial(std::size_t p, const shared_ptr<Material>& material)
{
	auto found = std::find(materials.begin(), materials.end(), material);
	if (found == materials.end()) found = materials.insert(materials.end(), material);
	const std::size_t before = std::size_t(points.material[p]), after = std::size_t(found - materials.begin());
	points.material[p] = int(after);
	updateLaws();
	const Real denser = materials[after]->density / materials[before]->density;
	if (mpm::Internals::of(runtime.laws[after]).columns(1) == 0)
		for (mpm::Column& column : points.internal)
			column[p] = 0; // an elastic point forgets
	else if (!keepsInternals(layoutOf(runtime.laws[before]), layoutOf(runtime.laws[after]))) {
		points.material[p] = int(before);
		throw std::runtime_error(
			"O.bodies[" + std::to_string(points.id[p]) + "].mat = " + material->getClassName() + " '" + material->label + incompatible);
	}
	densities.resize(materials.size(), NaN);
	if (std::isnan(densities[after])) densities[after] = materials[after]->density;
	if (denser > 0 && denser != 1) setMass(p, denser * points.mass[p]);
}

const Body* MpmPoints::bodyOf(std::size_t p, const BodyContainer& bodies) const
{
	const int   id    = points.id[p];
	const Body* body  = id >= 0 && std::size_t(id) < bodies.size() ? bodies[unsigned(id)].get() : nullptr;
	const auto* state = body ? dynamic_cast<const MpmState*>(body->state.get()) : nullptr;
	return state && state->pointId == id ? body : nullptr;
}

/* Which analysis the points' columns are of. */
mpm::Analysis MpmPoints::analysis() const
{
	switch (points.stress.size()) {
		case 3: return mpm::Analysis::planeStress;
		case 6: return mpm::Analysis::solid;
		default: return points.thickness.front() < 0 ? mpm::Analysis::axisymmetric : mpm::Analysis::planeStrain;
	}
}

void MpmPoints::dropErased(const BodyContainer& bodies)
{
	std::vector<std::size_t> kept;
	mpm::Energies&           energies = points.energies;
	for (std::size_t p = 0; p < points.count(); ++p)
		if (points.id[p] < 0 || bodyOf(p, bodies))
			kept.push_back(p);
		else if (energies.started && runtime.laws.size() == materials.size()) {
			// without a solver, which a loaded scene does not have yet
			const mpm::Energies stored = mpm::storedEnergy(analysis(), runtime.laws[std::size_t(points.material[p])], points, p);
			const Real          V = volume(p), elastic = V * stored.elastic, hardening = V * stored.hardening;
			Real                kinetic = 0;
			for (const mpm::Column& v : points.velocity)
				kinetic += .5 * points.mass[p] * v[p] * v[p];
			energies.external += kinetic + elastic + hardening;
			energies.elastic -= elastic, energies.hardening -= hardening;
		}
	if (kept.size() < points.count()) points.select(kept);
}

/* Whether a point still has this material: bodies may have been given another one since the last step. */
bool MpmPoints::inUse(std::size_t m) const
{
	const auto& bodies = *Omega::instance().getScene()->bodies;
	for (std::size_t p = 0; p < points.count(); ++p) {
		if (points.material[p] != int(m)) continue;
		const Body* body = bodyOf(p, bodies);
		if (points.id[p] < 0 || (body && body->material == materials[m])) return true;
	}
	return false;
}

mpm::Internals MpmPoints::internals(std::size_t p) const
{
	if (runtime.laws.size() < materials.size()) return {}; // no step yet
	return mpm::Internals::of(runtime.laws[std::size_t(points.material[p])]);
}

/* The laws are not saved; a loaded scene can be looked at before its first step. */
void MpmPoints::postLoad(MpmPoints&)
{
	std::string fault = mpm::faultOf(points, materials.size());
	for (const auto& material : materials)
		if (!material && fault.empty()) fault = "materials has an empty entry";
	if (const std::string neighbours = mpm::faultOf(continuity.memory); fault.empty() && !neighbours.empty()) fault = "continuity." + neighbours;
	const auto least = std::min_element(points.id.begin(), points.id.end());
	if (fault.empty() && (nextBodyless >= 0 || (least != points.id.end() && nextBodyless >= *least)))
		fault = "nextBodyless = " + std::to_string(nextBodyless) + " is no id for a new point";
	if (fault.empty() && (permanentForces.size() != forcedBodies.size() || permanentTorques.size() != forcedBodies.size()))
		fault = "forcedBodies has " + std::to_string(forcedBodies.size()) + " entries for " + std::to_string(permanentForces.size()) + " forces and "
			+ std::to_string(permanentTorques.size()) + " torques";
	if (fault.empty() && std::any_of(forcedBodies.begin(), forcedBodies.end(), [](int id) { return id < 0; })) fault = "forcedBodies has a negative id";
	if (!fault.empty()) refuseDamaged("MpmPoints." + fault);
	runtime.forcesDue = true;
	try {
		updateLaws();
	} catch (const std::runtime_error&) {
		runtime.laws.clear(); // the engine complains about a bad material before its next step
	}
	runtime.layoutsDue = true; // needs the scene's bodies, which are loaded later
}

/* A scene that a failed step has stopped must still be saveable: what fails here has failed in the run as well. */
void MpmPoints::preSave(MpmPoints&)
{
	const std::lock_guard<std::mutex> lock(mutex);
	try {
		finish();
	} catch (const mpm::StepFailure&) { // of a stress update that nobody has looked at yet
	}
	if (!runtime.layoutsDue) layouts.clear();
	for (std::size_t m = 0; m < runtime.laws.size() && !runtime.layoutsDue; ++m) {
		const Layout layout = layoutOf(runtime.laws[m]);
		layouts.insert(layouts.end(), layout.begin(), layout.end());
	}
	restoreForces();
	forcedBodies.clear(), permanentForces.clear(), permanentTorques.clear();
	Scene& scene = *Omega::instance().getScene();
	if (!scene.forces.getPermForceUsed()) return;
	if (scene.bodies->size() > 0) scene.forces.addMaxId(Body::id_t(scene.bodies->size()) - 1);
	scene.forces.sync(); // before it, YADE reads beyond the forces of the bodies that have none
	for (int id = 0; std::size_t(id) < scene.bodies->size(); ++id) {
		const Vector3r force = scene.forces.getPermForce(id), torque = scene.forces.getPermTorque(id);
		if (force.isZero() && torque.isZero()) continue;
		forcedBodies.push_back(id), permanentForces.push_back(force), permanentTorques.push_back(torque);
	}
}

namespace {
	/* Place of an id in the order in which points were made: bodies, then points without one. */
	std::int64_t rank(int id) { return id >= 0 ? id : (std::int64_t(1) << 31) - 1 - std::int64_t(id); }
} // namespace

const MpmPoints::Directory& MpmPoints::directory()
{
	Directory& d = m_directory;
	if (d.generation == points.generation && d.order.size() == points.count()) return d;
	std::size_t bodies = 0, loose = 0; // greater than every place
	for (const int id : points.id)
		(id >= 0 ? bodies : loose) = std::max(id >= 0 ? bodies : loose, std::size_t(id >= 0 ? id : -1 - id) + 1);
	d.order.resize(points.count());
	std::iota(d.order.begin(), d.order.end(), std::size_t(0));
	if (bodies + loose < 8 * points.count() + 65536) { // a table is faster than sorting, unless ids are few and far between
		std::vector<std::size_t> table(bodies + loose, nowhere);
		for (std::size_t p = 0; p < points.count(); ++p)
			table[points.id[p] >= 0 ? std::size_t(points.id[p]) : bodies + std::size_t(-1 - points.id[p])] = p;
		std::remove_copy(table.begin(), table.end(), d.order.begin(), nowhere);
	} else
		std::sort(d.order.begin(), d.order.end(), [this](std::size_t p, std::size_t q) { return rank(points.id[p]) < rank(points.id[q]); });
	d.generation = points.generation;
	return d;
}

std::size_t MpmPoints::indexOf(int id)
{
	const std::vector<std::size_t>& order = directory().order;
	const auto at = std::lower_bound(order.begin(), order.end(), id, [this](std::size_t p, int wanted) { return rank(points.id[p]) < rank(wanted); });
	if (at == order.end() || points.id[*at] != id) throw std::runtime_error("there is no material point " + std::to_string(id) + " (any more)");
	return *at;
}

const std::vector<std::size_t>& MpmPoints::inOrder() { return directory().order; }

// ---- one point ----------------------------------------------------------------------------------------------------------

Matrix3r MpmPoints::tensor(const mpm::Columns& columns, std::size_t p) const
{
	Matrix3r T = Matrix3r::Zero();
	auto     s = [&](std::size_t k) { return columns[k][p]; };
	switch (points.stress.size()) {
		case 3: T << s(0), s(2), 0, s(2), s(1), 0, 0, 0, 0; break;
		case 4: T << s(0), s(3), 0, s(3), s(1), 0, 0, 0, s(2); break;
		case 6: T << s(0), s(5), s(4), s(5), s(1), s(3), s(4), s(3), s(2); break;
		default: break; // no step yet: no stress
	}
	return T;
}

Matrix3r MpmPoints::stress(std::size_t p) const
{
	const mpm::Columns& given = points.initialStress;
	if (given.empty() || std::isnan(given[0][p])) return tensor(points.stress, p);
	Matrix3r T;
	T << given[0][p], given[5][p], given[4][p], given[5][p], given[1][p], given[3][p], given[4][p], given[3][p], given[2][p];
	return T;
}

Matrix3r MpmPoints::backStress(std::size_t p) const
{
	return internals(p).tensors > 0 && points.internal.size() >= points.stress.size() ? tensor(points.internal, p) : Matrix3r::Zero();
}

Real MpmPoints::plasticStrain(std::size_t p) const
{
	const mpm::Internals layout = internals(p);
	const std::size_t    column = std::size_t(layout.tensors) * points.stress.size();
	return layout.scalars > 0 && column < points.internal.size() ? points.internal[column][p] : 0;
}

Matrix3r MpmPoints::deformation(std::size_t p) const
{
	Matrix3r   F   = Matrix3r::Identity();
	const auto dim = points.deformation.size() == 9 ? 3 : 2;
	for (std::size_t k = 0; k < points.deformation.size(); ++k)
		F(int(k) / dim, int(k) % dim) = points.deformation[k][p];
	if (!points.thicknessStretch.empty()) F(2, 2) = points.thicknessStretch[p];
	return F;
}

Matrix3r MpmPoints::strain(std::size_t p) const
{
	const Matrix3r F = deformation(p);
	Matrix3r       strain;
	if (large) {
		const Eigen::SelfAdjointEigenSolver<Matrix3r> stretch(F * F.transpose());
		const Vector3r                                logarithms = .5 * stretch.eigenvalues().array().log();
		strain = stretch.eigenvectors() * logarithms.asDiagonal() * stretch.eigenvectors().transpose();
	} else
		strain = .5 * (F + F.transpose()) - Matrix3r::Identity();
	if (points.stress.size() == 3) { // plane stress: the thickness is free to follow, whether or not the method follows it
		if (!points.freeStrain.empty() && runtime.laws.size() == materials.size() && !runtime.laws[std::size_t(points.material[p])].keepsVolume())
			strain(2, 2) = points.freeStrain[p];
		else {
			const auto& elastic = dynamic_cast<const ElastMat&>(*materials[std::size_t(points.material[p])]);
			strain(2, 2)        = (1 - 2 * elastic.poisson) / elastic.young * stress(p).trace() - strain(0, 0) - strain(1, 1);
		}
	}
	return strain;
}

Real MpmPoints::volume(std::size_t p) const { return points.volume0[p] * (large ? deformation(p).determinant() : 1); }

Real MpmPoints::vonMises(std::size_t p) const
{
	const Matrix3r s = stress(p), deviator = s - s.trace() / 3 * Matrix3r::Identity();
	return std::sqrt(1.5) * deviator.norm();
}

// ---- py/mpm -------------------------------------------------------------------------------------------------------------

/* Number of a group: the one given, or that of a name; a new name gets the next free number. */
int MpmPoints::groupOf(int number, const std::string& name)
{
	constexpr int greatest = 255;
	if (name.empty()) {
		if (number < 0 || number > greatest)
			throw std::invalid_argument(
				"group = " + std::to_string(number) + ": give a name, or a number from 0 (none) to " + std::to_string(greatest));
		return number;
	}
	const auto known = std::find(groups.begin(), groups.end(), name);
	if (known != groups.end()) return int(known - groups.begin()) + 1;
	const int taken = points.group.empty() ? 0 : *std::max_element(points.group.begin(), points.group.end());
	const int next  = std::max(taken, int(groups.size())) + 1;
	if (next > greatest)
		throw std::invalid_argument("group = '" + name + "': the scene has " + std::to_string(greatest) + " groups already; use one of them");
	groups.resize(std::size_t(next));
	groups.back() = name;
	return next;
}

py::object MpmPoints::append(
	py::dict columns, const shared_ptr<Material>& material, int group, const std::string& groupName, bool bodies, py::object mask, py::object color)
{
	if (!material) throw std::invalid_argument("MpmPoints.append: material = None: give a material of O.materials");
	const DoubleBuffer position(columns["position"]), velocity(columns["velocity"]), volume(columns["volume"]), mass(columns["mass"]),
		size(columns["size"]), depth(columns["depth"]);
	const bool                    stressed = columns.has_key("stress"), curved = columns.has_key("reach");
	std::unique_ptr<DoubleBuffer> stress, reach;
	if (curved) reach = std::make_unique<DoubleBuffer>(columns["reach"]);
	if (stressed) stress = std::make_unique<DoubleBuffer>(columns["stress"]);
	const std::size_t n = volume.size();
	if (position.size() != 3 * n || velocity.size() != 3 * n || mass.size() != n || size.size() != n || depth.size() != n
		|| (stressed && stress->size() != 9 * n) || (curved && reach->size() != n))
		throw std::invalid_argument("MpmPoints.append: the arrays differ in their number of points; call mpm.fill or mpm.points");
	constexpr std::size_t chunk = 4096; // points between two looks at signals

	std::vector<shared_ptr<MpmState>> states;
	std::vector<shared_ptr<Body>>     made;
	if (bodies) states.reserve(n), made.reserve(n);
	for (std::size_t k = 0; k < n && bodies; ++k) {
		if (k % chunk == 0 && PyErr_CheckSignals() != 0) py::throw_error_already_set();
		const shared_ptr<MpmState> state(new MpmState);
		const shared_ptr<Sphere>   sphere(new Sphere);
		const shared_ptr<Body>     body(new Body);
		sphere->radius = .5 * size.data()[k];
		if (!color.is_none()) sphere->color = py::extract<Vector3r>(color)();
		state->pos = state->refPos = Vector3r(position.data()[3 * k], position.data()[3 * k + 1], position.data()[3 * k + 2]);
		state->vel                 = Vector3r(velocity.data()[3 * k], velocity.data()[3 * k + 1], velocity.data()[3 * k + 2]);
		state->mass                = mass.data()[k];
		state->inertia             = Vector3r::Constant(.4 * state->mass * sphere->radius * sphere->radius);
		state->points              = boost::static_pointer_cast<MpmPoints>(shared_from_this());
		body->state                = state;
		body->shape                = sphere;
		body->material             = material;
		body->subdomain            = MpmState::subdomainOfPoints;
		// without a contact law YADE aborts in its InteractionLoop, before the engine can refuse the material
		if (!boost::dynamic_pointer_cast<FrictMat>(material)) body->flags &= ~Body::FLAG_BOUNDED;
		if (!mask.is_none()) body->groupMask = py::extract<int>(mask)();
		states.push_back(state), made.push_back(body);
	}
	if (PyErr_CheckSignals() != 0) py::throw_error_already_set();

	// from here on nothing is refused or interrupted: points are made in whole, or not at all
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	restoreForces();
	const int label = groupOf(group, groupName);
	if (runtime.solver) runtime.solver->pointsChanged();
	std::size_t index = std::size_t(std::find(materials.begin(), materials.end(), material) - materials.begin());
	if (index == materials.size()) materials.push_back(material);
	BodyContainer& container = *Omega::instance().getScene()->bodies;
	dropErased(container); // ids of erased bodies are given again
	py::list ids;
	for (std::size_t k = 0; k < n; ++k) {
		const double *x = position.data() + 3 * k, *v = velocity.data() + 3 * k;
		const int     id = bodies ? container.insert(made[k]) : nextBodyless--;
		if (bodies) states[k]->pointId = id;
		points.append(id, int(index), x, v, mass.data()[k], volume.data()[k], size.data()[k], depth.data()[k]);
		if (label > 0) points.group.resize(points.count()), points.group.back() = label;
		if (curved) points.reach.resize(points.count()), points.reach.back() = reach->data()[k];
		if (points.energies.started) points.energies.external -= .5 * mass.data()[k] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
		ids.append(id);
	}
	++points.generation;
	filled = true;
	if (!points.stress.empty()) // columns that the analysis in hand needs, for whoever looks at the points before the next step
		points.prepare(points.deformation.size() == 9 ? 3 : 2, int(points.stress.size()), int(points.internal.size()), !points.thicknessStretch.empty(),
			!points.force.empty(), !points.dissipation.empty(), !points.freeStrain.empty());
	for (std::size_t k = 0; k < n && stressed; ++k)
		storeStress(points.count() - n + k, stress->data() + 9 * k);
	return ids;
}

// ---- loads on faces -----------------------------------------------------------------------------------------------------

shared_ptr<MpmTraction> MpmPoints::addTraction(
	py::dict columns, int kind, const Vector3r& traction, Real pressure, const std::vector<Real>& times, const std::vector<Real>& factors)
{
	const DoubleBuffer position(columns["position"]), area(columns["area"]);
	if (position.size() != area.size())
		throw std::invalid_argument("MpmPoints.addTraction: the arrays differ in their number of points; call mpm.traction");
	const shared_ptr<MpmTraction> load(new MpmTraction);
	load->kind     = kind;
	load->traction = traction, load->pressure = pressure;
	load->times = times, load->factors = factors;
	for (std::size_t k = 0; k + 2 < position.size(); k += 3) {
		Real square = 0;
		for (std::size_t d = 0; d < 3; ++d) {
			load->face.position[d].push_back(position.data()[k + d]);
			load->face.area[d].push_back(area.data()[k + d]);
			square += area.data()[k + d] * area.data()[k + d];
		}
		load->face.weight.push_back(std::sqrt(square));
	}
	load->face.reference = load->face.position;
	if (columns.has_key("traction")) {
		const DoubleBuffer field(columns["traction"]);
		for (std::size_t k = 0; k < std::min(field.size(), position.size()); ++k)
			load->face.field[k % 3].push_back(field.data()[k]);
	}
	if (columns.has_key("pressure")) {
		const DoubleBuffer field(columns["pressure"]);
		load->face.pressureField.assign(field.data(), field.data() + std::min(field.size(), load->face.count()));
	}
	const std::lock_guard<std::mutex> lock(mutex);
	tractions.push_back(load);
	return load;
}

py::list MpmPoints::loads() const
{
	py::list list;
	for (const auto& load : tractions)
		list.append(load);
	return list;
}

void MpmPoints::loadFaces(mpm::Analysis kind, Real time)
{
	points.tractions.clear();
	for (std::size_t k = 0; k < tractions.size(); ++k) {
		tractions[k]->load(k, kind, time);
		points.tractions.push_back(&tractions[k]->face);
	}
}

// ---- initial stress -----------------------------------------------------------------------------------------------------

namespace {
	/* Components of Points::initialStress: row and column of the tensor, and their names. */
	constexpr int     stressRow[6] = { 0, 1, 2, 1, 0, 0 }, stressColumn[6] = { 0, 1, 2, 2, 2, 1 };
	const char* const stressName[6] = { "xx", "yy", "zz", "yz", "zx", "xy" };

	/* Whether a law can have a point at this stress, back stress zero: within its yield surface, to rounding. */
	bool admits(const mpm::Law& law, const Real (&stress)[6])
	{
		const Real given = std::sqrt(mpm::Solid::mises2(stress));
		if (mpm::is<mpm::BoucWen>(law))
			return given <= mpm::as<mpm::BoucWen>(law).yieldStress * (1 + 1e-9); // its update has no yield surface to return to
		Real              sigma[6], none[6] {};
		std::vector<Real> internal(std::size_t(mpm::Internals::of(law).columns(6)), 0.);
		std::copy(stress, stress + 6, sigma);
		mpm::updateStress<mpm::Solid>(law, none, sigma, internal.data());
		Real moved = 0, scale = 0;
		for (int k = 0; k < 6; ++k)
			moved = std::max(moved, std::abs(sigma[k] - stress[k])), scale = std::max(scale, std::abs(stress[k]));
		return moved <= 1e-9 * scale;
	}
} // namespace

/* Until an analysis is known, the stress waits in a column of its own. */
void MpmPoints::storeStress(std::size_t p, const Real* tensor)
{
	if (points.initialStress.empty()) points.initialStress.assign(6, mpm::Column(points.count(), NaN));
	for (std::size_t k = 0; k < 6; ++k)
		points.initialStress[k][p] = tensor[3 * stressRow[k] + stressColumn[k]];
}

void MpmPoints::setStress(py::object ids, py::object stress)
{
	const DoubleBuffer                buffer(stress);
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	const auto n = std::size_t(py::len(ids));
	if (buffer.size() != 9 * n) throw std::invalid_argument("mpm.setStress: stress and ids differ in their number of points");
	std::vector<std::size_t> places;
	for (std::size_t k = 0; k < n; ++k)
		places.push_back(indexOf(py::extract<int>(ids[k])));
	for (std::size_t k = 0; k < n; ++k)
		storeStress(places[k], buffer.data() + 9 * k);
}

void MpmPoints::takeInitialStress(mpm::Analysis kind)
{
	if (points.initialStress.empty()) return;
	const bool plane = kind == mpm::Analysis::planeStress, solid = kind == mpm::Analysis::solid;
	const auto given = [this](std::size_t p) { return !std::isnan(points.initialStress[0][p]); };
	for (std::size_t p = 0; p < points.count(); ++p) {
		if (!given(p)) continue;
		Real       stress[6], greatest = 0;
		const auto refuseStress = [&](const std::string& why) {
			std::ostringstream text;
			text << "material point " << points.id[p] << ".stress = ";
			for (std::size_t k = 0; k < 6; ++k)
				text << (k ? ", " : "(") << stressName[k] << " " << stress[k];
			text << ") Pa: " << why;
			throw std::runtime_error(text.str());
		};
		for (std::size_t k = 0; k < 6; ++k)
			stress[k] = points.initialStress[k][p], greatest = std::max(greatest, std::abs(stress[k]));
		if (plane && std::abs(stress[2]) > 1e-12 * greatest) refuseStress("in plane stress zz is zero; leave it out of the initial stress");
		if (!solid && std::max(std::abs(stress[3]), std::abs(stress[4])) > 1e-12 * greatest)
			refuseStress("this analysis has no shear out of its plane; give yz = zx = 0");
		const mpm::Law& law = runtime.laws[std::size_t(points.material[p])];
		if (!admits(law, stress))
			refuseStress("it is beyond the yield surface of " + materials[std::size_t(points.material[p])]->getClassName()
				     + "; give a stress within it, or another material");
	}
	for (std::size_t p = 0; p < points.count(); ++p) {
		if (!given(p)) continue;
		const auto stored = [&] { return mpm::storedEnergy(kind, runtime.laws[std::size_t(points.material[p])], points, p); };
		const auto before = points.energies.started ? stored() : mpm::Energies {};
		for (std::size_t k = 0; k < points.stress.size(); ++k)
			points.stress[k][p] = points.initialStress[k < (plane ? 2 : 3) || solid ? k : 5][p];
		for (mpm::Column& column : points.internal)
			column[p] = 0;
		if (!points.energies.started) continue;
		const auto after = stored(); // what the stress brings with it comes from outside
		const Real V = volume(p), elastic = V * (after.elastic - before.elastic), hardening = V * (after.hardening - before.hardening);
		points.energies.elastic += elastic, points.energies.hardening += hardening, points.energies.external -= elastic + hardening;
	}
	points.initialStress.clear();
}

Vector3r MpmPoints::reaction(py::object ids)
{
	const std::lock_guard<std::mutex> lock(mutex);
	Vector3r                          sum = Vector3r::Zero();
	for (py::ssize_t k = 0, n = py::len(ids); k < n; ++k) {
		const int         id = py::extract<int>(ids[k]);
		const std::size_t p  = indexOf(id);
		if (points.prescribedDofs.empty() || !points.prescribedDofs[p])
			refuse("mpm.reaction", "ids", id,
				"the motion of this point is not prescribed, or has not been before the last step; set blockedDOFs of its body");
		const auto at = std::lower_bound(points.reactions.begin(), points.reactions.end(), mpm::SurfaceForce { id, 0, {}, {} });
		if (at == points.reactions.end() || at->point != id) continue;
		for (int d = 0; d < 3; ++d)
			sum[d] -= at->force[std::size_t(d)];
	}
	return sum;
}

py::dict MpmPoints::drive(const shared_ptr<Material>& material, py::object strain, bool freeXX, bool freeYY, bool freeZZ)
{
	const DoubleBuffer path(strain);
	const auto         signals = [] {
                if (PyErr_CheckSignals() != 0) py::throw_error_already_set();
	};
	const mpm::PointHistory history = mpm::drivePoint(lawOf(*material), { path.data(), path.data() + path.size() }, { freeXX, freeYY, freeZZ }, signals);
	py::dict                result;
	for (const auto& [name, values] :
		std::initializer_list<std::pair<const char*, const std::vector<double>*>> { { "stress", &history.stress }, { "strain", &history.strain },
			{ "backStress", &history.backStress }, { "plasticStrain", &history.plasticStrain }, { "dissipation", &history.dissipation } }) {
		double*          out;
		const py::object bytes = newBytes(values->size(), out);
		std::copy(values->begin(), values->end(), out);
		result[name] = bytes;
	}
	return result;
}

py::object MpmPoints::array(const std::string& name)
{
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	restoreForces();
	const std::vector<std::size_t>& order = inOrder();
	const std::size_t               n     = order.size();
	if (name == "id" || name == "material" || name == "group") {
		std::int64_t*    out;
		const py::object bytes = newBytes(n, out);
		for (std::size_t k = 0; k < n; ++k)
			out[k] = name == "id"           ? points.id[order[k]]
				 : name == "material"   ? materials[std::size_t(points.material[order[k]])]->id
				 : points.group.empty() ? 0
							: points.group[order[k]];
		return py::make_tuple(bytes, "int64", py::make_tuple(n));
	}
	const Quantity quantity = this->quantity(name);
	const auto     width    = std::size_t(quantity.components);
	if (width == 0)
		throw std::invalid_argument(
			"mpm.array('" + name
			+ "'): no such quantity; choose 'id', 'material', 'group', 'position', 'displacement', 'velocity', 'mass', 'volume', 'size', 'stress', "
			  "'strain', 'backStress', 'F', 'plasticStrain', 'dissipation' or 'vonMises'");
	double*          out;
	const py::object bytes = newBytes(n * width, out);
	for (std::size_t k = 0; k < n; ++k)
		quantity.read(order[k], out + k * width);
	return py::make_tuple(bytes, "float64", width == 1 ? py::make_tuple(n) : width == 3 ? py::make_tuple(n, 3) : py::make_tuple(n, 3, 3));
}

MpmPoints::Quantity MpmPoints::quantity(const std::string& name) const
{
	auto scalar = [](auto&& value) { return Quantity { 1, [=](std::size_t p, Real* out) { *out = value(p); } }; };
	auto vector = [](const mpm::Columns& columns) {
		return Quantity { 3, [&columns](std::size_t p, Real* out) {
					 for (std::size_t d = 0; d < 3; ++d)
						 out[d] = columns[d][p];
				 } };
	};
	auto matrix = [this](Matrix3r (MpmPoints::*value)(std::size_t) const) {
		return Quantity { 9, [this, value](std::size_t p, Real* out) {
					 const Matrix3r T = (this->*value)(p);
					 for (int k = 0; k < 9; ++k)
						 out[k] = T(k / 3, k % 3);
				 } };
	};
	if (name == "position") return vector(points.position);
	if (name == "velocity") return vector(points.velocity);
	if (name == "displacement") {
		const shared_ptr<BodyContainer> bodies = Omega::instance().getScene()->bodies;
		return { 3, [this, bodies](std::size_t p, Real* out) {
				const Body* body = bodyOf(p, *bodies);
				for (int d = 0; d < 3; ++d)
					out[d] = body ? points.position[std::size_t(d)][p] - body->state->refPos[d] : NaN;
			} };
	}
	if (name == "size") return scalar([this](std::size_t p) { return points.size[p]; });
	if (name == "mass") return scalar([this](std::size_t p) { return points.mass[p]; });
	if (name == "volume") return scalar([this](std::size_t p) { return volume(p); });
	if (name == "plasticStrain") return scalar([this](std::size_t p) { return plasticStrain(p); });
	if (name == "dissipation") return scalar([this](std::size_t p) { return points.dissipation.empty() ? 0 : points.dissipation[p]; });
	if (name == "vonMises") return scalar([this](std::size_t p) { return vonMises(p); });
	if (name == "stress") return matrix(&MpmPoints::stress);
	if (name == "strain") return matrix(&MpmPoints::strain);
	if (name == "backStress") return matrix(&MpmPoints::backStress);
	if (name == "F") return matrix(&MpmPoints::deformation);
	return { 0, {} };
}

} // namespace yade
