// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "pointers.h"
#include "wall_surface.h"

namespace LAMMPS_NS {

// The rods of LIGGGHTS's neighbour list of a wall whose ends are near it.
//
// LIGGGHTS lists rods whose bounding spheres are near: in a vessel of some rods' lengths that is
// nearly all of them. This list keeps those with an end nearer than a skin. It is made anew when
// LIGGGHTS has made its own, and when the ends may have moved half the skin since: all that is
// looked at in between is how fast the fastest rod is. (The other half is for rods that some fix
// moves otherwise than by the velocity it gives them at the end of its step.)
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
  double skin_ = 0.0;          // m
  double longest_ = 0.0;       // half an axis (m)
  double travelled_ = 0.0;     // by an end since the list was made, at most (m)
  std::vector<int> near_, far_;

  double fastest_end(const WallSurface &surface) const;
  bool is_near(const WallSurface &surface, int i) const;
};

}  // namespace LAMMPS_NS
