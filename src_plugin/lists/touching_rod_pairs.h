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

  // `close` is to stay as it is while they are asked for. `contact_flags`: of LIGGGHTS's history list,
  // null without one.
  void find(const std::vector<CloseRodPairs::Entry> &close,
            const std::vector<spherocylinder::Capsule> &rods, int **contact_flags);

  // In the order of the close pairs.
  int count() const { return count_; }
  const CloseRodPairs::Entry &pair(int n) const { return (*close_)[of_close_[n]]; }
  Touch touch(int n) const;
  // Pairs that do not touch but still have a contact flag.
  const std::vector<CloseRodPairs::Entry> &parted() const { return parted_; }

  // Those from the one numbered `first`, and whatever stands behind the last up to a whole batch.
  spherocylinder::ClosestLanes lanes(int first) const
  {
    return {&s_[first],
            &t_[first],
            &delta_x_[first],
            &delta_y_[first],
            &delta_z_[first],
            &distance_squared_[first],
            &nearly_parallel_[first]};
  }

 private:
  Search search_ = spherocylinder::closest_points;
  spherocylinder::SegmentPairs batch_{};
  // Of the batch: the rods by their ids' order, and whether that is not the list's.
  const spherocylinder::Capsule *first_[spherocylinder::kBatch], *second_[spherocylinder::kBatch];
  spherocylinder::Doubles swapped_{};

  const std::vector<CloseRodPairs::Entry> *close_ = nullptr;
  int count_ = 0;
  std::vector<int> of_close_;  // and of each the numbers of its touch, longer than count_
  std::vector<double> s_, t_, delta_x_, delta_y_, delta_z_, distance_squared_, nearly_parallel_;
  std::vector<CloseRodPairs::Entry> parted_;

  void make_room(size_t close);
  void set_batch(size_t start, int count, const std::vector<spherocylinder::Capsule> &rods);
  void make_certain(int count);
  void keep_touching(size_t start, int count, int **contact_flags);
};

}  // namespace LAMMPS_NS
