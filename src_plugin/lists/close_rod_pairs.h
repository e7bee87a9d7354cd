// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "atom.h"
#include "core/closest_points.h"
#include "lists/pair_skins.h"
#include "lists/rod_pair_list.h"
#include "rods/needed_ghosts.h"
#include "rods/rod_threads.h"

namespace LAMMPS_NS {

// What the lists of rod pairs held and cost since the run began, of this rank.
struct RodPairCounts {
  int64_t steps = 0;
  int64_t listed = 0;     // pairs in the list, at the last step
  int64_t close = 0;      // of these, tested at the last step
  int64_t touching = 0;   // of these, in contact at the last step
  int64_t renewals = 0;   // of the list or a part of it, those that follow LIGGGHTS's own included
  int64_t refreshes = 0;  // of the close pairs: steps in which some rod had moved through the skin
  double list_skin = 0.0, close_skin = 0.0;  // m, at the last step
};

// The pairs whose surfaces are near enough to be tested in a step: the inner of two lists.
//
// The outer one (RodPairList) holds, with their contact histories, all pairs nearer than a wide skin
// when it was made; this one those nearer than a narrow skin at the rods' reference poses. It stays
// complete while no surface point of a rod has moved more than the rod's half of the skin from its
// reference pose; a rod that has gets a new reference pose, and only its own pairs are looked at again. The
// outer list has reference poses of its own. Once a rod may have used up its half of the outer skin, it
// and all that have used up a good part of theirs get new ones, and their pairs are found again; those of
// the others stay. All of that is local; only the step in which ranks do so is agreed on. The order of the pairs is that of the outer
// list, by indices, so that sums of forces depend neither on the skins nor on when a rod was looked at.
class CloseRodPairs : protected Pointers {
 public:
  struct Entry {
    int i, j;
    int index;     // of j among the neighbours of i in LIGGGHTS's list
    bool swapped;  // the id of j is the lower one
  };

  explicit CloseRodPairs(LAMMPS *lmp) : Pointers(lmp), list_(lmp) {}

  // At the start of a run, when the pair style has asked for its lists. `skin`: of the close pairs (m),
  // 0: to be chosen from what it costs.
  void reset(const PairGran &pair, double skin);

  // Once a step: whether LIGGGHTS has moved rods between ranks and chosen ghosts anew since the step
  // before, and histories are with their rods.
  bool have_rods_migrated();

  // In the first step of a run that goes on with the lists of the one before (`pre no`).
  void check_rods_are_the_same() const;

  // Brings both lists up to date. The present poses in poses.rods() are read here: all of them by
  // poses.read_all(threads), one by poses.reader().read(i). `migrated`: as have_rods_migrated says.
  template <typename Poses>
  void update(PairGran &pair, const RodThreads &threads, Poses &poses, bool migrated)
  {
    make(pair, threads, poses, migrated);
    if (ghosts_->may_be_stale())
      for (bool asks = migrated; asks || any_rank_wants_ghosts(poses.rods()); asks = false) {
        ask_for_ghosts(poses.rods());
        make(pair, threads, poses, false);
      }
    count_step();
  }

  const std::vector<Entry> &entries() const { return entries_; }

  // Ghosts in some listed pair: of others only this need be known, that they do not come near. One
  // rank alone knows it of its own rods, whose images they are, while the box keeps its size.
  const std::vector<int> &tracked_ghosts() const { return list_.ghosts(); }

  // Of each rod of this rank as they are now, by their ids: how many of the close pairs it is in.
  std::vector<int> pairs_of_rods() const;

  // Whether the rods and ghosts at hand are those of the lists, in the same places.
  bool are_of_present_rods() const { return list_.is_of_present_rods(); }

  RodPairCounts &counts() { return counts_; }

 private:
  // Of a thread: fewer are read sooner than others are told.
  static constexpr int kFewestGhosts = 200;

  RodPairList list_;
  PairSkins skins_;
  NeededGhosts *ghosts_ = nullptr;  // of the rods
  std::vector<int> wanted_ghosts_;
  std::vector<char> were_stale_;
  bigint seen_builds_ = -1;  // of LIGGGHTS's lists, in this run
  // Reference poses of both lists; radii with the rod's half of the skin, which is what it may move.
  std::vector<spherocylinder::Capsule> reference_, list_reference_;
  std::vector<double> radii_;         // m, when the list was made
  std::array<double, 3> list_box_{};  // m, then
  // Owned rods that have come through their skins, as each thread has seen them.
  std::vector<std::vector<int>> moving_;
  bool skin_is_new_ = false;  // of the close pairs, in this step
  // Whether a rod or ghost of this rank has its outer skin used up when it moves next, and whether one of any
  // rank has. All find their pairs again in the same step: else each would wait for each other one.
  bool ends_soon_ = false, ends_soon_on_any_ = false;
  // Rods and ghosts whose pairs have to be looked at again, and whether each is one.
  std::vector<int> moved_rods_;
  std::vector<char> moved_;
  // In the order of the outer list; those of rod i begin at first_entry_[i].
  std::vector<Entry> entries_, next_entries_;
  std::vector<int> first_entry_;
  // Whether a row of the list is to be looked at again; those that were, and all their entries.
  std::vector<char> row_changes_;
  struct ChangedRow {
    int row, count;
  };
  std::vector<ChangedRow> changed_rows_;
  std::vector<Entry> changed_entries_;
  // What one thread makes of its part of them.
  struct RowMaker {
    std::vector<Entry> entries;
    int64_t looked_at = 0, walked = 0;
  };
  std::vector<RowMaker> row_makers_;
  // Rods and ghosts that are found again.
  std::vector<int> found_again_;
  std::vector<char> is_found_again_;
  RodPairCounts counts_;

