// SPDX-License-Identifier: GPL-2.0-or-later
/* Columns from a file: whatever is changed in them, the checks of LoadedColumns.hpp find it, or the kernel can use the columns without
leaving them. Run under AddressSanitizer and UndefinedBehaviorSanitizer, an access that the checks have missed ends the program. */
#include "kernel/LoadedColumns.hpp"
#include "Scene.hpp"
#include <gtest/gtest.h>
#include <random>

using namespace yade::mpm;

namespace {

struct Saved {
	Scene              scene;
	Continuity::Memory memory;
	Analysis           analysis {};
};

Saved saved(Analysis analysis)
{
	Saved     s;
	const int dim   = dimension(analysis);
	Scene&    scene = s.scene;
	s.analysis      = analysis;
	scene.laws      = { Scene::elastic(1e6, .3, 1000), Scene::boucWen(1e6, .3, 1000, 1e4, 3, .05) };
	scene.walls     = { Scene::wall(dim - 1, 1, 0, Wall::Kind::fixed) };
	scene.addBox(dim, { 1, 0, 0 }, { 2, 1, 1 }, .25, analysis == Analysis::axisymmetric);
	for (std::size_t p = 0; p < scene.points.count(); ++p)
		scene.points.material[p] = int(p % 2);
	scene.setVelocity([&](const std::array<double, 3>&) { return std::array<double, 3> { 0, dim == 2 ? -1. : 0., dim == 3 ? -1. : 0. }; });
	scene.control.dt = .2e-2;
	scene.start(analysis, ShapeKind::cubic, .5);
	for (int k = 0; k < 5; ++k)
		scene.step();
	scene.solver->finish();
	Continuity continuity;
	continuity.widest(scene.points, scene.laws, scene.walls);
	s.memory = continuity.memory;
	return s;
}

/* One change: an entry, a length or the number of columns. */
class Damage {
public:
	explicit Damage(unsigned seed)
	    : m_random(seed)
	{
	}

	std::string apply(Points& points, Continuity::Memory& memory)
	{
		switch (below(22)) {
			case 0: return column("id", points.id);
			case 1: return column("material", points.material);
			case 2: return column("mass", points.mass);
			case 3: return column("volume0", points.volume0);
			case 4: return column("size", points.size);
			case 5: return column("thickness", points.thickness);
			case 6: return columns("position", points.position);
			case 7: return columns("velocity", points.velocity);
			case 8: return columns("stress", points.stress);
			case 9: return columns("internal", points.internal);
			case 10: return columns("deformation", points.deformation);
			case 11: return column("thicknessStretch", points.thicknessStretch);
			case 12: return column("prescribedDofs", points.prescribedDofs);
			case 13: return column("inContact", points.inContact);
			case 14: return columns("contactVelocity", points.contactVelocity);
			case 15: return column("ids", memory.ids);
			case 16: return column("neighbours", memory.neighbours);
			case 17: return column("footings", memory.footings);
			case 18: return column("walls", memory.walls);
			case 19: return column("group", points.group);
			case 20: return columns("initialStress", points.initialStress);
			default: return below(3) == 0 ? column("kinds", memory.kinds) : below(2) ? column("dX", memory.dX) : column("depths", memory.depths);
		}
	}

private:
	std::mt19937 m_random;

	std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(m_random); }

	template <class T> std::string column(const std::string& name, std::vector<T>& values)
	{
		static const double numbers[] = { 0, 1, -1, 7, 99999, 2147483647., -2147483648., 1e300, -1e300, 1e-300, NAN, INFINITY };
		if (values.empty() || below(3) == 0) {
			const std::size_t sizes[] = { 0, values.size() + 1, values.size() + 1000, values.size() / 2, values.size() - !values.empty() };
			values.resize(sizes[below(5)]);
			return name + " resized to " + std::to_string(values.size());
		}
		const double      number = numbers[below(12)];
		const std::size_t at     = below(values.size());
		if (std::is_floating_point_v<T> && std::abs(number) < 1e38)
			values[at] = T(number);
		else if (std::is_same_v<T, double>)
			values[at] = T(number);
		else if (number >= double(std::numeric_limits<T>::lowest()) && number <= double(std::numeric_limits<T>::max()))
			values[at] = T(number);
		return name + "[" + std::to_string(at) + "] = " + std::to_string(double(values[at]));
	}
	std::string columns(const std::string& name, Columns& all)
	{
		if (all.empty() || below(4) == 0) {
			all.resize(below(11), Column(below(2) ? 64 : 3));
			return name + " with " + std::to_string(all.size()) + " columns";
		}
		return column(name, all[below(all.size())]);
	}
};

/* What a loaded scene does with its columns. */
void use(Saved& s)
{
	Scene& scene     = s.scene;
	int    internals = 0;
	for (const Law& law : scene.laws)
		internals = std::max(internals, Internals::of(law).columns(stressComponents(s.analysis)));
	if (!scene.points.stress.empty() && scene.points.stress.size() != std::size_t(stressComponents(s.analysis))) return; // the engine refuses
	scene.points.prepare(dimension(s.analysis), stressComponents(s.analysis), internals, s.analysis == Analysis::axisymmetric, false, false, false);
	scene.solver = makeSolver(s.analysis, ShapeKind::cubic, .5, scene.points, scene.laws, scene.walls);
	for (std::size_t p = 0; p < scene.points.count(); ++p)
		storedEnergy(s.analysis, scene.laws[std::size_t(scene.points.material[p])], scene.points, p);
	Continuity continuity;
	continuity.memory = s.memory;
	continuity.widest(scene.points, scene.laws, scene.walls);
	scene.solver->acousticTimeStep(scene.control);
	for (int k = 0; k < 2; ++k)
		scene.step();
	scene.solver->finish();
	scene.points.select(std::vector<std::size_t>(1, 0));
}

