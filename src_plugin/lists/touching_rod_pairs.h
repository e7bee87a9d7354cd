// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/closest_points_batch.h"
#include "lists/close_rod_pairs.h"
#include "rods/rod_threads.h"

namespace LAMMPS_NS {

class JointShares;

// Of the close pairs, those that touch now, worked out in batches.
class TouchingRodPairs {
 public:
  struct Touch {
    int i, j;
    int index;                             // as in CloseRodPairs::Entry
    spherocylinder::ClosestPoints points;  // p on i, q on j
    double distance;                       // |p - q| (m)
    bool nearly_parallel;                  // spread_contact may move the contact
    double beyond_i, beyond_j;  // ends of fibres reach so far beyond joints, JointShares::Share
  };

  // core/closest_points_batch.h, or what misses some of the contacts.
  using Search = void (*)(spherocylinder::SegmentPairs &);
  void search_by(Search search) { search_ = search; }

  // Of fibres: what of each contact is its pair's. Null without. Those of nothing do not touch.
  void share_by(const JointShares *shares) { shares_ = shares; }

  // Once a step: cuts the close pairs into pieces for the threads. `close` is to stay as it is while they are
  // asked for.
  void cut(const RodThreads &threads, const std::vector<CloseRodPairs::Entry> &close, size_t rods);
  // Whether what is read of them is worth asking for early.
  bool are_rods_far() const { return are_rods_far_; }
  // Then once for each piece, by any threads. `contact_flags`: of LIGGGHTS's history list, null without one.
  void find(int piece, const std::vector<spherocylinder::Capsule> &rods, int **contact_flags);

  // What one thread has found: places that follow each other, of pairs with rods from first_rod on, and
  // below next_rod, in the place of i. Pieces and places are in the order of the close pairs.
  struct Piece {
    int first, count;
    int first_rod, next_rod;
  };
  const std::vector<Piece> &pieces() const { return pieces_; }
  int count() const;
  // By place. A copy of it is not read anew whenever something is written.
  class Pairs {
   public:
    Pairs(const CloseRodPairs::Entry *close, const int *of_close)
        : close_(close), of_close_(of_close)
    {
    }
    const CloseRodPairs::Entry &operator[](int n) const { return close_[of_close_[n]]; }

   private:
    const CloseRodPairs::Entry *close_;
    const int *of_close_;
  };
  Pairs pairs() const { return {close_->data(), of_close_.data()}; }
  const CloseRodPairs::Entry &pair(int n) const { return pairs()[n]; }
  Touch touch(int n) const;
  const std::vector<CloseRodPairs::Entry> &close() const { return *close_; }
  template <typename See>
  void for_each(See see) const
  {
    for (const Piece &piece : pieces_)
      for (int n = piece.first; n < piece.first + piece.count; n++) see(touch(n));
  }
  // Of a piece: pairs that do not touch but still have a contact flag.
  const std::vector<CloseRodPairs::Entry> &parted(int piece) const
  {
    return searchers_[piece].parted;
  }

  // Of the one in this place; null without fibres.
  const double *shares(int first) const { return shares_ ? &share_[first] : nullptr; }
  // Then, where it is not all: what each rod is pushed beside, JointShares::Share.
  const spherocylinder::Vec3 &push_i(int n) const { return push_i_[n]; }
  const spherocylinder::Vec3 &push_j(int n) const { return push_j_[n]; }

  // Those from the place `first` on, and whatever stands behind the last up to a whole batch.
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
  // What a thread searches with.
  struct alignas(spherocylinder::kCacheLine) Searcher {
    spherocylinder::SegmentPairs batch{};
    // Of the batch: the rods by their ids' order, and whether that is not the list's.
    const spherocylinder::Capsule *first[spherocylinder::kBatch], *second[spherocylinder::kBatch];
    spherocylinder::Doubles swapped{};
    std::vector<CloseRodPairs::Entry> parted;

    void set(const CloseRodPairs::Entry *entries, int count,
             const std::vector<spherocylinder::Capsule> &rods);
    void make_certain(int count);
  };

  const JointShares *shares_ = nullptr;
  Search search_ = spherocylinder::closest_points;
  std::vector<Searcher> searchers_;
  const std::vector<CloseRodPairs::Entry> *close_ = nullptr;
  std::vector<Piece> pieces_;
  bool are_rods_far_ = false;
  std::vector<int>
      of_close_;  // and of each the numbers of its touch, a batch longer than the close pairs
  std::vector<double> s_, t_, delta_x_, delta_y_, delta_z_, distance_squared_, nearly_parallel_;
  std::vector<double> share_, beyond_i_, beyond_j_;  // the same, with fibres
  std::vector<spherocylinder::Vec3> push_i_, push_j_;

  void make_room(size_t close);
  void keep_touching(Piece &piece, Searcher &searcher, int start, int count, int **contact_flags);
  void place_beyond(int n, const spherocylinder::Segment &i, const spherocylinder::Segment &j,
                    double beyond_i, double beyond_j, bool swapped);
  void share(Piece &piece, Searcher &searcher, const std::vector<spherocylinder::Capsule> &rods,
             int **contact_flags);
};

}  // namespace LAMMPS_NS
