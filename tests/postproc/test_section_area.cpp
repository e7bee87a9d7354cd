// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "core/numbers.h"
#include "solid/section_area.h"

namespace spherocylinder {
namespace {

constexpr Rectangle kEverywhere{-100, 100, -100, 100};

TEST(SectionArea, PolygonClippedByALine)
{
  const Polygon square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(area(square), 4.0);
  EXPECT_DOUBLE_EQ(area(clip(square, {1, 0}, 0.5)), 1.0);
  // Corner beyond the diagonal t + z = 3: a triangle with legs of 1.
  EXPECT_DOUBLE_EQ(area(clip(square, {1, 1}, 3.0)), 3.5);
  EXPECT_DOUBLE_EQ(area(clip(square, {1, 0}, -1.0)), 0.0);
  EXPECT_DOUBLE_EQ(area(clip(square, {1, 0}, 9.0)), 4.0);
}

TEST(SectionArea, DiscAndPolygon)
{
  const Polygon large{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const Polygon quarter{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  const Polygon within{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  const Polygon apart{{5, 5}, {6, 5}, {6, 6}};
  EXPECT_NEAR(intersection_area(large, {0.3, 0.2}, 1.0), pi, 1e-14);
  EXPECT_NEAR(intersection_area(quarter, {0, 0}, 1.0), pi / 4, 1e-14);
  EXPECT_NEAR(intersection_area(within, {0, 0}, 1.0), 0.04, 1e-15);
  EXPECT_NEAR(intersection_area(apart, {0, 0}, 1.0), 0.0, 1e-15);
  // Half-plane at distance d from the centre: r^2 acos(d/r) - d sqrt(r^2 - d^2).
  const double d = 0.4;
  EXPECT_NEAR(intersection_area(clip(large, {1, 0}, -d), {0, 0}, 1.0),
              std::acos(d) - d * std::sqrt(1 - d * d), 1e-14);
}

TEST(SectionArea, WholeStadium)
{
  const Stadium stadium{{0.6, 0.8}, 1.5, 0.25};
  EXPECT_NEAR(area(stadium), 2 * 0.25 * 3.0 + pi * 0.0625, 1e-15);  // 2 r h + pi r^2
  EXPECT_NEAR(intersection_area(stadium, kEverywhere), area(stadium), 1e-14);
}

// Any line through the centre halves a stadium; two at right angles quarter it if one is its axis.
TEST(SectionArea, CutStadium)
{
  for (const Point2 &axis : {Point2{1, 0}, Point2{0, 1}, Point2{0.6, 0.8}, Point2{-0.8, 0.6}}) {
    const Stadium stadium{axis, 1.5, 0.25};
    EXPECT_NEAR(intersection_area(stadium, {0, 100, -100, 100}), area(stadium) / 2, 1e-14);
    EXPECT_NEAR(intersection_area(stadium, {-100, 100, -100, 0}), area(stadium) / 2, 1e-14);
  }
  EXPECT_NEAR(intersection_area({{1, 0}, 1.5, 0.25}, {0, 100, 0, 100}),
              area(Stadium{{1, 0}, 1.5, 0.25}) / 4, 1e-14);
}

// Upright stadium cut at height z in its upper round end: half a stadium less a circular segment.
TEST(SectionArea, StadiumCutThroughItsEnd)
{
  const double r = 0.5, half = 1.0, above = 0.2;  // cut 0.2 above the end's centre
  const double segment = r * r * std::acos(above / r) - above * std::sqrt(r * r - above * above);
  const Stadium stadium{{0, 1}, half, r};
  EXPECT_NEAR(intersection_area(stadium, {-9, 9, -9, half + above}), area(stadium) - segment,
              1e-14);
}

TEST(SectionArea, EmptyRectangle)
{
  EXPECT_EQ(intersection_area({{1, 0}, 1.0, 0.1}, {1, 1, -1, 1}), 0.0);
  EXPECT_EQ(intersection_area({{1, 0}, 1.0, 0.1}, {5, 6, -1, 1}), 0.0);
}

}  // namespace
}  // namespace spherocylinder
