// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmWall.hpp"
#include "BadInput.hpp"

namespace yade {

void MpmWall::postLoad(MpmWall&)
{
	if (!normal.array().isNaN().all()) checkNormal("MpmWall"); // else it is to be set later
}

void MpmWall::checkNormal(const std::string& name) const
{
	require(normal.allFinite() && normal.norm() > 0, name, "normal", normal.transpose(),
		"give the direction from the wall into the material, e.g. (1,0,0)");
	require(normal.cwiseAbs().maxCoeff() > (1 - 1e-12) * normal.norm(), name, "normal", normal.transpose(),
		"walls are normal to a coordinate axis; turn the scene (and gravity) so that this wall is too");
}

mpm::Wall MpmWall::toKernel(std::size_t number, int dim) const
{
	const std::string name = "MpmWall " + std::to_string(number);
	checkNormal(name);
	require(origin.allFinite(), name, "origin", origin.transpose(), "give a point of the wall's plane [m]");
	require(velocity.allFinite(), name, "velocity", velocity.transpose(), "give a finite velocity [m/s]");
	require(dim == 3 || velocity[2] == 0, name, "velocity", velocity.transpose(), "in a plane analysis nothing moves along z; give a velocity in x and y");
	require(friction >= 0 && std::isfinite(friction), name, "friction", friction, "give a coefficient of friction >= 0");

	mpm::Wall      wall;
	const Vector3r n = normal.normalized();
	n.cwiseAbs().maxCoeff(&wall.axis);
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
	require(friction == 0 || wall.kind == mpm::Wall::Kind::friction, name, "friction", friction,
		"a wall of kind '" + kind + "' has no friction; set kind = 'friction', or friction = 0");
	wall.friction = friction;
	for (int d = 0; d < 3; ++d)
		wall.velocity[std::size_t(d)] = velocity[d];
	return wall;
}

} // namespace yade
