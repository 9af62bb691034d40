// SPDX-License-Identifier: GPL-2.0-or-later
#include "EngineOrder.hpp"
#include "MpmState.hpp"
#include <algorithm>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/TimeStepper.hpp>
#include <stdexcept>

namespace yade {

namespace {
	/* Whether an engine of this class sets the velocities of its bodies. YADE knows the direct bases of a class. */
	bool movesBodies(const std::string& name)
	{
		if (name == "CombinedKinematicEngine") return true;
		for (const char* base : { "KinematicEngine", "TranslationEngine", "RotationEngine", "HelixEngine" })
			if (name == base || Omega::instance().isInheritingFrom(name, base)) return true;
		return false;
	}
} // namespace

void EngineOrder::check(const std::vector<shared_ptr<Engine>>& engines, const Engine& self)
{
	if (m_checked.size() == engines.size()
		&& std::equal(m_checked.begin(), m_checked.end(), engines.begin(),
			[](const Entry& a, const shared_ptr<Engine>& b) { return a.engine == b.get() && a.dead == b->dead; }))
		return;
	std::vector<Entry> order;
	const std::size_t  n    = engines.size();
	std::size_t        here = n;
	for (std::size_t k = 0; k < n; ++k) {
		const std::string name = engines[k]->getClassName();
		const Role        role = engines[k].get() == &self                            ? Role::self
					 : dynamic_cast<const TimeStepper*>(engines[k].get()) ? Role::stepper
					 : name == "NewtonIntegrator"                         ? Role::newton
					 : name == "InteractionLoop"                          ? Role::loop
					 : movesBodies(name)                                  ? Role::mover
											      : Role::other;
		if (role == Role::self) here = k;
		order.push_back({ engines[k].get(), engines[k]->dead, role });
	}
	// every process of yade.mpy has this engine: all refuse the same step, as one that went on would wait for the others for ever
	for (const auto& engine : engines)
		if (engine->label == "isendRecvForcesRunner" && !engine->dead)
			throw std::runtime_error(std::string("O.engines has isendRecvForcesRunner: ") + oneProcess);
	m_checked.clear();     // a bad order is complained of each time
	if (here == n) return; // asked for its time step outside O.engines
	for (const auto& engine : engines)
		if (engine.get() != &self && !engine->dead && !self.dead && engine->getClassName() == self.getClassName())
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
	m_checked = std::move(order);
}

void EngineOrder::checkMotions(const BodyContainer& bodies, int dim) const
{
	for (const Entry& entry : m_checked) {
		const auto* mover = entry.role == Role::mover && !entry.dead ? dynamic_cast<const PartialEngine*>(entry.engine) : nullptr;
		if (!mover) continue;
		const unsigned needed = dim == 3 ? 7 : 3;
		for (const int id : mover->ids) {
			const Body* body = id >= 0 && std::size_t(id) < bodies.body.size() ? bodies.body[std::size_t(id)].get() : nullptr;
			if (!body || !dynamic_cast<const MpmState*>(body->state.get()) || (body->state->blockedDOFs & needed) == needed) continue;
			throw std::runtime_error("O.bodies[" + std::to_string(id) + "].state.blockedDOFs: " + mover->getClassName()
						 + " moves this material point, whose motion is not prescribed: set blockedDOFs = '" + (dim == 3 ? "xyz" : "xy")
						 + "', and the material follows it");
		}
	}
}

bool EngineOrder::hasContacts() const
{
	return std::any_of(m_checked.begin(), m_checked.end(), [](const Entry& entry) { return entry.role == Role::loop && !entry.dead; });
}

bool EngineOrder::checkClocks(bool setsStep) const
{
	long here = -1, stepper = -1, newton = -1, loop = -1;
	for (long k = 0; k < long(m_checked.size()); ++k) {
		const Entry& checked = m_checked[std::size_t(k)];
		if (checked.dead) continue;
		switch (checked.role) {
			case Role::self: here = k; break;
			case Role::stepper: stepper = static_cast<const TimeStepper*>(checked.engine)->active ? k : stepper; break;
			case Role::newton: newton = k; break;
			case Role::loop: loop = k; break;
			case Role::mover:
			case Role::other: break;
		}
	}
	if (here < 0) return false;
	const auto between = [](long a, long b, long c) { return a >= 0 && c >= 0 && (b - a) * (b - c) < 0; };
	if (setsStep && newton >= 0 && newton < here)
		throw std::runtime_error("O.engines: MpmEngine (place " + std::to_string(here) + ") sets O.dt (timeStepSafety), which NewtonIntegrator (place "
					 + std::to_string(newton) + ") has used before; put MpmEngine before NewtonIntegrator");
	if (stepper < 0) return false;
	const std::string stepperName = m_checked[std::size_t(stepper)].engine->getClassName();
	const std::string name        = stepperName + " (place " + std::to_string(stepper) + ")";
	if (between(here, stepper, newton))
		throw std::runtime_error("O.engines: " + name + " changes O.dt between MpmEngine (place " + std::to_string(here)
					 + ") and NewtonIntegrator (place " + std::to_string(newton) + "), which must take the same step; put it before both");
	if (setsStep && (stepper > here || between(stepper, loop, here)))
		throw std::runtime_error("O.engines: contacts (InteractionLoop) would see the O.dt of " + name + ", which MpmEngine (place "
					 + std::to_string(here) + ", timeStepSafety) shortens only later; put them in the order InteractionLoop, " + stepperName
					 + ", MpmEngine, NewtonIntegrator");
	return true;
}

} // namespace yade
