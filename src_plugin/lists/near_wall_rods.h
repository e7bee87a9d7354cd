// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "pointers.h"
#include "walls/wall_surface.h"

namespace LAMMPS_NS {

// The rods of LIGGGHTS's neighbour list of a wall whose ends are near it; of the outside of a cylinder, those
// of which any part is.
//
// LIGGGHTS lists rods whose bounding spheres are near: in a vessel of some rods' lengths that is
// nearly all of them. This list keeps those with an end nearer than a skin. It is made anew when
// LIGGGHTS has made its own, and when rods and wall may have come nearer by the skin since: all that
// is looked at in between is how far the farthest rod has come, whatever moved it.
class NearWallRods : protected Pointers {
 public:
  explicit NearWallRods(LAMMPS *lmp) : Pointers(lmp) {}

  // LIGGGHTS's list is a new one, or is about to be.
  void forget() { known_ = false; }

  // Once a step. `candidates`: LIGGGHTS's list. True if this one is new.
  bool renew(const WallSurface &surface, const int *candidates, int count, int groupbit);

  // Owned rods, in LIGGGHTS's order: those near, and the candidates that are not.
  const std::vector<int> &near() const { return near_; }
  const std::vector<int> &far() const { return far_; }

 private:
  bool known_ = false;
  double skin_ = 0.0;                     // m
  double longest_ = 0.0;                  // half an axis (m)
  int version_ = 0;                       // of the poses that the list was made at
  spherocylinder::Vec3 surface_point_{};  // then
  double surface_radius_ = 0.0;
  std::vector<int> near_, far_;

  bool is_near(const WallSurface &surface, int i) const;
};

}  // namespace LAMMPS_NS
