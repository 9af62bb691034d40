// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmWall.hpp"
#include "BadInput.hpp"

namespace yade {

mpm::Wall MpmWall::toKernel(std::size_t number, int dim) const
{
	const std::string name = "MpmWall " + std::to_string(number);
	require(normal.allFinite() && normal.norm() > 0, name, "normal", normal.transpose(),
		"give the direction from the wall into the material, e.g. (1,0,0)");
	require(origin.allFinite(), name, "origin", origin.transpose(), "give a point of the wall's plane [m]");
	require(velocity.allFinite(), name, "velocity", velocity.transpose(), "give a finite velocity [m/s]");
	require(dim == 3 || velocity[2] == 0, name, "velocity", velocity.transpose(), "in a plane analysis nothing moves along z; give a velocity in x and y");
	require(friction >= 0 && std::isfinite(friction), name, "friction", friction, "give a coefficient of friction >= 0");

	mpm::Wall      wall;
	const Vector3r n = normal.normalized();
	n.cwiseAbs().maxCoeff(&wall.axis);
	require(std::abs(n[wall.axis]) > 1 - 1e-12, name, "normal", normal.transpose(),
		"walls are normal to a coordinate axis; turn the scene (and gravity) so that this wall is too");
	require(wall.axis < dim, name, "normal", normal.transpose(), "the analysis is plane, x and y; it has no walls normal to z");
	wall.side     = n[wall.axis] > 0 ? 1 : -1;
	wall.position = origin[wall.axis];
	if (kind == "fixed")
		wall.kind = mpm::Wall::Kind::fixed;
	else if (kind == "slip")
		wall.kind = mpm::Wall::Kind::slip;
	else if (kind == "friction")
		wall.kind = mpm::Wall::Kind::friction;
	else
		refuse(name, "kind", "'" + kind + "'", "choose 'fixed', 'slip' or 'friction'");
	wall.friction = friction;
	for (int d = 0; d < 3; ++d)
		wall.velocity[std::size_t(d)] = velocity[d];
	return wall;
}

} // namespace yade
