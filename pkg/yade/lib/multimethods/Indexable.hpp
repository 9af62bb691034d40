// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Layout.hpp>

namespace yade {

/* A class that dispatchers recognise by a small number. Each class has its own, given when its first instance is made. */
class Indexable {
protected:
	void createIndex()
	{
		int& index = modifyClassIndex();
		if (index != -1) return;
		index = getMaxCurrentlyUsedClassIndexOfKin() + 1;
		incrementMaxCurrentlyUsedClassIndexOfKin();
	}
	virtual void incrementMaxCurrentlyUsedClassIndexOfKin() = 0;
	virtual int& modifyClassIndex()                         = 0;

public:
	virtual ~Indexable() {}
	virtual const int& getClassIndex() const                      = 0;
	virtual const int& getBaseClassIndex(int depth) const         = 0;
	virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const = 0;
};
YADE_LAYOUT_SIZE(Indexable, 8)

} // namespace yade

#define REGISTER_CLASS_INDEX(cls, base)                                                                                                                        \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override { return indexOf##cls(); }                                                                                            \
                                                                                                                                                               \
public:                                                                                                                                                        \
	static int& indexOf##cls()                                                                                                                             \
	{                                                                                                                                                      \
		static int index = -1;                                                                                                                         \
		return index;                                                                                                                                  \
	}                                                                                                                                                      \
	const int& getClassIndex() const override { return indexOf##cls(); }                                                                                   \
	const int& getBaseClassIndex(int depth) const override { return depth == 1 ? base::getClassIndex() : base::getBaseClassIndex(depth - 1); }
