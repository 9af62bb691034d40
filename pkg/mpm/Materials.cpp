// SPDX-License-Identifier: GPL-2.0-or-later
#include "BoucWenMat.hpp"
#include "BadInput.hpp"

namespace yade {

mpm::Law lawOf(const Material& material)
{
	const std::string name = material.getClassName() + (material.label.empty() ? " " + std::to_string(material.id) : " '" + material.label + "'");
	const auto*       elastic = dynamic_cast<const ElastMat*>(&material);
	if (!elastic)
		throw std::runtime_error(name + " has no law for material points: give them an ElastMat, a FrictMat (linear elastic) or a BoucWenMat");

	mpm::Law law;
	require(elastic->density > 0 && std::isfinite(elastic->density), name, "density", elastic->density, "give a density > 0 [kg/m3]");
	require(elastic->young > 0 && std::isfinite(elastic->young), name, "young", elastic->young, "give Young's modulus > 0 [Pa]");
	require(elastic->poisson > -1 && elastic->poisson < .5, name, "poisson", elastic->poisson, "give Poisson's ratio in (-1, 0.5)");
	law.density = elastic->density;
	law.elastic = mpm::Hooke(elastic->young, elastic->poisson);

	if (const auto* m = dynamic_cast<const BoucWenMat*>(&material)) {
		require(m->yieldStress > 0, name, "yieldStress", m->yieldStress, "give a yield stress > 0 [Pa]");
		require(m->n > 0, name, "n", m->n, "give an exponent > 0, e.g. 10");
		require(std::isfinite(m->beta), name, "beta", m->beta, "give a number; beta = gamma = 0.5 unloads elastically");
		require(m->gamma >= std::abs(m->beta), name, "gamma", m->gamma, "choose gamma >= abs(beta), or dissipation can be negative; 0.5 and 0.5 unload elastically");
		require(std::abs(m->beta + m->gamma - 1) <= 1e-12, name, "beta", m->beta, "choose beta = 1 - gamma, or the stress saturates elsewhere than at yieldStress");
		require(m->tangentRatio >= 0 && m->tangentRatio < 1, name, "tangentRatio", m->tangentRatio, "give E_t/E in [0, 1), e.g. 0.05 for 5 % hardening");
		require(m->tolerance > 0, name, "tolerance", m->tolerance, "give a tolerance > 0, e.g. 1e-4");
		law.kind                  = mpm::Law::Kind::boucWen;
		law.boucWen.elastic       = law.elastic;
		law.boucWen.yieldStress   = m->yieldStress;
		law.boucWen.n             = m->n;
		law.boucWen.beta          = m->beta;
		law.boucWen.gamma         = m->gamma;
		law.boucWen.hardening     = mpm::BoucWenParameters::hardeningModulus(m->young, m->tangentRatio);
		law.boucWen.tolerance     = m->tolerance;
	}
	return law;
}

} // namespace yade
