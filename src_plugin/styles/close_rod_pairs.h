// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/closest_points.h"

namespace LAMMPS_NS {

class NeighList;

// The pairs of LIGGGHTS's neighbour list whose surfaces are near.
//
// LIGGGHTS lists pairs whose bounding spheres are near: for long rods tens of times more than
// touch. This list keeps those whose surfaces, at the rods' reference poses, are nearer than a
// skin. It stays complete while no surface point of a rod has moved more than half the skin from
// the rod's reference pose; a rod that has gets a new reference pose, and only its own pairs are
// looked at again. All of that is local: no communication, and contact histories stay where
// LIGGGHTS keeps them. The order of the pairs is that of LIGGGHTS's list, so that sums of forces
// do not depend on when a rod was looked at.
class CloseRodPairs {
 public:
  struct Entry {
    int i, j;
    int index;  // of j among the neighbours of i in LIGGGHTS's list
  };

  // Brings the list up to date. `rods`: all owned and ghost rods; `rebuilt`: LIGGGHTS's list is a
  // new one. Pairs with a contact flag are always kept.
  void update(const NeighList &list, int **contact_flags,
              const std::vector<spherocylinder::Capsule> &rods, bool rebuilt);

  const std::vector<Entry> &entries() const { return entries_; }

 private:
  double skin_ = 0.0;  // m
  std::vector<spherocylinder::Capsule> reference_;
  std::vector<char> moved_;
  std::vector<Entry> entries_, next_entries_;

  bool mark_moved(const std::vector<spherocylinder::Capsule> &rods);
  bool is_close(int i, int j) const;
};

}  // namespace LAMMPS_NS
