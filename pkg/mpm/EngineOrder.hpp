// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/BodyContainer.hpp>
#include <core/Engine.hpp>
#include <vector>

namespace yade {

/* Whether the order of O.engines can work: no engine may apply forces that ForceResetter clears before MpmEngine runs, and the
engines that move bodies must use one time step. */
class EngineOrder {
public:
	/* Why and with which remedy a scene on several processes is refused, wherever it shows. */
	static constexpr const char* oneProcess =
		"material points do not work in a scene that yade.mpy has split; run the scene in one process, with threads (-j)";

	/* Checks the order around self, again only after the list has changed; throws if forces would be lost. */
	void check(const std::vector<shared_ptr<Engine>>& engines, const Engine& self);
	/* Whether a TimeStepper sets O.dt as well; setsStep: MpmEngine does. Throws if MpmEngine and NewtonIntegrator would move points and
	grains by different steps, since a contact's impulses on the two would then differ. */
	bool checkClocks(bool setsStep) const;

	/* Throws if an engine sets the velocity of a material point that is free to follow the material. dim: axes of the analysis. */
	void checkMotions(const BodyContainer& bodies, int dim) const;

	/* Whether contacts are computed. */
	bool hasContacts() const;

private:
	enum class Role { other, self, stepper, newton, loop, mover };
	struct Entry { // of O.engines at the last check
		const Engine* engine;
		bool          dead;
		Role          role;
	};
	std::vector<Entry> m_checked;
};

} // namespace yade
