// SPDX-License-Identifier: GPL-2.0-or-later
#include "ProbeEngine.hpp"
#include <PluginLoad.hpp>
#include <chrono>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/TimeStepper.hpp>
#include <functional>
#include <map>
#include <pkg/common/Sphere.hpp>

namespace yade {

namespace py = ::boost::python;

YADE_PLUGIN((ProbeItem)(ProbeState)(ProbeMat)(ProbePeriodic)(ProbeEngine));

namespace {

	struct Access {
		std::function<py::object(py::object)>       get;
		std::function<void(py::object, py::object)> set;
	};

	template <class Class, class T> Access access(T Class::*member)
	{
		return { [member](py::object object) {
				Class& instance = py::extract<Class&>(object);
				return py::object(instance.*member);
			},
			[member](py::object object, py::object value) {
				Class& instance  = py::extract<Class&>(object);
				instance.*member = py::extract<T>(value)();
			} };
	}

	// tables; clang-format 14 joins two words of a declaration in them
	// clang-format off
#define PROBE(cls, name)                                                                                                                                       \
	{                                                                                                                                                      \
		#cls "." #name, access(&cls::name)                                                                                                             \
	}

	const std::map<std::string, Access>& table()
	{
		static const std::map<std::string, Access> accesses = {
			PROBE(Engine, dead), PROBE(Engine, ompThreads), PROBE(Engine, label),
			PROBE(PartialEngine, ids),
			PROBE(TimeStepper, active), PROBE(TimeStepper, timeStepUpdateInterval),
			PROBE(PeriodicEngine, virtPeriod), PROBE(PeriodicEngine, realPeriod), PROBE(PeriodicEngine, iterPeriod),
			PROBE(PeriodicEngine, nDo), PROBE(PeriodicEngine, initRun), PROBE(PeriodicEngine, firstIterRun),
			PROBE(PeriodicEngine, virtLast), PROBE(PeriodicEngine, realLast), PROBE(PeriodicEngine, iterLast), PROBE(PeriodicEngine, nDone),
			PROBE(State, vel), PROBE(State, mass), PROBE(State, angVel), PROBE(State, angMom), PROBE(State, inertia), PROBE(State, refPos),
			PROBE(State, refOri), PROBE(State, isDamped), PROBE(State, densityScaling),
			{ "State.pos",
			  { [](py::object o) { return py::object(Vector3r(py::extract<State&>(o)().pos)); },
			    [](py::object o, py::object v) {
				    State& state = py::extract<State&>(o);
				    state.pos    = py::extract<Vector3r>(v)();
			    } } },
			{ "State.ori",
			  { [](py::object o) { return py::object(Quaternionr(py::extract<State&>(o)().ori)); },
			    [](py::object o, py::object v) {
				    State& state = py::extract<State&>(o);
				    state.ori    = py::extract<Quaternionr>(v)();
			    } } },
			{ "State.se3",
			  { [](py::object o) {
				   const Se3r& se3 = py::extract<State&>(o)().se3;
				   return py::object(py::make_tuple(se3.position, se3.orientation));
			   },
			    [](py::object o, py::object v) {
				    State& state    = py::extract<State&>(o);
				    Se3r&  se3      = state.se3;
				    se3.position    = py::extract<Vector3r>(v[0])();
				    se3.orientation = py::extract<Quaternionr>(v[1])();
			    } } },
			{ "State.blockedDOFs",
			  { [](py::object o) {
				   std::string dofs;
				   for (int axis = 0; axis < 6; axis++)
					   if (py::extract<State&>(o)().blockedDOFs & State::axisDOF(axis % 3, axis > 2)) dofs += "xyzXYZ"[axis];
				   return py::object(dofs);
			   },
			    [](py::object o, py::object v) {
				    State& state      = py::extract<State&>(o);
				    state.blockedDOFs = State::DOF_NONE;
				    for (const char dof : std::string(py::extract<std::string>(v)()))
					    state.blockedDOFs |= 1u << std::string("xyzXYZ").find(dof);
			    } } },
			PROBE(Material, id), PROBE(Material, label), PROBE(Material, density),
			PROBE(ElastMat, young), PROBE(ElastMat, poisson),
			PROBE(FrictMat, frictionAngle),
			PROBE(Shape, color), PROBE(Shape, wire), PROBE(Shape, highlight),
			PROBE(Sphere, radius),
			PROBE(Bound, lastUpdateIter), PROBE(Bound, refPos), PROBE(Bound, sweepLength), PROBE(Bound, color), PROBE(Bound, min), PROBE(Bound, max),
			PROBE(Body, id), PROBE(Body, groupMask), PROBE(Body, flags), PROBE(Body, subdomain), PROBE(Body, material), PROBE(Body, state),
			PROBE(Body, shape), PROBE(Body, bound), PROBE(Body, clumpId), PROBE(Body, iterBorn), PROBE(Body, timeBorn),
			PROBE(Interaction, isActive), PROBE(Interaction, id1), PROBE(Interaction, id2), PROBE(Interaction, iterMadeReal),
			PROBE(Interaction, geom), PROBE(Interaction, phys), PROBE(Interaction, cellDist), PROBE(Interaction, iterBorn),
		};
		return accesses;
	}

