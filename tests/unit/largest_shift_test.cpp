// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/largest_shift.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/rotation.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

// Rows of `width` random values, and others near them; the norm of each column's largest difference,
// found one after the other.
struct Rows {
  std::vector<double> now, before;
  int width;

  Rows(RandomRods &random, int width_, int count) : width(width_)
  {
    for (int k = 0; k < width * count; k++) {
      before.push_back(random.sign() * random.log_uniform(1e-9, 1e3));
      now.push_back(before.back() + random.sign() * random.log_uniform(1e-9, 1e3));
    }
  }
  double expected() const
  {
    std::vector<double> largest(width, 0.0);
    for (size_t k = 0; k < now.size(); k++)
      largest[k % width] = std::max(largest[k % width], std::fabs(now[k] - before[k]));
    double sum = 0.0;
    for (const double value : largest) sum += value * value;
    return std::sqrt(sum);
  }
};

}  // namespace

// One value after the other, and the largest at each place in turn: no lane is left out.
TEST(LargestShift, IsFoundWhereverItStands)
{
  RandomRods random(67867979);
  for (int count = 0; count <= 40; count++) {
    Rows positions(random, 3, count), quaternions(random, 4, count);
    const auto expect = [&] {
      const LargestShift shift =
          largest_shift(positions.now.data(), positions.before.data(), quaternions.now.data(),
                        quaternions.before.data(), count);
      EXPECT_NEAR(shift.centre, positions.expected(), 1e-12 * positions.expected()) << count;
      EXPECT_NEAR(shift.orientation, 2.0 * quaternions.expected(), 2e-12 * quaternions.expected())
          << count;
    };
    expect();
    for (Rows *rows : {&positions, &quaternions})
      for (double &value : rows->now) {
        const double kept = value;
        value = random.sign() * 5e3;
        expect();
        value = kept;
      }
  }
}

// The end of an axis of length 1 moves no farther than is said, for turns of all sizes: the axes
// themselves are worked out.
TEST(LargestShift, BoundsTheWayOfAnAxis)
{
  RandomRods random(49979687);
  const double position[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < 100000; k++) {
    const double angle = random.log_uniform(1e-6, 3.1);
    const Quaternion before = orientation_of(random.direction());
    const Vec3 about = std::sin(0.5 * angle) * random.direction();
    const Quaternion after = Quaternion{std::cos(0.5 * angle), about.x, about.y, about.z} * before;
    const double a[4] = {before.w, before.x, before.y, before.z};
    const double b[4] = {after.w, after.x, after.y, after.z};
    const double way = norm(axis_of(after) - axis_of(before));
    EXPECT_LE(way, largest_shift(position, position, b, a, 1).orientation * (1.0 + 1e-12) + 1e-15);
  }
}
