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
#include <gtest/gtest.h>
#include <ostream>
#include <string>

#include "closest_points_reference.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr double kRoundOff = 4.0 * kEpsilon;  // of the coordinates, see above
constexpr double kRelative = 1e-12;

struct Pair {
  Segment i, j;
};

double scale_of(const Pair &pair)
{
  return norm(pair.i.centre) + norm(pair.j.centre) + pair.i.half_length + pair.j.half_length;
}

double distance(const Segment &i, const Segment &j)
{
  return std::sqrt(closest_points(i, j).distance_squared);
}

Segment reversed(const Segment &segment)
{
  return {segment.centre, -segment.axis, segment.half_length};
}

// Half the cylinder part of a rod of 1 to 1000 diameters.
double half_length(RandomRods &random, double diameter)
{
  return 0.5 * diameter * random.log_uniform(1.0, 1000.0);
}

Segment random_segment(RandomRods &random, double diameter)
{
  return {random.vector(3.0 * diameter), random.direction(), half_length(random, diameter)};
}

// j with its point at t beside i's point at s, `gap` away along `normal`.
Segment placed(const Segment &i, double s, const Vec3 &normal, double gap, const Vec3 &axis,
               double half_length, double t)
{
  return {i.at(s) + gap * normal - t * axis, axis, half_length};
}

// A position on a segment, now and then past its ends.
double position(RandomRods &random, double half_length)
{
  return half_length * random.uniform(-1.3, 1.3);
}

Pair any_pose(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  return {i, placed(i, position(random, i.half_length), random.direction(),
                    d * random.log_uniform(1e-3, 3.0), random.direction(), hj,
                    position(random, hj))};
}

Pair parallel_side_by_side(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along = random.uniform(-1.0, 1.0) * (i.half_length + hj);
  return {i, placed(i, along, random.across(i.axis), d * random.uniform(0.0, 2.0),
                    random.sign() * i.axis, hj, 0.0)};
}

// Beyond each other's ends, or end beside end to round-off.
Pair parallel_offset(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along =
      random.sign() * (i.half_length + hj + (random.below(2) ? d * random.uniform(0.0, 2.0) : 0.0));
  return {i, placed(i, along, random.across(i.axis), d * random.uniform(0.0, 2.0),
                    random.sign() * i.axis, hj, 0.0)};
}

Pair coaxial(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along = random.uniform(-2.0, 2.0) * (i.half_length + hj);
  return {i, placed(i, along, i.axis, 0.0, random.sign() * i.axis, hj, 0.0)};
}

// Axes that meet, or miss each other by next to nothing.
Pair crossing(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const Vec3 axis = random.direction();
  const double hj = half_length(random, d);
  const double gap = random.below(2) ? 0.0 : d * random.log_uniform(1e-16, 1e-3);
  return {i, placed(i, i.half_length * random.uniform(-1.0, 1.0),
                    RandomRods::unit(cross(i.axis, axis)), gap, axis, hj,
                    hj * random.uniform(-1.0, 1.0))};
}

// An end of j before i's side, end or corner, square on or not.
Pair end_on(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double positions[] = {i.half_length, -i.half_length, 0.0, position(random, i.half_length)};
  const Vec3 side = random.across(i.axis);
  const Vec3 axis = random.below(2) ? side : random.direction();
  const double gap = d * random.log_uniform(1e-3, 2.0);
  return {i, placed(i, positions[random.below(4)], side, gap, axis, hj, -hj)};
}

Pair one_sphere(RandomRods &random, double d)
{
  Pair pair = any_pose(random, d);
  (random.below(2) ? pair.i : pair.j).half_length = 0.0;
  return pair;
}

Pair nearly_parallel_at(RandomRods &random, double d, double angle)
{
  const Segment i = random_segment(random, d);
  const Vec3 side = random.across(i.axis);
  const Vec3 axis = RandomRods::unit(i.axis + angle * side);
  const double hj = half_length(random, d);
  const double gap = d * (random.below(4) ? random.log_uniform(1e-6, 3.0) : 0.0);
  return {i, placed(i, position(random, i.half_length), RandomRods::unit(cross(i.axis, side)), gap,
                    random.sign() * axis, hj, position(random, hj))};
}

Pair nearly_parallel(RandomRods &random, double d)
{
  return nearly_parallel_at(random, d, random.log_uniform(1e-12, 1e-3));
}

