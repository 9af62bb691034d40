// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "AsWritten.hpp"
#include "MpmPoints.hpp"
#include "MpmWall.hpp"
#include "kernel/Continuity.hpp"
#include <core/GlobalEngine.hpp>
#include <core/Timing.hpp>

namespace boost::serialization {
template <class Archive> void serialize(Archive& archive, yade::mpm::Continuity& continuity, const unsigned int)
{
	yade::mpm::Continuity::Memory& m = continuity.memory;
	archive&                       make_nvp("ids", m.ids) & make_nvp("neighbours", m.neighbours) & make_nvp("dX", m.dX);
	archive& make_nvp("footings", m.footings) & make_nvp("walls", m.walls) & make_nvp("depths", m.depths) & make_nvp("kinds", m.kinds);
}
} // namespace boost::serialization

namespace yade {

class MpmEngine : public GlobalEngine {
public:
	void action() override;

	/* Largest stable step of the scene as it stands [s]. */
	Real criticalTimeStep();
	/* Bytes that the grid holds. */
	std::size_t gridBytes() const { return m_points && m_points->runtime.solver ? m_points->runtime.solver->gridBytes() : 0; }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmEngine, GlobalEngine, "Explicit material point method (Sulsky, Chen & Schreyer, CMAME 118 (1994) 179; eqs. 12-16 of Sofianos & Koumousis, COMPDYN 2017): moves the material points that :yref:`mpm.fill` has made by solving the momentum equation on a background grid each step. External forces are those that YADE has collected on the points' bodies when this engine runs, so it stands after ForceResetter and the engines that apply forces. The grid follows the points.",
		((Real, cellSize, NaN, , "Edge of a grid cell, > 0 [m]; between two parallel walls stretched to fit a whole number of cells. Mandatory. Two points a cell and axis are usual: twice the spacing of mpm.fill."))
		((std::string, analysis, "planeStress", , "'planeStress', 'planeStrain' (points with a thickness, moving in x and y), 'axisymmetric' (x the radius, y along the axis; points filled with axisymmetric=True stand for full rings, and so do masses, forces on bodies, contacts and reactions; the axis x = 0 is a plane of symmetry without a wall) or '3d'."))
		((std::string, shape, "cubic", , "Shape functions: 'linear', 'gimp' (uniform GIMP), 'quadratic' or 'cubic' B-splines."))
		((std::string, scheme, "MUSL", , "When stress is updated: 'USF' (first), 'USL' (last), 'MUSL' (last, with nodal velocities mapped once more from the points)."))
		((Real, flip, 1, , "Part of the velocity increment that is FLIP, in [0, 1] [-]: 1 adds nodal velocity increments to the points and does not dissipate; 0 replaces the points' velocities by the grid's (PIC) and dissipates strongly."))
		((Vector3r, gravity, Vector3r::Zero(), , "Acceleration of gravity on all points [m/s2]."))
		((Real, damping, 0, , "Cundall's non-viscous damping, in [0, 1) [-], meaning as in NewtonIntegrator, on the nodes: a component of a nodal acceleration is scaled by 1 - damping where it speeds the motion up and by 1 + damping where it slows it down."))
		((bool, largeStrain, true, , "True: stress and back stress turn with the material (Hughes & Winget 1980), volumes are current. False: linear kinematics, initial volumes."))
		((bool, thinning, false, , "Plane stress in large strain: whether the thickness follows the strain normal to the plane (True) or is kept (False)."))
		((bool, meanDilatation, false, , "Against volumetric locking, of plastic flow or of Poisson ratios near 0.5, in 'planeStrain', 'axisymmetric' and '3d': the points of a cell (with 'quadratic' functions of a cell shifted by half) change their volume as one, by the mean of their volume strains, and their forces take the mean of their pressures (B-bar: Nagtegaal, Parks & Rice, CMAME 4 (1974) 153; doc/method.md). A point's own stress then holds part of a pressure that does no work; its deviator is the point's. Needed by 'linear' and 'gimp' functions, and by splines near incompressibility; a step of elastic points takes about twice as long."))
		((bool, fullMass, false, , "Scheme 'MUSL': whether the inverse of the full mass matrix, approximated by 2 - Q with Q from nodes to points and back, takes the place of the lumped one's in nodal accelerations and velocities (after Nairn & Hammerquist, CMAME 377 (2021) 113667; doc/method.md). With splines motion is then of fourth order in the cell size, where points are not much out of their lattice, instead of second ('axisymmetric': a few times more accurate); what is at rest does not change. A step takes 1.7 times as long and the stable one is shorter by 30 to 40 %, which mpm.criticalTimeStep() knows. With flip = 0 velocities are those of FMPM(2). Over hundreds of periods it heats a motion that few cells show more than the lumped mass does; filterTime prevents it. Errors: with another scheme."))
		((Real, filterTime, 0, , "Time with which velocities fade that the grid does not see, (1 - S S+)^2 v with S from nodes to points and S+ back (XPIC(2): Hammerquist & Nairn, CMAME 318 (2017) 724), >= 0 [s]; 0: they stay, as FLIP leaves them. Applied once in filterTime/50 or at every step, whichever is rarer, so that it costs nothing to speak of where filterTime is hundreds of steps, and as much as the step itself where it is a few. In long runs a few periods of the slowest vibration keep points from heating up (doc/accuracy); motion that the grid resolves is touched a little, mpmDamping has what it takes. Momentum is kept, a wall's share of it is in MpmWall.force."))
		((Real, timeStepSafety, 0, , "Where > 0, the engine sets O.dt before each step [-]: this part of the stable step, which follows the points' velocities at every step and the stiffness, density and place of the points every 500 steps. Beside an active TimeStepper (GlobalStiffnessTimeStepper) O.dt is the lesser of the two; the order is TimeStepper, MpmEngine, NewtonIntegrator. 0 leaves O.dt to the script. 0.4 suits most scenes."))
		((Real, largestGap, 2, , "Largest gap that may open between neighbouring points, or between points and the fixed wall that holds them, in cells, > 0 [-]: what their distance has more than the deformation of the material between them accounts for. A wider one is numerical fracture, the points share no node any more, and ends the run with their ids. Looked at whenever points can have moved a quarter of a cell at the velocities of the last look, every 10 to 1000 steps, and after at most twice as many steps as before that look. inf where a body is meant to come apart, or for no checks at all. Points of a DruckerPragerMat, which lets go in tension, are left out."))
		((Real, unfiltered, 0, (Attr::hidden), "Time that has passed with a filterTime since the last filtering [s]"))
		((Real, acousticLimit, NaN, (Attr::hidden), "Stable step of the points at rest, as last found [s]"))
		((std::vector<Real>, acousticFor, , (Attr::hidden), "Scheme, full mass or not, number of points and laws for which the stable step was last looked at"))
		((mpm::Continuity, continuity, , Attr::hidden, "What the check for gaps knows of neighbours"))
		((long, untilLook, 0, (Attr::hidden), "Steps to the next look at the gaps"))
		((long, lookInterval, 5, (Attr::hidden), "Steps from the last look at the gaps to the next one"))
		((std::vector<Vector3r>, wallsLeft, , (Attr::hidden), "Origins of the walls, as the last step has left them"))
		((std::vector<shared_ptr<MpmWall>>, walls, , , "Boundaries; without any, the grid is unbounded."))
		,
		timingDeltas = shared_ptr<TimingDeltas>(new TimingDeltas);
		,
		.def(AsWritten())
		.def("criticalTimeStep", &MpmEngine::criticalTimeStep, "Largest stable step of the scene as it stands [s]: 2/omega of the discrete operator with elastic stiffness, and the fastest point crossing less than a cell. doc/method.md derives it.")
		.add_property("gridBytes", &MpmEngine::gridBytes, "Memory of the grid [bytes].")
	);
	// clang-format on

private:
	shared_ptr<MpmPoints>                      m_points;
	std::tuple<std::string, std::string, Real> m_solverFor; // analysis, shape, cellSize that the solver was made for
	mpm::Solver*                               m_solver       = nullptr;
	std::size_t                                m_bodies       = 0; // points that have one
	std::size_t                                m_checkedCount = 0;
	Real                                       m_checkedStep  = 0; // steps up to this one are known to be stable