	/* The scene and its containers are not Python objects: YADE shows their attributes as those of O and O.bodies. */
	const std::map<std::string, Access>& sceneTable()
	{
		static const auto scene = [](auto member) -> Access {
			return { [member](py::object) { return py::object((*Omega::instance().getScene()).*member); },
				 [member](py::object, py::object value) {
					 auto& target = (*Omega::instance().getScene()).*member;
					 target       = py::extract<std::decay_t<decltype(target)>>(value)();
				 } };
		};
		static const auto bodies = [](auto member) -> Access {
			return { [member](py::object) { return py::object((*Omega::instance().getScene()->bodies).*member); },
				 [member](py::object, py::object value) {
					 auto& target = (*Omega::instance().getScene()->bodies).*member;
					 target       = py::extract<std::decay_t<decltype(target)>>(value)();
				 } };
		};
		static const std::map<std::string, Access> accesses = {
			{ "Scene.dt", scene(&Scene::dt) },
			{ "Scene.iter", scene(&Scene::iter) },
			{ "Scene.subStepping", scene(&Scene::subStepping) },
			{ "Scene.subStep", scene(&Scene::subStep) },
			{ "Scene.time", scene(&Scene::time) },
			{ "Scene.speed", scene(&Scene::speed) },
			{ "Scene.stopAtIter", scene(&Scene::stopAtIter) },
			{ "Scene.stopAtTime", scene(&Scene::stopAtTime) },
			{ "Scene.isPeriodic", scene(&Scene::isPeriodic) },
			{ "Scene.trackEnergy", scene(&Scene::trackEnergy) },
			{ "Scene.doSort", scene(&Scene::doSort) },
			{ "Scene.runInternalConsistencyChecks", scene(&Scene::runInternalConsistencyChecks) },
			{ "Scene.selectedBody", scene(&Scene::selectedBody) },
			{ "Scene.subdomain", scene(&Scene::subdomain) },
			{ "Scene.tags", scene(&Scene::tags) },
			{ "Scene.engines", scene(&Scene::engines) },
			{ "Scene._nextEngines", scene(&Scene::_nextEngines) },
			{ "Scene.materials", scene(&Scene::materials) },
			{ "Scene.miscParams", scene(&Scene::miscParams) },
			{ "BodyContainer.body", bodies(&BodyContainer::body) },
			{ "BodyContainer.useRedirection", bodies(&BodyContainer::useRedirection) },
			{ "BodyContainer.enableRedirection", bodies(&BodyContainer::enableRedirection) },
			{ "BodyContainer.insertedBodies", bodies(&BodyContainer::insertedBodies) },
			{ "BodyContainer.erasedBodies", bodies(&BodyContainer::erasedBodies) },
			{ "BodyContainer.realBodies", bodies(&BodyContainer::realBodies) },
			{ "BodyContainer.subdomainBodies", bodies(&BodyContainer::subdomainBodies) },
			{ "BodyContainer.dirty", bodies(&BodyContainer::dirty) },
			{ "BodyContainer.checkedByCollider", bodies(&BodyContainer::checkedByCollider) },
			{ "ForceContainer.force0",
			  { [](py::object) {
				   ForceContainer& forces = Omega::instance().getScene()->forces;
				   forces.sync();
				   return py::object(Vector3r(forces.getForce(0)));
			   },
			    [](py::object, py::object value) {
				    Omega::instance().getScene()->forces.addForce(0, py::extract<Vector3r>(value)());
			    } } },
			{ "ForceContainer.torque0",
			  { [](py::object) {
				   ForceContainer& forces = Omega::instance().getScene()->forces;
				   forces.sync();
				   return py::object(Vector3r(forces.getTorque(0)));
			   },
			    [](py::object, py::object value) {
				    Omega::instance().getScene()->forces.addTorque(0, py::extract<Vector3r>(value)());
			    } } },
			{ "ForceContainer.permForce0",
			  { [](py::object) { return py::object(Vector3r(Omega::instance().getScene()->forces.getPermForce(0))); },
			    [](py::object, py::object value) {
				    Omega::instance().getScene()->forces.setPermForce(0, py::extract<Vector3r>(value)());
			    } } },
			{ "EnergyTracker.probe",
			  { [](py::object) { return py::object(Omega::instance().getScene()->energy->getItem_py("probe")); },
			    [](py::object, py::object value) {
				    Omega::instance().getScene()->energy->setItem_py("probe", py::extract<Real>(value)());
			    } } },
		};
		return accesses;
	}
	// clang-format on

