// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace yade::mpm {

using Column  = std::vector<double>;
using Columns = std::vector<Column>; // one column a component

/* Energies of a scene [J]. Their sum is constant but for the error of the time integration: what leaves the points (work
against walls, damping) and what comes in (external work, negative) are terms of it.

They are those of the start of a step, where the leapfrog scheme knows positions and stress: velocities belong half a step
before and after it, and the kinetic energy is the mean of the two. The sum is then accurate to second order in dt, but for
the points' motion over the grid between one mapping and the next, which leaves a small term of first order. */
struct Energies {
	double kinetic = 0, elastic = 0, hardening = 0, dissipation = 0, external = 0, damping = 0, walls = 0;
	bool   started = false; // whether they are being tracked

	double total() const { return kinetic + elastic + hardening + dissipation + external + damping + walls; }
	void   add(const Energies& o)
	{
		elastic += o.elastic, hardening += o.hardening, dissipation += o.dissipation;
		external += o.external, damping += o.damping, walls += o.walls;
	}
};

/* A force on a point that the next step starts from, kept by id: points change their places. */
struct SurfaceForce {
	int                   point = 0, other = 0; // ids: of the point, and of the wall or group that it is in contact with
	std::array<double, 3> force {}, slip {};    // on the point [N]; elastic part of the slip [m]

	bool operator<(const SurfaceForce& o) const { return point != o.point ? point < o.point : other < o.other; }
};

struct Traction;

/* The material points of a scene, as a structure of arrays: the authoritative state. SI units.

Columns that a scene does not need stay empty: force (no bodies), internal (no law with internal variables),
thicknessStretch (no thinning), dissipation (no energies), freeStrain (no such law), group (no groups), initialStress (none, or taken over by stress),
prescribedDofs (no prescribed motion), inContact, contactVelocity, spin, torque (no contacts with bodies of YADE), reach (no curved body),
contactForces (no contacts in place), reactions (no prescribed motion).
*/
struct Points {
	std::vector<int>          id;              // of the point: its body's, or negative where it has none
	std::vector<int>          material;        // index into the scene's table of laws
	std::vector<int>          group;           // number of the point's group, 0: none; empty while the scene has no groups
	Column                    mass, volume0;   // [kg], [m3] undeformed
	Column                    size, thickness; // lattice spacing [m]; thickness [m] of a plane point, 0 of a 3D one, minus the circumference of a ring
	Columns                   position { 3 }, velocity { 3 }; // all three axes, whatever the analysis
	Columns                   stress, internal, deformation;  // deformation: F, row-major
	Columns                   initialStress;                  // xx yy zz yz zx xy [Pa], until the next step takes it over; NaN where none is given
	Columns                   displacementIncrement;          // displacement of the current step, not yet in position while its stress update is pending
	Columns                   force;                          // external, but for gravity [N]
	Column                    thicknessStretch;               // F_zz of thinning plane stress, hoop stretch of a ring
	Column                    dissipation;                    // heat per undeformed volume [J/m3], where energies are tracked
	Column                    freeStrain;                     // eps_zz in plane stress, of laws that do not keepsVolume()
	Energies                  energies, upcoming;             // at the start of the last step; and what is known of the next
	std::vector<std::uint8_t> prescribedDofs;                 // bit d: component d of the velocity is prescribed
	std::vector<std::uint8_t> inContact;                      // whether force follows the position, as a contact's does; set anew at every step
	Columns                   contactVelocity, spin;          // of a point in contact in the last step: the velocity that moved it, half its curl
	Columns                   torque;                         // on a point in contact [Nm]; like spin three components, z alone in the plane

	std::vector<Traction*> tractions; // loads on faces, of whoever holds them; made anew before each step

	Column                    reach;                    // distance from the point to the surface of its body [m]; 0: half its size
	std::vector<SurfaceForce> contactForces, reactions; // of the last step: of contacts in place, and on prescribed points; by point

	std::size_t generation = 0; // grows whenever points change their place in the arrays

	std::size_t count() const { return id.size(); }

