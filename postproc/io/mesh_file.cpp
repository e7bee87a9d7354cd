// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/mesh_file.h"

#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <vtkCleanPolyData.h>
#include <vtkDataSetReader.h>
#include <vtkGeometryFilter.h>
#include <vtkNew.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>

#include "io/input_error.h"
#include "io/output_file.h"
#include "io/text.h"
#include "io/vtk_errors.h"

namespace spherocylinder {
namespace {

void need_readable(const std::string &path)
{
  if (std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: is a folder, wanted an STL file", path));
  if (!std::ifstream(path)) throw InputError(fmt::format("{}: cannot be opened", path));
  note_input(path);
}

// A binary file says after 80 bytes how many triangles of 50 bytes follow; VTK takes what is there.
void need_all_triangles(const std::string &path)
{
  constexpr std::uintmax_t kHead = 84, kTriangle = 50;
  std::ifstream file(path, std::ios::binary);
  char head[kHead];
  if (!file.read(head, kHead) || std::string(head, 5) == "solid") return;
  std::uint32_t count = 0;
  std::memcpy(&count, head + 80, sizeof count);
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size < kHead + kTriangle * count)
    throw InputError(fmt::format("{}: ends after {} triangles, wanted {}", path,
                                 (size - kHead) / kTriangle, count));
}

vtkSmartPointer<vtkPolyData> read_stl(const std::string &path)
{
  need_all_triangles(path);
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

// Poly data or an unstructured grid of cells, of which the surfaces count.
vtkSmartPointer<vtkPolyData> read_vtk(const std::string &path)
{
  vtkNew<vtkDataSetReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputConnection(reader->GetOutputPort());
  surface->Update();
  return surface->GetOutput();
}

// Corners that are the same to the seven digits of a file become one.
vtkSmartPointer<vtkPolyData> shared_corners(vtkPolyData *polygons)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(polygons);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->SetTolerance(1e-7);
  clean->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  clean->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(clean->GetOutput()->GetPoints());
  mesh->SetPolys(clean->GetOutput()->GetPolys());
  return mesh;
}

void need_finite(const std::string &path, vtkPolyData *mesh)
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); i++) {
    const double *p = mesh->GetPoint(i);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw InputError(fmt::format("{}: a corner is at ({}, {}, {}), wanted finite numbers", path,
                                   p[0], p[1], p[2]));
  }
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_mesh(const std::string &path)
{
  std::string end = std::filesystem::path(path).extension();
  for (char &c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (end != ".stl" && end != ".vtk")
    throw InputError(
        fmt::format("{}: must be a mesh whose name ends in .stl or .vtk (got '{}')", path, end));
  need_readable(path);
  const VtkErrors errors;
  const auto polygons = end == ".stl" ? read_stl(path) : read_vtk(path);
  errors.expect_none(fmt::format("{}: cannot be read as {}", path, end.substr(1)));
  if (polygons->GetNumberOfPolys() + polygons->GetNumberOfStrips() == 0)
    throw InputError(fmt::format("{}: holds no triangles, wanted at least one", path));
  need_finite(path, polygons);
  auto mesh = shared_corners(polygons);
  if (mesh->GetNumberOfPolys() == 0)
    throw InputError(fmt::format("{}: all its triangles have no area, wanted at least one", path));
  return mesh;
}

std::string mesh_file_at(const std::string &name, std::int64_t step)
{
  const std::filesystem::path path(name);
  const std::string pattern = path.filename();
  const auto star = pattern.find('*');
  if (name.find('*') == std::string::npos) return name;
  if (star == std::string::npos || name.find('*') != name.rfind('*'))
    throw InputError(fmt::format(
        "{}: must hold one * at most, in the file's own name (it stands for the step)", name));
  const std::string head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code unknown;  // no such folder: no such file
  std::string found;
  for (const auto &entry : std::filesystem::directory_iterator(folder, unknown)) {
    const std::string file = entry.path().filename();
    if (file.size() <= head.size() + tail.size() || file.compare(0, head.size(), head) != 0 ||
        file.compare(file.size() - tail.size(), tail.size(), tail) != 0)
      continue;
    const std::string digits = file.substr(head.size(), file.size() - head.size() - tail.size());
    if (to_number<std::int64_t>(digits) != step) continue;
    if (!found.empty())
      throw InputError(fmt::format("{}: {} and {} are both of step {}, wanted one file a step",
                                   name, found, file, step));
    found = file;
  }
  if (found.empty())
    throw InputError(
        fmt::format("{}: there is no file of step {}, wanted one for each step drawn", name, step));
  return path.has_parent_path() ? (path.parent_path() / found).string() : found;
}

}  // namespace spherocylinder
