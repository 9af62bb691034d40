// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <boost/serialization/export.hpp>
#include <lib/base/Singleton.hpp>
#include <lib/factory/Factorable.hpp>
#include <string>

namespace yade {

/* Only reached through Singleton<ClassFactory>::instance(): its members stay unknown. */
class ClassFactory : public Singleton<ClassFactory> {
public:
	using CreateFactorable       = Factorable* (*)();
	using CreateSharedFactorable = shared_ptr<Factorable> (*)();
	using CreatePureCustom       = void* (*)();

	bool registerFactorable(std::string name, CreateFactorable, CreateSharedFactorable, CreatePureCustom);
	void registerPluginClasses(const char* fileAndClasses[]);

	shared_ptr<Factorable> createShared(std::string name);
	Factorable*            createPure(std::string name);
};

/* Defined in PluginLoad.cpp: whether the running YADE is the one that these declarations describe. If not, it has said so
on stderr, once, and the classes of the plugin must stay unregistered. */
bool pluginFitsRunningYade();

template <class T> void registerPluginClass(const char* name)
{
	Singleton<ClassFactory>::instance().registerFactorable(
		name, [] { return static_cast<Factorable*>(new T); }, [] { return shared_ptr<Factorable>(new T); }, [] { return static_cast<void*>(new T); });
}

} // namespace yade

#define YADE_PLUGIN_DETAIL_FACTORY(r, data, cls) registerPluginClass<cls>(BOOST_PP_STRINGIZE(cls));
#define YADE_PLUGIN_DETAIL_PYTHON(r, data, cls)                                                                                                                \
	void cls::pyRegisterClass(::boost::python::object scope) { registerInPython<cls>(scope); }
#include "../../load/PluginClasses.hpp"
