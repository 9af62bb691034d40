// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>
#include <string>

namespace yade {

class Scene;

/* Only reached through Omega::instance(): its members stay unknown. */
class Omega : public Singleton<Omega> {
public:
	const shared_ptr<Scene>& getScene() const;
	bool                     isRunning();
	void                     pause();
	bool                     isInheritingFrom(const std::string& className, const std::string& baseClassName);
};

} // namespace yade
