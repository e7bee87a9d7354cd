// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/capsule.h"
#include "pointers.h"
#include "region_neighbor_list.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;

// The rods an inserted rod must keep clear of: this rank's rods and ghosts as they were when the
// insertion began, and those placed since. LIGGGHTS's own insertion list holds bounding spheres
// only; it bins ours, and this class compares the true shapes. Attached to the rods, shared by all
// templates of one insertion.
class RodInsertionList : protected Pointers {
 public:
  explicit RodInsertionList(LAMMPS *lmp);

  // Collects the rods anew if this insertion (a fix's own list, at one time step) has not been
  // seen yet. `bounding_radius`: of the largest rod this insertion may place (m).
  void begin(const void *insertion, double bounding_radius);

  // Whether the capsule overlaps any rod here. A touch counts as an overlap.
  bool overlaps(const spherocylinder::Capsule &capsule);

  void add(const spherocylinder::Capsule &capsule);

 private:
  AtomVecSpherocylinder &rods_;
  RegionNeighborList<interpolate_no> bins_;
  std::vector<spherocylinder::Capsule> capsules_;
  std::vector<int> near_;
  const void *insertion_ = nullptr;
  bigint step_ = -1;
};

}  // namespace LAMMPS_NS
