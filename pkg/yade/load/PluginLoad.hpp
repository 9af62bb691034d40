// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace yade {

/* What the declarations say about a class that the running library has. */
struct ExpectedClass {
	const char* name;
	std::size_t size;       // of an object
	std::size_t vtableSize; // in bytes, as the library's symbol table has it; 0: not looked at
};
const std::vector<ExpectedClass>& expectedClasses();

/* Both return an empty string, or one sentence telling what differs. */
std::string versionMismatch(const std::string& builtFor, const std::string& running);
std::string layoutMismatch(const std::vector<ExpectedClass>& expected = expectedClasses());

/* Folder that the plugin was loaded from, without following symbolic links. */
std::string pluginFolder();

/* Whether the running YADE is the one that the plugin was built for. If not, it has said so on stderr, once, and the classes
of the plugin must stay unregistered. */
bool pluginFitsRunningYade();

} // namespace yade

#ifndef YADE_DECLARED_VERSION
/* With YADE's own headers: their YADE_PLUGIN, used after this file, would register the classes in any case. */
#	include <lib/factory/ClassFactory.hpp>
#	undef YADE_PLUGIN
#	define YADE_PLUGIN_DETAIL_FACTORY(r, data, cls)
#	define YADE_PLUGIN_DETAIL_PYTHON(r, data, cls)
#	include "PluginClasses.hpp"
#endif
