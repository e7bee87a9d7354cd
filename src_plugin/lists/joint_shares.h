// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/joint_share.h"
#include "lists/fibre_joints.h"
#include "update.h"

namespace LAMMPS_NS {

// What of a contact is a segment's where it may be its neighbour's as well (core/joint_share.h), for pairs and
// walls. Attached to the rods.
class JointShares : protected Pointers {
 public:
  explicit JointShares(LAMMPS *lmp) : Pointers(lmp), joints_(lmp) {}

  // Once a step, before the others: finds neighbours anew if rods may have other places. False in a
  // deck without fibres, on all ranks.
  bool bring_up_to_date();

  // Whether rods have been joined or parted since the step before: contacts at such a joint are others at once. Walls
  // see it in the step in which it is done, pairs in the next.
  bool have_changed() const
  {
    return changed_step_ >= 0 && update->ntimestep - changed_step_ <= 1;
  }

  // The rod joined at an end, -1 without.
  int neighbour(int i, bool head) const { return neighbours_[i][head]; }
  std::array<int, 3> with_neighbours(int i) const
  {
    return {i, neighbours_[i][0], neighbours_[i][1]};
  }

  // Of a rod's contact.
  struct Share {
    double share = 1.0;
    double beyond =
        0.0;  // how far beyond a joint it may be: at the head, or negative at the tail (m)
    // Force on the rod, over the stiffness, at the other one's point of contact (m): as its share grows and
    // its neighbour's falls, their energies differ if the joint is stretched.
    spherocylinder::Vec3 push = spherocylinder::kZero;
  };
  // Of rod i in the contact with rod j at s on the axis of i and t on that of j. That of the pair is the product of both rods'.
  Share of_one(int i, int j, const std::vector<spherocylinder::Capsule> &rods, double s,
               double t) const;
  // Of rod i with anything else, of which `other` is the axis at hand, where both overlap at less than
  // `reach`; at s. Of neighbours in the groups of `groupbit`.
  Share of_rod(int i, const spherocylinder::Capsule &rod, double s,
               const spherocylinder::Segment &other, double reach, int groupbit) const;
  // Of an end at a plane or the inside of a cylinder, where the neighbour's end is as well: half.
  double of_end(int i, bool head, int groupbit) const;

  // Whether the contact at s is near enough to an end that is joined. `other`: half length.
  bool is_near_joint(int i, const spherocylinder::Capsule &rod, double s, bool head,
                     double other) const;

 private:
  FibreJoints joints_;
  const FibreSegments *segments_ = nullptr;  // of the rods
  std::vector<std::array<int, 2>> neighbours_;  // of rods and ghosts: at the tail, at the head
  struct Seen {
    bigint builds = -1, last_build = -1;
    int rods = -1, ghosts = -1, changes = -1;
  };
  Seen seen_;
  bigint changed_step_ = -1;

  void share_at_end(Share &share, int i, bool head, const spherocylinder::Capsule &rod, double s,
                    const spherocylinder::Segment &other, double reach) const;
};

}  // namespace LAMMPS_NS