	const Access& find(const std::string& name)
	{
		for (const auto* accesses : { &table(), &sceneTable() })
			if (const auto found = accesses->find(name); found != accesses->end()) return found->second;
		throw std::invalid_argument("no attribute " + name + " in the probe's tables");
	}

} // namespace

void ProbePeriodic::action() { runs++; }

void ProbeEngine::action()
{
	if (!failWith.empty()) throw std::runtime_error(failWith);
	steps++;
	scratch = scene->dt;
	for (const auto& body : *scene->bodies)
		if (auto* state = dynamic_cast<ProbeState*>(body->state.get())) state->volume += 1;
}

void ProbeEngine::postLoad(ProbeEngine&) { postLoads++; }
void ProbeEngine::preSave(ProbeEngine&) { preSaves++; }
void ProbeEngine::postSave(ProbeEngine&) { postSaves++; }

py::object ProbeEngine::read(py::object object, const std::string& name) { return find(name).get(object); }
void       ProbeEngine::write(py::object object, const std::string& name, py::object value) { find(name).set(object, value); }

py::list ProbeEngine::attributesOf(const std::string& className)
{
	py::list names;
	for (const auto* accesses : { &table(), &sceneTable() })
		for (const auto& entry : *accesses)
			if (entry.first.rfind(className + ".", 0) == 0) names.append(entry.first.substr(className.size() + 1));
	return names;
}

std::string ProbeEngine::versionMismatch(const std::string& builtFor, const std::string& running) { return yade::versionMismatch(builtFor, running); }

std::string ProbeEngine::layoutMismatch(const std::string& className, int extraSize, int extraVtableSize)
{
	auto expected = expectedClasses();
	for (auto& cls : expected)
		if (cls.name == className) {
			cls.size += extraSize;
			cls.vtableSize += extraVtableSize;
		}
	return yade::layoutMismatch(expected);
}

Real ProbeEngine::secondsOfLoadCheck()
{
	const auto start = std::chrono::steady_clock::now();
	yade::layoutMismatch();
	return std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
}

bool ProbeEngine::sceneIsOmegas() { return scene && scene == Omega::instance().getScene().get(); }

py::list ProbeEngine::liveBodyIds()
{
	py::list ids;
	for (const auto& body : *Omega::instance().getScene()->bodies)
		ids.append(body->getId());
	return ids;
}

} // namespace yade
