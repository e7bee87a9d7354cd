// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/near_pairs.h"
#include "pointers.h"

namespace LAMMPS_NS {

class NeighList;
class PairGran;

// The neighbour list of pair_style gran for rods, in the place of LIGGGHTS's own.
//
// LIGGGHTS lists the pairs whose bounding spheres are near, with a contact history for each: for
// long rods tens of times more than have anything to do with one another. This one lists the pairs
// whose surfaces are nearer than a gap. It fills LIGGGHTS's own list object, so that fix contacthistory
// and whoever else asks for the pair style's list find it there. LIGGGHTS keeps deciding when rods
// migrate and ghosts are chosen anew; between that the list can be made again at any time from the
// rods at hand, without communication.
class RodPairList : protected Pointers {
 public:
  explicit RodPairList(LAMMPS *lmp) : Pointers(lmp) {}

  // Lists the pairs nearer than `gap` (m), partners of a rod in ascending order. Histories come from
  // fix contacthistory if LIGGGHTS has just migrated the rods, else from the list before.
  void renew(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods, double gap,
             bool migrated);

  // Whether the rods and ghosts at hand are those that the list is of, in the same places.
  bool is_of_present_rods() const;

  // Ghosts that are in the list, ascending.
  const std::vector<int> &ghosts() const { return ghosts_; }
  // The search for the list that is there.
  const spherocylinder::NearPairs &search() const { return near_; }
  int pairs() const { return static_cast<int>(now_.partners.size()); }

 private:
  struct Contents {
    std::vector<int> first, partners, flags;  // first: by owned rod, and one more
    std::vector<double> history;              // dnum values a pair
  };
  Contents now_, before_;
  spherocylinder::NearPairs near_;
  std::vector<int> ghosts_;
  std::vector<int> ids_;  // of rods and ghosts, when LIGGGHTS last put them in order

  bool is_listed(int i, int j) const;
  void keep_histories(int dnum);
  void fetch_histories(const NeighList &list, int dnum);
  void hand_over(NeighList &list);
};

}  // namespace LAMMPS_NS
