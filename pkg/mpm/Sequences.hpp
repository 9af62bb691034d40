// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <boost/python.hpp>
#include <boost/shared_ptr.hpp>
#include <new>
#include <utility>
#include <vector>

namespace yade {

/* Python lists and tuples for an attribute of type std::vector<boost::shared_ptr<T>>. YADE has conversions for vectors of
its own classes, none for those of a plugin's. Stands among the definitions of the class with such an attribute:
.def(Sequences<MpmWall>("MpmEngine.walls")), with the attribute's name for messages. An element that is None becomes an empty
pointer; one of another class is a TypeError. */
template <class T> class Sequences : public boost::python::def_visitor<Sequences<T>> {
	using Vector                   = std::vector<boost::shared_ptr<T>>;
	static inline const char* name = "";

	struct ToPython {
		static PyObject* convert(const Vector& vector)
		{
			boost::python::list list;
			for (const auto& item : vector)
				list.append(item);
			return boost::python::incref(list.ptr());
		}
	};
	static void* convertible(PyObject* object) { return object; } // construct() has the better message
	static void  construct(PyObject* object, boost::python::converter::rvalue_from_python_stage1_data* data)
	{
		if (!PyList_Check(object) && !PyTuple_Check(object)) {
			PyErr_Format(PyExc_TypeError, "%s = %R: give a list of objects of class %s", name, object, T().getClassName().c_str());
			boost::python::throw_error_already_set();
		}
		const boost::python::object sequence { boost::python::handle<>(boost::python::borrowed(object)) };
		Vector                      items;
		for (boost::python::ssize_t i = 0, n = boost::python::len(sequence); i < n; i++) {
			const boost::python::object                        item = sequence[i];
			const boost::python::extract<boost::shared_ptr<T>> pointer(item);
			if (!pointer.check()) {
				PyErr_Format(PyExc_TypeError, "%s[%zd] = %R: give objects of class %s", name, i, item.ptr(), T().getClassName().c_str());
				boost::python::throw_error_already_set();
			}
			items.push_back(pointer());
		}
		void* const storage = reinterpret_cast<boost::python::converter::rvalue_from_python_storage<Vector>*>(data)->storage.bytes;
		data->convertible   = new (storage) Vector(std::move(items));
	}

public:
	explicit Sequences(const char* attribute) { name = attribute; }

private:
	friend class boost::python::def_visitor_access;
	template <class Class> void visit(Class&) const
	{
		namespace converter = boost::python::converter;
		const auto* known   = converter::registry::query(boost::python::type_id<Vector>());
		if (!known || !known->m_to_python) boost::python::to_python_converter<Vector, ToPython>();
		if (!known || !known->rvalue_chain) converter::registry::push_back(&convertible, &construct, boost::python::type_id<Vector>());
	}
};

} // namespace yade
