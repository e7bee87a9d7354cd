// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace spherocylinder {

// How far rods have come from other poses of theirs, at most. Of any of them, not of one that is named:
// each component's largest difference is taken by itself.
struct LargestShift {
  double centre;       // m
  double orientation;  // of the axes' ends, over half an axis
};

// Positions and quaternions of `count` rods as LIGGGHTS keeps them: x y z x y z ..., w x y z w x y z ...
// A unit quaternion that moves by d moves the axis by at most 2 d: a turn by an angle a moves the one by
// 2 sin(a/4) and the other by at most 2 sin(a/2). (A quaternion of the other sign counts as far away.)
// Values that are no numbers make the result any number or none.
LargestShift largest_shift(const double *positions, const double *positions_before,
                           const double *quaternions, const double *quaternions_before, int count);

}  // namespace spherocylinder
