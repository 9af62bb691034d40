// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../Geometry.hpp"
#include "../Points.hpp"
#include "../laws/Law.hpp"
#include <memory>

namespace yade::mpm {

enum class Analysis { uniaxial, planeStress, planeStrain, axisymmetric, solid };
enum class ShapeKind { linear, gimp, quadratic, cubic };

/* When the stress is updated (doc/method.md): from the velocities at the start of the step (USF), from the updated nodal
velocities (USL), or from those mapped once more from the points (MUSL; Sulsky, Zhou & Schreyer, CPC 87 (1995) 236). */
enum class Scheme { usf, usl, musl };

/* Told of the end of each pass of a step, by whoever wants to know what a pass takes: the same passes at every step of a scheme. */
struct PassClock {
	virtual ~PassClock()               = default;
	virtual void lap(const char* pass) = 0;
};

struct StepControl {
	double                dt = 0, time = 0;
	std::array<double, 3> gravity { 0, 0, 0 };
	double                damping        = 0; // Cundall's, non-viscous, on the nodes
	double                flip           = 1; // 1: pure FLIP, 0: pure PIC
	Scheme                scheme         = Scheme::musl;
	bool                  largeStrain    = true;
	bool                  thinning       = false; // plane stress: the thickness follows the strain
	bool                  meanDilatation = false; // plane strain, axisymmetric, 3D: the points of an element change their volume as one
	bool                  fullMass       = false; // MUSL: the inverse of the full mass matrix, approximated, in place of the lumped one's
	bool                  affine         = false; // points carry their rotation to the nodes and back (Rotation.hpp)
	double                filter         = 0;     // part that is taken, after the step, off the velocities that the grid does not see
	int                   threads        = 1;
	bool                  trackEnergy    = false; // keep Points::energies and Points::dissipation
	PassClock*            clock          = nullptr;
};

/* A step that cannot go on: which point, where and why. */
class StepFailure : public std::runtime_error {
public:
	StepFailure(const std::string& what, int pointId)
	    : std::runtime_error(what)
	    , id(pointId)
	{
	}
	const int id;
};

/* Nodes of the grid that carry mass, for whoever wants to look at them. */
struct GridNodes {
	Columns position { 3 }, velocity { 3 };
	Column  mass;
};

/* Angular momentum that a point carries beside m x x v, J_p W_p [kg m2/s], and its energy J_p W_p^2 / 2 [J]: zero but with the affine
transfer (Rotation.hpp). */
struct PointRotation {
	std::array<double, 3> momentum { 0, 0, 0 };
	double                energy = 0;

	/* spread: sum N_ip (x_i - x_p)^2 along each axis. */
	static PointRotation of(const Points& points, std::size_t p, const std::array<double, 3>& spread)
	{
		PointRotation     result;
		const auto&       W     = points.angularVelocity;
		const std::size_t turns = W.size(); // about x, y, z, or about z alone
		for (std::size_t k = 0; k < turns && p < W[k].size(); ++k) {
			const std::size_t axis = turns == 3 ? k : 2;
			const double      J = points.mass[p] * (spread[(axis + 1) % 3] + spread[(axis + 2) % 3]), w = W[k][p];
			result.momentum[axis] = J * w;
			result.energy += .5 * J * w * w;
		}
		return result;
	}
};

/* Explicit material point method on the points of one scene: momentum on the grid, stress at the points.

The stress update of a step shares a pass over the points with the transfer that begins the next one; finish() carries
it out at once, for whoever wants to look at, save or change the points between two steps. */
class Solver {
public:
	virtual ~Solver() = default;

	virtual void step(const StepControl& control) = 0;
	virtual void finish()                         = 0;
	/* The points' number, order, position or velocity have been changed from outside (after finish()). */
	virtual void pointsChanged() = 0;
	/* Largest stable step for the points as they stand, at rest [s]: from the greatest eigenvalue of the discrete operator
	with elastic stiffness. Of control it depends on scheme, fullMass, affine and largeStrain. */
	virtual double acousticTimeStep(const StepControl& control) = 0;
	/* Cells that the fastest point crosses in a second. */
	virtual double crossingRate() const = 0;
	/* Largest stable step: the two as rates. */
	double criticalTimeStep(const StepControl& control) { return 1 / (1 / acousticTimeStep(control) + crossingRate()); }
	double criticalTimeStep(Scheme scheme, bool fullMass = false, bool affine = false)
	{
		StepControl control;
		control.scheme = scheme, control.fullMass = fullMass, control.affine = affine;
		return criticalTimeStep(control);
	}
	/* The nodes of the last step, with the velocities that it ended with. */
	virtual GridNodes nodes() const = 0;
	/* Bytes held by the grid. */
	virtual std::size_t gridBytes() const = 0;

	/* Of a point as it stands, after finish(). */
	virtual PointRotation rotation(std::size_t p) const = 0;

	virtual Analysis analysis() const   = 0;
	virtual int      components() const = 0; // of a stress
};

int dimension(Analysis analysis);
int stressComponents(Analysis analysis);

/* points, laws and walls stay the caller's and are read anew each step; walls' forces are written. */
std::unique_ptr<Solver> makeSolver(Analysis analysis, ShapeKind shape, double cellSize, Points& points, const std::vector<Law>& laws, std::vector<Wall>& walls);

/* Elastic and hardening energy that a point holds and can give back, over its volume [J/m3]. */
Energies storedEnergy(Analysis analysis, const Law& law, const Points& points, std::size_t p);

} // namespace yade::mpm
