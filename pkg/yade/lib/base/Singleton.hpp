// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/* In the global namespace, as in the library, which holds the instances and exports instance(). */
template <class T> class Singleton {
public:
	static T& instance();
	Singleton(const Singleton&)            = delete;
	Singleton& operator=(const Singleton&) = delete;

protected:
	Singleton();
};
