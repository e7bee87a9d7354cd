// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cstdlib>

namespace LAMMPS_NS {

class LAMMPS;

// Rods that are segments of fibres: which fibre, which place in its chain, what is joined. The values
// travel with their rods in fix fibres/spherocylinder, which is there only if some rod is a segment.
// Attached to the rods.
//
// The head of a segment (its end along +axis) is joined to the tail of the one at the next place. Neither
// says anything of a rod's id, so that joints outlive ids that are made anew.
class FibreSegments {
 public:
  explicit FibreSegments(LAMMPS *) {}

  // Of a row; fibre and place from 1, no fibre: 0. Of the joint at the head: bend and twist without load, the
  // energy that bending it for good has taken and the one it had when it broke (J).
  enum Column {
    kFibre,
    kPlace,
    kEnds,
    kBendX,
    kBendY,
    kTwist,
    kPlasticWork,
    kReleasedEnergy,
    kColumns
  };

  enum Ends : int {
    kTailJoined = 1,
    kHeadJoined = 2,
    // The hemisphere is counted in the neighbour's mass: also after the joint has gone.
    kTailShared = 4,
    kHeadShared = 8,
    // The joint that makes a ring of the chain, from its last segment's head to its first one's tail.
    kTailCloses = 16,
    kHeadCloses = 32,
    kRestGiven = 64,  // of the joint at the head
    // The next segment but one is so near, by the segment between, that both overlap when straight.
    kTailPasses = 128,
    kHeadPasses = 256,
    // The same across the joint that makes a ring: of the first two and the last two of the chain.
    kTailPassesRing = 512,
    kHeadPassesRing = 1024,
    // The joint at the head broke; and its two rods have not come apart since.
    kHeadBroken = 2048,
    kHeadParts = 4096,
    kAllEnds = 8191
  };

  double **rows = nullptr;  // of all rods and ghosts; null without fibres
  int changes = 0;          // how often joints were made or cut

  int fibre(int i) const { return value(i, kFibre); }
  int place(int i) const { return value(i, kPlace); }
  int ends(int i) const { return value(i, kEnds); }
  bool is_segment(int i) const { return rows && fibre(i) > 0; }
  int shared_ends(int i) const
  {
    if (!is_segment(i)) return 0;
    return ((ends(i) & kTailShared) != 0) + ((ends(i) & kHeadShared) != 0);
  }

  // Whether the rods are neighbours at a joint, or next but one and too near to be anything but in touch; or
  // were, and have overlapped since a joint between them broke.
  bool never_touch(int i, int j) const
  {
    if (!rows || fibre(i) == 0 || fibre(i) != fibre(j)) return false;
    return place(i) < place(j) ? are_too_near(i, j) : are_too_near(j, i);
  }

  // Of a rod that is new in memory.
  void clear(int i)
  {
    if (rows) std::fill_n(rows[i], static_cast<int>(kColumns), 0.0);
  }

 private:
  int value(int i, Column column) const { return static_cast<int>(rows[i][column]); }

  bool has(int i, int end) const { return (ends(i) & end) != 0; }

  // i before j in the chain.
  bool are_too_near(int i, int j) const
  {
    const int between = place(j) - place(i) - 1;
    if (between == 0 && has(i, kHeadJoined | kHeadParts)) return true;
    if (between == 1 && has(i, kHeadPasses)) return true;
    if (has(i, kTailCloses) && has(j, kHeadCloses) && has(j, kHeadJoined | kHeadParts)) return true;
    // The first and the last but one, or the second and the last.
    return has(i, kTailPassesRing) && has(j, kHeadPassesRing) &&
           (place(i) == 1) != has(j, kHeadCloses);
  }
};

}  // namespace LAMMPS_NS
