// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "walls/wall_surface.h"

namespace LAMMPS_NS {

// A primitive wall as rods meet it. With `shear` its surface moves and its geometry does not: it
// slides, or turns about its axis, which of a plane is a normal. A plane may also move along its
// normal, and a cylinder grow, geometry and all.
struct MovingWall {
  WallSurface surface;
  spherocylinder::Vec3 sliding;  // m/s
  spherocylinder::Vec3 turning;  // rad/s
  spherocylinder::Vec3 centre;   // of turning, for a plane (m)
  double growing = 0.0;          // of the cylinder's radius (m/s)

  // Where the end sphere's centre is, as with LIGGGHTS's spheres.
  spherocylinder::Vec3 velocity_at(const EndContact &contact, const spherocylinder::Vec3 &end) const
  {
    if (!surface.is_cylinder) return sliding + cross(turning, end - centre);
    const spherocylinder::Vec3 of_surface = sliding + cross(turning, contact.radial);
    if (growing == 0.0) return of_surface;
    return of_surface + (growing / norm(contact.radial)) * contact.radial;
  }
};

}  // namespace LAMMPS_NS
