// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "BadInput.hpp"
#include "MpmTraction.hpp"
#include "SavedBy.hpp"
#include "kernel/Continuity.hpp"
#include "kernel/solver/Solver.hpp"
#include <boost/serialization/array.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Material.hpp>
#include <core/Scene.hpp>
#include <functional>
#include <lib/serialization/Serializable.hpp>
#include <memory>
#include <mutex>

namespace boost::serialization {
/* Refuses a damaged count that exceeds the memory. */
template <class Work> void refuseHugeCounts(const char* object, Work&& work)
{
	const std::string fault = std::string(object) + " has a column too long for the memory";
	try {
		work();
	} catch (const std::bad_alloc&) {
		yade::refuseDamaged(fault);
	} catch (const std::length_error&) {
		yade::refuseDamaged(fault);
	}
}
template <class Archive> void serialize(Archive& archive, yade::mpm::Energies& e, const unsigned int)
{
	archive& make_nvp("kinetic", e.kinetic) & make_nvp("elastic", e.elastic) & make_nvp("hardening", e.hardening);
	archive& make_nvp("dissipation", e.dissipation) & make_nvp("external", e.external) & make_nvp("damping", e.damping);
	archive& make_nvp("walls", e.walls) & make_nvp("started", e.started);
}
template <class Archive> void serialize(Archive& archive, yade::mpm::SurfaceForce& f, const unsigned int)
{
	archive& make_nvp("point", f.point) & make_nvp("other", f.other) & make_nvp("force", f.force) & make_nvp("slip", f.slip);
}
/* The columns under their own names; no displacementIncrement is pending when a scene is saved, forces are YADE's. */
template <class Archive> void serializeColumns(Archive& archive, yade::mpm::Points& points)
{
	archive& make_nvp("id", points.id) & make_nvp("material", points.material) & make_nvp("prescribedDofs", points.prescribedDofs);
	archive& make_nvp("group", points.group) & make_nvp("initialStress", points.initialStress);
	archive& make_nvp("mass", points.mass) & make_nvp("volume0", points.volume0) & make_nvp("size", points.size);
	archive& make_nvp("thickness", points.thickness) & make_nvp("position", points.position) & make_nvp("velocity", points.velocity);
	archive& make_nvp("stress", points.stress) & make_nvp("internal", points.internal) & make_nvp("deformation", points.deformation);
	archive& make_nvp("thicknessStretch", points.thicknessStretch) & make_nvp("dissipation", points.dissipation);
	archive& make_nvp("freeStrain", points.freeStrain) & make_nvp("reach", points.reach);
	archive& make_nvp("contactForces", points.contactForces) & make_nvp("reactions", points.reactions);
	archive& make_nvp("inContact", points.inContact) & make_nvp("contactVelocity", points.contactVelocity);
	archive& make_nvp("energies", points.energies) & make_nvp("upcoming", points.upcoming);
}
template <class Archive> void serialize(Archive& archive, yade::mpm::Points& points, const unsigned int)
{
	refuseHugeCounts("MpmPoints", [&] { serializeColumns(archive, points); });
}
template <class Archive> void serialize(Archive& archive, yade::mpm::Continuity& continuity, const unsigned int)
{
	yade::mpm::Continuity::Memory& m = continuity.memory;
	refuseHugeCounts("MpmPoints.continuity", [&] {
		archive& make_nvp("ids", m.ids) & make_nvp("neighbours", m.neighbours) & make_nvp("dX", m.dX);
		archive& make_nvp("footings", m.footings) & make_nvp("walls", m.walls) & make_nvp("depths", m.depths) & make_nvp("kinds", m.kinds);
	});
}
} // namespace boost::serialization

namespace yade {

class BodyLinks;

/* The material points of a scene. They belong to the scene, as bodies do, not to the engine that moves them: an engine may
be replaced, and points may exist before there is one. Found in O.miscParams, saved with the scene, and held by the state
of every body that stands for a point.

What the kernel needs besides the points (laws, walls, solver) lives here too, because a stress update may be pending when
an engine goes away. */
class MpmPoints : public Serializable {
public:
	struct Runtime {
		std::vector<mpm::Law>        laws; // in the order of materials
		std::vector<mpm::Wall>       walls;
		std::unique_ptr<mpm::Solver> solver;
		std::shared_ptr<BodyLinks>   links;                // to the points' bodies
		long                         solverNumber = 0;     // unlike its address, no other solver has had it
		bool                         failed       = false; // the last step has
		bool                         layoutsDue   = false; // laws are those of a file, and have not been compared with its layouts
		bool                         forcesDue    = false; // the scene has been loaded, and its permanent forces are not back yet
	};

