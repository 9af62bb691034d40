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

} // namespace yade
