// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/capsule.h"
#include "core/contact_kinematics.h"

namespace LAMMPS_NS {

// Rods that are alike in all that does not move: most decks have a few kinds. What a batch of contacts
// holds of two rods' kinds then need not be written again for the next two of the same. A number never
// comes again for other kinds.
class RodKinds {
 public:
  static constexpr int kMost = 16;
  static constexpr int64_t kNone = -1;  // one of too many kinds

  void clear()
  {
    generation_++;
    known_.clear();
    of_rods_.clear();
    has_unknown_ = false;
  }

  void add(int type, const spherocylinder::Capsule &rod,
           const spherocylinder::InverseInertia &inverse)
  {
    const Kind kind = {type,         rod.radius,         rod.segment.half_length,
                       inverse.mass, inverse.transverse, inverse.is_driven};
    int k = of_rods_.empty() ? kUnknown : of_rods_.back();  // often that of the rod before
    if (k == kUnknown || !(known_[k] == kind))
      for (k = 0; k < static_cast<int>(known_.size()) && !(known_[k] == kind);) k++;
    has_unknown_ |= k == kMost;
    if (k == kMost)
      k = kUnknown;
    else if (k == static_cast<int>(known_.size()))
      known_.push_back(kind);
    of_rods_.push_back(k);
  }

  // False if rod i was added as another kind; of one of too many kinds it is not known.
  bool may_be(int i, int type, const spherocylinder::Capsule &rod,
              const spherocylinder::InverseInertia &inverse) const
  {
    const Kind kind = {type,         rod.radius,         rod.segment.half_length,
                       inverse.mass, inverse.transverse, inverse.is_driven};
    return of_rods_[i] == kUnknown || known_[of_rods_[i]] == kind;
  }

  // Of any two rods, where all are of one kind; else kNone.
  int64_t of_all_pairs() const
  {
    return known_.size() == 1 && !has_unknown_ ? generation_ * kMost * kMost : kNone;
  }

  // Of two rods, one number; kNone if one of them has no kind.
  int64_t of_pair(int i, int j) const
  {
    const int a = of_rods_[i], b = of_rods_[j];
    return a == kUnknown || b == kUnknown ? kNone : (generation_ * kMost + a) * kMost + b;
  }

 private:
  static constexpr int kUnknown = -1;
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
  int64_t generation_ = 0;
  std::vector<Kind> known_;
  std::vector<int> of_rods_;
  bool has_unknown_ = false;
};

}  // namespace LAMMPS_NS
