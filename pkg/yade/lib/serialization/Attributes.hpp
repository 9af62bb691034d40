// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/* What the class macros of Serializable.hpp expand to: attributes as Python sees them. */
#include <boost/mpl/vector.hpp>
#include <boost/python.hpp>
#include <lib/base/Math.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace yade {

namespace Attr {
	enum Flags {
		noSave          = 1,
		readonly        = 2,
		triggerPostLoad = 4,
		hidden          = 8,
		noResize        = 16,
	};
}

template <class T> struct IsEigen : std::is_base_of<Eigen::EigenBase<T>, T> {
};
template <class T> struct IsEigen<Eigen::Quaternion<T>> : std::true_type {
};
template <class T> struct IsVector : std::false_type {
};
template <class T> struct IsVector<std::vector<T>> : std::true_type {
};

template <class T> void setAttribute(T& attribute, const boost::python::object& value) { attribute = boost::python::extract<T>(value)(); }

/* As in YADE, a matrix or vector is handed out by reference (x.gravity[2] = -9.81 works) unless it is read-only; everything
else by value. */
template <int flags, class Class, class Self, class T>
void exposeAttribute(Class& pythonClass, const char* name, T Self::*member, const std::string& docAndType)
{
	namespace py = boost::python;
	if constexpr (flags & Attr::hidden)
		return;
	else {
		const std::string doc    = docAndType + " :yattrflags:`" + std::to_string(flags) + "` ";
		const py::object  getter = [&] {
                        if constexpr (IsEigen<T>::value && !(flags & Attr::readonly))
                                return py::make_getter(member, py::return_internal_reference<>());
                        else
                                return py::make_getter(member, py::return_value_policy<py::return_by_value>());
		}();
		if constexpr (flags & Attr::readonly) {
			pythonClass.add_property(name, getter, doc.c_str());
		} else {
			const auto set = [member](Self& self, const T& value) {
				if constexpr (IsVector<T>::value && (flags & Attr::noResize))
					if (value.size() != (self.*member).size()) throw std::length_error("the number of items of this attribute is fixed");
				self.*member = value;
				if constexpr (flags & Attr::triggerPostLoad) self.callPostLoad();
			};
			const py::object setter = py::make_function(set, py::default_call_policies(), boost::mpl::vector3<void, Self&, const T&>());
			pythonClass.add_property(name, getter, setter, doc.c_str());
		}
	}
}

/* __init__(self, attribute=value, ...) */
template <class T> boost::python::object initFromKeywords(boost::python::tuple selfAndArgs, boost::python::dict keywords)
{
	namespace py = boost::python;
	using Holder = py::objects::pointer_holder<boost::shared_ptr<T>, T>;

	const py::object     self = selfAndArgs[0];
	py::tuple            args(selfAndArgs.slice(1, py::len(selfAndArgs)));
	boost::shared_ptr<T> instance(new T);
	instance->pyHandleCustomCtorArgs(args, keywords);
	if (const auto n = py::len(args); n > 0) {
		throw std::runtime_error(instance->getClassName() + " takes its attributes as keywords, " + instance->getClassName() + "(name=value, ...); got "
					 + std::to_string(n) + " argument" + (n > 1 ? "s" : "") + " without a name.");
	}
	if (py::len(keywords) > 0) instance->pyUpdateAttrs(keywords); // which calls callPostLoad too

	void* const memory = Holder::allocate(self.ptr(), offsetof(py::objects::instance<Holder>, storage), sizeof(Holder));
	try {
		(new (memory) Holder(instance))->install(self.ptr());
	} catch (...) {
		Holder::deallocate(self.ptr(), memory);
		throw;
	}
	return py::object();
}

} // namespace yade
