// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Layout.hpp>
#include <core/Body.hpp>

namespace yade {

/* Forces and torques on bodies. add... may be called by several threads at once, get... wants sync() after that. */
class ForceContainer {
public:
	ForceContainer();
	~ForceContainer();
	ForceContainer(const ForceContainer&)            = delete;
	ForceContainer& operator=(const ForceContainer&) = delete;

	void            sync();
	void            ensureSynced();
	const Vector3r& getForce(Body::id_t id);
	const Vector3r& getTorque(Body::id_t id);
	const Vector3r& getPermForce(Body::id_t id);
	const Vector3r& getPermTorque(Body::id_t id);
	void            addForce(Body::id_t id, const Vector3r& force);
	void            addTorque(Body::id_t id, const Vector3r& torque);
	void            setPermForce(Body::id_t id, const Vector3r& force);
	void            setPermTorque(Body::id_t id, const Vector3r& torque);
	void            addMaxId(Body::id_t id);
	void            reset(long iteration, bool resetAll = false);
	bool            getPermForceUsed() const;

private:
	char members[304] __attribute__((aligned(8)));
};
YADE_LAYOUT_SIZE(ForceContainer, 304)

} // namespace yade
