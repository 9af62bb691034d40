// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>

/* YADE_PLUGIN((ClassA)(ClassB)) stands inside namespace yade of one source file, after the classes' definitions. It registers them
in a YADE that they fit, and leaves the namespace for a moment because Boost's export macros open namespace boost. The including
header defines YADE_PLUGIN_DETAIL_FACTORY and YADE_PLUGIN_DETAIL_PYTHON, the code of each class that YADE's own headers have already. */
#define YADE_PLUGIN_DETAIL_NAME(r, data, cls) BOOST_PP_STRINGIZE(cls),
#define YADE_PLUGIN_DETAIL_EXPORT(r, data, cls) BOOST_CLASS_EXPORT_IMPLEMENT(yade::cls)
#define YADE_PLUGIN(classes)                                                                                                                                   \
	namespace {                                                                                                                                            \
	__attribute__((constructor)) void registerClassesOfThisFile()                                                                                          \
	{                                                                                                                                                      \
		if (!pluginFitsRunningYade()) return;                                                                                                          \
		const char* fileAndClasses[] = { __FILE__, BOOST_PP_SEQ_FOR_EACH(YADE_PLUGIN_DETAIL_NAME, ~, classes) nullptr };                               \
		Singleton<ClassFactory>::instance().registerPluginClasses(fileAndClasses);                                                                     \
		BOOST_PP_SEQ_FOR_EACH(YADE_PLUGIN_DETAIL_FACTORY, ~, classes)                                                                                  \
	}                                                                                                                                                      \
	}                                                                                                                                                      \
	BOOST_PP_SEQ_FOR_EACH(YADE_PLUGIN_DETAIL_PYTHON, ~, classes)                                                                                           \
	}                                                                                                                                                      \
	BOOST_PP_SEQ_FOR_EACH(YADE_PLUGIN_DETAIL_EXPORT, ~, classes)                                                                                           \
	namespace yade {