	enum class Role { other, self, stepper, newton, loop };
	struct Checked { // of O.engines, when its order was checked
		Engine* engine;
		bool    dead;
		Role    role; // what an engine means for the time step
	};
	std::vector<Checked> m_checkedEngines;

	struct Link { // held, so that their addresses are theirs alone
		shared_ptr<Body>  body;
		shared_ptr<State> state;
	};
	std::vector<Link> m_links; // bodies known to be points', by id

	void step();
	/* Brings points, laws, walls and solver up to what the scene says; throws on bad input. */
	mpm::StepControl             prepare();
	void                         prepareWalls(int dim, bool axisymmetric);
	void                         prepareSolver();
	std::unique_lock<std::mutex> attach();
	bool                         stretches(mpm::Analysis kind) const;
	void                         checkPoints(mpm::Analysis kind) const;
	void                         checkGimp() const;
	void                         checkEngineOrder();
	void                         planFilter(mpm::StepControl& control);
	bool                         checkClocks() const;
	bool                         stiffnessChanged(const mpm::StepControl& control);
	void                         checkStep(const mpm::StepControl& control, bool stepper);
	void                         adaptStep(mpm::StepControl& control, bool stepper);
	void                         checkContinuity(const mpm::StepControl& control);
	bool                         link(std::size_t p);
	void                         readBodies();
	template <int dim> bool      readStates(std::vector<std::size_t>& moved);
	void                         takeVelocity(std::size_t p, bool touched, const Vector3r& shown);
	void                         refuseStates(int dim) const;
	void                         readContact(std::size_t p, bool touched, State& state);
	void                         writeBodies();
	void                         reportEnergies() const;
};
REGISTER_SERIALIZABLE(MpmEngine);

} // namespace yade
