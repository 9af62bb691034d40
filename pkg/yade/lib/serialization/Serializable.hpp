// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <boost/python.hpp>
#include <boost/python/raw_function.hpp>

/* export.hpp instantiates a class for the archives that were included before it: the four that YADE writes and reads. */
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/export.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <boost/noncopyable.hpp>
#include <boost/preprocessor/cat.hpp>
#include <boost/preprocessor/control/if.hpp>
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/seq/for_each_i.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/tuple/elem.hpp>

#include <lib/factory/ClassFactory.hpp>
#include <lib/factory/Factorable.hpp>
#include <lib/serialization/Attributes.hpp>

namespace yade {

class Serializable : public Factorable {
	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive&, const unsigned int) {}

public:
	Serializable() {}
	virtual ~Serializable();
	std::string                   getBaseClassName(unsigned int i = 0) const override;
	int                           getBaseClassNumber() const override;
	std::string                   getClassName() const override;
	virtual void                  pySetAttr(const std::string& key, const ::boost::python::object& value);
	virtual ::boost::python::dict pyDict() const;
	virtual ::boost::python::dict pyDictCustom() const;
	virtual void                  callPostLoad();
	virtual void                  checkPyClassRegistersItself(const std::string& thisClassName) const;
	virtual void                  pyRegisterClass(::boost::python::object scope);
	virtual void                  pyHandleCustomCtorArgs(::boost::python::tuple& args, ::boost::python::dict& keywords);

	void        pyUpdateAttrs(const ::boost::python::dict& attributes);
	std::string pyStr();

	/* A class that wants to be told hides these with its own, e.g. void postLoad(MyClass&). */
	template <class T> void preLoad(T&) {}
	template <class T> void postLoad(T&) {}
	template <class T> void preSave(T&) {}
	template <class T> void postSave(T&) {}
};
YADE_LAYOUT_SIZE(Serializable, 24)

} // namespace yade

/* An attribute is a tuple (Type, name, default, flags, "doc"), where default and flags may be empty. The loops run over
(~)attrs and skip the first element, so that attrs may be empty too. */
#define YADE_ATTR_TYPE(attr) BOOST_PP_TUPLE_ELEM(5, 0, attr)
#define YADE_ATTR_NAME(attr) BOOST_PP_TUPLE_ELEM(5, 1, attr)
#define YADE_ATTR_DEFAULT(attr) BOOST_PP_TUPLE_ELEM(5, 2, attr)
#define YADE_ATTR_FLAGS(attr) (BOOST_PP_TUPLE_ELEM(5, 3, attr) + 0)
#define YADE_ATTR_DOC(attr) BOOST_PP_TUPLE_ELEM(5, 4, attr)

#define YADE_ATTR_SKIP(data, attr)
#define YADE_ATTR_LOOP(r, macroAndData, i, attr)                                                                                                               \
	BOOST_PP_IF(i, BOOST_PP_TUPLE_ELEM(2, 0, macroAndData), YADE_ATTR_SKIP)(BOOST_PP_TUPLE_ELEM(2, 1, macroAndData), attr)
#define YADE_ATTR_FOR_EACH(macro, data, attrs) BOOST_PP_SEQ_FOR_EACH_I(YADE_ATTR_LOOP, (macro, data), (~)attrs)

#define YADE_ATTR_DECLARE(data, attr) YADE_ATTR_TYPE(attr) YADE_ATTR_NAME(attr);
#define YADE_ATTR_INITIALIZE(data, attr) , YADE_ATTR_NAME(attr)(YADE_ATTR_DEFAULT(attr))
#define YADE_INIT_MEMBER(data, nameAndValue) , BOOST_PP_TUPLE_ELEM(2, 0, nameAndValue)(BOOST_PP_TUPLE_ELEM(2, 1, nameAndValue))
#define YADE_ATTR_SET(data, attr)                                                                                                                              \
	if constexpr (!(YADE_ATTR_FLAGS(attr) & Attr::hidden)) {                                                                                               \
		if (key == BOOST_PP_STRINGIZE(YADE_ATTR_NAME(attr))) {                                                                                         \
			::yade::setAttribute(YADE_ATTR_NAME(attr), value);                                                                                     \
			return;                                                                                                                                \
		}                                                                                                                                              \
	}
#define YADE_ATTR_TO_DICT(data, attr)                                                                                                                          \
	if constexpr (!(YADE_ATTR_FLAGS(attr) & Attr::hidden))                                                                                                 \
		attributes[BOOST_PP_STRINGIZE(YADE_ATTR_NAME(attr))] = ::boost::python::object(YADE_ATTR_NAME(attr));
#define YADE_ATTR_SERIALIZE(data, attr)                                                                                                                        \
	if constexpr (!(YADE_ATTR_FLAGS(attr) & Attr::noSave))                                                                                                 \
		archive& ::boost::serialization::make_nvp(BOOST_PP_STRINGIZE(YADE_ATTR_NAME(attr)), YADE_ATTR_NAME(attr));
