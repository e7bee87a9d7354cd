// SPDX-License-Identifier: GPL-2.0-or-later
// Random choices that are the same on every machine: the standard fixes the engine, not its
// distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

#include "core/vec3.h"

namespace grammar {

using spherocylinder::Vec3;

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  double uniform(double lo, double hi)
  {
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  // lo and hi are among the answers.
  int integer(int lo, int hi)
  {
    return lo + static_cast<int>(engine_() % static_cast<uint64_t>(hi - lo + 1));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  template <class T>
  T pick(std::initializer_list<T> values)
  {
    return values.begin()[integer(0, static_cast<int>(values.size()) - 1)];
  }

  // Evenly over the unit sphere: its height is even, and so is its azimuth.
  Vec3 direction()
  {
    const double z = uniform(-1.0, 1.0), turn = uniform(0.0, 2.0 * std::acos(-1.0));
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }

  // LIGGGHTS wants primes above 10000 as seeds, and no two alike in a deck.
  int seed()
  {
    static const int primes[] = {15485863, 32452843, 49979687, 67867967, 86028121, 10007,
                                 10009,    10037,    10039,    10061,    10067,    10069};
    return primes[seeds_++ % 12];
  }

 private:
  std::mt19937_64 engine_;
  int seeds_ = 0;
};

}  // namespace grammar
