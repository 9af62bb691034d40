// SPDX-License-Identifier: GPL-2.0-or-later
/* What pkg/yade declares, written down by the compiler: sizes, offsets, places of virtual functions in their vtables, types
of functions. This file is compiled twice, against pkg/yade and against YADE's own headers, and layout_headers.py compares the
two. Only constants are used here; nothing of YADE is called. Compiled with -fno-access-control. */
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Bound.hpp>
#include <core/EnergyTracker.hpp>
#include <core/ForceContainer.hpp>
#include <core/GlobalEngine.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/TimeStepper.hpp>
#include <core/Timing.hpp>
#include <cstddef>
#include <cstring>
#include <lib/factory/ClassFactory.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Sphere.hpp>
#include <sstream>
#include <string>
#include <typeinfo>

#pragma GCC diagnostic ignored "-Winvalid-offsetof"

// clang-format off: lists of names
namespace yade {
namespace {

	std::ostringstream lines;

	template <class Function> long slotOf(Function function)
	{
		std::ptrdiff_t raw[2];
		std::memcpy(raw, &function, sizeof raw);
		return raw[0] % 2 == 1 ? (raw[0] - 1) / long(sizeof(void*)) : -1; // -1: not virtual
	}

#define SIZE(cls) lines << "size " #cls " " << sizeof(cls) << "\n";
#define AT(cls, member) lines << "offset " #cls "." #member " " << offsetof(cls, member) << "\n";
#define SLOT(cls, function) lines << "slot " #cls "::" #function " " << slotOf(&cls::function) << "\n";
#define TYPE(cls, function) lines << "type " #cls "::" #function " " << typeid(&cls::function).name() << "\n";
#define OVERLOAD(cls, function, type) lines << "type " #cls "::" #function " " << typeid(static_cast<type>(&cls::function)).name() << "\n";

	void sizesAndOffsets()
	{
		SIZE(Factorable)
		SIZE(Serializable)
		SIZE(Indexable)
		SIZE(TimingInfo)
		AT(TimingInfo, nExec)
		AT(TimingInfo, nsec)
			SIZE(TimingDeltas) AT(TimingDeltas, last) AT(TimingDeltas, data) AT(TimingDeltas, labels) SIZE(Engine) AT(Engine, scene) AT(
				Engine, timingInfo) AT(Engine, timingDeltas) AT(Engine, dead) AT(Engine, ompThreads) AT(Engine,
				label) SIZE(GlobalEngine) SIZE(PartialEngine) AT(PartialEngine, ids) SIZE(PeriodicEngine) AT(PeriodicEngine,
				virtPeriod) AT(PeriodicEngine, realPeriod) AT(PeriodicEngine, iterPeriod) AT(PeriodicEngine, nDo) AT(PeriodicEngine,
				initRun) AT(PeriodicEngine, firstIterRun) AT(PeriodicEngine, virtLast) AT(PeriodicEngine, realLast) AT(PeriodicEngine,
				iterLast) AT(PeriodicEngine, nDone) SIZE(TimeStepper) AT(TimeStepper, active) AT(TimeStepper,
				timeStepUpdateInterval) SIZE(Material) AT(Material, id) AT(Material, label) AT(Material, density) SIZE(ElastMat) AT(ElastMat,
				young) AT(ElastMat, poisson) SIZE(FrictMat) AT(FrictMat, frictionAngle) SIZE(Shape) AT(Shape, boundFunctor) AT(Shape,
				internalforcefunctor) AT(Shape, color) AT(Shape, wire) AT(Shape, highlight) SIZE(Sphere) AT(Sphere, radius) SIZE(Bound)
				AT(Bound, lastUpdateIter) AT(Bound, refPos) AT(Bound, sweepLength) AT(Bound, color) AT(Bound, min) AT(Bound, max) SIZE(Se3r) AT(
					Se3r, position) AT(Se3r, orientation) SIZE(State) AT(State, updateMutex) AT(State, se3) AT(State, vel) AT(State, mass)
					AT(State, angVel) AT(State, angMom) AT(State, inertia) AT(State, refPos) AT(State, refOri) AT(
						State, blockedDOFs) AT(State, isDamped) AT(State, densityScaling) SIZE(IGeom) SIZE(IPhys) SIZE(Interaction)
						AT(Interaction, isActive) AT(Interaction, id1) AT(Interaction, id2) AT(Interaction, iterMadeReal) AT(
							Interaction, iterLastSeen) AT(Interaction, geom) AT(Interaction, phys) AT(Interaction, cellDist)
							AT(Interaction, linIx) AT(Interaction, iterBorn) SIZE(Body) AT(Body, id) AT(
								Body, groupMask) AT(Body, flags) AT(Body, subdomain) AT(Body,
								material) AT(Body, state) AT(Body, shape) AT(Body, bound) AT(Body, intrs) AT(Body, clumpId)
								AT(Body, iterBorn) AT(Body, timeBorn) SIZE(BodyContainer) AT(BodyContainer, body)
									AT(BodyContainer, dirty) AT(BodyContainer, checkedByCollider)
										AT(BodyContainer, insertedBodies) AT(BodyContainer, erasedBodies)
											AT(BodyContainer, realBodies) AT(BodyContainer, useRedirection)
												AT(BodyContainer, enableRedirection)
													AT(BodyContainer, subdomainBodies)
														AT(BodyContainer, drawloopmutex) lines
			<< "size BodyContainer::begin() " << sizeof(std::declval<BodyContainer&>().begin()) << "\n";
		SIZE(ForceContainer)
		SIZE(EnergyTracker)
		SIZE(Scene)
		AT(Scene, hostNameMax)
		AT(Scene, forces)
		AT(Scene, SpeedElements)
		AT(Scene, renderer) AT(Scene, prevTime) AT(Scene, dt) AT(Scene, iter) AT(Scene, subStepping) AT(Scene, subStep) AT(Scene, time) AT(Scene, speed)
			AT(Scene, stopAtIter) AT(Scene, stopAtTime) AT(Scene, isPeriodic) AT(Scene, trackEnergy) AT(Scene, doSort)
				AT(Scene, runInternalConsistencyChecks) AT(Scene, selectedBody) AT(Scene, subdomain) AT(Scene, subD) AT(Scene, tags)
					AT(Scene, engines) AT(Scene, _nextEngines) AT(Scene, bodies) AT(Scene, interactions) AT(Scene, energy)
						AT(Scene, materials) AT(Scene, bound) AT(Scene, cell) AT(Scene, miscParams) AT(Scene, dispParams)
	}

#define EVERY_CLASS(cls)                                                                                                                                       \
	SLOT(cls, getBaseClassName)                                                                                                                            \
	SLOT(cls, getBaseClassNumber)                                                                                                                          \
	SLOT(cls, getClassName)                                                                                                                                \
	SLOT(cls, pySetAttr)                                                                                                                                   \
	SLOT(cls, pyDict)                                                                                                                                      \
	SLOT(cls, pyDictCustom) SLOT(cls, callPostLoad) SLOT(cls, checkPyClassRegistersItself) SLOT(cls, pyRegisterClass) SLOT(cls, pyHandleCustomCtorArgs)
#define EVERY_INDEXABLE(cls)                                                                                                                                   \
	EVERY_CLASS(cls)                                                                                                                                       \
	SLOT(cls, modifyClassIndex)                                                                                                                            \
	SLOT(cls, getClassIndex) SLOT(cls, getBaseClassIndex) SLOT(cls, getMaxCurrentlyUsedClassIndexOfKin) SLOT(cls, incrementMaxCurrentlyUsedClassIndexOfKin)

