// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/* A plugin of YADE for tests only: one class of each kind that a plugin derives. */
#include "../../pkg/mpm/Sequences.hpp"
#include <core/GlobalEngine.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

class ProbeItem : public Serializable {
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ProbeItem, Serializable, "One of several things an engine holds.",
		((Vector3r, normal, Vector3r(0, 0, 1), , "A direction"))
		((std::string, kind, "plain", , "A word"))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ProbeItem);

class ProbeState : public State {
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ProbeState, State, "A state with a tensor.",
		((Matrix3r, stress, Matrix3r::Zero(), , "Stress [Pa]"))
		((Real, volume, 0, Attr::readonly, "Volume"))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ProbeState, State);
};
REGISTER_SERIALIZABLE(ProbeState);

class ProbeMat : public FrictMat {
public:
	shared_ptr<State> newAssocState() const override { return shared_ptr<State>(new ProbeState); }
	bool              stateTypeOk(State* state) const override { return dynamic_cast<ProbeState*>(state); }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ProbeMat, FrictMat, "A material with a state of its own.",
		((Real, yieldStress, 1e6, , "Yield stress [Pa]"))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ProbeMat, FrictMat);
};
REGISTER_SERIALIZABLE(ProbeMat);

class ProbePeriodic : public PeriodicEngine {
public:
	void action() override;
	YADE_CLASS_BASE_DOC_ATTRS(ProbePeriodic, PeriodicEngine, "Counts its runs.", ((long, runs, 0, , "How often it ran")));
};
REGISTER_SERIALIZABLE(ProbePeriodic);

class ProbeEngine : public GlobalEngine {
public:
	void action() override;
	void postLoad(ProbeEngine&);
	void preSave(ProbeEngine&);
	void postSave(ProbeEngine&);

	/* Through the declarations, an attribute named like "State.mass". */
	::boost::python::object read(::boost::python::object object, const std::string& name);
	void                    write(::boost::python::object object, const std::string& name, ::boost::python::object value);
	::boost::python::list   attributesOf(const std::string& className);
	std::string             versionMismatch(const std::string& builtFor, const std::string& running);
	std::string             layoutMismatch(const std::string& className, int extraSize, int extraVtableSize);
	Real                    secondsOfLoadCheck();
	bool                    sceneIsOmegas();
	::boost::python::list   liveBodyIds();

	Vector3r notAnAttribute;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(ProbeEngine, GlobalEngine, "Reads and writes what the declarations name.",
		((bool, flag, false, , "A flag"))
		((int, count, 3, , "A number of things"))
		((long, steps, 0, Attr::readonly, "Steps done"))
		((Real, size, 1.5, , "A size [m]"))
		((std::string, word, "cubic", , "A word"))
		((Vector3r, gravity, Vector3r(0, 0, -9.81), , "A vector"))
		((Vector3i, cells, Vector3i(1, 2, 3), , "Integers"))
		((Matrix3r, tensor, Matrix3r::Identity(), , "A matrix"))
		((Vector3r, reaction, Vector3r(1, 2, 3), Attr::readonly, "A vector that scripts only read"))
		((shared_ptr<ProbeItem>, item, , , "One object"))
		((vector<shared_ptr<ProbeItem>>, items, , , "Several objects"))
		((vector<Real>, reals, , , "Pack"))
		((vector<int>, ints, , , "Integers"))
		((Real, scratch, 7, Attr::noSave, "Not saved"))
		((Real, watched, 0, Attr::triggerPostLoad, "Setting it calls postLoad"))
		((int, inner, 11, Attr::hidden, "Saved, and not seen by Python"))
		((int, postLoads, 0, Attr::noSave, "How often postLoad ran"))
		((int, preSaves, 0, , "How often preSave ran"))
		((int, postSaves, 0, , "How often postSave ran"))
		((std::string, failWith, "", , "If not empty, action throws it"))
		,
		((notAnAttribute, Vector3r(4, 5, 6)))
		,
		count += 1;
		,
		.def(Sequences<ProbeItem>("ProbeEngine.items"))
		.def("read", &ProbeEngine::read)
		.def("write", &ProbeEngine::write)
		.def("attributesOf", &ProbeEngine::attributesOf)
		.def("versionMismatch", &ProbeEngine::versionMismatch)
		.def("layoutMismatch", &ProbeEngine::layoutMismatch)
		.def("secondsOfLoadCheck", &ProbeEngine::secondsOfLoadCheck)
		.def("sceneIsOmegas", &ProbeEngine::sceneIsOmegas)
		.def("liveBodyIds", &ProbeEngine::liveBodyIds)
		.def_readonly("notAnAttributeX", &ProbeEngine::inner)
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(ProbeEngine);

} // namespace yade