TEST(LoadedColumnsTest, WholeColumnsHaveNoFault)
{
	for (const Analysis analysis : { Analysis::planeStress, Analysis::planeStrain, Analysis::axisymmetric, Analysis::solid }) {
		Saved s = saved(analysis);
		EXPECT_EQ(faultOf(s.scene.points, s.scene.laws.size()), "");
		EXPECT_EQ(faultOf(s.memory), "");
		EXPECT_EQ(nonFiniteValue(s.scene.points), "");
		EXPECT_NO_THROW(use(s));
	}
}

TEST(LoadedColumnsTest, FaultsAreNamed)
{
	const Saved whole = saved(Analysis::planeStrain);
	auto        s     = [&] { return Saved { whole.scene.copy(whole.analysis, ShapeKind::cubic, .5), whole.memory, whole.analysis }; };
	const auto  fault = [&](auto&& change) {
                Saved damaged = s();
                change(damaged);
                return faultOf(damaged.scene.points, damaged.scene.laws.size()) + faultOf(damaged.memory);
	};
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.mass.pop_back(); }), "mass has 15 entries for 16 points");
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.stress[2].push_back(0); }), "stress[2] has 17 entries for 16 points");
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.stress.resize(5, Column(16)); }), "stress has 5 columns, and can have 0, 1, 3, 4, 6");
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.deformation.clear(); }), "deformation has 0 columns, and can have 4");
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.material[3] = 2; }),
		"material of point " + std::to_string(whole.scene.points.id[3]) + " is 2 of 2 materials");
	EXPECT_EQ(fault([](Saved& d) { d.scene.points.id[3] = d.scene.points.id[4]; }), "two points have the id " + std::to_string(whole.scene.points.id[4]));
	EXPECT_EQ(fault([](Saved& d) { d.memory.neighbours[0] = 16; }), "neighbours has the entry 16, and there are 16");
	EXPECT_EQ(fault([](Saved& d) { d.memory.depths.push_back(0); }),
		"depths has " + std::to_string(whole.memory.depths.size() + 1) + " entries for " + std::to_string(whole.memory.footings.size()) + " footings");
	Saved nan                     = s();
	nan.scene.points.stress[1][2] = NAN;
	EXPECT_EQ(nonFiniteValue(nan.scene.points), "stress[1] of material point " + std::to_string(nan.scene.points.id[2]) + " is nan");
}

TEST(LoadedColumnsTest, FaultsOfAFaceAreNamed)
{
	Traction whole;
	for (std::size_t d = 0; d < 3; ++d)
		whole.position[d] = whole.reference[d] = whole.area[d] = { 1, 2 };
	whole.weight = { 1, 2 };
	EXPECT_EQ(faultOf(whole), "");
	const auto fault = [&](auto&& change) {
		Traction face = whole;
		change(face);
		return faultOf(face);
	};
	EXPECT_EQ(fault([](Traction& f) { f.position[1].pop_back(); }), "position[1] has 1 entries for 2 places");
	EXPECT_EQ(fault([](Traction& f) { f.reference[2].push_back(0); }), "reference[2] has 3 entries for 2 places");
	EXPECT_EQ(fault([](Traction& f) { f.area[0].clear(); }), "area[0] has 0 entries for 2 places");
	EXPECT_EQ(fault([](Traction& f) { f.field[0] = { 1 }; }), "field[0] has 1 entries for 2 places");
	EXPECT_EQ(fault([](Traction& f) { f.pressureField = { 1, 2, 3 }; }), "pressureField has 3 entries for 2 places");
	EXPECT_EQ(fault([](Traction& f) { f.weight.pop_back(); }), "position[0] has 2 entries for 1 places");
}

TEST(LoadedColumnsTest, NoDamageGetsPastTheChecksToAnAccessOutOfRange)
{
	std::vector<Saved> wholes;
	for (const Analysis analysis : { Analysis::planeStress, Analysis::planeStrain, Analysis::axisymmetric, Analysis::solid })
		wholes.push_back(saved(analysis));
	int refused = 0, failed = 0, ran = 0;
	for (unsigned seed = 0; seed < 2000; ++seed) {
		const Saved& whole = wholes[seed % wholes.size()];
		Saved        s { whole.scene.copy(whole.analysis, ShapeKind::cubic, .5), whole.memory, whole.analysis };
		Damage       damage(seed);
		std::string  did = damage.apply(s.scene.points, s.memory);
		if (seed % 3 == 0) did += ", " + damage.apply(s.scene.points, s.memory);
		SCOPED_TRACE("seed " + std::to_string(seed) + ": " + did);
		if (!faultOf(s.scene.points, s.scene.laws.size()).empty() || !faultOf(s.memory).empty() || !nonFiniteValue(s.scene.points).empty()) {
			++refused;
			continue;
		}
		try {
			use(s);
			++ran;
		} catch (const StepFailure&) {
			++failed;
		}
	}
	EXPECT_GT(refused, 1000);
	EXPECT_GT(ran, 100);
	EXPECT_GT(failed, 10);
}

} // namespace
