// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "BoucWen.hpp"

namespace yade::mpm {

/* A material as the kernel sees it: which law, and the parameters of that law. */
struct Law {
	enum class Kind { elastic, boucWen };
	Kind              kind    = Kind::elastic;
	double            density = 0;
	Hooke             elastic;
	BoucWenParameters boucWen;

	/* Factor on D that bounds the law's tangent; the stable time step shrinks with its root. */
	double stiffnessBound() const { return kind == Kind::boucWen ? boucWen.stiffnessBound() : 1; }
};

/* Internal variables of a point, columns of Points::internal: first tensors in the components of the stress state,
which turn with the material, then scalars. Dissipative laws keep the back stress as first tensor and the accumulated
plastic strain as first scalar. */
struct Internals {
	int tensors = 0, scalars = 0;

	static Internals of(Law::Kind kind) { return kind == Law::Kind::boucWen ? Internals { 1, 1 } : Internals {}; }
	int              columns(int components) const { return tensors * components + scalars; }
};

/* sigma and the internal variables at the end of a step; sigma and all tensors have been turned with the material. */
template <class S> void updateStress(const Law& law, const double* strain, double* sigma, double* internal)
{
	switch (law.kind) {
		case Law::Kind::elastic: {
			double De[S::N];
			S::elastic(law.elastic, strain, De);
			for (int k = 0; k < S::N; ++k)
				sigma[k] += De[k];
			break;
		}
		case Law::Kind::boucWen: internal[S::N] += boucWenUpdate<S>(law.boucWen, strain, sigma, internal); break;
	}
}

} // namespace yade::mpm
