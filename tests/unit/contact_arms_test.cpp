// SPDX-License-Identifier: GPL-2.0-or-later
// Whole batches set from rods in memory, against one pair after the other: to the last bit, so that
// forces do not depend on how a batch was filled.
#include "core/contact_arms.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr int kRods = 50;

struct Rods {
  RandomRods random{373587883};
  Capsule capsules[kRods];
  RodState states[kRods];

  Rods()
  {
    for (int n = 0; n < kRods; n++) {
      const Vec3 axis = random.direction();
      capsules[n] = {{random.vector(10.0), axis, random.uniform(0.0, 5.0)},
                     random.uniform(0.1, 1.0)};
      states[n] = {random.vector(3.0), random.vector(7.0), axis};
    }
  }
};

void expect_same(const Vec3 &a, const Vec3 &b)
{
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
}

}  // namespace

TEST(SegmentPairs, SetAtOnceAreThoseSetOneByOne)
{
  Rods rods;
  SegmentPairs at_once{}, one_by_one{};
  const Capsule *i[kBatch], *j[kBatch];
  for (int k = 0; k < kBatch; k++) {
    i[k] = &rods.capsules[rods.random.below(kRods)];
    j[k] = &rods.capsules[rods.random.below(kRods)];
    one_by_one.set(k, i[k]->segment, j[k]->segment, i[k]->radius + j[k]->radius);
  }
  set_pairs(at_once, i, j);
  for (int k = 0; k < kBatch; k++) {
    expect_same(at_once.between.get(k), one_by_one.between.get(k));
    expect_same(at_once.axis_i.get(k), one_by_one.axis_i.get(k));
    expect_same(at_once.axis_j.get(k), one_by_one.axis_j.get(k));
    EXPECT_EQ(at_once.half_i[k], one_by_one.half_i[k]);
    EXPECT_EQ(at_once.half_j[k], one_by_one.half_j[k]);
    EXPECT_EQ(at_once.reach[k], one_by_one.reach[k]);
  }
}

TEST(SegmentPairs, SwappedAreThoseSetTheOtherWayRound)
{
  Rods rods;
  SegmentPairs pairs{};
  ClosestPoints before[kBatch];
  Doubles swapped;
  for (int k = 0; k < kBatch; k++) {
    const Capsule &i = rods.capsules[k], &j = rods.capsules[k + 1];
    pairs.set(k, i.segment, j.segment, i.radius + j.radius);
    swapped[k] = k % 3 == 0 ? 1.0 : 0.0;
  }
  closest_points(pairs);
  for (int k = 0; k < kBatch; k++) before[k] = pairs.get(k);
  swap_pairs(pairs, swapped);
  for (int k = 0; k < kBatch; k++) {
    const bool swap = k % 3 == 0;
    EXPECT_EQ(pairs.s[k], swap ? before[k].t : before[k].s);
    EXPECT_EQ(pairs.t[k], swap ? before[k].s : before[k].t);
    expect_same(pairs.delta.get(k), swap ? -before[k].delta : before[k].delta);
    EXPECT_EQ(pairs.distance_squared[k], before[k].distance_squared);
  }
}

class ContactArmsOf : public testing::Test {
 protected:
  // The rods' pairs in `arms_`, of which one has points that do not differ, or is nearly parallel, where
  // asked.
  bool place(int coinciding, int parallel, int count)
  {
    Doubles s, t, x, y, z, squared, nearly_parallel{};
    for (int k = 0; k < kBatch; k++) {
      i_[k] = &rods_.states[rods_.random.below(kRods)];
      j_[k] = &rods_.states[rods_.random.below(kRods)];
      s_[k] = s[k] = rods_.random.uniform(-2.0, 2.0);
      t_[k] = t[k] = rods_.random.uniform(-2.0, 2.0);
      delta_[k] = k == coinciding ? kZero : rods_.random.vector(0.1);
      x[k] = delta_[k].x;
      y[k] = delta_[k].y;
      z[k] = delta_[k].z;
      squared[k] = norm_squared(delta_[k]);
      nearly_parallel[k] = k == parallel ? 1.0 : 0.0;
      arms_.radius_i[k] = rods_.random.uniform(0.1, 1.0);
      arms_.radius_j[k] = rods_.random.uniform(0.1, 1.0);
    }
    return place_at_closest_points(arms_, i_, j_, {s, t, x, y, z, squared, nearly_parallel}, count);
  }

