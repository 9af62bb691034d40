// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/Declared.hpp>

namespace yade {

/* O.energy */
class EnergyTracker : public Serializable {
	YADE_DECLARED_CLASS(EnergyTracker)

	void                  setItem_py(const std::string& name, Real value);
	Real                  getItem_py(const std::string& name);
	void                  clear();
	Real                  total() const;
	::boost::python::list keys_py() const;

protected:
	EnergyTracker();

private:
	char members[152] __attribute__((aligned(8)));
};
YADE_LAYOUT_SIZE(EnergyTracker, 176)

} // namespace yade
