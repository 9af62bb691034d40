// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../laws/LawLanes.hpp"
#include "GridToPoints.hpp"
#include "MeanDilatation.hpp"
#include "NodeFields.hpp"
#include "StressWork.hpp"
#include "TileReport.hpp"
#include <optional>

namespace yade::mpm {

/* Eq. 16:  grad v_p = sum v_i grad N_ip, strain increment and rotation, law, deformation gradient; then the point moves by its
displacement increment. Points of a block that share a law are updated at once, others one by one.

With the affine transfer a point moves with the velocities that strain it, x_p += dt sum N_ip v_i, since only then F and x go on
agreeing in a body that turns. It keeps the mean s of the spin w = curl v/2 over the last ten radians of turning, which sets the rate of the
filter (NullSpaceFilter.hpp). The spin of a vibration changes its sign within a small angle, so that s stays small. */
template <class D> struct StressUpdate {
	using S                   = typename D::S;
	using Shape               = typename D::Shape;
	using Values              = typename D::Values;
	static constexpr int  dim = S::dim, N = S::N;
	static constexpr bool hoop = hasHoop<S>;

	static constexpr const char* noVolume = "has a volume that is not positive";
	static constexpr const char* noStress = "is strained by more than its law can follow in a step";
	static constexpr const char* tooFar   = "is deformed by more than its own size in a step";
	static constexpr const char* crushed  = "is crushed to less than a fiftieth of its volume";
	static constexpr const char* pressed  = "is under more pressure than elastic compression to a fiftieth of its volume gives";

	/* Least part of its undeformed volume that a point may have, by its deformation and by its elastic strain. The laws are linear in the
	logarithmic strain; beyond a compression of ln 50 = 3.9 no material follows them, and the grid resolves the body no more. */
	static constexpr double leastVolume = .02;

	static const char* remedy(const char* why)
	{
		if (why == noStress) return "reduce O.dt or the load, or check its material (yieldStress in Pa?)";
		if (why == crushed || why == pressed) return "reduce the load, or give its material the stiffness to carry it (young in Pa?)";
		return "reduce O.dt or the load, or use more points a cell";
	}

	D&                      d;
	const std::vector<Law>& laws;
	const StepControl&      control;  // of the step whose velocities strain the points
	Energies*               energies; // of the tiles, where they are tracked

	void updateTile(std::size_t t, TileReport& report)
	{
		if constexpr (dim > 1)
			if (rotates(d)) return run(d.transfer.instructions, [this, t, &report] { strainTile<true>(t, report); });
		run(d.transfer.instructions, [this, t, &report] { strainTile<false>(t, report); });
	}

private:
	Points& points() const { return d.transfer.points; }

	template <bool affine> void strainTile(std::size_t t, TileReport& report)
	{
		const auto& tile  = d.transfer.grid.tiles()[t];
		const bool  moves = affine && movesWithStrain(points(), control.scheme);
		bool        left  = false;
		report.spin       = 0;
		Values      v[dim], dilatations;
		for (int a = 0; a < dim; ++a)
			D::Patch::read(tile, d.fields.velocity[a], v[a]);
		if (averagesDilatation<S>(control)) elementDilatations<S>(d.transfer, tile, control, v, dilatations);
		forEachBlock(tile.begin, tile.end, [&](Block block) {
			Lanes                   x[dim], G[gradients<S>];
			WeightLanes<dim, Shape> w;
			for (int a = 0; a < dim; ++a)
				load(points().position[std::size_t(a)], block, x[a]);
			d.transfer.weights(tile, block, x, w);
			[[maybe_unused]] Lanes u[dim];
			for (int l = 0; l < lanes; ++l) {
				const auto& wl = w[std::min(l, block.count - 1)];
				if constexpr (affine)
					displacementAndGradient(wl, v, x[0][l], l, u, G);
				else
					displacementGradient<S>(wl, v, x[0][l], control.dt, l, G);
			}
			if constexpr (affine) noteSpin(block, G, report);
			if (averagesDilatation<S>(control)) takeMeanDilatation<S, Shape>(block, control, w, dilatations, G);
			if (!areModerate(G) || !updateBlockStress(block, G, report))
				for (int l = 0; l < block.count; ++l) {
					double Gp[gradients<S>];
					for (int k = 0; k < gradients<S>; ++k)
						Gp[k] = G[k][l];
					updatePointStress(t, block.first + std::size_t(l), Gp, report);
				}
			if constexpr (affine)
				if (moves) takeDisplacement(block, u);
			move(block, x);
			if constexpr (affine)
				if (moves) left |= !staysInside(tile, block, x);
		});
		if (moves) report.left |= left;
	}
	/* dt v and dt grad v of a lane's point. */
	void displacementAndGradient(const typename D::Weights& w, const Values (&v)[dim], double r, int l, Lanes (&u)[dim], Lanes (&G)[gradients<S>]) const
	{
		for (int a = 0; a < dim; ++a) {
			double gradient[dim];
			u[a][l] = control.dt * w.gatherWithGradient(v[a], gradient);
			for (int e = 0; e < dim; ++e)
				G[a * dim + e][l] = control.dt * gradient[e];
		}
		if constexpr (hoop) G[dim * dim][l] = u[0][l] / r;
	}
	/* Displacement increments: u, of prescribed components the prescribed one. */
	void takeDisplacement(Block block, Lanes (&u)[dim])
	{
		Points& P = points();
		for (std::size_t a = 0; a < std::size_t(dim); ++a) {
			for (int l = 0; !P.prescribedDofs.empty() && l < block.count; ++l) {
				const std::size_t p = block.first + std::size_t(l);
				if (P.prescribedDofs[p] >> a & 1) u[a][l] = control.dt * P.velocity[a][p];
			}
			store(u[a], block, P.displacementIncrement[a]);
		}
	}
	bool staysInside(const typename D::Tile& tile, Block block, const Lanes (&x)[dim]) const
	{
		const auto& g      = d.transfer.geometry;
		int         inside = 1;
		for (std::size_t a = 0; a < std::size_t(dim); ++a) {
			const double origin = g.origin[a], cell = g.cell[a], lower = g.xiMin[a], upper = g.xiMax[a], corner = tile.index[a] * D::T::Grid::width;
			Lanes        size {};
			if (Shape::usesSize) load(points().size, block, size);
#pragma omp simd reduction(& : inside)
			for (int l = 0; l < lanes; ++l) {
				const double xi = (x[a][l] - origin) / cell, inTile = xi - Shape::shift(.5 * size[l] / cell) - corner;
				inside &= (inTile >= 0) & (inTile < D::T::Grid::width) & (xi >= lower) & (xi <= upper);
			}
		}
		return inside;
	}
	/* s += b (w - s) with b = a/(1 + a), a = dt |w|/10; reports the greatest |s|. */
	void noteSpin(Block block, const Lanes (&G)[gradients<S>], TileReport& report)
	{
		Points&          P         = points();
		constexpr double memory    = 10; // radians
		const double     perSecond = 1 / control.dt;
		Lanes            turn[turns<dim>], mean[turns<dim>], square;
		for (int k = 0; k < turns<dim>; ++k) {
			const int from = turnsFrom<dim>(k), to = turnsTo<dim>(k);
			forLanes([&](int l) { turn[k][l] = .5 * (G[to * dim + from][l] - G[from * dim + to][l]); });
			load(P.meanSpin[std::size_t(k)], block, mean[k]);
		}
		forLanes([&](int l) {
			double squareOfTurn = 0;
			square[l]           = 0;
			for (int k = 0; k < turns<dim>; ++k)
				squareOfTurn += turn[k][l] * turn[k][l];
			const double angle = std::sqrt(squareOfTurn), taken = angle / (memory + angle);
			for (int k = 0; k < turns<dim>; ++k) {
				mean[k][l] += taken * (perSecond * turn[k][l] - mean[k][l]);
				square[l] += mean[k][l] * mean[k][l];
			}
		});
		for (int l = 0; l < block.count; ++l)
			report.spin = std::max(report.spin, square[l]);
		for (int k = 0; k < turns<dim>; ++k)
			store(mean[k], block, P.meanSpin[std::size_t(k)]);
	}
	void move(Block block, Lanes (&x)[dim])
	{
		Lanes increment;
		for (std::size_t a = 0; a < std::size_t(dim); ++a) {
			load(points().displacementIncrement[a], block, increment);
			forLanes([&](int l) { x[a][l] += increment[l], increment[l] = 0; });
			store(x[a], block, points().position[a]);
			store(increment, block, points().displacementIncrement[a]);
		}
	}

	/* Whether no point is deformed by as much as its own size in this step. Beyond, the run has failed, and a law would take
	sub-steps for ever. */
	static bool areModerate(const Lanes (&G)[gradients<S>])
	{
		int moderate = 1;
		for (int k = 0; k < gradients<S>; ++k)
#pragma omp simd reduction(& : moderate)
			for (int l = 0; l < lanes; ++l)
				moderate &= std::abs(G[k][l]) <= 1;
		return moderate;
	}
	template <int count> static bool isFinite(const double* x)
	{
		return std::all_of(x, x + count, [](double value) { return std::isfinite(value); });
	}
	/* Sum of the normal stresses at which the elastic strains of a confined point are those of leastVolume [Pa]: negative. */
	static double leastTrace(const Law& law)
	{
		double strain[N] {}, stress[N] {}, trace = 0;
		strain[0] = std::log(leastVolume);
		S::elastic(law.elastic, strain, stress);
		for (int k = 0; k < normals<S>(); ++k)
			trace += stress[k];
		return trace;
	}
	static double traceOf(const double* sigma)
	{
		double trace = 0;
		for (int k = 0; k < normals<S>(); ++k)
			trace += sigma[k];
		return trace;
	}
	static double determinantOf(const Lanes (&F)[dim * dim], int l)
	{
		double f[dim * dim];
		for (int k = 0; k < dim * dim; ++k)
			f[k] = F[k][l];
		return determinant<dim>(f);
	}

	/* The stress update of a block at once, where the points share a law; else returns false and does nothing. */
	bool updateBlockStress(Block block, const Lanes (&G)[gradients<S>], TileReport& report)
	{
		Points&   P        = points();
		const int material = P.material[block.first];
		if (energies) return false;
		for (int l = 1; l < block.count; ++l)
			if (P.material[block.first + std::size_t(l)] != material) return false;

		const Law&  law      = laws[std::size_t(material)];
		const int   columns  = Internals::of(law).columns(N);
		const bool  thinning = std::is_same_v<S, PlaneStress> && control.thinning, tracksNormal = !P.freeStrain.empty();
		LawBlock<S> b;
		b.respond   = thinning || tracksNormal;
		b.turnToEnd = rotates(d);
		std::copy(G, G + gradients<S>, b.G);
		for (int k = 0; k < N; ++k)
			load(P.stress[std::size_t(k)], block, b.sigma[k]);
		for (int k = 0; k < columns; ++k)
			load(P.internal[std::size_t(k)], block, b.internal[k]);
		for (int k = 0; k < dim * dim; ++k)
			load(P.deformation[std::size_t(k)], block, b.F[k]);

		updateBlock(d.transfer.instructions, law, control.largeStrain, b);
		const double least = leastTrace(law);
		int          sound = 1;
#pragma omp simd reduction(& : sound)
		for (int l = 0; l < lanes; ++l) {
			double trace = 0, shear = 0;
			for (int k = 0; k < normals<S>(); ++k)
				trace += b.sigma[k][l];
			for (int k = normals<S>(); k < N; ++k)
				shear += b.sigma[k][l];
			const double sum = trace + shear;
			sound &= (sum - sum == 0) & (trace > least) & (determinantOf(b.F, l) > leastVolume);
		}
		if (!sound) reportBlock(block, b, least, report);

		for (int k = 0; k < N; ++k)
			store(b.sigma[k], block, P.stress[std::size_t(k)]);
		for (int k = 0; k < columns; ++k)
			store(b.internal[k], block, P.internal[std::size_t(k)]);
		for (int k = 0; k < dim * dim; ++k)
			store(b.F[k], block, P.deformation[std::size_t(k)]);
		if constexpr (hoop)
			for (int l = 0; l < block.count; ++l)
				advanceHoop(block.first + std::size_t(l), G[dim * dim][l]);
		for (int l = 0; l < block.count && b.respond; ++l)
			strainNormal(block.first + std::size_t(l), b.response.freeStrain[l]);
		return true;
	}
	/* Reports the failures of a block; where the law has failed, the point keeps its stress. */
	[[gnu::noinline]] void reportBlock(Block block, LawBlock<S>& b, double leastTrace, TileReport& report)
	{
		for (int l = 0; l < block.count; ++l) {
			const std::size_t p = block.first + std::size_t(l);
			double            sigma[N];
			for (int k = 0; k < N; ++k)
				sigma[k] = b.sigma[k][l];
			if (!(determinantOf(b.F, l) > 0))
				report.fail(p, noVolume);
			else if (!isFinite<N>(sigma))
				report.fail(p, noStress);
			else
				checkCompression(p, determinantOf(b.F, l), traceOf(sigma), leastTrace, report);
			if (isFinite<N>(sigma)) continue;
			for (int k = 0; k < N; ++k)
				b.sigma[k][l] = points().stress[std::size_t(k)][p];
			for (std::size_t k = 0; k < points().internal.size(); ++k)
				b.internal[k][l] = points().internal[k][p];
			b.response.freeStrain[l] = 0;
		}
	}
	static void checkCompression(std::size_t p, double volume, double trace, double leastTrace, TileReport& report)
	{
		if (!(volume > leastVolume))
			report.fail(p, crushed);
		else if (!(trace > leastTrace))
			report.fail(p, pressed);
	}
	void advanceHoop(std::size_t p, double g)
	{
		double& stretch = points().thicknessStretch[p];
		stretch += control.largeStrain ? g * stretch : g;
	}
	/* Takes the strain increment of a stress-free normal over. */
	void strainNormal(std::size_t p, double e)
	{
		if (!points().freeStrain.empty()) points().freeStrain[p] += e;
		if (std::is_same_v<S, PlaneStress> && control.thinning) points().thicknessStretch[p] *= (1 + .5 * e) / (1 - .5 * e);
	}
	[[gnu::noinline]] void updatePointStress(std::size_t t, std::size_t p, const double (&G)[gradients<S>], TileReport& report)
	{
		Points&         P       = points();
		const Law&      law     = laws[std::size_t(P.material[p])];
		const Internals layout  = Internals::of(law);
		const int       columns = layout.columns(N);
		double          sigma[N], internal[maxInternals(N)], F[dim * dim];
		for (int k = 0; k < N; ++k)
			sigma[k] = P.stress[std::size_t(k)][p];
		for (int k = 0; k < columns; ++k)
			internal[k] = P.internal[std::size_t(k)][p];
		for (int k = 0; k < dim * dim; ++k)
			F[k] = P.deformation[std::size_t(k)][p];
		if (!std::all_of(G, G + gradients<S>, [](double g) { return std::abs(g) <= 1; })) {
			advanceDeformation<dim>(G, control.largeStrain, F);
			return report.fail(p, determinant<dim>(F) > 0 ? tooFar : noVolume);
		}
		Increment<S> increment;
		if (control.largeStrain) {
			increment.large(G);
			if (rotates(d)) increment.turnToEnd();
			increment.rotate(sigma);
			for (int k = 0; k < layout.tensors; ++k)
				increment.rotate(internal + k * N);
		} else
			increment.small(G);
		const bool responds = energies || !P.freeStrain.empty() || (std::is_same_v<S, PlaneStress> && control.thinning);
		Response   response;

		std::optional<StressWork<S>> work;
		if (energies) work.emplace(P, law, p, control.largeStrain, F, increment.strain, sigma, internal);
		updateStress<LawState<S>>(law, increment.strain, sigma, internal, responds ? &response : nullptr);
		if (!isFinite<N>(sigma)) return report.fail(p, noStress);
		if (responds) strainNormal(p, response.freeStrain);
		if constexpr (hoop) advanceHoop(p, G[dim * dim]);
		advanceDeformation<dim>(G, control.largeStrain, F);
		if (energies) work->add(F, sigma, internal, response, energies[t]);
		for (int k = 0; k < N; ++k)
			P.stress[std::size_t(k)][p] = sigma[k];
		for (int k = 0; k < columns; ++k)
			P.internal[std::size_t(k)][p] = internal[k];
		for (int k = 0; k < dim * dim; ++k)
			P.deformation[std::size_t(k)][p] = F[k];
		if (!(determinant<dim>(F) > 0)) return report.fail(p, noVolume);
		checkCompression(p, determinant<dim>(F), traceOf(sigma), leastTrace(law), report);
	}
};

} // namespace yade::mpm
