// SPDX-License-Identifier: GPL-2.0-or-later
// A fibre of equal segments as it is without load, before it is put anywhere.
#pragma once

#include <vector>

#include "core/rod_joint.h"

namespace spherocylinder {

struct FibreShape {
  double radius = 0.0;          // m
  double joint_distance = 0.0;  // h, of a single segment its cylinder (m)
  double segment_length = 0.0;  // h + 2 r
  JointRest rest;               // of each joint
  // From the first to the last, about the centre of mass, which is the origin; from the first one's tail to
  // the last one's head along z, and curved towards x.
  std::vector<JointedRod> segments;

  int joints() const { return static_cast<int>(segments.size()) - 1; }
  // Whether segments next but one overlap when straight.
  bool is_short() const { return joint_distance < 2.0 * radius; }
};

// `total_length`: of the straight fibre, hemispheres included, N h + 2 r. `curvature` (1/m) and `twist`
// (rad/m) are each joint's bend and twist without load over h. One segment is a rod.
FibreShape fibre_shape(int segments, double radius, double total_length, double curvature = 0.0,
                       double twist = 0.0);

// Shared hemispheres counted once (m^3).
double volume_of(const FibreShape &fibre);

// Radius of the sphere about the centre of mass that holds it.
double bounding_radius_of(const FibreShape &fibre);

// From the first one's tail to the last one's head.
double chord_of(const FibreShape &fibre);

// The smallest distance of the surfaces of two segments that may touch; infinite if there are none.
double narrowest_gap_of(const FibreShape &fibre);

// Tails' and heads' share of segment k: how many of its hemispheres are its neighbours'.
int shared_ends_of(const FibreShape &fibre, int k);

}  // namespace spherocylinder