// The angle drowns in the round-off of the axes, in part or wholly.
Pair parallel_to_round_off(RandomRods &random, double d)
{
  return nearly_parallel_at(random, d, random.log_uniform(1e-18, 1e-12));
}

Pair unequal_lengths(RandomRods &random, double d)
{
  Segment i = random_segment(random, d);
  i.half_length = 500.0 * d;
  const double hj = 0.5 * d;
  const Vec3 axis = random.below(2) ? random.direction()
                                    : RandomRods::unit(i.axis + random.log_uniform(1e-12, 1e-3) *
                                                                    random.direction());
  return {i, placed(i, position(random, i.half_length), random.direction(),
                    d * random.log_uniform(1e-3, 3.0), axis, hj, position(random, hj))};
}

// Whole coordinates and axes along the coordinate axes: ties everywhere, all sums exact.
Pair lattice(RandomRods &random, double d)
{
  const auto coordinate = [&] { return d * (random.below(9) - 4); };
  const auto segment = [&]() -> Segment {
    const Vec3 axes[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    return {{coordinate(), coordinate(), coordinate()},
            random.sign() * axes[random.below(3)],
            d * random.below(5)};
  };
  return {segment(), segment()};
}

// A scene a thousand rod lengths or more away from the origin.
Pair far_from_origin(RandomRods &random, double d)
{
  Pair pair = any_pose(random, d);
  const Vec3 away = (1e6 * d) * random.direction();
  pair.i.centre = pair.i.centre + away;
  pair.j.centre = pair.j.centre + away;
  return pair;
}

struct Family {
  const char *name;
  Pair (*make)(RandomRods &, double diameter);
};

void PrintTo(const Family &family, std::ostream *out) { *out << family.name; }

constexpr Family kFamilies[] = {
    {"any_pose", any_pose},
    {"parallel_side_by_side", parallel_side_by_side},
    {"parallel_offset", parallel_offset},
    {"coaxial", coaxial},
    {"crossing", crossing},
    {"end_on", end_on},
    {"one_sphere", one_sphere},
    {"nearly_parallel", nearly_parallel},
    {"parallel_to_round_off", parallel_to_round_off},
    {"unequal_lengths", unequal_lengths},
    {"lattice", lattice},
    {"far_from_origin", far_from_origin},
};

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
  // A pair of the family, of any size between a micrometre and a kilometre.
  Pair next() { return GetParam().make(random_, random_.log_uniform(1e-6, 1e3)); }

  RandomRods random_{104729};
};

}  // namespace

// Independent slow method: the nine faces of the problem in quadruple precision.
TEST_P(ClosestPointsOf, DistanceAgreesWithFacesInQuadruplePrecision)
{
  constexpr int pairs = 100000;
  Worst worst;
  for (int k = 0; k < pairs; ++k) {
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
  constexpr int pairs = 5000;
  double worst = 0.0;
  for (int k = 0; k < pairs; ++k) {
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
  for (int k = 0; k < 100000; ++k) {
    const auto [i, j] = next();
    const ClosestPoints c = closest_points(i, j);
    ASSERT_LE(std::fabs(c.s), i.half_length);
    ASSERT_LE(std::fabs(c.t), j.half_length);
    const Vec3 delta = i.at(c.s) - j.at(c.t);
    ASSERT_TRUE(delta.x == c.delta.x && delta.y == c.delta.y && delta.z == c.delta.z);
    ASSERT_EQ(c.distance_squared, norm_squared(delta));
  }
}

// Neither the order of the rods nor the sign of an axis means anything. (Points may differ: of
// equally near pairs either may come out.)
TEST_P(ClosestPointsOf, DistanceIgnoresOrderAndAxisSigns)
{
  double worst = 0.0;
  for (int k = 0; k < 50000; ++k) {
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
  for (int k = 0; k < 50000; ++k) {
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
  for (int k = 0; k < 100000; ++k) {
    const Pair pair = next();
    const double reach = distance(pair.i, pair.j) + kRoundOff * scale_of(pair);
    ASSERT_FALSE(lines_are_apart(pair.i, pair.j, reach * random_.uniform(1.0, 1.001)));
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, ClosestPointsOf, testing::ValuesIn(kFamilies),
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
  for (int k = 0; k < 1000000; ++k) {
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
