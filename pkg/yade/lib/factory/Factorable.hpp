// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Layout.hpp>
#include <lib/base/Math.hpp>
#include <string>

namespace yade {

/* Root of every class that YADE makes by name. */
class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
	Factorable() {}
	virtual ~Factorable();
	virtual std::string getBaseClassName(unsigned int i = 0) const;
	virtual int         getBaseClassNumber() const;
	virtual std::string getClassName() const;
};
YADE_LAYOUT_SIZE(Factorable, 24)

} // namespace yade
