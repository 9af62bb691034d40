// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmPoints.hpp"
#include <boost/weak_ptr.hpp>

namespace yade {

/* The bodies of the material points, as scripts and other engines see them. read() takes their changes before a step, write()
stores the new positions and velocities in the bodies after it. Owns no body: Python may have made parts of one, and then the last reference must
not be dropped by the thread of the simulation, which does not hold Python's lock. */
class BodyLinks {
public:
	struct Changes { // that the engine must act on; indices of points
		std::vector<std::size_t> moved, otherMaterial, otherMass;
		bool                     erased = false;
	};
	/* Forces, velocities, prescribed components and contacts go into the points' columns. Throws if one of them is not finite or out of
	the plane of a plane analysis, or if a body has been given a property that a material point cannot have. */
	Changes read(Scene& scene, MpmPoints& points);
	/* Positions and velocities, and the spin where a point is in contact. Asks the collider to run if a body has outrun its bound. */
	void write(Scene& scene, const mpm::Points& points) const;

	const Body& body(int id) const { return *m_links[std::size_t(id)].body; }

private:
	struct Link { // the weak pointers keep the addresses of their counters from being given again
		boost::weak_ptr<Body>  bodyCount;
		boost::weak_ptr<State> stateCount;
		Body*                  body  = nullptr; // alive while O.bodies has a body with that counter
		State*                 state = nullptr;

		bool holds(const shared_ptr<Body>& b) const
		{
			return b && b.get() == body && !bodyCount.owner_before(b) && !b.owner_before(bodyCount) && body->state.get() == state
			       && !stateCount.owner_before(body->state) && !body->state.owner_before(stateCount);
		}
	};
	std::vector<Link> m_links; // by id

	bool                    link(Scene& scene, MpmPoints& points, std::size_t p);
	template <int dim> void readStates(Scene& scene, MpmPoints& points, Changes& changes);
	void                    takeVelocity(mpm::Points& points, std::size_t p, bool touched, const State& state) const;
	void                    refuseStates(Scene& scene, const mpm::Points& points, int dim) const;
	void                    refuseBody(Scene& scene, const Body& body) const;
	void                    readContact(Scene& scene, mpm::Points& points, std::size_t p, bool touched, State& state) const;
};

} // namespace yade
