// SPDX-License-Identifier: GPL-2.0-or-later
// The cylindrical vessel as VTK geometry, metres, in the vessel's own frame: z runs along its axis.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "solid/clipped_volume.h"

namespace spherocylinder {

// Part of the wall: angles (rad, from x towards y) from `begin` over `span`.
struct WallArc {
  double begin = 0.0;
  double span = 6.28318530717958648;
};

vtkSmartPointer<vtkPolyData> vessel_wall(const UprightCylinder &vessel, const WallArc &arc = {});
vtkSmartPointer<vtkPolyData> vessel_floor(const UprightCylinder &vessel);

// Circle of the vessel's radius at height z: one line, or dashes.
vtkSmartPointer<vtkPolyData> vessel_ring(const UprightCylinder &vessel, double z);
vtkSmartPointer<vtkPolyData> dashed_vessel_ring(const UprightCylinder &vessel, double z);

// The axis of the vessel is x, y or z of space (0, 1, 2), of which the other two are its own x and
// y in cyclic order.
Vec3 to_vessel(const Vec3 &space, int axis);
Vec3 to_space(const Vec3 &vessel, int axis);

// Turns the mesh from the vessel's frame to space.
void turn_to_space(vtkPolyData *mesh, int axis);

}  // namespace spherocylinder
