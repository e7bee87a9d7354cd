// SPDX-License-Identifier: GPL-2.0-or-later
// Rods as VTK geometry. Space frame, metres.
#pragma once

#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "io/fibres.h"
#include "io/rods.h"

namespace spherocylinder {

struct RodGeometry {
  vtkSmartPointer<vtkPolyData> mesh;
  std::vector<vtkIdType> rod_of_point;  // index into the rods
  std::vector<vtkIdType> rod_of_cell;

  // Of fibres: the neighbour whose value a point shares, and by how much, 0.5 at the joint and 0 in a
  // segment's middle. Empty without fibres.
  std::vector<vtkIdType> neighbour_of_point;
  std::vector<float> part_of_neighbour;
};

// Every rod as a closed surface of triangles with normals, `resolution` corners around (>= 8).
RodGeometry rod_surfaces(const std::vector<Rod> &rods, int resolution);

// The same, but fibres as smooth tubes (pictures/fibre_surface.h).
RodGeometry rod_surfaces(const std::vector<Rod> &rods, const Fibres &fibres, int resolution);

// Every rod as one line between the centres of its ends, a sphere as one vertex.
RodGeometry rod_lines(const std::vector<Rod> &rods);

}  // namespace spherocylinder
