// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <core/BodyContainer.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Engine.hpp>
#include <core/ForceContainer.hpp>
#include <core/Material.hpp>

namespace yade {

class Cell;
class DisplayParameters;
class InteractionContainer;
class OpenGLRenderer;

class Scene : public Serializable {
	YADE_DECLARED_CLASS(Scene)

	Scene();
	void               moveToNextTimeStep();
	shared_ptr<Engine> engineByName(const std::string& name);
	bool               timeStepperPresent();
	bool               timeStepperActive();
	bool               timeStepperActivate(bool activate);

	const unsigned int                hostNameMax;
	ForceContainer                    forces;
	Eigen::Matrix<Real, 10, 1>        SpeedElements;
	shared_ptr<OpenGLRenderer>        renderer;
	long                              prevTime; // microseconds
	Real                              dt;
	long                              iter;
	bool                              subStepping;
	int                               subStep;
	Real                              time;
	Real                              speed;
	long                              stopAtIter;
	Real                              stopAtTime;
	bool                              isPeriodic;
	bool                              trackEnergy;
	bool                              doSort;
	bool                              runInternalConsistencyChecks;
	Body::id_t                        selectedBody;
	int                               subdomain;
	shared_ptr<Shape>                 subD;
	std::vector<std::string>          tags;
	std::vector<shared_ptr<Engine>>   engines;
	std::vector<shared_ptr<Engine>>   _nextEngines;
	shared_ptr<BodyContainer>         bodies;
	shared_ptr<InteractionContainer>  interactions;
	shared_ptr<EnergyTracker>         energy;
	std::vector<shared_ptr<Material>> materials;
	shared_ptr<Bound>                 bound;
	shared_ptr<Cell>                  cell;
	/* Saved with the scene, used by nothing in YADE itself. */
	std::vector<shared_ptr<Serializable>>      miscParams;
	std::vector<shared_ptr<DisplayParameters>> dispParams;
};
YADE_LAYOUT_SIZE(Scene, 752)
YADE_LAYOUT_OFFSET(Scene, forces, 32)
YADE_LAYOUT_OFFSET(Scene, SpeedElements, 336)
YADE_LAYOUT_OFFSET(Scene, dt, 440)
YADE_LAYOUT_OFFSET(Scene, time, 464)
YADE_LAYOUT_OFFSET(Scene, stopAtTime, 488)
YADE_LAYOUT_OFFSET(Scene, isPeriodic, 496)
YADE_LAYOUT_OFFSET(Scene, subdomain, 504)
YADE_LAYOUT_OFFSET(Scene, engines, 552)
YADE_LAYOUT_OFFSET(Scene, bodies, 600)
YADE_LAYOUT_OFFSET(Scene, materials, 648)
YADE_LAYOUT_OFFSET(Scene, cell, 688)
YADE_LAYOUT_OFFSET(Scene, miscParams, 704)
YADE_LAYOUT_OFFSET(Scene, dispParams, 728)

} // namespace yade
