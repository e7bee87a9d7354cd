// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs of segments in families of poses that make a short formula for the closest points fail.
#pragma once

#include <iosfwd>
#include <vector>

#include "core/capsule.h"
#include "test_support.h"

struct Pair {
  spherocylinder::Segment i, j;
};

// The coordinates that a computed distance is a difference of.
double scale_of(const Pair &pair);

// Rods of 1 to 1000 diameters, or of none, and gaps of diameters or less.
struct Family {
  const char *name;
  Pair (*make)(RandomRods &, double diameter);
};

void PrintTo(const Family &family, std::ostream *out);  // for GoogleTest

const std::vector<Family> &families();

// A pair of the family, of any size between a micrometre and a kilometre.
struct SizedPair {
  double diameter;
  Pair pair;
};

SizedPair any_size(const Family &family, RandomRods &random);