#define YADE_ATTR_EXPOSE(data, attr)                                                                                                                           \
	::yade::exposeAttribute<YADE_ATTR_FLAGS(attr)>(pythonClass, BOOST_PP_STRINGIZE(YADE_ATTR_NAME(attr)), &Self::YADE_ATTR_NAME(attr),                     \
									    YADE_ATTR_DOC(attr) " :ydefault:`" BOOST_PP_STRINGIZE(YADE_ATTR_DEFAULT(attr)) "` :yattrtype:`" BOOST_PP_STRINGIZE(YADE_ATTR_TYPE(attr)) "`");

/* The members every class of a plugin has. YADE_PLUGIN defines pyRegisterClass, the first virtual function that is not
inline: vtable, typeinfo and all this are compiled once, where YADE_PLUGIN stands. */
#define YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(cls, base, doc, attrs, init, ctor, pyChain)                                                                     \
public:                                                                                                                                                        \
	YADE_ATTR_FOR_EACH(YADE_ATTR_DECLARE, ~, attrs)                                                                                                        \
	cls()                                                                                                                                                  \
	    : base() YADE_ATTR_FOR_EACH(YADE_INIT_MEMBER, ~, init) YADE_ATTR_FOR_EACH(YADE_ATTR_INITIALIZE, ~, attrs)                                          \
	{                                                                                                                                                      \
		ctor;                                                                                                                                          \
	}                                                                                                                                                      \
	virtual ~cls() {}                                                                                                                                      \
	void        pyRegisterClass(::boost::python::object scope) override;                                                                                   \
	std::string getClassName() const override { return #cls; }                                                                                             \
	std::string getBaseClassName(unsigned int i = 0) const override { return i == 0 ? #base : ""; }                                                        \
	int         getBaseClassNumber() const override { return 1; }                                                                                          \
	void        pySetAttr(const std::string& key, const ::boost::python::object& value) override                                                           \
	{                                                                                                                                                      \
		YADE_ATTR_FOR_EACH(YADE_ATTR_SET, ~, attrs)                                                                                                    \
		base::pySetAttr(key, value);                                                                                                                   \
	}                                                                                                                                                      \
	::boost::python::dict pyDict() const override                                                                                                          \
	{                                                                                                                                                      \
		::boost::python::dict attributes;                                                                                                              \
		YADE_ATTR_FOR_EACH(YADE_ATTR_TO_DICT, ~, attrs)                                                                                                \
		attributes.update(this->pyDictCustom());                                                                                                       \
		attributes.update(base::pyDict());                                                                                                             \
		return attributes;                                                                                                                             \
	}                                                                                                                                                      \
	void callPostLoad() override                                                                                                                           \
	{                                                                                                                                                      \
		base::callPostLoad();                                                                                                                          \
		this->postLoad(*this);                                                                                                                         \
	}                                                                                                                                                      \
                                                                                                                                                               \
private:                                                                                                                                                       \
	friend class boost::serialization::access;                                                                                                             \
	template <class Archive> void serialize(Archive& archive, const unsigned int)                                                                          \
	{                                                                                                                                                      \
		archive& BOOST_SERIALIZATION_BASE_OBJECT_NVP(base);                                                                                            \
		if constexpr (Archive::is_loading::value)                                                                                                      \
			this->preLoad(*this);                                                                                                                  \
		else                                                                                                                                           \
			this->preSave(*this);                                                                                                                  \
		YADE_ATTR_FOR_EACH(YADE_ATTR_SERIALIZE, ~, attrs)                                                                                              \
		if constexpr (Archive::is_loading::value)                                                                                                      \
			this->postLoad(*this);                                                                                                                 \
		else                                                                                                                                           \
			this->postSave(*this);                                                                                                                 \
	}                                                                                                                                                      \
	template <class Self> void registerInPython(::boost::python::object scope)                                                                             \
	{                                                                                                                                                      \
		this->checkPyClassRegistersItself(#cls);                                                                                                       \
		::boost::python::scope                                                                                       inScope(scope);                   \
		::boost::python::docstring_options                                                                           docs(true, true, false);          \
		::boost::python::class_<Self, ::boost::shared_ptr<Self>, ::boost::python::bases<base>, ::boost::noncopyable> pythonClass(                      \
			#cls, doc, ::boost::python::no_init);                                                                                                  \
		pythonClass.def("__init__", ::boost::python::raw_function(&::yade::initFromKeywords<Self>, 1));                                                \
		YADE_ATTR_FOR_EACH(YADE_ATTR_EXPOSE, ~, attrs)                                                                                                 \
		(void)(pythonClass pyChain);                                                                                                                   \
	}                                                                                                                                                      \
                                                                                                                                                               \
public:

#define YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(cls, base, doc, attrs, ctor, pyChain) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(cls, base, doc, attrs, , ctor, pyChain)
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(cls, base, doc, attrs, ctor) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(cls, base, doc, attrs, , ctor, )
#define YADE_CLASS_BASE_DOC_ATTRS(cls, base, doc, attrs) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(cls, base, doc, attrs, , , )
#define YADE_CLASS_BASE_DOC(cls, base, doc) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(cls, base, doc, , , , )

/* Stands inside namespace yade after the class. */
#define REGISTER_SERIALIZABLE(cls)                                                                                                                             \
	}                                                                                                                                                      \
	BOOST_CLASS_EXPORT_KEY(yade::cls)                                                                                                                      \
	namespace yade {
