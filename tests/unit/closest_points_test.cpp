// SPDX-License-Identifier: GPL-2.0-or-later
// Closest points of two segments against slow methods, over families of poses that make a short
// formula fail.
//
// Bound on the distance: a point c + s u is rounded by about half an ulp of its coordinates, and so
// is the difference of two points, so that no method in double precision can beat an epsilon or so
// times the coordinates:
//   |d - d_ref| <= 4 epsilon (|c_i| + |c_j| + h_i + h_j),
// which is |d - d_ref| <= 1e-12 d_ref wherever d_ref exceeds 1/1000 of those coordinates.
#include "core/closest_points.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "closest_points_reference.h"
#include "segment_families.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr double kRoundOff = 4.0 * kEpsilon;  // of the coordinates, see above
constexpr double kRelative = 1e-12;

double distance(const Segment &i, const Segment &j)
{
  return std::sqrt(closest_points(i, j).distance_squared);
}

Segment reversed(const Segment &segment)
{
  return {segment.centre, -segment.axis, segment.half_length};
}

// Worst errors of a family, in the units of the two bounds.
class Worst {
 public:
  void add(const Pair &pair, double distance, long double reference)
  {
    const double scale = scale_of(pair);
    const double error = static_cast<double>(std::fabs(distance - reference));
    in_epsilons_ = std::max(in_epsilons_, error / (kEpsilon * scale));
    if (kRelative * reference >= kRoundOff * scale)
      relative_ = std::max(relative_, error / static_cast<double>(reference));
  }

  double relative() const { return relative_; }
  double in_epsilons() const { return in_epsilons_; }

 private:
  double relative_ = 0.0;     // where d_ref is above round-off
  double in_epsilons_ = 0.0;  // |d - d_ref| / (epsilon scale)
};

class ClosestPointsOf : public testing::TestWithParam<Family> {
 protected:
  Pair next() { return any_size(GetParam(), random_).pair; }

  RandomRods random_{104729};
};

}  // namespace

// Independent slow method: the nine faces of the problem in quadruple precision.
TEST_P(ClosestPointsOf, DistanceAgreesWithFacesInQuadruplePrecision)
{
  constexpr int kPairs = 100000;
  Worst worst;
  for (int k = 0; k < kPairs; k++) {
    const Pair pair = next();
    worst.add(pair, distance(pair.i, pair.j), distance_by_faces(pair.i, pair.j));
  }
  std::printf("%-22s worst relative %.1e, worst absolute %.2f epsilon of the coordinates\n",
              GetParam().name, worst.relative(), worst.in_epsilons());
  RecordProperty("worst_relative", std::to_string(worst.relative() * 1e15) + "e-15");
  RecordProperty("worst_in_epsilons", std::to_string(worst.in_epsilons()));
  EXPECT_LE(worst.relative(), kRelative);
  EXPECT_LE(worst.in_epsilons() * kEpsilon, kRoundOff);
}

// The reference against a second slow method, a ternary search.
TEST_P(ClosestPointsOf, FacesAgreeWithSearch)
{
  constexpr int kPairs = 5000;
  double worst = 0.0;
  for (int k = 0; k < kPairs; k++) {
    const Pair pair = next();
    const long double difference =
        std::fabs(distance_by_search(pair.i, pair.j) - distance_by_faces(pair.i, pair.j));
    worst = std::max(worst, static_cast<double>(difference) / scale_of(pair));
  }
  // Rounding of the search's long double (1e-19): far below what double can show.
  EXPECT_LE(worst, 0.01 * kEpsilon);
}

// Both points are on their segments, and delta and distance are those of the two points.
TEST_P(ClosestPointsOf, PointsLieOnTheSegments)
{
  for (int k = 0; k < 100000; k++) {
    const auto [i, j] = next();
    const ClosestPoints c = closest_points(i, j);
    ASSERT_LE(std::fabs(c.s), i.half_length);
    ASSERT_LE(std::fabs(c.t), j.half_length);
    // delta is worked out from the difference of the centres, the points each on its own.
    const double rounding = 8.0 * kEpsilon * scale_of({i, j});
    ASSERT_LE(norm(i.at(c.s) - j.at(c.t) - c.delta), rounding);
    ASSERT_EQ(c.distance_squared, norm_squared(c.delta));
  }
}

// Neither the order of the rods nor the sign of an axis means anything. (Points may differ: of
// equally near pairs either may come out.)
TEST_P(ClosestPointsOf, DistanceIgnoresOrderAndAxisSigns)
{
  double worst = 0.0;
  for (int k = 0; k < 50000; k++) {
    const Pair pair = next();
    const double expected = distance(pair.i, pair.j);
    for (const double other :
         {distance(pair.j, pair.i), distance(reversed(pair.i), pair.j),
          distance(pair.i, reversed(pair.j)), distance(reversed(pair.i), reversed(pair.j)),
          distance(reversed(pair.j), reversed(pair.i))})
      worst = std::max(worst, std::fabs(other - expected) / (kEpsilon * scale_of(pair)));
  }
  RecordProperty("worst_in_epsilons", std::to_string(worst));
  // Both distances may be wrong, each by the bound above.
  EXPECT_LE(worst * kEpsilon, 2.0 * kRoundOff);
}

