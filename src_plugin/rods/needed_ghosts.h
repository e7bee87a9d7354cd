// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/capsule.h"
#include "host/private_members.h"
#include "lmptype.h"
#include "pointers.h"
#include "rods/field_travel.h"

namespace LAMMPS_NS {

// What went to other ranks for their ghosts since the run began, of this rank.
struct GhostCounts {
  int64_t messages = 0, poses = 0, bytes = 0;  // those of new ghosts included
  int64_t asked = 0;                           // how often ghosts were asked for
};

// The ghosts that LIGGGHTS's messages of a step hold.
//
// LIGGGHTS sends all of them in each step; of long rods most touch nothing. Here a rank asks for those that
// are near its rods and gets them in each step. Of the others it gets a new pose when the owner is farther than
// a slack from the pose that was sent: such a ghost is stale, its owner anywhere within the slack. It must
// be asked for before it may touch a rod.
//
// Ghosts go from rank to rank, one swap after the other. What is asked for goes all the way in each step. Where a
// rank passes on what is stale with itself, it does so whenever something new has come, so that all ranks
// behind it have its pose: none is farther from the owner's than the slack.
class NeededGhosts : protected Pointers {
 public:
  explicit NeededGhosts(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of a run, by all ranks: whether ghosts may be left out. `who` wants all in each step.
  void begin_run();
  void send_all_for(const std::string &who) { reader_ = who; }
  const std::string &reader() const { return reader_; }
  bool may_be_stale() const;

  // Before LIGGGHTS makes new ghosts: these are all sent until they are asked for.
  void forget();

  // By all ranks, with the poses of this step in the ghosts: from now on these are sent, `wanted` on this rank.
  // If ghosts were asked for before, those that are new among them are brought up to date.
  void ask_for(const std::vector<int> &wanted);
  bool are_asked_for() const { return asked_for_; }
  // Those that any rank has set.
  int flags_of_ranks(int mine) const;
  // By all ranks, before rods are inserted: all ghosts get the poses of their owners. Once a step: the first
  // fix that inserts puts its rods where LIGGGHTS has the ghosts, which are kept here for those after it.
  void bring_all_before_insertion();
  // Of this step's, null if none were brought.
  const std::vector<spherocylinder::Capsule> *before_insertion() const;

  // How far the owner of a ghost may be from the ghost where it is stale (m).
  double slack(int i) const { return kSlack * radius_of(i); }
  bool is_stale(int ghost) const { return asked_for_ && !is_sent_[ghost - first_ghost_]; }

  // Ghosts with poses that have come since they were last forgotten, some more than once; all of them are not
  // named where not are_asked_for.
  const std::vector<int> &arrived() const { return arrived_; }
  void forget_arrived();

  const GhostCounts &counts() const { return counts_; }

  // For the atom style: the messages of a swap.
  int pack(unsigned travel, int n, const int *list, const GhostGain &gain, double *buf);
  void unpack(unsigned travel, int n, int first, const double *buf);
  bool is_asking() const { return is_asking_; }
  int pack_asked(int n, int first, double *buf);
  void unpack_asked(int n, const int *list, const double *buf);
  void count(const int *list, int poses, int numbers);

 private:
  std::vector<spherocylinder::Capsule> before_insertion_;
  bigint brought_step_ = -1;
  // Of a rod's radius: what a stale ghost costs the lists in pairs it costs less in messages.
  static constexpr double kSlack = 0.15;

  // A rod or ghost that is not sent in each step, the place it has in the swap, and its pose at the other side.
  struct Kept {
    int rod, place;
    spherocylinder::Segment sent;
  };
  struct Swap {
    GhostSwap of_host;
    std::vector<int> sent, received;  // in each step
    std::vector<Kept> kept;
    bool is_new = true;  // no message since it was last asked for
  };

  std::string reader_;
  bool asked_for_ = false, is_asking_ = false, sends_all_ = false;
  std::vector<Swap> swaps_;
  int first_ghost_ = 0;
  std::vector<char> is_sent_;  // to this rank, in each step; by ghost
  std::vector<int> arrived_;
  std::vector<char> has_arrived_;  // by ghost
  GhostCounts counts_;
  // Of one message: rods that are sent beside those asked for, and their places.
  std::vector<int> others_, places_;

  double radius_of(int i) const;
  void see_swaps();
  void see_arrived(int ghost);
  Swap &swap_from(const int *list);
  Swap &swap_to(int first);
  bool is_as_it_was(const Swap &swap, int i) const;
  double slack_squared_here(int i) const;
  spherocylinder::Segment across(int i, const spherocylinder::Vec3 &period) const;
  int pack_needed(unsigned travel, Swap &swap, const GhostGain &gain, double *buf);
};

}  // namespace LAMMPS_NS
