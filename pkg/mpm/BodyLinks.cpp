// SPDX-License-Identifier: GPL-2.0-or-later
#include "BodyLinks.hpp"
#include "BadInput.hpp"
#include "EngineOrder.hpp"
#include "MpmState.hpp"
#include <algorithm>
#include <core/BodyContainer.hpp>
#include <core/Bound.hpp>
#include <core/ForceContainer.hpp>
#include <core/Interaction.hpp>
#include <pkg/common/ElastMat.hpp>

namespace yade {

namespace {
	constexpr Real unscaled = -1; // State.densityScaling of a body that no engine has scaled
} // namespace

/* Whether the point's body still is in O.bodies, looked up anew. */
bool BodyLinks::link(Scene& scene, MpmPoints& points, std::size_t p)
{
	const auto  id     = std::size_t(points.points.id[p]);
	const auto& bodies = scene.bodies->body;
	m_links.resize(bodies.size());
	if (id < m_links.size()) m_links[id] = {};
	if (!points.bodyOf(p, *scene.bodies)) return false;
	m_links[id] = { bodies[id], bodies[id]->state, bodies[id].get(), bodies[id]->state.get() };
	return true;
}

BodyLinks::Changes BodyLinks::read(Scene& scene, MpmPoints& points)
{
	scene.forces.sync();
	Changes changes;
	points.points.force.size() == 2 ? readStates<2>(scene, points, changes) : readStates<3>(scene, points, changes);
	return changes;
}

/* In a small scene this loop is the cost of YADE: it looks for bad input after it has passed. */
template <int dim> void BodyLinks::readStates(Scene& scene, MpmPoints& all, Changes& changes)
{
	mpm::Points&      points = all.points;
	const auto&       bodies = scene.bodies->body;
	auto&             forces = scene.forces;
	const std::size_t n      = points.count();
	double *          f[dim], *v[dim];
	const double *    x[dim], *u[dim];
	for (std::size_t d = 0; d < dim; ++d)
		f[d] = points.force[d].data(), v[d] = points.velocity[d].data(), x[d] = points.position[d].data(),
		u[d] = points.displacementIncrement[d].data();
	const int* const  ids       = points.id.data();
	const auto* const materials = all.materials.data();

	const Real* const mass    = points.mass.data();
	const bool        rotates = !points.angularVelocity.empty();

	bool refused  = false;
	Real offPlane = 0;
	for (std::size_t p = 0; p < n; ++p) {
		if (ids[p] < 0) continue;
		const auto id = std::size_t(ids[p]);
		// an answer of MpmPoints::bodyOf holds as long as body and state stay
		const bool linked = id < m_links.size() && id < bodies.size() && m_links[id].holds(bodies[id]);
		if (!linked && !link(scene, all, p)) {
			changes.erased = true;
			continue;
		}
		const Body&     body  = *m_links[id].body;
		State&          state = *m_links[id].state;
		const Vector3r &force = forces.getForce(ids[p]), &position = state.se3.position, &velocity = state.vel;
		const Real      sum = force[0] + force[1] + force[2] + position[0] + position[1] + position[2] + velocity[0] + velocity[1] + velocity[2];
		if (!(sum - sum == 0)) {
			refused = true;
			continue;
		}
		const bool before = !points.inContact.empty() && points.inContact[p]; // then it shows another velocity than its own
		Real       gone   = 0;
		if (before || rotates || points.energies.started) takeVelocity(points, p, before, state);
		for (int d = 0; d < dim; ++d) {
			f[d][p] = force[d];
			if (!before) v[d][p] = velocity[d];
			gone += std::abs(position[d] - (x[d][p] + u[d][p]));
		}
		if (dim == 2) offPlane += std::abs(position[2]) + std::abs(velocity[2]);
		if (gone != 0) changes.moved.push_back(p);
		if (const auto fixed = std::uint8_t(state.blockedDOFs & 7); fixed || !points.prescribedDofs.empty()) {
			points.prescribedDofs.resize(n, 0);
			points.prescribedDofs[p] = fixed;
		}
		// interactions without geometry and physics are the collider's guesses, which a saved scene lacks
		const auto real    = [](const auto& i) { return i.second->geom && i.second->phys; };
		const bool touched = !body.intrs.empty() && std::any_of(body.intrs.begin(), body.intrs.end(), real);
		if (touched || before) readContact(scene, points, p, touched, state);
		const Vector3r& torque = forces.getTorque(ids[p]);
		if (body.clumpId != Body::ID_NONE || body.subdomain != MpmState::subdomainOfPoints || state.densityScaling != unscaled
			|| (!touched && (torque[0] != 0 || torque[1] != 0 || torque[2] != 0)))
			refuseBody(scene, body);
		if (state.mass != mass[p]) changes.otherMass.push_back(p);
		if (body.material.get() != materials[points.material[p]].get()) changes.otherMaterial.push_back(p);
	}
	if (offPlane != 0 || refused) refuseStates(scene, points, dim);
}

/* Refuses a property that YADE admits for a body and a material point cannot have. */
void BodyLinks::refuseBody(Scene& scene, const Body& body) const
{
	const std::string name = "O.bodies[" + std::to_string(body.id) + "]";
	require(body.clumpId == Body::ID_NONE, name, "clumpId", body.clumpId,
		"a material point cannot be a member of a clump, which moves as a rigid body; dissolve the clump with O.bodies.erase("
			+ std::to_string(body.clumpId) + "), which keeps its members, and make rigid parts of grains");
	require(body.subdomain == MpmState::subdomainOfPoints, name, "subdomain", body.subdomain, EngineOrder::oneProcess);
	require(body.state->densityScaling == unscaled, name + ".state", "densityScaling", body.state->densityScaling,
		"the mass of material points is not scaled; set NewtonIntegrator.densityScaling = False and this to -1");
	refuse("O.forces", "t(" + std::to_string(body.id) + ")", scene.forces.getTorque(body.id).transpose(),
		"only a contact can apply a torque to a material point; apply a couple of forces to points around it");
}

/* The change that a script has made to a body's velocity is a change of the point's own velocity; the kinetic energy that it adds
is external work. The solver finds the rotation of a free point that has been given another velocity. */
void BodyLinks::takeVelocity(mpm::Points& points, std::size_t p, bool touched, const State& state) const
{
	const Vector3r& shown   = state.vel;
	bool            changed = false;
	for (std::size_t d = 0; d < points.force.size(); ++d) {
		Real&      v   = points.velocity[d][p];
		const Real old = v;
		v              = touched ? old + (shown[int(d)] - points.contactVelocity[d][p]) : shown[int(d)];
		points.energies.external += .5 * points.mass[p] * (old * old - v * v);
		changed |= v != old;
	}
	if (!changed || points.angularVelocity.empty() || (state.blockedDOFs & 7)) return;
	points.spinUnknown.resize(points.count(), 0);
	points.spinUnknown[p] = 1;
}

/* Complains of the first body whose force, position or velocity cannot be. */
void BodyLinks::refuseStates(Scene& scene, const mpm::Points& points, int dim) const
{
	for (const int id : points.id) {
		if (id < 0) continue;
		const State* state = std::size_t(id) < m_links.size() ? m_links[std::size_t(id)].state : nullptr;
		if (!state) continue;
		const std::string body     = "O.bodies[" + std::to_string(id) + "].state";
		const Vector3r&   force    = scene.forces.getForce(id);
		const auto*       material = dynamic_cast<const ElastMat*>(m_links[std::size_t(id)].body->material.get());
		const bool        halved   = material && material->poisson == 0 && !m_links[std::size_t(id)].body->intrs.empty();
		require(force.allFinite(), "O.forces", "f(" + std::to_string(id) + ")", force.transpose(),
			halved ? "in a contact of two materials with poisson = 0 YADE divides zero by zero for the tangential stiffness; give one of them a "
				 "small poisson, e.g. 1e-3"
			       : "look at the engine, contact or script that applies it");
		require(state->vel.allFinite(), body, "vel", state->vel.transpose(), "give a finite velocity [m/s]");
		require(state->pos.allFinite(), body, "pos", state->pos.transpose(), "give a finite position [m]");
		require(dim == 3 || (state->pos[2] == 0 && state->vel[2] == 0), body, "pos, vel", state->pos[2],
			"in a plane analysis points lie at z = 0 and stay there; set z and the velocity along it to 0, or choose analysis = '3d'");
	}
	throw std::logic_error("MpmEngine: a point's force, position or velocity is not finite, and none was found");
}

/* Torque on a point that touches another body; one that has stopped doing so shows its own velocity again. */
void BodyLinks::readContact(Scene& scene, mpm::Points& points, std::size_t p, bool touched, State& state) const
{
	if (points.inContact.empty()) points.prepareContacts();
	points.inContact[p] = touched;
	if (touched) {
		const Vector3r& torque = scene.forces.getTorque(points.id[p]);
		if (!torque.allFinite())
			refuse("O.forces", "t(" + std::to_string(points.id[p]) + ")", torque.transpose(),
				"look at the engine, contact or script that applies it");
		for (std::size_t k = 0, turns = points.torque.size(); k < turns; ++k)
			points.torque[k][p] = torque[turns == 3 ? int(k) : 2];
	} else {
		for (std::size_t d = 0; d < points.contactVelocity.size(); ++d)
			state.vel[int(d)] = points.velocity[d][p];
		state.angVel = Vector3r::Zero();
	}
}

void BodyLinks::write(Scene& scene, const mpm::Points& points) const
{
	const std::size_t dim    = points.displacementIncrement.size();
	const auto&       bodies = scene.bodies->body;
	bool              outrun = false;
	for (std::size_t p = 0; p < points.count(); ++p) {
		const auto id = std::size_t(points.id[p]);
		if (points.id[p] < 0 || id >= bodies.size() || !m_links[id].holds(bodies[id])) continue; // erased from another thread meanwhile
		const Link& link    = m_links[id];
		State&      state   = *link.state;
		const bool  touched = !points.inContact.empty() && points.inContact[p];
		for (std::size_t d = 0; d < dim; ++d) {
			state.se3.position[int(d)] = points.position[d][p] + points.displacementIncrement[d][p];
			state.vel[int(d)]          = (touched ? points.contactVelocity : points.velocity)[d][p];
		}
		for (std::size_t k = 0, turns = points.spin.size(); k < turns && touched; ++k)
			state.angVel[turns == 3 ? int(k) : 2] = points.spin[k][p];
		// NewtonIntegrator asks for the collider where bodies outrun their bounds, but skips points
		if (const Bound* bound = link.body->bound.get()) outrun |= (state.pos - bound->refPos).squaredNorm() > bound->sweepLength * bound->sweepLength;
	}
	if (outrun) scene.doSort = true;
}

} // namespace yade
