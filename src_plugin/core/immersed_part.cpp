// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/immersed_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.h"

namespace spherocylinder {

namespace {

// Gauss-Legendre rule of 16 points on [-1, 1], positive half (Abramowitz & Stegun, table 25.4).
constexpr double kNodes[] = {0.0950125098376374, 0.2816035507792589, 0.4580167776572274,
                             0.6178762444026438, 0.7554044083550030, 0.8656312023878318,
                             0.9445750230732326, 0.9894009349916499};
constexpr double kWeights[] = {0.1894506104550685, 0.1826034150449236, 0.1691565193950025,
                               0.1495959888165767, 0.1246289712555339, 0.0951585116824928,
                               0.0622535239386479, 0.0271524594117541};

// What a slice of unit thickness at s adds.
struct Slice {
  double area;
  double moment_along;   // area times s
  double moment_across;  // along the steepest line of the disc
};

struct Cut {
  double half_cylinder, radius;
  double height;        // of the rod's centre above the surface
  double cosine, sine;  // of the tilt

  double height_at(double s) const { return height + s * cosine; }

  Slice slice(double s) const
  {
    const double beyond = std::max(0.0, std::fabs(s) - half_cylinder);
    const double disc_squared = std::max(0.0, radius * radius - beyond * beyond);
    const double disc = std::sqrt(disc_squared), h = height_at(s);
    // Whole discs first, so that an upright rod (sine 0) needs no division.
    if (h >= disc * sine) return {0.0, 0.0, 0.0};
    if (h <= -disc * sine) return {pi * disc_squared, pi * disc_squared * s, 0.0};
    const double t = -h / sine;
    const double chord_squared = std::max(0.0, disc_squared - t * t);
    const double chord = std::sqrt(chord_squared);  // half of it
    const double area = disc_squared * (0.5 * pi + std::asin(t / disc)) + t * chord;
    return {area, area * s, -(2.0 / 3.0) * chord_squared * chord};
  }

  // Where discs begin or end to be cut, and where the rod's surface has its seams.
  std::array<double, 12> places() const
  {
    const double end = half_cylinder + radius;
    std::array<double, 12> s;
    s.fill(end);
    size_t count = 0;
    const auto add = [&](double place) { s[count++] = std::clamp(place, -end, end); };
    for (const double side : {-1.0, 1.0}) {
      add(side * end);
      add(side * half_cylinder);
      if (cosine != 0.0) add((side * radius * sine - height) / cosine);
      // In the hemisphere about side * half_cylinder, whose centre is d above the surface:
      // (d + q cos)^2 = (r^2 - q^2) sin^2.
      const double d = height_at(side * half_cylinder);
      if (std::fabs(d) >= radius) continue;
      const double root = sine * std::sqrt(radius * radius - d * d);
      for (const double q : {-d * cosine - root, -d * cosine + root})
        if (q * side > 0.0) add(side * half_cylinder + q);
    }
    std::sort(s.begin(), s.end());
    return s;
  }
};

}  // namespace

ImmersedPart immersed_part(const Capsule &rod, const Vec3 &up, double surface)
{
  const Vec3 &axis = rod.segment.axis;
  Cut cut;
  cut.half_cylinder = rod.segment.half_length;
  cut.radius = rod.radius;
  cut.height = dot(rod.segment.centre, up) - surface;
  cut.cosine = dot(axis, up);
  const Vec3 across = up - cut.cosine * axis;
  cut.sine = norm(across);
  const Vec3 steepest = cut.sine > 0.0 ? (1.0 / cut.sine) * across : Vec3{0.0, 0.0, 0.0};

  const double reach = cut.half_cylinder * std::fabs(cut.cosine) + cut.radius;
  if (cut.height >= reach) return {0.0, {0.0, 0.0, 0.0}};
  const double r = cut.radius;
  if (cut.height <= -reach)
    return {pi * r * r * (2.0 * cut.half_cylinder + (4.0 / 3.0) * r), {0.0, 0.0, 0.0}};

  Slice sum{0.0, 0.0, 0.0};
  const std::array<double, 12> places = cut.places();
  for (size_t k = 0; k + 1 < places.size(); k++) {
    const double middle = 0.5 * (places[k] + places[k + 1]);
    const double half = 0.5 * (places[k + 1] - places[k]);
    if (half <= 0.0) continue;
    // s = middle + half sin(phi) takes the roots at the ends out of the integrand.
    for (int n = 0; n < 8; n++)
      for (const double side : {-1.0, 1.0}) {
        const double phi = 0.5 * pi * side * kNodes[n];
        const double weight = kWeights[n] * 0.5 * pi * half * std::cos(phi);
        const Slice slice = cut.slice(middle + half * std::sin(phi));
        sum.area += weight * slice.area;
        sum.moment_along += weight * slice.moment_along;
        sum.moment_across += weight * slice.moment_across;
      }
  }
  if (!(sum.area > 0.0)) return {0.0, {0.0, 0.0, 0.0}};
  return {sum.area, (1.0 / sum.area) * (sum.moment_along * axis + sum.moment_across * steepest)};
}

}  // namespace spherocylinder
