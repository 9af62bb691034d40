// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmWall.hpp"
#include "BadInput.hpp"
#include "kernel/Text.hpp"

namespace yade {

void MpmWall::postLoad(MpmWall&)
{
	if (!normal.array().isNaN().all()) checkNormal("MpmWall"); // else it is to be set later
}

void MpmWall::checkNormal(const std::string& name) const
{
	require(normal.allFinite() && normal.norm() > 0, name, "normal", normal.transpose(),
		"give the direction from the wall into the material, e.g. (1,0,0)");
	require(kind == "friction" || normal.cwiseAbs().maxCoeff() > (1 - 1e-12) * normal.norm(), name, "normal", normal.transpose(),
		"walls of kind '" + kind + "' are normal to a coordinate axis; set kind = 'friction' first, or turn the scene (and gravity)");
}

mpm::Wall MpmWall::toKernel(std::size_t number, int dim) const
{
	const std::string name = "MpmWall " + std::to_string(number);
	checkNormal(name);
	require(origin.allFinite(), name, "origin", origin.transpose(), "give a point of the wall's plane [m]");
	require(velocity.allFinite(), name, "velocity", velocity.transpose(), "give a finite velocity [m/s]");
	require(dim == 3 || velocity[2] == 0, name, "velocity", velocity.transpose(), "in a plane analysis nothing moves along z; give a velocity in x and y");
	require(friction >= 0 && std::isfinite(friction), name, "friction", friction, "give a coefficient of friction >= 0");

	require(angularVelocity.allFinite(), name, "angularVelocity", angularVelocity.transpose(), "give a finite angular velocity [rad/s]");
	require(dim == 3 || (angularVelocity[0] == 0 && angularVelocity[1] == 0), name, "angularVelocity", angularVelocity.transpose(),
		"in a plane analysis walls turn about z alone");

	require(angularVelocity.allFinite(), name, "angularVelocity", angularVelocity.transpose(), "give a finite angular velocity [rad/s]");
	require(dim == 3 || (angularVelocity[0] == 0 && angularVelocity[1] == 0), name, "angularVelocity", angularVelocity.transpose(),
		"in a plane analysis walls turn about z alone");

	mpm::Wall      wall;
	const Vector3r n = normal.normalized();
	require(dim == 3 || std::abs(n[2]) < 1e-12, name, "normal", normal.transpose(), "the analysis is plane, x and y; it has no walls normal to z");
	if (kind == "fixed")
		wall.kind = mpm::Wall::Kind::fixed;
	else if (kind == "slip")
		wall.kind = mpm::Wall::Kind::slip;
	else if (kind == "friction")
		wall.kind = mpm::Wall::Kind::friction;
	else
		refuse(name, "kind", "'" + kind + "'", "choose 'fixed', 'slip' or 'friction'");
	wall.mirrors() ? setMirror(wall, name, n) : setContact(wall, name, n, dim);
	wall.friction = friction;
	for (int d = 0; d < 3; ++d)
		wall.velocity[std::size_t(d)] = velocity[d];
	return wall;
}

void MpmWall::setMirror(mpm::Wall& wall, const std::string& name, const Vector3r& n) const
{
	const std::string remedy = "; set kind = 'friction', or leave this out";
	require(friction == 0, name, "friction", friction, "a wall of kind '" + kind + "' has no friction" + remedy);
	require(extent.empty(), name, "extent", mpm::number(extent.empty() ? 0 : extent[0]), "a wall of kind '" + kind + "' has no end" + remedy);
	require(angularVelocity.isZero(0), name, "angularVelocity", angularVelocity.transpose(), "a wall of kind '" + kind + "' does not turn" + remedy);
	n.cwiseAbs().maxCoeff(&wall.axis);
	wall.side     = n[wall.axis] > 0 ? 1 : -1;
	wall.position = origin[wall.axis];
}

void MpmWall::setContact(mpm::Wall& wall, const std::string& name, const Vector3r& n, int dim) const
{
	require(extent.size() <= std::size_t(dim - 1), name, "extent", std::to_string(extent.size()) + " numbers",
		dim == 3 ? "give one half size for a disk or two for a rectangle [m]" : "give the half length of a segment [m]");
	for (const Real half : extent)
		require(half > 0 && std::isfinite(half), name, "extent", half, "the wall is empty; give half sizes > 0 [m], or none for the whole plane");
	if (extent.size() == 2) {
		require(along.allFinite() && along.norm() > 0 && std::abs(along.normalized().dot(n)) < 1e-9, name, "along", along.transpose(),
			"give the direction of the rectangle's first side, normal to the wall's normal");
		const Vector3r first = (along - along.dot(n) * n).normalized();
		for (std::size_t d = 0; d < 3; ++d)
			wall.along[d] = first[int(d)];
	}
	wall.oblique = true;
	wall.extent.assign(extent.begin(), extent.end());
	for (std::size_t d = 0; d < 3; ++d)
		wall.normal[d] = n[int(d)], wall.origin[d] = origin[int(d)], wall.angularVelocity[d] = angularVelocity[int(d)];
	if (dim == 2) wall.normal[2] = 0;
}

void MpmWall::move(Real dt)
{
	origin += dt * velocity;
	const Real angle = dt * angularVelocity.norm();
	if (angle == 0) return;
	const AngleAxisr turn(angle, angularVelocity.normalized());
	normal = (turn * normal).normalized();
	along  = turn * along;
}

} // namespace yade
