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

template <class T> struct IsPointers : std::false_type {
};
template <class T> struct IsPointers<std::vector<boost::shared_ptr<T>>> : std::true_type {
};

/* Sequences of the plugin's own objects. YADE registers conversions for vectors of its own classes, numbers and strings,
nobody does for vectors of shared_ptr<ClassOfThePlugin>. */
template <class Vector> struct VectorConverter {
};
template <class T> struct VectorConverter<std::vector<boost::shared_ptr<T>>> {
	using Vector = std::vector<boost::shared_ptr<T>>;
	static PyObject* convert(const Vector& vector)
	{
		boost::python::list list;
		for (const auto& item : vector)
			list.append(item);
		return boost::python::incref(list.ptr());
	}
	static void* convertible(PyObject* object) { return PyList_Check(object) || PyTuple_Check(object) ? object : nullptr; }
	static void  construct(PyObject* object, boost::python::converter::rvalue_from_python_stage1_data* data)
	{
		const Vector items = read(boost::python::object(boost::python::handle<>(boost::python::borrowed(object))), "list");
		void* const  storage
			= reinterpret_cast<boost::python::converter::rvalue_from_python_storage<Vector>*>(data)->storage.bytes;
		data->convertible = new (storage) Vector(items);
	}
	/* The objects of a list or tuple; name, of the attribute that they are meant for, is used in the complaint of one of another class. */
	static Vector read(const boost::python::object& sequence, const std::string& name)
	{
		Vector items;
		if (!convertible(sequence.ptr())) {
			PyErr_Format(PyExc_TypeError, "%s = %R: give a list of objects of class %s", name.c_str(), sequence.ptr(), T().getClassName().c_str());
			boost::python::throw_error_already_set();
		}
		for (boost::python::ssize_t i = 0, n = boost::python::len(sequence); i < n; i++) {
			const boost::python::object                       item = sequence[i];
			const boost::python::extract<boost::shared_ptr<T>> itself(item);
			if (!itself.check()) {
				PyErr_Format(PyExc_TypeError, "%s[%zd] = %R: give objects of class %s", name.c_str(), i, item.ptr(), T().getClassName().c_str());
				boost::python::throw_error_already_set();
			}
			items.push_back(itself());
		}
		return items;
	}
	static void registerOnce()
	{
		const auto* known = boost::python::converter::registry::query(boost::python::type_id<Vector>());
		if (!known || !known->m_to_python) boost::python::to_python_converter<Vector, VectorConverter>();
		if (!known || !known->rvalue_chain)
			boost::python::converter::registry::push_back(&convertible, &construct, boost::python::type_id<Vector>());
	}
};
template <class T> void registerConverter(const T*) { }
template <class T> void registerConverter(const std::vector<boost::shared_ptr<T>>*) { VectorConverter<std::vector<boost::shared_ptr<T>>>::registerOnce(); }

template <class T> void setAttribute(T& attribute, const boost::python::object& value, const std::string&) { attribute = boost::python::extract<T>(value)(); }
template <class T> void setAttribute(std::vector<boost::shared_ptr<T>>& attribute, const boost::python::object& value, const std::string& name)
{
	attribute = VectorConverter<std::vector<boost::shared_ptr<T>>>::read(value, name);
}

/* As in YADE, a matrix or vector is handed out by reference (x.gravity[2] = -9.81 works) unless it is read-only; everything
else by value. */
template <int flags, class Class, class Self, class T>
void exposeAttribute(Class& pythonClass, const char* name, T Self::*member, const std::string& docAndType)
{
	namespace py = boost::python;
	if constexpr (flags & Attr::hidden) return;
	else {
		registerConverter(static_cast<const T*>(nullptr));
		const std::string doc    = docAndType + " :yattrflags:`" + std::to_string(flags) + "` ";
		const py::object  getter = [&] {
                        if constexpr (IsEigen<T>::value && !(flags & Attr::readonly)) return py::make_getter(member, py::return_internal_reference<>());
                        else
                                return py::make_getter(member, py::return_value_policy<py::return_by_value>());
		}();
		if constexpr (flags & Attr::readonly) {
			pythonClass.add_property(name, getter, doc.c_str());
		} else {
			using Given    = std::conditional_t<IsPointers<T>::value, py::object, T>;
			const auto set = [member, attribute = std::string(name)](Self& self, const Given& given) {
				T value {};
				if constexpr (IsPointers<T>::value) setAttribute(value, given, self.getClassName() + "." + attribute);
				else
					value = given;
				if constexpr (IsVector<T>::value && (flags & Attr::noResize))
					if (value.size() != (self.*member).size()) throw std::length_error("the number of items of this attribute is fixed");
				self.*member = value;
				if constexpr (flags & Attr::triggerPostLoad) self.callPostLoad();
			};
			const py::object setter = py::make_function(set, py::default_call_policies(), boost::mpl::vector3<void, Self&, const Given&>());
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
		throw std::runtime_error(
		        instance->getClassName() + " takes its attributes as keywords, " + instance->getClassName() + "(name=value, ...); got "
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
