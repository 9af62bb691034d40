// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace yade {

/* The one form of complaint about an attribute: object, attribute, value, remedy. */
template <class Value> [[noreturn]] void refuse(const std::string& object, const std::string& attribute, const Value& value, const std::string& remedy)
{
	std::ostringstream text;
	text << object << "." << attribute << " = " << value << ": " << remedy;
	throw std::runtime_error(text.str());
}
template <class Value> void require(bool good, const std::string& object, const std::string& attribute, const Value& value, const std::string& remedy)
{
	if (!good) refuse(object, attribute, value, remedy);
}

} // namespace yade