	/* Every column of doubles, for what treats them alike: sorting, erasing, saving. */
	template <class Visitor> void forEachColumn(Visitor&& visit)
	{
		for (Column* c : { &mass, &volume0, &size, &thickness })
			visit(*c);
		for (Columns* cs : { &position, &velocity, &stress, &internal, &deformation, &initialStress, &displacementIncrement, &force, &contactVelocity,
			     &spin, &torque })
			for (Column& c : *cs)
				visit(c);
		visit(thicknessStretch);
		visit(dissipation);
		visit(freeStrain);
		visit(reach);
	}
	template <class Visitor> void forEachIndexColumn(Visitor&& visit)
	{
		visit(id);
		visit(material);
		visit(group);
		visit(prescribedDofs);
		visit(inContact);
	}

	/* Adds an undeformed, stress-free point; prepare() gives it the columns that the analysis needs. */
	void append(int id_, int material_, const double* x, const double* v, double mass_, double volume_, double size_, double thickness_)
	{
		id.push_back(id_), material.push_back(material_);
		if (!group.empty()) group.push_back(0);
		if (!reach.empty()) reach.push_back(0);
		for (Column& column : initialStress)
			column.push_back(std::numeric_limits<double>::quiet_NaN());
		mass.push_back(mass_), volume0.push_back(volume_), size.push_back(size_), thickness.push_back(thickness_);
		for (int d = 0; d < 3; ++d)
			position[d].push_back(x[d]), velocity[d].push_back(v[d]);
	}
	/* Gives every point the columns of an analysis: dim axes, stresses of the given number of components, internal
	variables, and where asked for the thickness (or hoop) stretch, the external forces, the dissipation and the
	strain of the free normal. New entries are those of a point at rest. */
	void prepare(int dim, int components, int internals, bool stretch, bool forces, bool energy, bool freeNormal)
	{
		const std::size_t n     = count();
		auto              shape = [n](Columns& columns, int number, auto&& initial) {
                        columns.resize(std::size_t(number));
                        for (int k = 0; k < number; ++k)
                                columns[std::size_t(k)].resize(n, initial(k));
		};
		auto zero = [](int) { return 0.; };
		shape(stress, components, zero), shape(internal, internals, zero), shape(displacementIncrement, dim, zero);
		shape(deformation, dim * dim, [dim](int k) { return k % (dim + 1) == 0 ? 1. : 0.; });
		shape(force, forces ? dim : 0, zero);
		thicknessStretch.resize(stretch ? n : 0, 1.);
		if (freeNormal || !freeStrain.empty()) freeStrain.resize(n, 0.);
		if (energy || !dissipation.empty()) dissipation.resize(n, 0.);
		if (!prescribedDofs.empty()) prescribedDofs.resize(n, 0);
		if (!reach.empty()) reach.resize(n, 0.);
		if (!inContact.empty()) prepareContacts();
	}
	/* Gives every point what points in contact need. */
	void prepareContacts()
	{
		const std::size_t n = count(), dim = displacementIncrement.size(), turns = dim == 3 ? 3 : dim - 1;
		inContact.resize(n, 0);
		contactVelocity.resize(dim), spin.resize(turns), torque.resize(turns);
		for (Columns* columns : { &contactVelocity, &spin, &torque })
			for (Column& column : *columns)
				column.resize(n, 0.);
	}

	/* Keeps the points order[0], order[1], ... in this order and drops the others. */
	void select(const std::vector<std::size_t>& order)
	{
		auto gather = [&](auto& column, auto& kept) {
			if (column.empty()) return;
			kept.resize(order.size());
			for (std::size_t k = 0; k < order.size(); ++k)
				kept[k] = column[order[k]];
			column.swap(kept);
		};
		forEachColumn([&, kept = Column()](auto& column) mutable { gather(column, kept); });
		forEachIndexColumn([&](auto& column) {
			std::remove_reference_t<decltype(column)> kept;
			gather(column, kept);
		});
		++generation;
	}
	/* Moves point from[k] to place to[k]; the one is a permutation of the other. */
	void move(const std::vector<std::size_t>& from, const std::vector<std::size_t>& to)
	{
		auto permute = [&](auto& column) {
			if (column.empty()) return;
			std::remove_reference_t<decltype(column)> moved(from.size());
			for (std::size_t k = 0; k < from.size(); ++k)
				moved[k] = column[from[k]];
			for (std::size_t k = 0; k < to.size(); ++k)
				column[to[k]] = moved[k];
		};
		forEachColumn(permute);
		forEachIndexColumn(permute);
		++generation;
	}
};

} // namespace yade::mpm
