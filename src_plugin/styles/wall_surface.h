// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/vec3.h"

namespace LAMMPS_NS {

class PrimitiveWall;

// A wall that rods can touch with their ends, in numbers: a plane at right angles to a coordinate
// axis, or the inside of a cylinder along one.
struct WallSurface {
  bool is_cylinder;
  int axis;                   // 0, 1, 2: the plane's normal, or the cylinder's axis
  spherocylinder::Vec3 point; // on the plane, or on the cylinder's axis (m)
  double radius;              // of the cylinder (m)

  // From the cylinder's axis to a point (m).
  spherocylinder::Vec3 radial(const spherocylinder::Vec3 &at) const
  {
    spherocylinder::Vec3 r = at - point;
    (axis == 0 ? r.x : axis == 1 ? r.y : r.z) = 0.0;
    return r;
  }
  // Of a point from the plane, signed, along the coordinate axis (m).
  double height(const spherocylinder::Vec3 &at) const
  {
    const spherocylinder::Vec3 r = at - point;
    return axis == 0 ? r.x : axis == 1 ? r.y : r.z;
  }
  spherocylinder::Vec3 unit() const
  {
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
  }
};

// What LIGGGHTS's own wall is, found by asking it about two points: it does not tell its parameters.
WallSurface surface_of(PrimitiveWall &wall);

}  // namespace LAMMPS_NS
