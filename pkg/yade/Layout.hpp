// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>

/* offsetof of a class that is not standard-layout is conditionally supported; GCC supports it for every class without
virtual bases, which is all there is here, and warns nonetheless. */
#define YADE_LAYOUT_OFFSET(cls, member, offset)                                                                                                                \
	_Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Winvalid-offsetof\"") static_assert(                                                 \
		offsetof(cls, member) == (offset), #cls "::" #member " is not where the installed YADE has it");                                               \
	_Pragma("GCC diagnostic pop")

#define YADE_LAYOUT_SIZE(cls, size) static_assert(sizeof(cls) == (size), #cls " has not the size it has in the installed YADE");
