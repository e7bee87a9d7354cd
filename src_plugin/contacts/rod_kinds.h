// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/capsule.h"
#include "core/contact_kinematics.h"

namespace LAMMPS_NS {

// Rods that are alike in all that does not move: most decks have a few kinds. What a batch of contacts
// holds of two rods' kinds then need not be written again for the next two of the same.
class RodKinds {
 public:
  static constexpr int kMost = 16;
  static constexpr int kNone = -1;  // one of too many kinds

  void clear()
  {
    known_.clear();
    of_rods_.clear();
  }

  void add(int type, const spherocylinder::Capsule &rod,
           const spherocylinder::InverseInertia &inverse)
  {
    const Kind kind = {type,         rod.radius,         rod.segment.half_length,
                       inverse.mass, inverse.transverse, inverse.is_driven};
    int k = of_rods_.empty() ? kNone : of_rods_.back();  // often that of the rod before
    if (k == kNone || !(known_[k] == kind))
      for (k = 0; k < static_cast<int>(known_.size()) && !(known_[k] == kind);) k++;
    if (k == kMost)
      k = kNone;
    else if (k == static_cast<int>(known_.size()))
      known_.push_back(kind);
    of_rods_.push_back(k);
  }

  // Of two rods, one number; kNone if one of them has no kind.
  int of_pair(int i, int j) const
  {
    const int a = of_rods_[i], b = of_rods_[j];
    return a == kNone || b == kNone ? kNone : kMost * a + b;
  }

 private:
  struct Kind {
    int type;
    double radius, half_length, inverse_mass, inverse_transverse;
    bool is_driven;

    bool operator==(const Kind &other) const
    {
      return type == other.type && radius == other.radius && half_length == other.half_length &&
             inverse_mass == other.inverse_mass && inverse_transverse == other.inverse_transverse &&
             is_driven == other.is_driven;
    }
  };
  std::vector<Kind> known_;
  std::vector<int> of_rods_;
};

}  // namespace LAMMPS_NS
