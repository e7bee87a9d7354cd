// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "pointers.h"

namespace LAMMPS_NS {

class JointShares;

// Ends the run where two rods overlap far that did not a step ago: some command or fix has put them
// there. Knows the deep overlaps of the step before by the rods' ids, on whatever rank they were.
class SuddenOverlaps : protected Pointers {
 public:
  // An overlap of this share of the diameter that was not there in the step before is no impact: the
  // rod was placed so. An impact that goes up to 0.5, which ContactMonitor warns of, with the longest
  // step that is not warned about, 0.2 of the stability limit 2/omega, begins with at most
  // v dt = (0.5 omega)(0.4/omega) = 0.2.
  static constexpr double kSudden = 0.25;
  static constexpr double kWatched = 0.05;  // overlaps below are not looked up again

  explicit SuddenOverlaps(LAMMPS *lmp) : Pointers(lmp) {}

  // Whether nothing is watched: keyword of the pair style.
  void allow(bool allowed) { allowed_ = allowed; }

  // What one thread saw.
  class Seen {
   public:
    // At most once a contact and step, of all those above kWatched. `overlap`: over the mean diameter;
    // `movable`: either rod can be moved.
    void look(int i, int j, double overlap, bool movable)
    {
      if (overlap > kWatched) deep_.push_back({i, j, overlap, movable});
    }

   private:
    friend class SuddenOverlaps;
    struct Overlap {
      int i, j;
      double overlap;
      bool movable;
    };
    std::vector<Overlap> deep_;
  };
  // Leaves it empty.
  void take(Seen &seen);

  // Once a step, after its contacts. The very first step of all has none before it. `migrated`: rods
  // may have come from another rank. `shares`: null in a deck without fibres.
  void end_step(bool migrated, const JointShares *shares);

  // After rods have been given other ids; `new_id(old)` is 0 for a rod that is gone.
  template <typename NewId>
  void rename(NewId new_id)
  {
    for (Deep &deep : before_) {
      const int id = new_id(deep.id), other_id = new_id(deep.other_id);
      deep.id = std::min(id, other_id);
      deep.other_id = std::max(id, other_id);
    }
  }

 private:
  struct Deep {
    int id, other_id;  // the lower one first
    int i, j;          // where they are in this step
    double overlap;
    bool movable;

    bool operator<(const Deep &other) const
    {
      return id != other.id ? id < other.id : other_id < other.other_id;
    }
  };
  bool allowed_ = false;
  bool is_first_ = true;
  std::vector<Deep> now_, before_;

  void gather_before();
  bool was_there(int id, int other_id) const;
  bool goes_on(const Deep &deep, const JointShares &shares) const;
  [[noreturn]] void end_run(const Deep &found) const;
};

}  // namespace LAMMPS_NS
