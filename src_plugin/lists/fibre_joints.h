// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/rod_joint.h"
#include "pointers.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;
class FibreSegments;

// The joints that this rank's rods have, by places in memory: rods and ghosts are found by fibre and
// place, of several images the nearest. Ranks that share a joint both have it; nothing is communicated.
class FibreJoints : protected Pointers {
 public:
  struct Joint {
    int first, second;  // the first one's head meets the second one's tail; one may be a ghost
  };

  explicit FibreJoints(LAMMPS *lmp);

  // In the order of the owned rods. `who` begins the error about a partner that is not at hand.
  void find(const char *who);

  // The same for one end of a rod or ghost: once the places are listed, -1 if it is not at hand.
  void list_places();
  int partner_at_hand(int i, bool head) const;

  const std::vector<Joint> &joints() const { return joints_; }

  // Rods and ghosts that are this segment or an image of it.
  std::vector<int> at(int fibre, int place) const;

  spherocylinder::JointedRod rod(int i) const;

 private:
  struct Place {
    int fibre, place, index;
  };

  AtomVecSpherocylinder &rods_;
  const FibreSegments &segments_;
  std::vector<Joint> joints_;
  std::vector<Place> places_;  // of rods and ghosts, sorted

  int partner_of(int i, bool head, const char *who) const;
};

}  // namespace LAMMPS_NS
