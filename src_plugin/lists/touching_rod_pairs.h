// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/closest_points_batch.h"
#include "lists/close_rod_pairs.h"

namespace LAMMPS_NS {

// Of the close pairs, those that touch now, worked out in batches.
class TouchingRodPairs {
 public:
  struct Touch {
    int i, j;
    int index;                             // as in CloseRodPairs::Entry
    spherocylinder::ClosestPoints points;  // p on i, q on j
    double distance;                       // |p - q| (m)
    bool nearly_parallel;                  // spread_contact may move the contact
  };

  // core/closest_points_batch.h, or what misses some of the contacts.
  using Search = void (*)(spherocylinder::SegmentPairs &);
  void search_by(Search search) { search_ = search; }

  // `contact_flags`: of LIGGGHTS's history list, null without one.
  void find(const std::vector<CloseRodPairs::Entry> &close,
            const std::vector<spherocylinder::Capsule> &rods, const int *tag, int **contact_flags);

  // In the order of the close pairs.
  const std::vector<Touch> &touching() const { return touching_; }
  // Pairs that do not touch but still have a contact flag.
  const std::vector<CloseRodPairs::Entry> &parted() const { return parted_; }

 private:
  Search search_ = spherocylinder::closest_points;
  spherocylinder::SegmentPairs batch_{};
  std::vector<Touch> touching_;
  std::vector<CloseRodPairs::Entry> parted_;
};

}  // namespace LAMMPS_NS
