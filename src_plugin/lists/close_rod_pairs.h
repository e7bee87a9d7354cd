// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/closest_points.h"
#include "lists/rod_pair_list.h"

namespace LAMMPS_NS {

// What the lists of rod pairs held and cost since the run began, of this rank.
struct RodPairCounts {
  int64_t steps = 0;
  int64_t listed = 0;     // pairs in the list, at the last step
  int64_t close = 0;      // of these, tested at the last step
  int64_t touching = 0;   // of these, in contact at the last step
  int64_t renewals = 0;   // of the list, those that follow LIGGGHTS's own included
  int64_t refreshes = 0;  // of the close pairs: steps in which some rod had moved through the skin
  double list_skin = 0.0, close_skin = 0.0;  // m, at the last step
};

// The pairs whose surfaces are near enough to be tested in a step: the inner of two lists.
//
// The outer one (RodPairList) holds, with their contact histories, all pairs nearer than a wide skin
// when it was made; this one those nearer than a narrow skin at the rods' reference poses. It stays
// complete while no surface point of a rod has moved more than half the skin from the rod's reference
// pose; a rod that has gets a new reference pose, and only its own pairs are looked at again. Once
// such a rod may have used up its half of the outer skin, the outer list is made again. All of that is
// local: no communication. The order of the pairs is that of the outer list, by indices, so
// that sums of forces depend neither on the skins nor on when a rod was looked at.
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

  // Brings both lists up to date; `read(all)` is asked for the present poses in `rods`, of all rods or
  // only of tracked ones. `migrated`: as have_rods_migrated says.
  template <typename Read>
  void update(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods, bool migrated,
              Read read)
  {
    read(migrated);
    if (migrated || !look(pair, rods)) {
      if (!migrated) read(true);
      renew(pair, rods, migrated);
    }
    count_step();
  }

  const std::vector<Entry> &entries() const { return entries_; }

  // Ghosts in some listed pair: of others only this need be known, that they do not come near. One
  // rank alone knows it of its own rods, whose images they are, while the box keeps its size.
  const std::vector<int> &tracked_ghosts() const { return list_.ghosts(); }

  RodPairCounts &counts() { return counts_; }

 private:
  RodPairList list_;
  bool skin_is_chosen_ = true;
  bool skins_are_tried_ = false;                         // long enough to choose others
  bigint seen_builds_ = -1;                              // of LIGGGHTS's lists, in this run
  double diameter_ = 0.0;                                // mean of all rods at hand (m)
  double skin_ = 0.0, list_skin_ = 0.0;                  // m
  std::vector<spherocylinder::Capsule> reference_;       // of the close pairs
  std::vector<spherocylinder::Segment> list_reference_;  // of the outer list
  std::array<double, 3> list_box_{};                     // m, when it was made
  std::vector<char> moved_;
  bool any_moved_ = false;
  std::vector<Entry> entries_, next_entries_;
  RodPairCounts counts_;

  // What was done since the skins were chosen: pairs tested, in steps; pairs of the list walked along
  // and looked at, in refreshes; cells entered and pairs tried, in renewals.
  struct Work {
    int64_t steps = 0, tested = 0, walked = 0, looked_at = 0, renewals = 0, cells = 0, tried = 0;
  } work_;

  bool look(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods);
  bool follow(int i, const spherocylinder::Capsule &rod, bool all);
  void renew(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods, bool migrated);
  int64_t walk(PairGran &pair);
  void count_step();
  bool is_close(int i, int j) const;
  void widen_list();
  void choose_skins();
  bool ghosts_stay() const;
  std::array<double, 3> box_size() const;
  static double twice_shift_squared(const spherocylinder::Segment &now,
                                    const spherocylinder::Segment &then);
};

}  // namespace LAMMPS_NS
