// SPDX-License-Identifier: GPL-2.0-or-later
/* Runs when YADE loads the plugin, before any class registers: makes sure that the running YADE is the one that the plugin
was built for, and lets Python find the plugin's own modules as parts of the package yade. Compiled against the declarations
in pkg/yade or against YADE's own headers, like the rest of the plugin. */
#include <PluginLoad.hpp>

#include <algorithm>
#include <boost/python.hpp>
#include <core/Body.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/TimeStepper.hpp>
#include <cstring>
#include <dlfcn.h>
#include <iostream>
#include <link.h>
#include <malloc.h>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Sphere.hpp>

/* Set by CMake: the version that was installed when the plugin was configured, and the folder, beside the plugin, that holds
Python modules to be imported as yade.<module>. */
#ifndef YADE_PLUGIN_BUILT_FOR
#	error "YADE_PLUGIN_BUILT_FOR is not defined (link the CMake target yade::plugin)"
#endif
#ifndef YADE_PLUGIN_PYTHON_FOLDER
#	define YADE_PLUGIN_PYTHON_FOLDER "mpm-py"
#endif

namespace yade {

namespace {
	namespace py = ::boost::python;

	struct PythonLock {
		PyGILState_STATE state = PyGILState_Ensure();
		~PythonLock() { PyGILState_Release(state); }
	};

	std::string symbolOfVtable(const std::string& className) { return "_ZTVN4yade" + std::to_string(className.size()) + className + "E"; }

	/* A pointer to a virtual member function holds one more than the place of the function in the vtable, in bytes (the
	Itanium C++ ABI). */
	template <class Function> std::size_t placeInVtable(Function function)
	{
		static_assert(sizeof(Function) == 2 * sizeof(std::ptrdiff_t), "not a pointer to a member function of the Itanium C++ ABI");
		std::ptrdiff_t raw[2];
		std::memcpy(raw, &function, sizeof raw);
		return static_cast<std::size_t>(raw[0] - 1);
	}

	/* The vtable that the headers describe: two words and one for each virtual function. */
	template <class Function> std::size_t bytesOfVtable(Function last) { return 2 * sizeof(void*) + placeInVtable(last) + sizeof(void*); }

	/* In a class that is also an Indexable, incrementMaxCurrentlyUsedClassIndexOfKin(), which is protected, comes after
	getMaxCurrentlyUsedClassIndexOfKin(), and the base Indexable adds a table of its own: two words and its seven functions. */
	template <class Function> std::size_t bytesOfIndexableVtable(Function lastButOne)
	{
		return bytesOfVtable(lastButOne) + sizeof(void*) + 9 * sizeof(void*);
	}

	/* The allocator rounds a size up, and may hand out a somewhat larger block that was left over: the smallest of many tells
	how much was asked for. make() returns a new block each time. */
	template <class Make, class Free> std::size_t smallestBlock(std::size_t stopAt, const Make& make, const Free& free)
	{
		std::vector<void*> blocks;
		std::size_t        smallest = std::size_t(-1);
		while (blocks.size() < 64 && smallest > stopAt) {
			blocks.push_back(make());
			smallest = std::min(smallest, malloc_usable_size(blocks.back()));
		}
		for (void* block : blocks)
			free(block);
		return smallest;
	}

	/* Told to the allocator's rounding, 16 bytes. */
	bool objectHasSize(const char* className, std::size_t size)
	{
		const std::size_t wanted =
			smallestBlock((size + 23) / 16 * 16 - 8, [&] { return ::operator new(size); }, [](void* block) { ::operator delete(block); });
		const std::size_t found = smallestBlock(
			wanted, [&] { return static_cast<void*>(Singleton<ClassFactory>::instance().createPure(className)); },
			[](void* object) { delete static_cast<Factorable*>(object); });
		return found == wanted;
	}

	/* Sets an attribute by name, as Python does, and reads it through the declarations. */
	template <class T, class Value> bool readsBack(const char* className, const char* attribute, Value T::*member, const Value& value)
	{
		const auto object = boost::dynamic_pointer_cast<T>(Singleton<ClassFactory>::instance().createShared(className));
		if (!object) return false;
		object->pySetAttr(attribute, py::object(value));
		return (*object).*member == value;
	}

	std::string attributeMismatch()
	{
		const Real  number = 1234.5;
		std::string wrong;
		const auto  check = [&](bool good, const char* name) {
                        if (!good && wrong.empty()) wrong = name;
		};
		check(readsBack<Engine, std::string>("GlobalEngine", "label", &Engine::label, "probe"), "Engine.label");
		check(readsBack<PeriodicEngine, long>("PeriodicEngine", "nDone", &PeriodicEngine::nDone, 42), "PeriodicEngine.nDone");
		check(readsBack<State, Real>("State", "mass", &State::mass, number), "State.mass");
		check(readsBack<State, Real>("State", "densityScaling", &State::densityScaling, number), "State.densityScaling");
		check(readsBack<FrictMat, Real>("FrictMat", "density", &FrictMat::density, number), "Material.density");
		check(readsBack<FrictMat, Real>("FrictMat", "frictionAngle", &FrictMat::frictionAngle, number), "FrictMat.frictionAngle");
		check(readsBack<Sphere, Real>("Sphere", "radius", &Sphere::radius, number), "Sphere.radius");
		check(readsBack<Body, int>("Body", "groupMask", &Body::groupMask, 42), "Body.groupMask");
		check(readsBack<Body, Real>("Body", "timeBorn", &Body::timeBorn, number), "Body.timeBorn");
		check(readsBack<Scene, Real>("Scene", "stopAtTime", &Scene::stopAtTime, number), "Scene.stopAtTime");
		check(readsBack<Scene, bool>("Scene", "trackEnergy", &Scene::trackEnergy, true), "Scene.trackEnergy");
		return wrong;
	}