  enum class Wanted { Nothing, ClosePairs, SomePairs, AllPairs };

  template <typename Poses>
  void make(PairGran &pair, const RodThreads &threads, Poses &poses, bool migrated)
  {
    const std::vector<spherocylinder::Capsule> &rods = poses.rods();
    if (migrated) {
      poses.read_all(threads);
      migrated = !list_goes_on(pair, rods);
    }
    Wanted wanted = migrated ? Wanted::AllPairs : look(threads, poses.reader(), rods);
    if (wanted == Wanted::SomePairs) {
      poses.read_all(threads);
      wanted = renew_some(pair, rods) ? Wanted::ClosePairs : Wanted::AllPairs;
    }
    if (wanted == Wanted::AllPairs) {
      if (!migrated) poses.read_all(threads);
      renew(pair, threads, rods, migrated);
    }
    if (wanted == Wanted::ClosePairs) refresh(pair, threads);
  }

  bool list_goes_on(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods);
  // Reads owned rods and tracked ghosts, and looks which have come through their skins.
  template <typename Reader>
  Wanted look(const RodThreads &threads, const Reader reader,
              const std::vector<spherocylinder::Capsule> &rods)
  {
    if (!begin_to_look(threads, static_cast<int>(rods.size()))) return Wanted::AllPairs;
    const int owned = atom->nlocal, pieces = static_cast<int>(moving_.size());
    const spherocylinder::Capsule *reference = reference_.data();
    threads.run(pieces, [=](int piece) {
      const int last = RodThreads::first_of(piece + 1, pieces, owned);
      for (int i = RodThreads::first_of(piece, pieces, owned); i < last; i++) {
        const spherocylinder::Capsule &rod = reader.read(i);
        if (has_used_up_skin(rod, reference[i])) moving_[piece].push_back(i);
      }
    });
    const std::vector<int> &ghosts = tracked_ghosts();
    threads.run_over(static_cast<int>(ghosts.size()), kFewestGhosts,
                     [reader, &ghosts](int first, int last) {
                       for (int k = first; k < last; k++) reader.read(ghosts[k]);
                     });
    return finish_to_look(rods);
  }
  // False if all pairs are to be listed anew.
  bool begin_to_look(const RodThreads &threads, int rods);
  Wanted finish_to_look(const std::vector<spherocylinder::Capsule> &rods);
  static bool has_used_up_skin(const spherocylinder::Capsule &rod,
                               const spherocylinder::Capsule &reference, double stale_by = 0.0)
  {
    const double half = reference.radius - rod.radius - stale_by;
    return twice_shift_squared(rod.segment, reference.segment) > half * half;
  }
  bool is_used_up(int i, const spherocylinder::Capsule &rod) const;
  bool move_on(int i, const spherocylinder::Capsule &rod);
  void move(int i, const spherocylinder::Capsule &rod, double half);
  void list_at(int i, const spherocylinder::Capsule &rod);
  bool is_skin_too_wide(int i, const spherocylinder::Capsule &rod) const;
  double least_half(double speed) const;
  double speed_of(int i) const;
  double mean_root_speed() const;
  bool renew_some(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods);
  bool choose_moved(const std::vector<spherocylinder::Capsule> &rods);
  void renew(PairGran &pair, const RodThreads &threads,
             const std::vector<spherocylinder::Capsule> &rods, bool migrated);
  void refresh(PairGran &pair, const RodThreads &threads);
  void see_changed_rows();
  void remake_rows(PairGran &pair, const RodThreads &threads);
  void remake_row(const NeighList &list, int i, RowMaker &maker) const;
  void put_rows(bool fit);
  void count_step();
  bool is_close(int i, int j) const;
  bool ghosts_stay() const;
  bool stays(int i) const;
  double stale_by(int i) const;
  double may_be_stale_by(int i) const;
  double listed_half(int i, const spherocylinder::Capsule &rod) const;
  double close_half(int i, const spherocylinder::Capsule &rod) const;
  void ask_for_ghosts(const std::vector<spherocylinder::Capsule> &rods);
  bool any_rank_wants_ghosts(const std::vector<spherocylinder::Capsule> &rods);
  bool want_ghosts(const std::vector<spherocylinder::Capsule> &rods) const;
  std::array<double, 3> box_size() const;
};

}  // namespace LAMMPS_NS
