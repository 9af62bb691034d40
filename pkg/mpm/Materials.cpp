// SPDX-License-Identifier: GPL-2.0-or-later
#include "Materials.hpp"
#include "BadInput.hpp"

namespace yade {

namespace {
	Real hardeningModulus(const std::string& name, Real young, Real tangentRatio)
	{
		require(tangentRatio >= 0 && tangentRatio < 1, name, "tangentRatio", tangentRatio, "give E_t/E in [0, 1), e.g. 0.05 for 5 % hardening");
		return mpm::hardeningModulus(young, tangentRatio);
	}

	mpm::BoucWen modelOf(const BoucWenMat& m, const std::string& name)
	{
		mpm::BoucWen law;
		law.yieldStress = m.yieldStress;
		law.n           = m.n;
		law.beta        = m.beta;
		law.gamma       = m.gamma;
		law.hardening   = hardeningModulus(name, m.young, m.tangentRatio);
		law.tolerance   = m.tolerance;
		law.isotropic   = { m.isotropicModulus, m.saturationStress, m.saturationRate };

		law.strengthDegradation  = m.strengthDegradation;
		law.stiffnessDegradation = m.stiffnessDegradation;
		law.pinching             = m.pinching;
		law.pinchingRate         = m.pinchingRate;
		law.pinchingLevel        = m.pinchingLevel;
		law.pinchingWidth        = m.pinchingWidth;
		law.reloading            = m.reloading;
		if (m.loadingRule == "paper")
			law.loadingRule = mpm::BoucWen::LoadingRule::paper;
		else if (m.loadingRule != "normal")
			refuse(name, "loadingRule", "'" + m.loadingRule + "'", "choose 'normal', or 'paper' for comparison");
		return law;
	}

	mpm::J2 modelOf(const J2Mat& m, const std::string& name)
	{
		mpm::J2 law;
		law.yieldStress = m.yieldStress;
		law.hardening   = hardeningModulus(name, m.young, m.tangentRatio);
		law.isotropic   = { m.isotropicModulus, m.saturationStress, m.saturationRate };
		return law;
	}

	mpm::DruckerPrager modelOf(const DruckerPragerMat& m, const std::string& name)
	{
		mpm::DruckerPrager law;
		law.cohesion         = m.cohesion;
		law.internalFriction = m.internalFriction;
		law.dilatancy        = m.dilatancy;
		using Match          = mpm::DruckerPrager::Match;
		if (m.match == "compression")
			law.match = Match::compression;
		else if (m.match == "extension")
			law.match = Match::extension;
		else if (m.match == "planeStrain")
			law.match = Match::planeStrain;
		else if (m.match == "inscribed")
			law.match = Match::inscribed;
		else
			refuse(name, "match", "'" + m.match + "'", "choose 'compression', 'extension', 'planeStrain' or 'inscribed'");
		return law;
	}

	/* Class, and label or place in O.materials where it has one. */
	std::string nameOf(const Material& material)
	{
		if (!material.label.empty()) return material.getClassName() + " '" + material.label + "'";
		return material.getClassName() + (material.id < 0 ? "" : " " + std::to_string(material.id));
	}
} // namespace

mpm::Law lawOf(const Material& material)
{
	const std::string name    = nameOf(material);
	const auto*       elastic = dynamic_cast<const ElastMat*>(&material);
	if (!elastic)
		throw std::runtime_error(
			name
			+ " has no law for material points: give them an ElastMat, a FrictMat (linear elastic), a BoucWenMat, a J2Mat or a DruckerPragerMat");

	mpm::Law law;
	require(elastic->density > 0 && std::isfinite(elastic->density), name, "density", elastic->density, "give a density > 0 [kg/m3]");
	law.density = elastic->density;
	law.elastic = mpm::Hooke(elastic->young, elastic->poisson);
	if (const auto* rough = dynamic_cast<const FrictMat*>(&material)) {
		require(rough->frictionAngle >= 0 && rough->frictionAngle < 1.57, name, "frictionAngle", rough->frictionAngle,
			"give the angle of friction of contacts, from 0 to below 1.57 [rad]");
		law.frictionAngle = rough->frictionAngle;
	}
	if (const auto* boucWen = dynamic_cast<const BoucWenMat*>(&material))
		law.model = modelOf(*boucWen, name);
	else if (const auto* j2 = dynamic_cast<const J2Mat*>(&material))
		law.model = modelOf(*j2, name);
	else if (const auto* cone = dynamic_cast<const DruckerPragerMat*>(&material))
		law.model = modelOf(*cone, name);
	if (const std::string fault = mpm::validate(law); !fault.empty()) throw std::runtime_error(name + "." + fault);
	return law;
}

} // namespace yade