	std::string runningVersion()
	{
		const PythonLock lock;
		try {
			return py::extract<std::string>(py::import("yade.config").attr("version"))();
		} catch (const py::error_already_set&) {
			PyErr_Clear();
			return "of unknown version";
		}
	}

	/* Makes `from yade import <module>` look beside the plugin too. */
	void extendPackagePath(const std::string& refusal)
	{
		const PythonLock lock;
		try {
			py::object       package = py::import("sys").attr("modules")["yade"];
			const py::object path    = package.attr("__path__");
			const py::str    folder(pluginFolder() + "/" YADE_PLUGIN_PYTHON_FOLDER);
			if (!path.contains(folder)) path.attr("append")(folder);
			if (!refusal.empty()) package.attr("mpmRefusal") = refusal;
		} catch (const py::error_already_set&) {
			PyErr_Clear(); // loaded by something else than the Python package yade: nothing to extend
		}
	}
} // namespace

const std::vector<ExpectedClass>& expectedClasses()
{
	/* Looking up the size of a vtable takes the dynamic linker a search through all symbols of a library, so that a class
	stands for its bases. */
	static const std::vector<ExpectedClass> classes = {
		{ "Engine", sizeof(Engine), 0 },
		{ "GlobalEngine", sizeof(GlobalEngine), 0 },
		{ "PartialEngine", sizeof(PartialEngine), 0 },
		{ "PeriodicEngine", sizeof(PeriodicEngine), bytesOfVtable(&PeriodicEngine::action) },
		{ "TimeStepper", sizeof(TimeStepper), bytesOfVtable(&TimeStepper::computeTimeStep) },
		{ "Scene", sizeof(Scene), bytesOfVtable(&Scene::pyHandleCustomCtorArgs) },
		{ "Body", sizeof(Body), bytesOfVtable(&Body::userForcedDisplacementRedrawHook) },
		{ "BodyContainer", sizeof(BodyContainer), 0 },
		{ "State", sizeof(State), bytesOfIndexableVtable(&State::getMaxCurrentlyUsedClassIndexOfKin) },
		{ "Material", sizeof(Material), 0 },
		{ "ElastMat", sizeof(ElastMat), 0 },
		{ "FrictMat", sizeof(FrictMat), bytesOfIndexableVtable(&FrictMat::getMaxCurrentlyUsedClassIndexOfKin) },
		{ "Shape", sizeof(Shape), 0 },
		{ "Sphere", sizeof(Sphere), bytesOfIndexableVtable(&Sphere::getMaxCurrentlyUsedClassIndexOfKin) },
		{ "EnergyTracker", sizeof(EnergyTracker), 0 },
	};
	return classes;
}

std::string versionMismatch(const std::string& builtFor, const std::string& running)
{
	if (builtFor == running) return "";
	return "it was built for YADE " + builtFor + " and this is YADE " + running;
}

std::string layoutMismatch(const std::vector<ExpectedClass>& expected)
{
	for (const auto& cls : expected) {
		const std::string name = std::string("yade::") + cls.name;
		if (cls.vtableSize != 0) {
			void* const vtable = dlsym(RTLD_DEFAULT, symbolOfVtable(cls.name).c_str());
			Dl_info     info;
			ElfW(Sym)* symbol = nullptr;
			if (!vtable || !dladdr1(vtable, &info, reinterpret_cast<void**>(&symbol), RTLD_DL_SYMENT) || !symbol)
				return "this YADE has no class " + name;
			if (symbol->st_size != cls.vtableSize)
				return "in this YADE " + name + " has a vtable of " + std::to_string(symbol->st_size) + " bytes instead of "
				       + std::to_string(cls.vtableSize);
		}
		if (!objectHasSize(cls.name, cls.size))
			return "in this YADE a " + name + " does not have the expected size of " + std::to_string(cls.size) + " bytes";
	}
	const PythonLock lock;
	try {
		const std::string wrong = attributeMismatch();
		if (!wrong.empty()) return "in this YADE " + wrong + " lies elsewhere in memory than expected";
	} catch (const py::error_already_set&) {
		PyErr_Clear();
		return "this YADE lacks attributes that the plugin relies on";
	}
	return "";
}

std::string pluginFolder()
{
	Dl_info info;
	if (!dladdr(reinterpret_cast<void*>(&pluginFolder), &info) || !info.dli_fname) return ".";
	const std::string file(info.dli_fname);
	const auto        slash = file.rfind('/');
	return slash == std::string::npos ? "." : file.substr(0, slash);
}

bool pluginFitsRunningYade()
{
	static const bool fits = [] {
		std::string reason = versionMismatch(YADE_PLUGIN_BUILT_FOR, runningVersion());
		try {
			if (reason.empty()) reason = layoutMismatch();
		} catch (const std::exception& error) {
			reason = std::string("this YADE cannot be checked (") + error.what() + ")";
		}
		std::string refusal;
		if (!reason.empty()) {
			refusal = "yade-mpm: the plugin does not load because " + reason
				  + "; build it anew for this one, with its source tree if it is no release that pkg/yade declares (see its README).";
			std::cerr << refusal << std::endl;
		}
		extendPackagePath(refusal);
		return reason.empty();
	}();
	return fits;
}

} // namespace yade