  Rods rods_;
  ContactArms arms_{};
  const RodState *i_[kBatch], *j_[kBatch];
  double s_[kBatch], t_[kBatch];
  Vec3 delta_[kBatch];
};

TEST_F(ContactArmsOf, PlacedAtOnceAreThoseOneByOne)
{
  EXPECT_TRUE(place(-1, -1, kBatch));
  for (int k = 0; k < kBatch; k++) {
    expect_same(arms_.velocity_i.get(k), i_[k]->velocity);
    expect_same(arms_.velocity_j.get(k), j_[k]->velocity);
    expect_same(arms_.omega_i.get(k), i_[k]->omega);
    expect_same(arms_.omega_j.get(k), j_[k]->omega);
    expect_same(arms_.arm_i.get(k), s_[k] * i_[k]->axis);
    expect_same(arms_.arm_j.get(k), t_[k] * j_[k]->axis);
    const double distance = norm(delta_[k]);
    expect_same(arms_.normal.get(k), (1.0 / distance) * delta_[k]);
    EXPECT_EQ(arms_.distance[k], distance);
    EXPECT_EQ(arms_.overlap[k], arms_.radius_i[k] + arms_.radius_j[k] - distance);
    EXPECT_EQ(arms_.mass_share[k], 1.0);
  }
}

// Those behind the last are of no meaning.
TEST_F(ContactArmsOf, SayWhereTheClosestPointsAreNotAll)
{
  EXPECT_FALSE(place(kBatch - 1, -1, kBatch));
  EXPECT_FALSE(place(-1, 5, 6));
  EXPECT_TRUE(place(7, 9, 7));
}

// The one number that is above, differs, is deep or stiff, at each place and behind the last.
TEST(Batch, QuestionsOfAllFindTheOne)
{
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int place = 0; place < kBatch; place++) {
    Doubles values;
    std::int64_t numbers[kBatch], others[kBatch];
    for (int k = 0; k < kBatch; k++) {
      values[k] = k % 2 ? 1.0 : kNan;
      numbers[k] = others[k] = 7;
    }
    EXPECT_FALSE(any_above(values, 1.0, kBatch));
    values[place] = std::nextafter(1.0, 2.0);
    EXPECT_TRUE(any_above(values, 1.0, place + 1));
    EXPECT_FALSE(any_above(values, 1.0, place));

    EXPECT_FALSE(any_differs(numbers, 7, kBatch) || any_differs(numbers, others, kBatch));
    numbers[place] = std::int64_t{7} + (std::int64_t{1} << 32);
    EXPECT_TRUE(any_differs(numbers, 7, place + 1) && any_differs(numbers, others, place + 1));
    EXPECT_FALSE(any_differs(numbers, 7, place) || any_differs(numbers, others, place));
  }
}

TEST(Batch, TheDeepestAndTheStiffestContactAreFound)
{
  for (int place = 0; place < kBatch; place++) {
    ContactArms arms{};
    ContactLoads loads{};
    Doubles relative;
    for (int k = 0; k < kBatch; k++) {
      arms.radius_i[k] = 1.0;
      arms.radius_j[k] = 3.0;
      arms.overlap[k] = 0.4;
      loads.stiffness[k] = 100.0;
      loads.effective_mass[k] = 1.0;
    }
    relative_overlaps(arms, relative);
    EXPECT_EQ(relative[place], 0.1);
    EXPECT_FALSE(any_deeper_or_stiffer(arms, loads, 0.1, 0.01, kBatch));
    arms.overlap[place] = 0.41;
    EXPECT_TRUE(any_deeper_or_stiffer(arms, loads, 0.1, 0.01, place + 1));
    EXPECT_FALSE(any_deeper_or_stiffer(arms, loads, 0.1, 0.01, place));
    arms.overlap[place] = 0.4;
    loads.effective_mass[place] = 0.99;
    EXPECT_TRUE(any_deeper_or_stiffer(arms, loads, 0.1, 0.01, place + 1));
    EXPECT_FALSE(any_deeper_or_stiffer(arms, loads, 0.1, 0.01, place));
  }
}
