// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmPoints.hpp"
#include "Buffers.hpp"
#include "Materials.hpp"
#include "MpmState.hpp"
#include "kernel/PointDriver.hpp"
#include <Eigen/Eigenvalues>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Omega.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Sphere.hpp>

namespace yade {

namespace py = ::boost::python;

namespace {
	const char* const incompatible = "': its law keeps other internal variables than the points carry (plastic strain, back stress); give points a law of "
					 "the same kind and options, or make new points";
}

shared_ptr<MpmPoints> MpmPoints::of(const Scene& scene)
{
	for (const auto& item : scene.miscParams)
		if (auto points = dynamic_pointer_cast<MpmPoints>(item)) return points;
	return {};
}

void MpmPoints::finish()
{
	if (runtime.solver) runtime.solver->finish();
}

void MpmPoints::updateLaws()
{
	runtime.laws.resize(materials.size());
	for (std::size_t m = 0; m < materials.size(); ++m)
		try {
			const mpm::Law law = lawOf(*materials[m]);
			if (!keepsInternals(runtime.laws[m], law) && inUse(m))
				throw std::runtime_error(materials[m]->getClassName() + " '" + materials[m]->label + incompatible);
			runtime.laws[m] = law;
		} catch (const std::runtime_error&) {
			if (inUse(m)) throw;
		}
}

/* Whether what points have of internal variables means the same to another law; a law without any leaves none behind. */
bool MpmPoints::keepsInternals(const mpm::Law& before, const mpm::Law& after) const
{
	const mpm::Internals a = mpm::Internals::of(before), b = mpm::Internals::of(after);
	return points.internal.empty() || a.columns(1) == 0 || (a.tensors == b.tensors && a.scalars == b.scalars && before.kind == after.kind);
}

void MpmPoints::changeMaterial(std::size_t p, const shared_ptr<Material>& material)
{
	auto found = std::find(materials.begin(), materials.end(), material);
	if (found == materials.end()) found = materials.insert(materials.end(), material);
	const std::size_t before = std::size_t(points.material[p]), after = std::size_t(found - materials.begin());
	points.material[p] = int(after);
	updateLaws();
	if (mpm::Internals::of(runtime.laws[after]).columns(1) == 0)
		for (mpm::Column& column : points.internal)
			column[p] = 0; // an elastic point forgets
	else if (!keepsInternals(runtime.laws[before], runtime.laws[after])) {
		points.material[p] = int(before);
		throw std::runtime_error(
			"O.bodies[" + std::to_string(points.id[p]) + "].mat = " + material->getClassName() + " '" + material->label + incompatible);
	}
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
		else if (energies.started) {
			// without a solver, which a loaded scene does not have yet
			const mpm::Energies stored = mpm::storedEnergy(analysis(), runtime.laws[std::size_t(points.material[p])], points, p);
			const Real          V = volume(p), elastic = V * stored.elastic, hardening = V * stored.hardening;
			Real                kinetic = 0;
			for (const mpm::Column& v : points.velocity)
				kinetic += .5 * points.mass[p] * v[p] * v[p];
			if (runtime.solver) kinetic += runtime.solver->rotation(p).energy;
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
	try {
		updateLaws();
	} catch (const std::runtime_error&) {
		runtime.laws.clear(); // the engine complains about a bad material before its next step
	}
}

/* A scene that a failed step has stopped must still be saveable: what fails here has failed in the run as well. */
void MpmPoints::preSave(MpmPoints&)
{
	const std::lock_guard<std::mutex> lock(mutex);
	try {
		finish();
	} catch (const mpm::StepFailure&) {
	}
}

const MpmPoints::Directory& MpmPoints::directory()
{
	Directory& d = m_directory;
	if (d.generation == points.generation && d.order.size() == points.count()) return d;
	d.bodies.clear(), d.loose.clear(), d.order.clear();
	for (std::size_t p = 0; p < points.count(); ++p) {
		const int         id    = points.id[p];
		auto&             place = id >= 0 ? d.bodies : d.loose;
		const std::size_t at    = std::size_t(id >= 0 ? id : -1 - id);
		if (place.size() <= at) place.resize(std::max(at + 1, 2 * place.size()), nowhere);
		place[at] = p;
	}
	d.order.reserve(points.count());
	for (const auto* places : { &d.bodies, &d.loose })
		for (const std::size_t p : *places)
			if (p != nowhere) d.order.push_back(p);
	d.generation = points.generation;
	return d;
}

std::size_t MpmPoints::indexOf(int id)
{
	const Directory&  d     = directory();
	const auto&       place = id >= 0 ? d.bodies : d.loose;
	const std::size_t at    = std::size_t(id >= 0 ? id : -1 - id);
	if (at >= place.size() || place[at] == nowhere) throw std::runtime_error("there is no material point " + std::to_string(id) + " (any more)");
	return place[at];
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

Matrix3r MpmPoints::stress(std::size_t p) const { return tensor(points.stress, p); }

Matrix3r MpmPoints::backStress(std::size_t p) const
{
	return internals(p).tensors > 0 && !points.internal.empty() ? tensor(points.internal, p) : Matrix3r::Zero();
}

Real MpmPoints::plasticStrain(std::size_t p) const
{
	const mpm::Internals layout = internals(p);
	return layout.scalars > 0 && !points.internal.empty() ? points.internal[std::size_t(layout.tensors) * points.stress.size()][p] : 0;
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
		if (!points.freeStrain.empty() && !keepsVolume(runtime.laws[std::size_t(points.material[p])]))
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

namespace {
	/* Bodies outside the scene's own subdomain (0) are left alone by NewtonIntegrator and do not touch each other, while
	contacts with other bodies and forces on them work as usual: what a material point wants. */
	constexpr int subdomainOfPoints = 1;
} // namespace

py::object MpmPoints::append(
	py::object positions, Real spacing, Real thickness, bool ring, const shared_ptr<Material>& material, const Vector3r& velocity, bool bodies)
{
	const DoubleBuffer                buffer(positions);
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	if (runtime.solver) runtime.solver->pointsChanged();

	std::size_t index = std::size_t(std::find(materials.begin(), materials.end(), material) - materials.begin());
	if (index == materials.size()) materials.push_back(material);

	BodyContainer& container = *Omega::instance().getScene()->bodies;
	dropErased(container); // ids of erased bodies are given again
	py::list ids;
	for (std::size_t k = 0; k + 2 < buffer.size(); k += 3) {
		const Vector3r x(buffer.data()[k], buffer.data()[k + 1], buffer.data()[k + 2]);
		int            id    = 0;
		const Real     depth = ring ? 2 * M_PI * x[0] : thickness > 0 ? thickness : spacing, volume = spacing * spacing * depth;
		const Real     mass = material->density * volume;
		if (bodies) {
			const shared_ptr<MpmState> state(new MpmState);
			const shared_ptr<Sphere>   sphere(new Sphere);
			const shared_ptr<Body>     body(new Body);
			sphere->radius = .5 * spacing;
			state->pos = state->refPos = x;
			state->vel                 = velocity;
			state->mass                = mass;
			state->inertia             = Vector3r::Constant(.4 * mass * sphere->radius * sphere->radius);
			state->points              = static_pointer_cast<MpmPoints>(shared_from_this());
			body->state                = state;
			body->shape                = sphere;
			body->material             = material;
			body->subdomain            = subdomainOfPoints;
			id = state->pointId = container.insert(body);
		} else
			id = nextBodyless--;
		points.append(id, int(index), x.data(), velocity.data(), mass, volume, spacing, ring ? -depth : thickness);
		if (points.energies.started) points.energies.external -= .5 * mass * velocity.squaredNorm();
		ids.append(id);
	}
	++points.generation;
	filled = true;
	if (!points.stress.empty()) // columns that the analysis in hand needs, for whoever looks at the points before the next step
		points.prepare(int(points.advance.size()), int(points.stress.size()), int(points.internal.size()), !points.thicknessStretch.empty(),
			!points.force.empty(), !points.dissipation.empty(), !points.freeStrain.empty());
	return ids;
}

py::dict MpmPoints::drive(const shared_ptr<Material>& material, py::object strain, bool freeXX, bool freeYY, bool freeZZ)
{
	const DoubleBuffer      path(strain);
	const mpm::PointHistory history = mpm::drivePoint(lawOf(*material), { path.data(), path.data() + path.size() }, { freeXX, freeYY, freeZZ });
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

Vector3r MpmPoints::angularMomentum(const Vector3r& about)
{
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	Vector3r sum = Vector3r::Zero();
	for (std::size_t p = 0; p < points.count(); ++p) {
		const Vector3r x(points.position[0][p], points.position[1][p], points.position[2][p]);
		const Vector3r v(points.velocity[0][p], points.velocity[1][p], points.velocity[2][p]);
		sum += points.mass[p] * (x - about).cross(v);
		if (!runtime.solver) continue;
		const auto carried = runtime.solver->rotation(p).momentum;
		sum += Vector3r(carried[0], carried[1], carried[2]);
	}
	return sum;
}

py::object MpmPoints::array(const std::string& name)
{
	const std::lock_guard<std::mutex> lock(mutex);
	finish();
	const std::vector<std::size_t>& order = inOrder();
	const std::size_t               n     = order.size();
	if (name == "id" || name == "material") {
		std::int64_t*    out;
		const py::object bytes = newBytes(n, out);
		for (std::size_t k = 0; k < n; ++k)
			out[k] = name == "id" ? points.id[order[k]] : materials[std::size_t(points.material[order[k]])]->id;
		return py::make_tuple(bytes, "int64", py::make_tuple(n));
	}
	const Quantity quantity = this->quantity(name);
	const auto     width    = std::size_t(quantity.components);
	if (width == 0)
		throw std::invalid_argument(
			"mpm.array('" + name
			+ "'): no such quantity; choose 'id', 'material', 'position', 'displacement', 'velocity', 'mass', 'volume', 'stress', "
			  "'strain', 'backStress', 'F', 'plasticStrain', 'dissipation', 'vonMises' or 'angularVelocity'");
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
	if (name == "angularVelocity")
		return { 3, [this](std::size_t p, Real* out) {
				const std::size_t turns = points.angularVelocity.size();
				for (std::size_t d = 0; d < 3; ++d)
					out[d] = turns == 3 ? points.angularVelocity[d][p] : turns == 1 && d == 2 ? points.angularVelocity[0][p] : 0;
			} };
	if (name == "displacement") {
		const shared_ptr<BodyContainer> bodies = Omega::instance().getScene()->bodies;
		return { 3, [this, bodies](std::size_t p, Real* out) {
				const Body* body = bodyOf(p, *bodies);
				for (int d = 0; d < 3; ++d)
					out[d] = body ? points.position[std::size_t(d)][p] - body->state->refPos[d] : NaN;
			} };
	}
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
