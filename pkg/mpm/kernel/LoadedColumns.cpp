// SPDX-License-Identifier: GPL-2.0-or-later
#include "LoadedColumns.hpp"
#include "Text.hpp"
#include "laws/Law.hpp"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace yade::mpm {

namespace {
	std::string entries(const std::string& name, std::size_t found, std::size_t wanted, const char* of)
	{
		return found == wanted ? "" : name + " has " + std::to_string(found) + " entries for " + std::to_string(wanted) + " " + of;
	}
	/* Of a column that may be missing. */
	std::string optional(const std::string& name, std::size_t found, std::size_t points)
	{
		return found == 0 ? "" : entries(name, found, points, "points");
	}

	std::string lengths(const std::string& name, const Columns& columns, std::size_t points)
	{
		for (std::size_t k = 0; k < columns.size(); ++k)
			if (std::string fault = entries(name + "[" + std::to_string(k) + "]", columns[k].size(), points, "points"); !fault.empty())
				return fault;
		return "";
	}
	std::string number(const std::string& name, std::size_t found, std::initializer_list<std::size_t> admitted)
	{
		if (std::find(admitted.begin(), admitted.end(), found) != admitted.end()) return "";
		std::string list;
		for (const std::size_t n : admitted)
			list += (list.empty() ? "" : ", ") + std::to_string(n);
		return name + " has " + std::to_string(found) + " columns, and can have " + list;
	}
	template <class... Texts> std::string first(const Texts&... texts)
	{
		std::string fault;
		((fault = fault.empty() ? texts : fault), ...);
		return fault;
	}
} // namespace

std::string faultOf(const Points& points, std::size_t materials)
{
	const std::size_t n     = points.count();
	std::string       fault = first(entries("material", points.material.size(), n, "points"), entries("mass", points.mass.size(), n, "points"),
		      entries("volume0", points.volume0.size(), n, "points"), entries("size", points.size.size(), n, "points"),
		      entries("thickness", points.thickness.size(), n, "points"), number("position", points.position.size(), { 3 }),
		      number("velocity", points.velocity.size(), { 3 }), lengths("position", points.position, n), lengths("velocity", points.velocity, n));
	if (!fault.empty()) return fault;

	// columns that the first step makes: all of them, or none
	const std::size_t stress = points.stress.size();
	fault                    = number("stress", stress, { 0, 1, 3, 4, 6 });
	if (!fault.empty()) return fault;
	const std::size_t dim = stress == 0 ? 0 : stress == 1 ? 1 : stress == 6 ? 3 : 2;
	fault                 = first(number("deformation", points.deformation.size(), { dim * dim }), lengths("stress", points.stress, n),
				lengths("internal", points.internal, n), lengths("deformation", points.deformation, n),
				optional("thicknessStretch", points.thicknessStretch.size(), n), optional("dissipation", points.dissipation.size(), n),
				optional("freeStrain", points.freeStrain.size(), n), optional("prescribedDofs", points.prescribedDofs.size(), n),
				optional("inContact", points.inContact.size(), n), optional("group", points.group.size(), n), optional("reach", points.reach.size(), n),
				number("initialStress", points.initialStress.size(), { 0, 6 }), lengths("initialStress", points.initialStress, n),
				number("contactVelocity", points.contactVelocity.size(), { points.inContact.empty() ? 0 : dim }),
				lengths("contactVelocity", points.contactVelocity, n));
	if (!fault.empty()) return fault;
	if (points.internal.size() > std::size_t(maxInternals(6)))
		return "internal has " + std::to_string(points.internal.size()) + " columns, more than any law keeps";

	for (std::size_t p = 0; p < n; ++p)
		if (points.material[p] < 0 || std::size_t(points.material[p]) >= materials)
			return "material of point " + std::to_string(points.id[p]) + " is " + std::to_string(points.material[p]) + " of "
			       + std::to_string(materials) + " materials";
	std::vector<int> ids = points.id;
	std::sort(ids.begin(), ids.end());
	if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end()) return "two points have the id " + std::to_string(*twice);
	for (const auto& [name, forces] : { std::make_pair("contactForces", &points.contactForces), std::make_pair("reactions", &points.reactions) })
		if (!std::is_sorted(forces->begin(), forces->end())) return std::string(name) + " are not in the order of the points' ids";
	return "";
}

