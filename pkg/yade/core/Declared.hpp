// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

/* What every class of the library overrides. Declared and not defined, so that vtable and typeinfo come from the library:
the destructor is the key function. The bodies of serialize() are compiled into the library's archive glue, and there is no
exported symbol for them; YADE_DECLARED_SERIALIZE therefore repeats the names, in the library's order, of the few classes
that a plugin derives from. */
#define YADE_DECLARED_CLASS(cls)                                                                                                                               \
public:                                                                                                                                                        \
	virtual ~cls();                                                                                                                                        \
	std::string           getBaseClassName(unsigned int i = 0) const override;                                                                             \
	int                   getBaseClassNumber() const override;                                                                                             \
	std::string           getClassName() const override;                                                                                                   \
	void                  pySetAttr(const std::string& key, const ::boost::python::object& value) override;                                                \
	::boost::python::dict pyDict() const override;                                                                                                         \
	void                  callPostLoad() override;                                                                                                         \
	void                  pyRegisterClass(::boost::python::object scope) override;

#define YADE_DECLARED_INDEX()                                                                                                                                  \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override;                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int depth) const override;

#define YADE_DECLARED_INDEX_COUNTER()                                                                                                                          \
public:                                                                                                                                                        \
	const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                                                        \
                                                                                                                                                               \
protected:                                                                                                                                                     \
	void incrementMaxCurrentlyUsedClassIndexOfKin() override;

#define YADE_DECLARED_NVP(r, archive, member) archive& BOOST_SERIALIZATION_NVP(member);
#define YADE_DECLARED_NVP_REST(r, archive, i, member) BOOST_PP_IF(i, YADE_DECLARED_NVP, YADE_DECLARED_SKIP)(r, archive, member)
#define YADE_DECLARED_SKIP(r, archive, member)

#define YADE_DECLARED_SERIALIZE(base, members)                                                                                                                 \
	template <class Archive> void serialize(Archive& archive, const unsigned int)                                                                          \
	{                                                                                                                                                      \
		archive& BOOST_SERIALIZATION_BASE_OBJECT_NVP(base);                                                                                            \
		BOOST_PP_SEQ_FOR_EACH_I(YADE_DECLARED_NVP_REST, archive, (~)members)                                                                           \
	}
