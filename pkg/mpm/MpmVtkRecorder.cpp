// SPDX-License-Identifier: GPL-2.0-or-later
#include "MpmVtkRecorder.hpp"
#include "Action.hpp"
#include "BadInput.hpp"
#include <core/Scene.hpp>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace yade {

namespace {
	const char* const self = "MpmVtkRecorder";

	const std::vector<std::string> known { "id", "material", "displacement", "velocity", "mass", "volume", "stress", "strain", "backStress", "F",
		"plasticStrain", "vonMises", "dissipation" };

	bool contains(const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

	/* Points of a data set, each with a cell of its own, which most filters of VTK ask for. */
	template <class Coordinates> vtkNew<vtkUnstructuredGrid> vertices(std::size_t count, Coordinates&& coordinates)
	{
		vtkNew<vtkDoubleArray> x;
		x->SetNumberOfComponents(3);
		x->SetNumberOfTuples(vtkIdType(count));
		vtkNew<vtkIdTypeArray> offsets, connectivity;
		offsets->SetNumberOfValues(vtkIdType(count) + 1);
		connectivity->SetNumberOfValues(vtkIdType(count));
		for (std::size_t k = 0; k < count; ++k) {
			coordinates(k, x->GetPointer(vtkIdType(3 * k)));
			connectivity->SetValue(vtkIdType(k), vtkIdType(k));
		}
		for (std::size_t k = 0; k <= count; ++k)
			offsets->SetValue(vtkIdType(k), vtkIdType(k));
		vtkNew<vtkPoints> points;
		points->SetData(x);
		vtkNew<vtkCellArray> cells;
		cells->SetData(offsets, connectivity);
		vtkNew<vtkUnstructuredGrid> set;
		set->SetPoints(points);
		set->SetCells(VTK_VERTEX, cells);
		return set;
	}

	template <class Read> void addField(vtkUnstructuredGrid* set, const std::string& name, int components, std::size_t count, Read&& read)
	{
		vtkNew<vtkDoubleArray> values;
		values->SetName(name.c_str());
		values->SetNumberOfComponents(components);
		values->SetNumberOfTuples(vtkIdType(count));
		for (std::size_t k = 0; k < count; ++k)
			read(k, values->GetPointer(vtkIdType(k) * components));
		set->GetPointData()->AddArray(values);
	}

	[[noreturn]] void refuseFile(const std::string& file)
	{
		throw std::runtime_error(std::string(self) + ": cannot write " + file + ": is the disk full, or the folder write-protected?");
	}

	/* A file that appears whole or not at all: write(name) writes it under another name and returns whether it could. */
	template <class Write> void writeWhole(const std::string& file, Write&& write)
	{
		const std::string part = file + ".part";
		std::error_code   fault;
		if (write(part)) {
			std::filesystem::rename(part, file, fault);
			if (!fault) return;
		}
		std::filesystem::remove(part, fault);
		refuseFile(file);
	}

	bool writeSet(vtkUnstructuredGrid* set, const std::string& file, bool ascii, bool compress)
	{
		vtkNew<vtkXMLUnstructuredGridWriter> writer;
		writer->SetFileName(file.c_str());
		writer->SetInputData(set);
		if (ascii)
			writer->SetDataModeToAscii();
		else
			writer->SetDataModeToAppended(), writer->EncodeAppendedDataOff();
		if (!compress) writer->SetCompressorTypeToNone();
		return writer->Write() && writer->GetErrorCode() == 0;
	}
} // namespace

void MpmVtkRecorder::action()
{
	act([this] { record(); });
}

void MpmVtkRecorder::record()
{
	const shared_ptr<MpmPoints> points = MpmPoints::of(*scene);
	if (!points) throw std::runtime_error("MpmVtkRecorder: the scene has no material points; make them with mpm.fill() before the first step");
	const std::lock_guard<std::mutex> lock(points->mutex);
	points->finish();
	check(*points);
	writePoints(*points);
	if (wants("grid")) writeGrid(*points);
}

void MpmVtkRecorder::postLoad(MpmVtkRecorder&)
{
	if (times.size() == files.size() && gridTimes.size() == gridFiles.size()) return;
	refuseDamaged(std::string(self) + ".times has " + std::to_string(times.size()) + " entries for " + std::to_string(files.size())
		      + " files, and gridTimes " + std::to_string(gridTimes.size()) + " for " + std::to_string(gridFiles.size()));
}

/* Name of this step's file. */
std::string MpmVtkRecorder::newFile(const std::string& what, const std::vector<std::string>& written) const
{
	const std::string file = nameOf(what) + "." + std::to_string(scene->iter) + ".vtu";
	if (contains(written, file))
		refuse(self, "fileName", "'" + fileName + "'",
			file + " has been written already, before O.resetTime(); give another fileName for what follows");
	return file;
}

bool MpmVtkRecorder::wants(const std::string& what) const { return contains(recorders, what); }

std::string MpmVtkRecorder::nameOf(const std::string& what) const { return fileName + what; }

void MpmVtkRecorder::check(const MpmPoints& points) const
{
	const std::filesystem::path folder = std::filesystem::path(nameOf("points")).parent_path();
	require(!fileName.empty(), self, "fileName", "''", "give the beginning of the files' names, e.g. 'out/beam-'");
	require(folder.empty() || std::filesystem::is_directory(folder), self, "fileName", "'" + fileName + "'",
		"there is no folder " + folder.string() + "; make it first (os.makedirs)");
	for (const std::string& name : recorders) {
		if (name == "all" || name == "grid" || contains(known, name)) continue;
		std::string names;
		for (const std::string& k : known)
			names += "'" + k + "', ";
		refuse(self, "recorders", "'" + name + "'", "choose among " + names + "'all' and 'grid'");
	}
	if (wants("displacement") && std::any_of(points.points.id.begin(), points.points.id.end(), [](int id) { return id < 0; }))
		refuse(self, "recorders", "'displacement'", "points without bodies do not know where they began; leave it out, or fill with bodies=True");
}

std::vector<std::string> MpmVtkRecorder::quantities(const MpmPoints& points) const
{
	if (!wants("all")) return recorders;
	std::vector<std::string> names;
	for (const std::string& name : known) {
		if (name == "displacement" && std::any_of(points.points.id.begin(), points.points.id.end(), [](int id) { return id < 0; })) continue;
		if (name == "dissipation" && points.points.dissipation.empty()) continue;
		names.push_back(name);
	}
	return names;
}

void MpmVtkRecorder::writePoints(MpmPoints& points)
{
	const std::vector<std::size_t>& order    = points.inOrder();
	const auto                      position = points.quantity("position");
	const auto                      set      = vertices(order.size(), [&](std::size_t k, double* x) { position.read(order[k], x); });
	for (const std::string& name : quantities(points)) {
		if (name == "grid") continue;
		if (name == "id" || name == "material") {
			vtkNew<vtkIntArray> values;
			values->SetName(name.c_str());
			values->SetNumberOfValues(vtkIdType(order.size()));
			for (std::size_t k = 0; k < order.size(); ++k)
				values->SetValue(vtkIdType(k),
					name == "id" ? points.points.id[order[k]] : points.materials[std::size_t(points.points.material[order[k]])]->id);
			set->GetPointData()->AddArray(values);
			continue;
		}
		const auto quantity = points.quantity(name);
		addField(set, name, quantity.components, order.size(), [&](std::size_t k, double* out) { quantity.read(order[k], out); });
	}
	const std::string file = newFile("points", files);
	writeWhole(file, [&](const std::string& name) { return writeSet(set, name, ascii, compress); });
	files.push_back(file), times.push_back(scene->time);
	writeCollection("points", files, times);
}

void MpmVtkRecorder::writeGrid(const MpmPoints& points)
{
	const mpm::GridNodes nodes  = points.runtime.solver ? points.runtime.solver->nodes() : mpm::GridNodes();
	const std::size_t    count  = nodes.mass.size();
	auto                 vector = [&](const mpm::Columns& columns) {
                return [&columns](std::size_t k, double* out) {
                        for (std::size_t d = 0; d < 3; ++d)
                                out[d] = columns[d][k];
                };
	};
	const auto set = vertices(count, vector(nodes.position));
	addField(set, "mass", 1, count, [&](std::size_t k, double* out) { *out = nodes.mass[k]; });
	addField(set, "velocity", 3, count, vector(nodes.velocity));
	const std::string file = newFile("grid", gridFiles);
	writeWhole(file, [&](const std::string& name) { return writeSet(set, name, ascii, compress); });
	gridFiles.push_back(file), gridTimes.push_back(scene->time);
	writeCollection("grid", gridFiles, gridTimes);
}

/* ParaView's list of the files with this fileName, and their times; names are relative to the list's own folder. */
void MpmVtkRecorder::writeCollection(const std::string& what, const std::vector<std::string>& list, const std::vector<Real>& when) const
{
	vtkNew<vtkXMLDataElement> root, collection;
	root->SetName("VTKFile");
	root->SetAttribute("type", "Collection");
	root->SetAttribute("version", "0.1");
	collection->SetName("Collection");
	root->AddNestedElement(collection);
	for (std::size_t k = 0; k < list.size(); ++k) {
		if (list[k].compare(0, nameOf(what).size() + 1, nameOf(what) + ".") != 0) continue; // written under another fileName
		vtkNew<vtkXMLDataElement> entry;
		entry->SetName("DataSet");
		std::ostringstream time; // as a number VTK would write it to six digits
		time << std::setprecision(17) << when[k];
		entry->SetAttribute("timestep", time.str().c_str());
		entry->SetAttribute("part", "0");
		entry->SetAttribute("file", std::filesystem::path(list[k]).filename().c_str());
		collection->AddNestedElement(entry);
	}
	writeWhole(nameOf(what) + ".pvd", [&](const std::string& name) {
		std::ofstream file(name);
		root->PrintXML(file, vtkIndent());
		file.close();
		return bool(file);
	});
}

} // namespace yade