// A rigid motion of the scene. Its own rounding moves the centres and, through the axes, the ends
// by as much as the bound on either distance.
TEST_P(ClosestPointsOf, RigidMotionKeepsDistance)
{
  double worst = 0.0;
  for (int k = 0; k < 50000; k++) {
    const Pair pair = next();
    const Vec3 about = random_.direction();
    const double angle = random_.uniform(-kPi, kPi);
    const Vec3 shift = random_.vector(scale_of(pair));
    const auto moved = [&](const Segment &segment) -> Segment {
      return {turned(segment.centre, about, angle) + shift,
              RandomRods::unit(turned(segment.axis, about, angle)), segment.half_length};
    };
    const Pair image{moved(pair.i), moved(pair.j)};
    const double difference = distance(image.i, image.j) - distance(pair.i, pair.j);
    worst = std::max(worst, std::fabs(difference) / (kEpsilon * scale_of(image)));
  }
  RecordProperty("worst_in_epsilons", std::to_string(worst));
  EXPECT_LE(worst * kEpsilon, 3.0 * kRoundOff);
}

// The cheap test may miss, but never call a pair apart that is nearer than the reach.
TEST_P(ClosestPointsOf, LinesAreNotApartWithinReach)
{
  for (int k = 0; k < 100000; k++) {
    const Pair pair = next();
    const double reach = distance(pair.i, pair.j) + kRoundOff * scale_of(pair);
    ASSERT_FALSE(lines_are_apart(pair.i, pair.j, reach * random_.uniform(1.0, 1.001)));
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, ClosestPointsOf, testing::ValuesIn(families()),
                         [](const auto &info) { return std::string(info.param.name); });

// Closed form: crossed at right angles, 2 apart.
TEST(LinesAreApart, SeesCrossedLines)
{
  const Segment i{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 5.0}, j{{0.0, 0.0, 2.0}, {0.0, 1.0, 0.0}, 5.0};
  EXPECT_TRUE(lines_are_apart(i, j, 1.9));
  EXPECT_FALSE(lines_are_apart(i, j, 2.1));
}

// Closed form: two segments of zero length are points, |c_i - c_j|, to the last bit.
TEST(ClosestPoints, ZeroLengthsAreSpheres)
{
  RandomRods random(15485863);
  for (int k = 0; k < 1000000; k++) {
    const double size = random.log_uniform(1e-6, 1e3);
    const Segment i{random.vector(size), random.direction(), 0.0};
    const Segment j{random.vector(size), random.direction(), 0.0};
    const ClosestPoints c = closest_points(i, j);
    ASSERT_EQ(c.s, 0.0);
    ASSERT_EQ(c.t, 0.0);
    ASSERT_EQ(c.distance_squared, norm_squared(i.centre - j.centre));
  }
}

// Closed form: two rods crossed at right angles, s and t read off the figure.
TEST(ClosestPoints, CrossedAtRightAngles)
{
  for (const double d : kDiameters) {
    const Segment i{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 5.0 * d};
    const Segment j{{2.0 * d, 1.0 * d, 3.0 * d}, {0.0, 1.0, 0.0}, 4.0 * d};
    const ClosestPoints c = closest_points(i, j);
    EXPECT_DOUBLE_EQ(c.s, 2.0 * d);
    EXPECT_DOUBLE_EQ(c.t, -1.0 * d);
    EXPECT_DOUBLE_EQ(c.delta.z, -3.0 * d);  // from j to i
    EXPECT_DOUBLE_EQ(c.distance_squared, 9.0 * d * d);
  }
}

// The lines meet at i's centre (s = 0) beyond j's end: to clamp t there and keep s misses the
// nearest pair. Closed form: j's lower end (1, 0, 0.2) against i's end (1, 0, 0).
TEST(ClosestPoints, ClampedPartnerMovesThePoint)
{
  const Segment i{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 1.0};
  const Vec3 axis = RandomRods::unit({1.0, 0.0, 0.2});
  const Segment j{Vec3{1.0, 0.0, 0.2} + 3.0 * axis, axis, 3.0};
  const ClosestPoints c = closest_points(i, j);
  EXPECT_NEAR(c.s, 1.0, 1e-15);
  EXPECT_NEAR(c.t, -3.0, 1e-15);
  EXPECT_NEAR(std::sqrt(c.distance_squared), 0.2, 1e-15);
}
