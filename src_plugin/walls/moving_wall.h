// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "walls/wall_surface.h"

namespace LAMMPS_NS {

// A primitive wall as rods meet it. With `shear` its surface moves and its geometry does not: it
// slides, or turns about its axis, which of a plane is a normal. A plane may also move along its
// normal, geometry and all.
struct MovingWall {
  WallSurface surface;
  spherocylinder::Vec3 sliding;  // m/s
  spherocylinder::Vec3 turning;  // rad/s
  spherocylinder::Vec3 centre;   // of turning, for a plane (m)

  // Where the end sphere's centre is, as with LIGGGHTS's spheres.
  spherocylinder::Vec3 velocity_at(const EndContact &contact, const spherocylinder::Vec3 &end) const
  {
    return sliding + cross(turning, surface.is_cylinder ? contact.radial : end - centre);
  }
};

}  // namespace LAMMPS_NS
