// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "MpmPoints.hpp"
#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

/* Files for ParaView and the like, beside YADE's VTKRecorder for everything that is not a material point. */
class MpmVtkRecorder : public PeriodicEngine {
public:
	void action() override;
	void postLoad(MpmVtkRecorder&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(MpmVtkRecorder, PeriodicEngine, "Writes the material points, and if asked the background grid, to VTK files (.vtu, and a .pvd that lists them with their times), each time it runs. Stands after :yref:`MpmEngine`; spheres and facets beside the points are VTKRecorder's. Runs at the start (initRun) and then as iterPeriod, virtPeriod or realPeriod say. Numbers are written in double precision. A scene that was loaded goes on with its .pvd.",
		((SavedBy, savedBy, , Attr::hidden, "Version that has saved the scene"))
		((std::string, fileName, "", , "Start of the names of the files, folder included, as in VTKRecorder: 'out/beam-' gives out/beam-points.<iteration>.vtu and out/beam-points.pvd, and for the grid out/beam-grid.<iteration>.vtu and out/beam-grid.pvd. The folder must exist. Mandatory."))
		((std::vector<std::string>, recorders, std::vector<std::string>(1, "all"), , "What to write of the points: names of quantities of :yref:`mpm.array` ('id', 'material', 'displacement', 'velocity', 'mass', 'volume', 'stress', 'strain', 'backStress', 'F', 'plasticStrain', 'vonMises', 'dissipation'), or 'all' of them ('displacement' where every point has a body, 'dissipation' with O.trackEnergy); and 'grid' for the nodes of the grid that carry mass, with their mass and velocity at the end of the step."))
		((bool, ascii, false, , "Text instead of binary data, for small scenes."))
		((bool, compress, false, , "Compress the data (zlib)."))
		((std::vector<Real>, times, , Attr::readonly, "O.time of each of files [s], as in the .pvd; a state recorded after MpmEngine has run in a step is that at the end of this step."))
		((std::vector<std::string>, files, , Attr::readonly, "Files of the points written so far."))
		((std::vector<std::string>, gridFiles, , Attr::readonly, "Files of the grid written so far."))
		((std::vector<Real>, gridTimes, , Attr::readonly, "O.time of each of gridFiles [s]."))
		,
		initRun = true;
		,
	);
	// clang-format on

private:
	void                     record();
	bool                     wants(const std::string& what) const;
	std::vector<std::string> quantities(const MpmPoints& points) const;
	void                     check(const MpmPoints& points) const;
	std::string              nameOf(const std::string& what) const;
	void                     writePoints(MpmPoints& points);
	void                     writeGrid(const MpmPoints& points);
	std::string              newFile(const std::string& what, const std::vector<std::string>& written) const;
	void                     writeCollection(const std::string& what, const std::vector<std::string>& files, const std::vector<Real>& when) const;
};
REGISTER_SERIALIZABLE(MpmVtkRecorder);

} // namespace yade
