// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/largest_components.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "test_support.h"

using namespace spherocylinder;

// One value after the other, and the largest at each place in turn: no lane is left out.
TEST(LargestComponents, AreFoundWhereverTheyStand)
{
  RandomRods random(67867979);
  for (int count = 0; count <= 40; count++) {
    std::vector<double> rows;
    double wanted[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3 * count; k++) {
      rows.push_back(random.sign() * random.log_uniform(1e-9, 1e3));
      wanted[k % 3] = std::max(wanted[k % 3], std::fabs(rows.back()));
    }
    const auto expect = [&](double x, double y, double z) {
      const Vec3 largest = largest_components(rows.data(), count);
      EXPECT_TRUE(largest.x == x && largest.y == y && largest.z == z) << count;
    };
    expect(wanted[0], wanted[1], wanted[2]);
    for (int at = 0; at < 3 * count; at++) {
      const double before = rows[at];
      rows[at] = random.sign() * 2e3;
      expect(at % 3 == 0 ? 2e3 : wanted[0], at % 3 == 1 ? 2e3 : wanted[1],
             at % 3 == 2 ? 2e3 : wanted[2]);
      rows[at] = before;
    }
  }
}
