// SPDX-License-Identifier: GPL-2.0-or-later
// The cylindrical vessel as VTK geometry. Space frame, metres.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "analysis/clipped_volume.h"

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

}  // namespace spherocylinder
