// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

class FibreJoints;
class FibreSegments;

// What changes in FibreSegments::kEnds of two segments when their joint breaks, or when two that have lain in
// each other since a joint broke have come apart. Sent from rank to rank as so many ints.
struct EndsChange {
  int fibre;
  struct OfRod {
    int place, cleared, set;
  } first, second;

  // Of a joint, by its first rod.
  static EndsChange broken(const FibreSegments &segments, int first, int second);
};

// The segments that overlap where a fibre was parted, and do not touch before they have come apart once: the
// neighbours at the joint that broke, and of short segments the next but one across it.
class FibrePartings : protected Pointers {
 public:
  explicit FibrePartings(LAMMPS *lmp) : Pointers(lmp) {}

  // Among this rank's rods and ghosts; the owner of the first rod has the pair. After joints.find().
  void find(const FibreJoints &joints, const FibreSegments &segments);

  bool empty() const { return pairs_.empty(); }

  // Ghosts that have to be known in each step.
  void add_ghosts(std::vector<int> &ghosts) const;

  // Of those that are apart now.
  void add_parted(std::vector<EndsChange> &changes) const;

 private:
  struct Pair {
    int first;
    std::vector<int> seconds;  // the rod and its images, those at hand
    EndsChange change;
  };
  std::vector<Pair> pairs_;

  bool are_apart(const Pair &pair) const;
};

}  // namespace LAMMPS_NS
