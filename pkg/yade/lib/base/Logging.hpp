// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <iostream>

/* YADE logs through Boost.Log with a filter per class; here a message goes to stderr with its place. */
#define YADE_LOG_TO_STDERR(level, msg)                                                                                                                         \
	do {                                                                                                                                                   \
		std::cerr << "<" level "> " << __FILE__ << ":" << __LINE__ << " " << __func__ << ": " << msg << std::endl;                                     \
	} while (false)
#define LOG_WARN(msg) YADE_LOG_TO_STDERR("WARNING", msg)
#define LOG_ERROR(msg) YADE_LOG_TO_STDERR("ERROR", msg)
#define LOG_FATAL(msg) YADE_LOG_TO_STDERR("FATAL ERROR", msg)
#define LOG_INFO(msg)
#define LOG_DEBUG(msg)
#define LOG_TRACE(msg)
#define DECLARE_LOGGER
#define CREATE_LOGGER(cls)
