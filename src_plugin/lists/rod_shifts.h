// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/largest_shift.h"
#include "lmptype.h"
#include "pointers.h"

namespace LAMMPS_NS {

// How far this rank's rods have come, at most, since poses of theirs that were kept, whatever moved
// them. All walls ask the same one, so that it is worked out once a step.
class RodShifts : protected Pointers {
 public:
  explicit RodShifts(LAMMPS *lmp) : Pointers(lmp) {}

  // Of any end of an axis of at most this half length (m). Larger than any length if no poses of
  // these rods are kept.
  double farthest(double half_length);

  // The present poses are kept from now on. LIGGGHTS may have put the rods in another order since.
  void keep_poses();

  // Another number for each time that poses were kept.
  int version() const { return version_; }

 private:
  std::vector<double> positions_, quaternions_;
  spherocylinder::LargestShift shift_{};
  bigint step_ = -1;  // of shift_
  int version_ = 0;

  bool are_kept_in_this_step() const;
};

}  // namespace LAMMPS_NS