std::string faultOf(const Continuity::Memory& memory)
{
	const std::size_t n = memory.ids.size(), links = n ? memory.neighbours.size() / n : 0;
	std::string       fault = first(n && (links < 1 || links > 3)
						? "neighbours has " + std::to_string(memory.neighbours.size()) + " entries for " + std::to_string(n) + " ids"
						: "",
		entries("neighbours", memory.neighbours.size(), n * links, "places"), entries("dX", memory.dX.size(), n * links * links, "components"),
		entries("walls", memory.walls.size(), memory.footings.size(), "footings"),
		entries("depths", memory.depths.size(), memory.footings.size(), "footings"),
		entries("kinds", memory.kinds.size(), memory.kinds.size() / 3 * 3, "numbers"));
	if (!fault.empty()) return fault;
	for (const auto& [name, column, bound] : { std::make_tuple("neighbours", &memory.neighbours, n), std::make_tuple("footings", &memory.footings, n),
		     std::make_tuple("walls", &memory.walls, memory.kinds.size() / 3) })
		for (const Continuity::Slot slot : *column)
			if (slot >= bound) return std::string(name) + " has the entry " + std::to_string(slot) + ", and there are " + std::to_string(bound);
	std::vector<int> ids = memory.ids;
	std::sort(ids.begin(), ids.end());
	if (const auto twice = std::adjacent_find(ids.begin(), ids.end()); twice != ids.end()) return "ids has " + std::to_string(*twice) + " twice";
	return "";
}

std::string faultOf(const Traction& face)
{
	const std::size_t n     = face.count();
	std::string       fault = face.pressureField.empty() ? "" : entries("pressureField", face.pressureField.size(), n, "places");
	for (std::size_t d = 0; d < 3 && fault.empty(); ++d) {
		const std::string axis = "[" + std::to_string(d) + "]";
		fault                  = first(entries("position" + axis, face.position[d].size(), n, "places"),
					 entries("reference" + axis, face.reference[d].size(), n, "places"), entries("area" + axis, face.area[d].size(), n, "places"),
                        face.field[d].empty() ? "" : entries("field" + axis, face.field[d].size(), n, "places"));
	}
	return fault;
}

std::string nonFiniteValue(const Points& points)
{
	std::string fault;
	const auto  look = [&](const std::string& name, const Column& column) {
                for (std::size_t p = 0; p < column.size() && fault.empty(); ++p)
                        if (!std::isfinite(column[p])) fault = name + " of material point " + std::to_string(points.id[p]) + " is " + mpm::number(column[p]);
	};
	for (const auto& [name, column] : { std::make_pair("mass", &points.mass), std::make_pair("volume0", &points.volume0),
		     std::make_pair("size", &points.size), std::make_pair("thickness", &points.thickness),
		     std::make_pair("thicknessStretch", &points.thicknessStretch), std::make_pair("dissipation", &points.dissipation),
		     std::make_pair("freeStrain", &points.freeStrain), std::make_pair("reach", &points.reach) })
		look(name, *column);
	for (const auto& [name, columns] :
		{ std::make_pair("position", &points.position), std::make_pair("velocity", &points.velocity), std::make_pair("stress", &points.stress),
			std::make_pair("internal", &points.internal), std::make_pair("deformation", &points.deformation) })
		for (std::size_t k = 0; k < columns->size(); ++k)
			look(std::string(name) + "[" + std::to_string(k) + "]", (*columns)[k]);
	for (const auto* forces : { &points.contactForces, &points.reactions })
		for (const SurfaceForce& f : *forces)
			for (std::size_t d = 0; d < 3 && fault.empty(); ++d)
				if (!std::isfinite(f.force[d]) || !std::isfinite(f.slip[d]))
					fault = "a force on material point " + std::to_string(f.point) + " is not finite";
	return fault;
}

} // namespace yade::mpm
