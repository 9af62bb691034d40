// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python.hpp>
#include <string>

namespace yade {

/* repr() and str() of an object as a script would make it: MpmWall(normal=Vector3(1,0,0)), the class and what is not as it comes.
.def(AsWritten()) in a class' chain. */
class AsWritten : public ::boost::python::def_visitor<AsWritten> {
public:
	template <class Class> void visit(Class& pythonClass) const
	{
		using T = typename Class::wrapped_type;
		pythonClass.def("__repr__", &text<T>).def("__str__", &text<T>);
	}

private:
	template <class T> static std::string text(const T& object)
	{
		namespace py       = ::boost::python;
		const py::dict own = object.pyDict(), fresh = T().pyDict();
		const py::list names = own.keys();
		const auto     shown = [](const py::dict& attributes, const py::object& name) {
                        return std::string(py::extract<std::string>(attributes[name].attr("__repr__")()));
		};
		std::string list;
		for (py::ssize_t k = 0, n = py::len(names); k < n; ++k) {
			const std::string value = shown(own, names[k]);
			if (value != shown(fresh, names[k])) list += (list.empty() ? "" : ", ") + std::string(py::extract<std::string>(names[k])) + "=" + value;
		}
		return object.getClassName() + "(" + list + ")";
	}
};

} // namespace yade
