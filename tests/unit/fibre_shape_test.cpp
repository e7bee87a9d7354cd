// SPDX-License-Identifier: GPL-2.0-or-later
// Shapes of fibres without load, against the polygon in a circle and against the joint that measures them.
#include "core/fibre_shape.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/mass_properties.h"
#include "core/numbers.h"

using namespace spherocylinder;

namespace {

double largest_gap_at_joints(const FibreShape &fibre)
{
  double largest = 0.0;
  for (int k = 0; k < fibre.joints(); k++)
    largest = std::max(largest, norm(fibre.segments[k].head() - fibre.segments[k + 1].tail()));
  return largest;
}

// Straight along z from end to end of the length, joints (L - 2 r)/N apart, hemispheres counted once.
TEST(FibreShape, StraightOneIsTheRodCutInPieces)
{
  for (const double size : {1e-6, 1.0, 1e3})
    for (const int segments : {1, 2, 7}) {
      const double r = 0.01 * size, length = 0.3 * size;
      const FibreShape fibre = fibre_shape(segments, r, length);
      ASSERT_EQ(fibre.segments.size(), static_cast<size_t>(segments));
      EXPECT_NEAR(chord_of(fibre), length - 2.0 * r, 1e-14 * length);
      EXPECT_NEAR(bounding_radius_of(fibre), 0.5 * length, 1e-14 * length);
      EXPECT_NEAR(volume_of(fibre), mass_properties(2.0 * r, length, 1.0).volume,
                  1e-13 * volume_of(fibre));
      EXPECT_LE(largest_gap_at_joints(fibre), 1e-15 * length);
      for (const JointedRod &segment : fibre.segments) EXPECT_NEAR(segment.axis().z, 1.0, 1e-15);
    }
}

// Joints of a bent one lie on the circle round a regular polygon of sides h that turns by c h at each.
TEST(FibreShape, CurvedOneLiesOnACircle)
{
  const int segments = 9;
  const double r = 0.002, h = 0.02, curvature = 20.0;
  const FibreShape fibre = fibre_shape(segments, r, segments * h + 2.0 * r, curvature);
  const double turn = curvature * h, circle = 0.5 * h / std::sin(0.5 * turn);
  EXPECT_NEAR(chord_of(fibre), 2.0 * circle * std::sin(0.5 * segments * turn), 1e-14);
  const Vec3 tail = fibre.segments.front().tail(), head = fibre.segments.back().head();
  EXPECT_NEAR(tail.x, head.x, 1e-15);
  EXPECT_NEAR(tail.y, head.y, 1e-15);
  EXPECT_GT(head.z, tail.z);
  // Towards x: the circle's centre is there.
  const double to_chord = circle * std::cos(0.5 * segments * turn);
  const Vec3 centre = {tail.x + to_chord, 0.0, 0.5 * (tail.z + head.z)};
  Vec3 moment = kZero;
  for (int k = 0; k < segments; k++) {
    const JointedRod &segment = fibre.segments[k];
    EXPECT_NEAR(norm(segment.head() - centre), circle, 1e-14);
    const double mass = mass_properties(2.0 * r, h + 2.0 * r, 1.0, shared_ends_of(fibre, k)).mass;
    moment = moment + mass * segment.centre;
  }
  EXPECT_LE(norm(moment), 1e-15 * volume_of(fibre));
}

// The joint's own measure of bend and twist is the rest state that was asked for: no load.
TEST(FibreShape, JointsAreAtRest)
{
  for (const double curvature : {-40.0, 0.0, 3.0})
    for (const double twist : {-60.0, 0.0, 5.0}) {
      const FibreShape fibre = fibre_shape(6, 0.002, 0.1, curvature, twist);
      EXPECT_LE(largest_gap_at_joints(fibre), 1e-16);
      for (int k = 0; k < fibre.joints(); k++) {
        const JointDeformation d = joint_deformation(fibre.segments[k], fibre.segments[k + 1]);
        EXPECT_NEAR(d.bend_x, 0.0, 1e-14);
        EXPECT_NEAR(d.bend_y, curvature * fibre.joint_distance, 1e-14);
        EXPECT_NEAR(d.twist, twist * fibre.joint_distance, 1e-14);
        EXPECT_EQ(fibre.rest.bend_y, curvature * fibre.joint_distance);
      }
    }
}

// A hexagon that misses one side, and one that is closed: ends apart by a side, or on each other.
TEST(FibreShape, OneThatClosesTouchesItself)
{
  const double h = 0.02, r = 0.002, sixth = 2.0 * pi / 6.0;
  EXPECT_NEAR(narrowest_gap_of(fibre_shape(5, r, 5 * h + 2.0 * r, sixth / h)), h - 2.0 * r, 1e-14);
  EXPECT_NEAR(narrowest_gap_of(fibre_shape(6, r, 6 * h + 2.0 * r, sixth / h)), -2.0 * r, 1e-14);
  // Of short segments the next but one overlaps as a neighbour does and is not counted.
  EXPECT_NEAR(narrowest_gap_of(fibre_shape(4, r, 4 * 1.5 * r + 2.0 * r)), (2 * 1.5 - 2.0) * r,
              1e-15);
  EXPECT_TRUE(std::isinf(narrowest_gap_of(fibre_shape(2, r, 0.1))));
}

}  // namespace
