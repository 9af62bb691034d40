// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "BodyLinks.hpp"
#include "EngineOrder.hpp"
#include "MpmPoints.hpp"
#include "MpmWall.hpp"
#include "Sequences.hpp"
#include <core/GlobalEngine.hpp>
#include <core/Timing.hpp>

namespace yade {

class MpmEngine : public GlobalEngine {
public:
	void action() override;

	/* Largest stable step of the scene as it stands [s]. */
	Real criticalTimeStep();
	/* Bytes that the grid holds. */
	std::size_t gridBytes() const;

	void postLoad(MpmEngine&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmEngine, GlobalEngine, "Explicit material point method (Sulsky, Chen & Schreyer, CMAME 118 (1994) 179; eqs. 12-16 of Sofianos & Koumousis, COMPDYN 2017): moves the material points that :yref:`mpm.fill` has made by solving the momentum equation on a background grid each step. External forces are those that YADE has collected on the points' bodies when this engine runs, so it stands after ForceResetter and the engines that apply forces. The grid follows the points.",
		((SavedBy, savedBy, , Attr::hidden, "Version that has saved the scene"))
		((Real, cellSize, NaN, , "Edge of a grid cell, > 0 [m]; between two parallel walls stretched to fit a whole number of cells. Mandatory. Two points a cell and axis are usual: twice the spacing of mpm.fill."))
		((std::string, analysis, "planeStress", , "'planeStress' or 'planeStrain' (points with a thickness, moving in x and y), 'axisymmetric' or '3d'. In axisymmetry x is the radius and y the axis. Points filled with axisymmetric=True are full rings; masses, forces on bodies, contacts and reactions belong to full rings; the axis x = 0 is a plane of symmetry without a wall."))
		((std::string, shape, "cubic", , "Shape functions: 'linear', 'gimp' (uniform GIMP), 'quadratic' or 'cubic' B-splines."))
		((std::string, scheme, "MUSL", , "Time of the stress update: 'USF' (at the start of a step), 'USL' (at its end), 'MUSL' (at its end, with nodal velocities mapped again from the points)."))
		((Real, flip, 1, , "FLIP part of the velocity update, in [0, 1] [-]: 1 adds the nodal velocity increments to the velocities of the points and does not dissipate; 0 replaces them by the velocities of the grid (PIC) and dissipates strongly."))
		((Vector3r, gravity, Vector3r::Zero(), , "Acceleration of gravity on all points [m/s2]."))
		((Real, damping, 0, , "Cundall's non-viscous damping on the nodes, in [0, 1) [-], as in NewtonIntegrator: scales a component of a nodal acceleration by 1 - damping if it speeds up the motion, and by 1 + damping if it slows it down."))
		((bool, largeStrain, true, , "True: stress and back stress rotate with the material (Hughes & Winget 1980), and volumes are current. False: linear kinematics, initial volumes."))
		((bool, thinning, false, , "In plane stress with large strain: True lets the thickness change with the strain normal to the plane; False keeps it constant."))
		((bool, meanDilatation, false, , "Remedy for volumetric locking, of plastic flow or of Poisson ratios near 0.5, in 'planeStrain', 'axisymmetric' and '3d'. The points of a cell (with 'quadratic' functions a cell shifted by half) take the mean of their volume strains, and the nodal forces take the mean of their pressures (B-bar: Nagtegaal, Parks & Rice, CMAME 4 (1974) 153; doc/method.md). Part of the pressure of a single point then does no work; its deviator is its own. Needed with 'linear' and 'gimp' functions, and with splines near incompressibility. A step of elastic points takes about twice as long."))
		((bool, fullMass, false, , "Second-order mass correction with scheme 'MUSL': 2 - Q, with Q the transfer from nodes to points and back, approximates the inverse of the full mass matrix in nodal accelerations and velocities (after Nairn & Hammerquist, CMAME 377 (2021) 113667; doc/method.md). With splines the error of a motion is of fourth order in the cell size instead of second, while the points are near their lattice; in 'axisymmetric' it is a few times smaller. Equilibrium states do not change. A step takes 1.7 times as long, and the stable step is 30 to 40 % shorter; mpm.criticalTimeStep() includes that. With flip = 0 the velocities are those of FMPM(2). Over hundreds of periods it heats a motion of few cells more than the lumped mass does; filterTime prevents this. Raises an error with another scheme."))
		((Real, filterTime, 0, , "Time constant of the null-space filter, >= 0 [s]; 0 switches it off. The filter removes (1 - S S+)^2 v, the velocities that the grid does not represent, with S from nodes to points and S+ back (XPIC(2): Hammerquist & Nairn, CMAME 318 (2017) 724). It acts every max(dt, filterTime/50): the cost is negligible if filterTime is hundreds of steps, and that of the step itself if it is a few. In long runs a few periods of the slowest vibration keep the points from heating up (doc/accuracy). Resolved motion is damped slightly; mpmDamping includes the loss. Momentum is conserved; MpmWall.force includes the impulse of walls."))
		((Real, timeStepSafety, 0, , "If > 0, the engine sets O.dt before each step to this part of the stable step [-]. It follows the velocities of the points at every step, and their stiffness, density and positions every 500 steps. With an active TimeStepper (GlobalStiffnessTimeStepper) O.dt is the smaller of the two; the order of engines is TimeStepper, MpmEngine, NewtonIntegrator. With 0 the script sets O.dt. 0.4 suits most scenes."))
		((Real, largestGap, 2, , "Largest gap between neighbouring points, or between points and the fixed wall that holds them, in cells, > 0 [-]. The gap is the part of their distance that the deformation of the material between them does not explain. A larger gap is numerical fracture, because the points share no node any more; it ends the run with an error that names the points. The check runs when points can have moved a quarter of a cell since the last one, every 10 to 1000 steps, with at most twice the last interval. inf switches the check off, for a body that is expected to separate. Points of a DruckerPragerMat are excluded, because it has a tension cut-off."))
		((Real, unfiltered, 0, (Attr::hidden), "Time that has passed with a filterTime since the last filtering [s]"))
		((Real, acousticLimit, NaN, (Attr::hidden), "Stable step of the points at rest, as last found [s]"))
		((std::vector<Real>, acousticFor, , (Attr::hidden), "Scheme, full mass or not, number of points, grid, walls and laws for which the stable step was last found"))
		((Real, checkedStep, 0, (Attr::hidden), "Steps up to this one are known to be stable [s]"))
		((long, untilLook, 0, (Attr::hidden), "Steps to the next look at the gaps"))
		((long, lookInterval, 5, (Attr::hidden), "Steps from the last look at the gaps to the next one"))
		((std::vector<Vector3r>, wallsLeft, , (Attr::hidden), "Origins of the walls, as the last step has left them"))
		((std::vector<shared_ptr<MpmWall>>, walls, , , "Boundaries. Without walls the grid is unbounded."))
		,
		timingDeltas = shared_ptr<TimingDeltas>(new TimingDeltas);
		,
		.def(AsWritten())
		.def(Sequences<MpmWall>("MpmEngine.walls"))
		.def("criticalTimeStep", &MpmEngine::criticalTimeStep, "Largest stable step of the present scene [s]: 2/omega of the discrete operator with elastic stiffness, limited so that the fastest point crosses less than a cell. doc/method.md has the derivation.")
		.add_property("gridBytes", &MpmEngine::gridBytes, "Memory of the grid [bytes].")
	);
	// clang-format on

private:
	MpmPoints*                                 m_points = nullptr; // during a step
	std::tuple<std::string, std::string, Real> m_solverFor;        // analysis, shape, cellSize that the solver was made for
	long                                       m_solver       = 0; // MpmPoints::Runtime::solverNumber of it
	std::size_t                                m_bodies       = 0; // points that have one
	std::size_t                                m_checkedCount = 0;
	bool                                       m_valuesDue    = true; // columns have not been looked through for numbers that are not finite
	EngineOrder                                m_order;

	struct Attached { // the points are let go of after the lock
		shared_ptr<MpmPoints>        points;
		std::unique_lock<std::mutex> lock;
	};

	void step();
	/* Brings points, laws, walls and solver up to what the scene says; throws on bad input. */
	mpm::StepControl prepare();
	void             prepareWalls(int dim, bool axisymmetric);
	void             prepareSolver();
	Attached         attach();
	void             checkKinematics(mpm::Analysis kind);
	void             checkValues();
	void             checkPrescribed() const;
	void             forgetStep();
	bool             stretches(mpm::Analysis kind) const;
	void             checkPoints(mpm::Analysis kind) const;
	void             checkCorner(std::size_t fixed, std::size_t contact) const;
	void             checkGimp() const;
	void             planFilter(mpm::StepControl& control);
	bool             stiffnessChanged(const mpm::StepControl& control);
	void             checkStep(const mpm::StepControl& control, bool stepper);
	void             adaptStep(mpm::StepControl& control, bool stepper);
	void             checkContinuity(const mpm::StepControl& control);
	void             readBodies();
	BodyLinks&       links();
	void             reportEnergies() const;
};
REGISTER_SERIALIZABLE(MpmEngine);

} // namespace yade
