// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/largest_magnitude.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "test_support.h"

using namespace spherocylinder;

// One value after the other, with the largest at each place in turn: no lane is left out.
TEST(LargestMagnitude, IsFoundWhereverItStands)
{
  RandomRods random(67867979);
  for (int count = 0; count <= 70; count++) {
    std::vector<double> values;
    double wanted = 0.0;
    for (int k = 0; k < count; k++) {
      values.push_back(random.sign() * random.log_uniform(1e-9, 1e3));
      wanted = std::max(wanted, std::fabs(values.back()));
    }
    EXPECT_EQ(largest_magnitude(values.data(), count), wanted) << count;
    for (int at = 0; at < count; at++) {
      const double before = values[at];
      values[at] = random.sign() * 2e3;
      EXPECT_EQ(largest_magnitude(values.data(), count), 2e3) << at << " of " << count;
      values[at] = before;
    }
  }
}