	void slots()
	{
		SLOT(Factorable, getBaseClassName)
		SLOT(Factorable, getBaseClassNumber)
		SLOT(Factorable, getClassName)
		EVERY_CLASS(Serializable)
		EVERY_CLASS(Engine)
		EVERY_CLASS(GlobalEngine)
		EVERY_CLASS(PartialEngine) EVERY_CLASS(PeriodicEngine) EVERY_CLASS(TimeStepper) EVERY_CLASS(Interaction) EVERY_CLASS(Body)
			EVERY_CLASS(BodyContainer) EVERY_CLASS(EnergyTracker) EVERY_CLASS(Scene) EVERY_INDEXABLE(Material) EVERY_INDEXABLE(ElastMat)
				EVERY_INDEXABLE(FrictMat) EVERY_INDEXABLE(Shape) EVERY_INDEXABLE(Sphere) EVERY_INDEXABLE(Bound) EVERY_INDEXABLE(State)
					EVERY_INDEXABLE(IGeom) EVERY_INDEXABLE(IPhys) SLOT(Indexable, incrementMaxCurrentlyUsedClassIndexOfKin)
						SLOT(Indexable, modifyClassIndex) SLOT(Indexable, getClassIndex) SLOT(Indexable, getBaseClassIndex)
							SLOT(Indexable, getMaxCurrentlyUsedClassIndexOfKin) SLOT(Engine, isActivated) SLOT(Engine, action)
								SLOT(PeriodicEngine, isActivated) SLOT(TimeStepper, isActivated) SLOT(TimeStepper, action)
									SLOT(TimeStepper, computeTimeStep) SLOT(Material, newAssocState)
										SLOT(Material, stateTypeOk) SLOT(Body, userForcedDisplacementRedrawHook)
	}

