// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/plane_volume.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {
namespace {

// Ball of radius r about the origin below z = d.
double ball_below(double r, double d)
{
  if (d <= -r) return 0.0;
  if (d >= r) return 4.0 / 3.0 * pi * r * r * r;
  return pi / 3.0 * (r + d) * (r + d) * (2.0 * r - d);
}

// Half ball of radius r about the origin, on the side to which the unit vector (s, c) in (t, z)
// points, below z = d; s >= 0.
//
// For c >= 0. The plane z = const cuts the ball in a disc of radius rho = sqrt(r^2 - z^2) and the
// flat face in the line t = -c z/s. Where |z| < s r the line cuts the disc, and the segment beyond
// it has the area rho^2 phi + (c z/s^2) Y, with Y = sqrt(s^2 r^2 - z^2), cos phi = -c z/(s rho),
// that is tan phi = Y/(-c z). Its integral from -s r, by parts with P = r^2 z - z^3/3, is
//   P phi + (2/3) r^3 atan2(Y, c r) + c z^2 Y/(3 s^2).
// Below -s r there is nothing; above s r all of the ball. For c < 0 it is the ball less the other
// half.
double half_ball_below(double r, double s, double c, double d)
{
  if (c < 0.0) return ball_below(r, d) - half_ball_below(r, s, -c, d);
  if (d <= -s * r) return 0.0;
  if (d >= s * r) return ball_below(r, d) - 2.0 / 3.0 * pi * r * r * r;
  const double y = std::sqrt((s * r - d) * (s * r + d));
  const double slope = d / s;  // |d| < s r
  return (r * r - d * d / 3.0) * d * std::atan2(y, -c * d) +
         2.0 / 3.0 * r * r * r * std::atan2(y, c * r) + c * slope * slope * y / 3.0;
}

// Area of a disc of radius r on the side y <= b of a chord, |b| <= r.
double disc_below(double r, double b)
{
  return r * r * std::acos(std::clamp(-b / r, -1.0, 1.0)) + b * std::sqrt((r - b) * (r + b));
}

// s times the integral of disc_below from -r to b, where b = depth/s may lie beyond +-r:
//   H(b) = b r^2 acos(-b/r) + r^2 w - w^3/3, w = sqrt(r^2 - b^2); H(r) = pi r^3.
double integrated_disc(double r, double s, double depth)
{
  if (depth <= -s * r) return 0.0;
  if (depth >= s * r) return pi * r * r * depth;  // s H(r) + pi r^2 (depth - s r)
  const double b = depth / s;
  const double w = std::sqrt(std::max((r - b) * (r + b), 0.0));
  return s * (b * r * r * std::acos(std::clamp(-b / r, -1.0, 1.0)) + (r * r - w * w / 3.0) * w);
}

// Cylinder of half length h about the origin, axis (s, c) in (t, z), below z = d; s, c >= 0. The
// round section at q along the axis is cut at b = (d - q c)/s above its centre.
double tube_below(double r, double h, double s, double c, double d)
{
  if (d >= h * c + s * r) return 2.0 * pi * r * r * h;
  if (d <= -h * c - s * r) return 0.0;
  // Below this change of b the difference of two integrals has fewer digits than three Gauss
  // points, which a root at the disc's rim leaves off by the change to the power 3/2.
  constexpr double kLittle = 1e-6;
  if (2.0 * h * c > kLittle * s * r)
    return (integrated_disc(r, s, d + h * c) - integrated_disc(r, s, d - h * c)) / c;
  const auto section = [&](double q) {
    return disc_below(r, std::clamp((d - q * h * c) / s, -r, r));
  };
  const double node = std::sqrt(0.6);
  return h * (5.0 * section(-node) + 8.0 * section(0.0) + 5.0 * section(node)) / 9.0;
}

}  // namespace

double volume_below(const Capsule &capsule, double height)
{
  const Segment &segment = capsule.segment;
  const double r = capsule.radius, h = segment.half_length;
  const double c = std::abs(segment.axis.z);  // the axis turned upwards
  const double s = std::hypot(segment.axis.x, segment.axis.y);
  const double d = height - segment.centre.z;
  if (d >= h * c + r) return volume(capsule);
  if (d <= -h * c - r) return 0.0;
  if (h == 0.0) return ball_below(r, d);
  const double upper = half_ball_below(r, s, c, d - h * c);
  const double lower = half_ball_below(r, s, -c, d + h * c);
  return std::max(tube_below(r, h, s, c, d) + upper + lower, 0.0);
}

}  // namespace spherocylinder