	/* Those of the scene, or an empty pointer. */
	static shared_ptr<MpmPoints> of(const Scene& scene);
	/* For py/mpm: those of the scene in hand, new ones if it has none. Python must not append them to O.miscParams: YADE's conversion of a
	list leaks a reference to each item, and every scene would stay in memory after O.reset(). */
	static shared_ptr<MpmPoints> ofScene();

	std::size_t count() const { return points.count(); }
	std::string text() const { return "<MpmPoints: " + std::to_string(count()) + " material points; look at them with mpm.array()>"; }
	/* Carries out the pending stress update. Throws StepFailure where it fails; not again after a step that has failed, so that the points
	can be read and saved as that step has left them. */
	void finish();
	/* Brings the kernel's laws up to the materials' attributes; throws on bad ones. */
	void updateLaws();
	/* Throws if points with bodies have a material that YADE's contact laws would abort on. */
	void requireContactLaw() const;
	/* Gives the bodies of a loaded scene the permanent forces and torques that they were saved with, which YADE does not save; not where a
	script has set permanent forces itself since. */
	void restoreForces();
	/* Points of a material whose density has changed get the mass of the new one. Returns whether there were any. */
	bool updateMasses();
	/* Changes a point's mass, and that of its body where the two agree; the kinetic energy that it brings is external work. */
	void setMass(std::size_t p, Real mass);
	/* Gives a point another material; throws where its internal variables would not fit. */
	void changeMaterial(std::size_t p, const shared_ptr<Material>& material);
	/* The body that stands for a point, or null where it has none (any more). */
	const Body*   bodyOf(std::size_t p, const BodyContainer& bodies) const;
	mpm::Analysis analysis() const;
	/* Drops the points whose bodies have been erased; what they held leaves the balance of energies as external work. */
	void dropErased(const BodyContainer& bodies);
	/* Index of the point with this id in the arrays as they stand; throws where there is none. */
	std::size_t indexOf(int id);
	/* Indices of all points in the order they were made in: bodies by id, then points without a body. */
	const std::vector<std::size_t>& inOrder();

	/* A quantity of the points: how many numbers, and what they are at a point. */
	struct Quantity {
		int                                              components;
		std::function<void(std::size_t p, Real* values)> read;
	};
	/* By its name in mpm.array; empty (no components) where there is none of this name. Good until points change. */
	Quantity quantity(const std::string& name) const;

	/* State of one point, as Python sees it. */
	Matrix3r stress(std::size_t p) const;
	Matrix3r strain(std::size_t p) const;
	Matrix3r backStress(std::size_t p) const;
	Matrix3r deformation(std::size_t p) const;
	Real     plasticStrain(std::size_t p) const;
	Real     volume(std::size_t p) const;
	Real     vonMises(std::size_t p) const;

	/* Gives the points with an initial stress this stress, in the components of an analysis; throws, and changes nothing, where the
	 * analysis or the point's law cannot have it. */
	void takeInitialStress(mpm::Analysis analysis);

	/* For py/mpm: adds points, described by arrays of N rows of doubles under these names: position, velocity (3 numbers a row), volume, mass, size,
	 * depth (thickness, 0 of a 3D point, minus the circumference of a ring) and, if given, stress (9) and reach, and a body for each unless bodies is
	 * false, with YADE's mask and colour where they are not None. group: its number, or its name where that is not empty. Returns their ids. Signals are
	 * handled before any point is made. */
	::boost::python::object append(::boost::python::dict columns, const shared_ptr<Material>& material, int group, const std::string& groupName,
		bool bodies, ::boost::python::object mask, ::boost::python::object color);
	/* For py/mpm: a load on a face, with arrays position, area (vectors, 3 numbers a row) and, if given, traction (3) and pressure (1) of its quadrature
	 * points; see MpmTraction. */
	shared_ptr<MpmTraction> addTraction(::boost::python::dict columns, int kind, const Vector3r& traction, Real pressure, const std::vector<Real>& times,
		const std::vector<Real>& factors);
	::boost::python::list   loads() const;
	/* Sets the loads on faces at a time. */
	void loadFaces(mpm::Analysis analysis, Real time);
	/* For py/mpm: Cauchy stress (buffer of N x 9 doubles) of the points with these ids. */
	void setStress(::boost::python::object ids, ::boost::python::object stress);
	/* For py/mpm: sum of the forces that the material exerts on the points with these ids, whose motion is prescribed [N]. */
	Vector3r reaction(::boost::python::object ids);
	/* For py/mpm: one material point through a path of strains (buffer of N x 9 doubles), some normal components stress-free. */
	static ::boost::python::dict drive(const shared_ptr<Material>& material, ::boost::python::object strain, bool freeXX, bool freeYY, bool freeZZ);
	/* For py/mpm: (bytes, dtype, shape) of one quantity, points in the order they were made in. */
	::boost::python::object array(const std::string& name);