	void types()
	{
		TYPE(Factorable, getBaseClassName)
		TYPE(Factorable, getBaseClassNumber)
		TYPE(Factorable, getClassName)
		TYPE(Serializable, pySetAttr)
		TYPE(Serializable, pyDict)
		TYPE(Serializable, pyDictCustom)
		TYPE(Serializable, callPostLoad) TYPE(Serializable, checkPyClassRegistersItself) TYPE(Serializable, pyRegisterClass) TYPE(
			Serializable, pyHandleCustomCtorArgs) TYPE(Serializable, pyUpdateAttrs) TYPE(Serializable, pyStr) TYPE(Indexable,
			createIndex) TYPE(Indexable, incrementMaxCurrentlyUsedClassIndexOfKin) TYPE(Indexable, modifyClassIndex) TYPE(Indexable,
			getClassIndex) TYPE(Indexable, getBaseClassIndex) TYPE(Indexable, getMaxCurrentlyUsedClassIndexOfKin) TYPE(ClassFactory,
			registerFactorable) TYPE(ClassFactory, registerPluginClasses) TYPE(ClassFactory, createShared) TYPE(ClassFactory,
			createPure) TYPE(Engine, isActivated) TYPE(Engine, action) TYPE(PeriodicEngine, isActivated) TYPE(TimeStepper,
			computeTimeStep) TYPE(TimingDeltas, start) TYPE(TimingDeltas, checkpoint) TYPE(Material, newAssocState) TYPE(Material,
			stateTypeOk) OVERLOAD(Material, byId, const shared_ptr<Material> (*)(int, Scene*)) OVERLOAD(Material, byLabel,
			const shared_ptr<Material> (*)(const std::string&, Scene*)) TYPE(State, axisDOF) TYPE(State, blockedDOFs_vec_get) TYPE(State,
			blockedDOFs_vec_set) TYPE(Interaction, isReal) TYPE(Interaction, getId1) TYPE(Interaction, getId2) TYPE(Body,
			userForcedDisplacementRedrawHook) TYPE(Body, getId) TYPE(Body, isClump) TYPE(Body, isClumpMember) TYPE(Body, isStandalone) TYPE(Body,
			isDynamic) TYPE(Body, isBounded) TYPE(Body, isAspherical) TYPE(Body, setDynamic) TYPE(Body, setBounded) TYPE(Body, setAspherical)
			TYPE(Body, maskOk) TYPE(Body, maskCompatible) OVERLOAD(Body, byId, const shared_ptr<Body>& (*)(Body::id_t, Scene*)) TYPE(
				BodyContainer, insert) TYPE(BodyContainer, erase) TYPE(BodyContainer, clear) TYPE(BodyContainer, exists)
				TYPE(BodyContainer, size) OVERLOAD(BodyContainer, operator[], shared_ptr<Body> & (BodyContainer::*)(unsigned int)) OVERLOAD(
					BodyContainer, operator[], const shared_ptr<Body>& (BodyContainer::*)(unsigned int) const) TYPE(ForceContainer, sync)
					TYPE(ForceContainer, ensureSynced) TYPE(ForceContainer, getForce) TYPE(ForceContainer, getTorque) TYPE(ForceContainer,
						getPermForce) TYPE(ForceContainer, getPermTorque) TYPE(ForceContainer, addForce) TYPE(ForceContainer, addTorque)
						TYPE(ForceContainer, setPermForce) TYPE(ForceContainer, setPermTorque) TYPE(ForceContainer, addMaxId)
							TYPE(ForceContainer, reset) TYPE(ForceContainer, getPermForceUsed) TYPE(EnergyTracker, setItem_py)
								TYPE(EnergyTracker, getItem_py) TYPE(EnergyTracker, clear) TYPE(EnergyTracker, total)
									TYPE(EnergyTracker, keys_py) TYPE(Scene, moveToNextTimeStep) TYPE(Scene, engineByName)
										TYPE(Scene, timeStepperPresent) TYPE(Scene, timeStepperActive)
											TYPE(Scene, timeStepperActivate) TYPE(Omega, getScene)
												TYPE(Omega, isRunning) TYPE(Omega, pause)
													TYPE(Omega, isInheritingFrom)
	}

	/* Values of the enumerators that pkg/yade repeats. */
	void values()
	{
		for (const unsigned value : { unsigned(State::DOF_NONE), unsigned(State::DOF_X), unsigned(State::DOF_Y), unsigned(State::DOF_Z),
			     unsigned(State::DOF_RX), unsigned(State::DOF_RY), unsigned(State::DOF_RZ), unsigned(State::DOF_ALL), unsigned(State::DOF_XYZ),
			     unsigned(State::DOF_RXRYRZ) })
			lines << "value State::DOF " << value << "\n";
		lines << "value Body::FLAG_BOUNDED " << int(Body::FLAG_BOUNDED) << "\nvalue Body::FLAG_ASPHERICAL " << int(Body::FLAG_ASPHERICAL)
		      << "\nvalue Body::ID_NONE " << long(Body::ID_NONE) << "\n";
		for (const int flag : { int(Attr::noSave), int(Attr::readonly), int(Attr::triggerPostLoad), int(Attr::hidden), int(Attr::noResize) })
			lines << "value Attr " << flag << "\n";
	}

} // namespace
} // namespace yade

extern "C" __attribute__((visibility("default"))) const char* layoutOfYade()
{
	static const std::string all = [] {
		yade::sizesAndOffsets();
		yade::slots();
		yade::types();
		yade::values();
		return yade::lines.str();
	}();
	return all.c_str();
}
