// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of triangles in files: STL, text or binary, and the VTK files of LIGGGHTS's dump mesh/vtk.
#pragma once

#include <cstdint>
#include <string>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace spherocylinder {

// Triangles with their corners shared, in double precision; by the name's end .stl or .vtk. Throws
// InputError for a file that is neither, holds no triangle, or cannot be read.
vtkSmartPointer<vtkPolyData> read_mesh(const std::string &path);

// The name of a mesh at a time step: `name` itself, or, where it holds a `*`, the file of that step,
// its number with or without zeros before it (dump_modify pad). Throws InputError if there is none,
// more than one, or more than one `*`.
std::string mesh_file_at(const std::string &name, std::int64_t step);

}  // namespace spherocylinder
