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
/* Texts become strings only where there is something to complain of: this is asked at every step. */
template <class Object, class Attribute, class Value, class Remedy>
void require(bool good, const Object& object, const Attribute& attribute, const Value& value, const Remedy& remedy)
{
	if (!good) refuse(object, attribute, value, remedy);
}
/* The one form of complaint about a saved scene; fault names object and attribute. */
[[noreturn]] inline void refuseDamaged(const std::string& fault) { throw std::runtime_error(fault + ": the saved scene is damaged; load another copy of it"); }

} // namespace yade
