// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade::mpm {

struct Hooke;
struct Law;

/* Internal variables of a point, columns of Points::internal: first tensors in the components of the stress state,
which turn with the material, then scalars. Dissipative laws keep the back stress as first tensor, where they have any,
and the accumulated plastic strain as first scalar. */
struct Internals {
	int tensors = 0, scalars = 0;

	static Internals of(const Law& law);
	constexpr int    columns(int components) const { return tensors * components + scalars; }
};

/* Properties that most laws share. A law derives from this struct and redefines the members that differ for it. */
struct LawDefaults {
	/* Factor on Hooke's D that bounds the tangent; the stable time step shrinks with its root. */
	double stiffnessBound(const Hooke&) const { return 1; }
	/* Whether tr eps = (1 - 2 nu)/E tr sigma always: the flow keeps the volume, and the compliance stays. */
	bool keepsVolume() const { return true; }
	/* Whether points may separate because the law carries no tension beyond a limit: a gap is then no numerical fracture. */
	bool hasTensionCutoff() const { return false; }
	/* Whether stress-free normals always get the same strain; else only without shear. */
	bool sharesFreeStrain() const { return true; }
	/* Whether the update adds the strain of stress-free normals to the response itself. Where it does not, the strain
	follows from a flow that keeps the volume. */
	static constexpr bool findsFreeStrain = false;
	/* Factor by which the elastic compliance has grown; internal(k) is the k-th internal variable. */
	template <class S, class Get> double complianceGrowth(Get&&) const { return 1; }
	/* Energy a volume [J/m3] stored beside the elastic one. */
	template <class S> double hardeningEnergy(const double*) const { return 0; }
};

} // namespace yade::mpm
