// SPDX-License-Identifier: GPL-2.0-or-later
// Random input, scales and constants shared by the unit tests.
#pragma once

#include <cmath>
#include <limits>
#include <random>

#include "core/vec3.h"

constexpr double kPi = 3.14159265358979323846;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kDensity = 2700.0;  // aluminium (unit: kg/m^3)

// Diameters at which the tests repeat themselves (m): nothing in the core may know a scale.
constexpr double kDiameters[] = {1e-6, 1e-3, 0.01, 1.0, 1e3};

class RandomRods {
 public:
  explicit RandomRods(unsigned prime_seed) : engine_(prime_seed) {}

  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  double log_uniform(double low, double high)
  {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }

  double sign() { return below(2) ? 1.0 : -1.0; }

  spherocylinder::Vec3 vector(double size)
  {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

  // Uniform on the unit sphere (Archimedes: height and azimuth are uniform).
  spherocylinder::Vec3 direction()
  {
    const double z = uniform(-1.0, 1.0);
    const double azimuth = uniform(0.0, 2.0 * kPi);
    const double rho = std::sqrt(1.0 - z * z);
    return unit({rho * std::cos(azimuth), rho * std::sin(azimuth), z});
  }

  // A unit vector at right angles to `axis`, uniform in azimuth.
  spherocylinder::Vec3 across(const spherocylinder::Vec3 &axis)
  {
    for (;;) {
      const spherocylinder::Vec3 candidate = cross(axis, direction());
      if (norm(candidate) > 0.1) return unit(candidate);
    }
  }

  static spherocylinder::Vec3 unit(const spherocylinder::Vec3 &a) { return (1.0 / norm(a)) * a; }

 private:
  std::mt19937_64 engine_;
};

// v turned by `angle` about the unit vector k (Rodrigues). A long double angle keeps its digits
// after many turns.
inline spherocylinder::Vec3 turned(const spherocylinder::Vec3 &v, const spherocylinder::Vec3 &k,
                                   long double angle)
{
  const double c = static_cast<double>(std::cos(angle));
  const double s = static_cast<double>(std::sin(angle));
  return c * v + s * cross(k, v) + ((1.0 - c) * dot(k, v)) * k;
}
