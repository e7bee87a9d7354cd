// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/near_pairs.h"
#include "lists/rows_with_room.h"
#include "pointers.h"

namespace LAMMPS_NS {

class FibreSegments;
class NeighList;
class PairGran;

// The neighbour list of pair_style gran for rods, in the place of LIGGGHTS's own.
//
// LIGGGHTS lists the pairs whose bounding spheres are near, with a contact history for each: for
// long rods tens of times more than have anything to do with one another. This one lists the pairs
// whose surfaces are nearer than a gap. It fills LIGGGHTS's own list object, so that fix contacthistory
// and whoever else asks for the pair style's list find it there. LIGGGHTS keeps deciding when rods
// migrate and ghosts are chosen anew; between that the list can be made again at any time from the
// rods at hand, without communication.
class RodPairList : protected Pointers {
 public:
  explicit RodPairList(LAMMPS *lmp) : Pointers(lmp) {}

  // Lists the pairs that touch, of rods whose radii hold their halves of the skin; partners of a rod in
  // ascending order. Histories come from fix contacthistory if LIGGGHTS has just migrated the rods, else
  // from the list before.
  void renew(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods, bool migrated);

  // The same of `moved` rods and ghosts only: what was found of them is dropped, but for pairs in
  // contact, and found anew among the `rods`, of which the others are where they were. False if all
  // have to be looked at; the list is then as it was.
  bool renew_some(PairGran &pair, const std::vector<spherocylinder::Capsule> &rods,
                  const std::vector<int> &moved, const std::vector<char> &is_moved);

  // After renew_some: rods whose pairs it may have changed, ascending, and ghosts that are in the list
  // only since.
  const std::vector<int> &changed_rows() const { return changed_; }
  const std::vector<int> &new_ghosts() const { return new_ghosts_; }

  // After LIGGGHTS has migrated rods, if they and the ghosts are those that the list is of, in the same
  // places: it goes on, histories and all. False if it may not: groups, exclusions and fibres may be others.
  bool goes_on(PairGran &pair);

  // The rods in whose rows a rod or ghost is.
  const Holders &holders() const { return holders_; }

  // Whether the rods and ghosts at hand are those that the list is of, in the same places.
  bool is_of_present_rods() const;

  // The ids of its rods and then of ghosts, by their places when LIGGGHTS last put them in order.
  const std::vector<int> &ids() const { return ids_; }

  // Ghosts that are in the list or have been since all of it was made, ascending.
  const std::vector<int> &ghosts() const { return ghosts_; }
  // The search for the list that is there.
  const spherocylinder::NearPairs &search() const { return near_; }
  int pairs() const { return pairs_; }

 private:
  struct Contents {
    RowsWithRoom rows;                 // by owned rod
    std::vector<int> partners, flags;  // ascending in each row
    std::vector<double> history;       // dnum values a pair
  };
  Contents now_, before_;
  int pairs_ = 0, dnum_ = 0;
  bool grown_ = false;                     // the arrays, by some row
  const FibreSegments *fibres_ = nullptr;  // null without any
  int seen_fibres_ = 0;                    // their changes when the list was made
  Holders holders_;
  spherocylinder::NearPairs near_;
  std::vector<int> ghosts_, new_ghosts_;
  // Rods, and ids of rods and ghosts, when LIGGGHTS last put them in order.
  int owned_ = 0;
  std::vector<int> ids_;

  // Of one row, as it is made anew; all others as they are found.
  std::vector<int> partners_, flags_, changed_, remade_;
  std::vector<double> history_;
  std::vector<spherocylinder::NearPairs::Pair> found_;

  spherocylinder::SearchPieces pieces_of(int rods) const;
  bool is_listed(int i, int j) const;
  void begin_row();
  void add(int partner);
  void add_as(const Contents &contents, int place);
  bool put_row(int i);
  void keep_row(int i, const int *partner, const int *end);
  void fetch_histories(const NeighList &list);
  void remake_row(int i, const spherocylinder::NearPairs::Pair *found,
                  const spherocylinder::NearPairs::Pair *end, const std::vector<char> &is_moved);
  void hand_over(NeighList &list);
  void hand_over_row(NeighList &list, int i);
  void see_ghosts();
  void see_new_ghosts();
};

}  // namespace LAMMPS_NS
