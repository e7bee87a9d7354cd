// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>

namespace LAMMPS_NS {

// How wide the skins of the two lists of near pairs are (CloseRodPairs): that of the close pairs and the
// wider one of the list. Both belong half to either rod of a pair; the half of a rod is wider the faster
// it is. A pair costs with the width of its skins, a rod each time that it has come through its own, so that
// the width that costs least grows as the root of the speed. For a rod of the mean root the halves are those
// of close() and listed().
class PairSkins {
 public:
  // What was done since the skins were chosen: pairs tested, in steps; pairs of the list walked along
  // and looked at, in refreshes; rods found again, cells entered and pairs tried, in renewals.
  struct Work {
    int64_t steps = 0, tested = 0, walked = 0, looked_at = 0, renewed = 0, cells = 0, tried = 0;
  };

  // `close`: of the close pairs, for all rods (m); 0: chosen from what it costs.
  void reset(double close);
  // Before all pairs are listed. `diameter`: the mean (m); `root_speed`: mean of the roots of the speeds.
  void begin(double diameter, double root_speed);

  double close() const { return close_; }    // m
  double listed() const { return listed_; }  // m
  // Half of the skin of the close pairs, and how much wider that of the list is (m).
  double close_half() const { return 0.5 * close_; }
  double close_half(double speed) const;
  double beyond_half(double speed) const;

  // Whether enough has been done to choose; true if the skin of the list has become another.
  bool is_time_to_choose(int rods) const;
  bool choose(double root_speed);
  // Until they are chosen for what they cost: a list of few pairs may as well be a wide one. True if it is
  // worth listing all pairs anew.
  bool widen(int rods, int pairs);

  Work work;

 private:
  bool close_is_chosen_ = true;
  bool are_tried_ = false;             // long enough to choose others
  double diameter_ = 0.0;              // mean (m)
  double root_speed_ = 0.0;            // mean
  double close_ = 0.0, listed_ = 0.0;  // m

  double factor(double speed) const;
};

}  // namespace LAMMPS_NS
