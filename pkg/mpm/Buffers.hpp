// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <boost/python.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace yade {

/* A contiguous array of doubles that Python hands in, for as long as this object lives. */
class DoubleBuffer {
public:
	explicit DoubleBuffer(const ::boost::python::object& object)
	{
		if (PyObject_GetBuffer(object.ptr(), &m_view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) ::boost::python::throw_error_already_set();
		if (std::string(m_view.format ? m_view.format : "") != "d") {
			PyBuffer_Release(&m_view);
			throw std::invalid_argument("expected a contiguous array of float64");
		}
	}
	~DoubleBuffer() { PyBuffer_Release(&m_view); }
	DoubleBuffer(const DoubleBuffer&)            = delete;
	DoubleBuffer& operator=(const DoubleBuffer&) = delete;
	const double* data() const { return static_cast<const double*>(m_view.buf); }
	std::size_t   size() const { return std::size_t(m_view.len) / sizeof(double); }

private:
	Py_buffer m_view;
};

/* Bytes for Python, uninitialised, and where to write them. */
template <class T>::boost::python::object newBytes(std::size_t count, T*& data)
{
	::boost::python::object bytes(::boost::python::handle<>(PyByteArray_FromStringAndSize(nullptr, Py_ssize_t(count * sizeof(T)))));
	data = reinterpret_cast<T*>(PyByteArray_AsString(bytes.ptr()));
	return bytes;
}

} // namespace yade