	void preSave(MpmPoints&);
	void postLoad(MpmPoints&);

	Runtime    runtime;
	std::mutex mutex; // between the simulation's thread and Python's

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmPoints, Serializable, "The material points of a scene, held in O.miscParams and saved with it. Use :yref:`mpm.fill` to make points and :yref:`mpm.array` to look at them.",
		((SavedBy, savedBy, , Attr::hidden, "Version that has saved the scene"))
		((mpm::Points, points, , Attr::hidden, "Structure of arrays"))
		((std::vector<std::string>, groups, , Attr::hidden, "Names of groups 1, 2, ... of points; empty where a group has a number only"))
		((std::vector<shared_ptr<MpmTraction>>, tractions, , Attr::hidden, "Loads on faces"))
		((std::vector<shared_ptr<Material>>, materials, , Attr::hidden, "Materials that points have; a point holds an index into them"))
		((std::vector<Real>, densities, , Attr::hidden, "Of each material, when its points were last given their masses [kg/m3]"))
		((mpm::Continuity, continuity, , Attr::hidden, "Neighbours of the points, for the check for gaps"))
		((bool, large, true, Attr::hidden, "Whether the deformation gradient was integrated for large strain"))
		((bool, filled, true, Attr::hidden, "Whether points have been added since the engine last looked at all of them"))
		((int, nextBodyless, -1, Attr::hidden, "Id of the next point without a body"))
		((std::vector<int>, layouts, , Attr::hidden, "Of each material's law when the scene was saved: which one, numbers of internal tensors and scalars"))
		((std::vector<int>, forcedBodies, , Attr::hidden, "Ids of bodies with a permanent force or torque when the scene was saved ..."))
		((std::vector<Vector3r>, permanentForces, , Attr::hidden, "... their forces [N] ..."))
		((std::vector<Vector3r>, permanentTorques, , Attr::hidden, "... and their torques [Nm]"))
		,/*ctor*/,
		.def("append", &MpmPoints::append, "Adds points; :yref:`mpm.fill` and :yref:`mpm.points` call it.")
		.def("addTraction", &MpmPoints::addTraction, "A load on a face; :yref:`mpm.traction` calls it.")
		.add_property("tractions", &MpmPoints::loads, "Loads on faces, by :yref:`mpm.traction`; a list [-].")
		.def("setStress", &MpmPoints::setStress, "Initial stress; :yref:`mpm.setStress` calls it.")
		.def_readonly("groups", &MpmPoints::groups, "Names of groups 1, 2, ... of points [-].")
		.def("ofScene", &MpmPoints::ofScene, "Points of the scene in hand, new ones if it has none; :yref:`mpm.fill` calls it.").staticmethod("ofScene")
		.def("array", &MpmPoints::array, "Raw bytes and shape of one quantity; :yref:`mpm.array` calls it.")
		.def("drive", &MpmPoints::drive, "History of one point as raw bytes; :yref:`mpm.drive` calls it.").staticmethod("drive")
		.def("version", &mpm::version, "Version of the plugin, e.g. '1.0.0'; mpm.__version__ shows it.").staticmethod("version")
		.def("reaction", &MpmPoints::reaction, "Force on prescribed points; :yref:`mpm.reaction` calls it.")
		.def("__len__", &MpmPoints::count)
		.def("__repr__", &MpmPoints::text)
		.def("__str__", &MpmPoints::text)
	);
	// clang-format on

private:
	static constexpr std::size_t nowhere = std::size_t(-1);
	struct Directory { // of the points as they stand, made when asked for
		std::size_t              generation = 0;
		std::vector<std::size_t> order; // indices of the points, bodies by id, then the others
	};
	Directory m_directory;

	const Directory& directory();

	int            groupOf(int number, const std::string& name);
	void           storeStress(std::size_t p, const Real* tensor);
	Matrix3r       tensor(const mpm::Columns& columns, std::size_t p) const;
	mpm::Internals internals(std::size_t p) const;
	bool           inUse(std::size_t material) const;
	using Layout = std::array<int, 3>; // of a law's internal variables: index of the law, tensors, scalars
	static Layout layoutOf(const mpm::Law& law);
	bool          keepsInternals(const Layout& before, const Layout& after) const;
};
REGISTER_SERIALIZABLE(MpmPoints);

} // namespace yade
