// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/gather_pairs.h"
#include "contacts/history_layout.h"
#include "lists/joint_shares.h"
#include "pointers.h"

namespace LAMMPS_NS {

// A contact that begins next to a joint goes on from that of the same rod with the segment on the other side:
// its history is that one's, with which it slides and rolls on. A rank that has neither rod of that other
// contact asks those that have.
class JointHistories : protected Pointers {
 public:
  explicit JointHistories(LAMMPS *lmp) : Pointers(lmp) {}

  // When the touching pairs of a step are known and histories are those of the step before. Collective.
  void hand_over(const TouchingRodPairs &touching, const std::vector<spherocylinder::Capsule> &rods,
                 const JointShares &shares, const PairHistories &histories,
                 const HistoryLayout &layout);

 private:
  // Of a new contact: which other one it may go on from.
  struct Source {
    int segment, neighbour,
        other;  // rods of the new one; the one beyond the joint; by place in memory
  };
  struct New {
    int touch;
    int first, count;  // of its sources, the first of which that touches counts
  };
  std::vector<New> new_;
  std::vector<Source> sources_;

  void find_new(const TouchingRodPairs &touching, const std::vector<spherocylinder::Capsule> &rods,
                const JointShares &shares, int **flags);
  const double *values_of(const TouchingRodPairs &touching, int a, int b,
                          const PairHistories &histories, bool &swapped) const;
  void ask_others(const TouchingRodPairs &touching, const PairHistories &histories,
                  const HistoryLayout &layout, const std::vector<int> &open);
};

}  // namespace LAMMPS_NS
