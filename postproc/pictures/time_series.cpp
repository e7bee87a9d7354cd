// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/time_series.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataWriter.h>

#include "io/input_error.h"
#include "io/output_file.h"

namespace spherocylinder {

void write_poly_data(const std::string &path, vtkPolyData *data)
{
  // To memory: where a file is cut short, VTK says success or loses its way.
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  if (writer->Write() == 0) throw InputError(fmt::format("{}: VTK could not make it", path));
  write_file(path, writer->GetOutputString());
}

void TimeSeries::add(double time, const std::string &file, int part)
{
  entries_.push_back({time, std::filesystem::path(file).filename(), part});
}

bool TimeSeries::has(const std::string &file) const
{
  const std::string name = std::filesystem::path(file).filename();
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry &entry) { return entry.file == name; });
}

void TimeSeries::write() const
{
  vtkNew<vtkXMLDataElement> root, collection;
  root->SetName("VTKFile");
  root->SetAttribute("type", "Collection");
  root->SetAttribute("version", "0.1");
  collection->SetName("Collection");
  root->AddNestedElement(collection);
  for (const Entry &entry : entries_) {
    vtkNew<vtkXMLDataElement> data_set;
    data_set->SetName("DataSet");
    data_set->SetAttribute("timestep", fmt::format("{:.10g}", entry.time).c_str());
    data_set->SetAttribute("part", fmt::format("{}", entry.part).c_str());
    data_set->SetAttribute("file", entry.file.c_str());
    collection->AddNestedElement(data_set);
  }
  OutputFile output(path_);
  std::ofstream file(output.working_path());
  file << "<?xml version=\"1.0\"?>\n";
  root->PrintXML(file, vtkIndent());
  file.close();
  if (!file) throw InputError(fmt::format("{}: could not be written to its end", path_));
  output.finish();
}

}  // namespace spherocylinder
