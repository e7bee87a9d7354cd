// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/overlap_volume.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/closest_points.h"
#include "core/numbers.h"
#include "solid/capsule_measures.h"
#include "solid/section_area.h"

namespace spherocylinder {
namespace {

// An overlap need not be known better than this part of a rod.
constexpr double kLeast = 1e-8;

// Axes at a smaller angle are taken as parallel: over a rod of 1000 diameters this is off by a
// millionth of a diameter.
constexpr double kParallelSine = 1e-9;

// Of the smaller radius; for deeper overlaps the roots that the quadrature leaves in its integrand
// come near the interval.
constexpr double kDeepestCrossing = 0.5;

// Relative, of the quadratures of the quick cases at that depth.
constexpr double kQuickError = 1e-8;

// Both rods seen from planes parallel to both axes: t along a's axis, x along the normal n.
struct Crossing {
  Vec3 n;           // from a to b
  double apart;     // of the axes, along n, >= 0
  Point2 axis_b;    // in the plane, z component is -+ sin(gamma)
  Point2 centre_b;  // in the plane, from the centre of a
};

Vec3 perpendicular(const Vec3 &u)
{
  const Vec3 side = std::abs(u.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 n = cross(u, side);
  return (1.0 / norm(n)) * n;
}

Crossing crossing_of(const Segment &a, const Segment &b)
{
  const Vec3 between = b.centre - a.centre;
  Vec3 n = cross(a.axis, b.axis);
  if (norm(n) < kParallelSine) n = between - dot(between, a.axis) * a.axis;
  n = norm(n) > 0.0 ? (1.0 / norm(n)) * n : perpendicular(a.axis);
  if (dot(between, n) < 0.0) n = -n;
  const Vec3 e1 = a.axis, e2 = cross(n, a.axis);
  Point2 axis_b{dot(b.axis, e1), dot(b.axis, e2)};
  const double length = std::hypot(axis_b.t, axis_b.z);
  axis_b = {axis_b.t / length, axis_b.z / length};
  return {n, dot(between, n), axis_b, {dot(between, e1), dot(between, e2)}};
}

double half_width(double radius, double x)
{
  return std::sqrt(std::max((radius - x) * (radius + x), 0.0));
}

// Whether the bands cross wholly within the straight parts of both rods, and neither axis lies
// inside the other rod.
bool crosses_clear_of_ends(const Capsule &a, const Capsule &b, const Crossing &c)
{
  const double depth = a.radius + b.radius - c.apart;
  if (depth > kDeepestCrossing * std::min(a.radius, b.radius)) return false;
  const double sine = std::abs(c.axis_b.z);
  if (sine < kParallelSine) return false;
  const double t = -c.centre_b.z / c.axis_b.z;
  const double s = c.centre_b.t + t * c.axis_b.t;
  const double wide_a = half_width(a.radius, c.apart - b.radius);
  const double wide_b = half_width(b.radius, c.apart - a.radius);
  const double cosine = std::abs(c.axis_b.t);
  return std::abs(s) + (wide_b + wide_a * cosine) / sine <= a.segment.half_length &&
         std::abs(t) + (wide_a + wide_b * cosine) / sine <= b.segment.half_length;
}

// Gauss-Chebyshev quadrature of the second kind: integral of sqrt((high - x)(x - low)) F(x) =
// c^2 pi/(n + 1) sum sin^2(k pi/(n + 1)) F(m + c cos(k pi/(n + 1))), m the middle, 2 c the width.
double crossing_volume(const Capsule &a, const Capsule &b, const Crossing &c)
{
  constexpr int kNodes = 8;
  const double low = c.apart - b.radius, high = a.radius;
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double sum = 0.0;
  for (int k = 1; k <= kNodes; k++) {
    const double angle = k * pi / (kNodes + 1);
    const double x = middle + half * std::cos(angle);
    sum += std::sin(angle) * std::sin(angle) * std::sqrt((a.radius + x) * (b.radius + c.apart - x));
  }
  return 4.0 / std::abs(c.axis_b.z) * half * half * pi / (kNodes + 1) * sum;
}

// An end of a rod that touches, as a ball.
struct BallEnd {
  Vec3 centre;
  Vec3 outwards;  // along the axis, away from the rod
  double radius;
  bool is_end;  // the closest point lies at an end (both ends of a sphere do)
};

BallEnd end_at(const Capsule &rod, double s)
{
  const Segment &segment = rod.segment;
  return {segment.at(s), s < 0.0 ? -segment.axis : segment.axis, rod.radius,
          std::abs(s) == segment.half_length};
}

// Whether what the ball has in common with a body that begins `near` from its centre in the
// direction m belongs to the rod's round end: a point of it lies at least near along m, and no
// further to the side than the ball does there.
bool lies_beyond_end(const BallEnd &ball, const Vec3 &m, double near)
{
  const double along = dot(m, ball.outwards);
  const double across = std::sqrt(std::max(1.0 - along * along, 0.0));
  return ball.is_end && near > 0.0 && along * near - across * half_width(ball.radius, near) >= 0.0;
}

double cap_volume(double radius, double height)
{
  return pi / 3.0 * height * height * (3.0 * radius - height);
}

// Two balls, centres g apart: the caps beyond the plane of the circle in which they meet.
double balls_volume(double r, double q, double g)
{
  const double x = ((r - q) * (r + q) + g * g) / (2.0 * g);
  return cap_volume(r, r - x) + cap_volume(q, q - (g - x));
}

// A ball of radius r and a long tube of radius q whose axis is g away. Planes at right angles to
// the shortest way cut a disc of radius rho = sqrt(r^2 - x^2) and a band 2 w wide,
// w = sqrt(q^2 - (g - x)^2). Beyond x0, where rho = w, the disc lies in the band: a cap. Before it
// they share 2 (w sqrt(rho^2 - w^2) + rho^2 asin(w/rho)), with a root at either end of the interval
// that x = middle - half cos(theta) takes away; Gauss-Legendre in theta.
double ball_in_tube_volume(double r, double q, double g)
{
  constexpr double kNodes[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                               0.8650633666889845, 0.9739065285171717};
  constexpr double kWeights[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                 0.1494513491505806, 0.0666713443086881};
  const double x0 = ((r - q) * (r + q) + g * g) / (2.0 * g);
  const double middle = 0.5 * (x0 + g - q), half = 0.5 * (x0 - g + q);
  const auto integrand = [&](double theta) {
    const double x = middle - half * std::cos(theta);
    const double rho = half_width(r, x), w = half_width(q, g - x);
    const double rest = std::sqrt(std::max(2.0 * g * (x0 - x), 0.0));  // sqrt(rho^2 - w^2)
    return (w * rest + rho * rho * std::atan2(w, rest)) * std::sin(theta);
  };
  double sum = 0.0;
  for (int k = 0; k < 5; k++)
    for (const double side : {-1.0, 1.0})
      sum += kWeights[k] * integrand(0.5 * pi * (1.0 + side * kNodes[k]));
  return 2.0 * half * 0.5 * pi * sum + cap_volume(r, r - x0);
}

// Volume of the common cases that need no search: see overlap_volume.h. Nothing for others.
std::optional<double> quick_volume(const Capsule &a, const Capsule &b, const ClosestPoints &closest,
                                   double g)
{
  const double depth = a.radius + b.radius - g;
  if (depth > kDeepestCrossing * std::min(a.radius, b.radius)) return std::nullopt;
  const Vec3 a_to_b = (-1.0 / g) * closest.delta;
  const BallEnd end_a = end_at(a, closest.s), end_b = end_at(b, closest.t);
  const bool beyond_a = lies_beyond_end(end_a, a_to_b, g - b.radius);
  const bool beyond_b = lies_beyond_end(end_b, -a_to_b, g - a.radius);
  if (beyond_a && beyond_b) return balls_volume(a.radius, b.radius, g);
  // The ball and the straight part of the other rod, which the common body must not leave.
  if (beyond_a && std::abs(closest.t) + half_width(a.radius, g - b.radius) <= b.segment.half_length)
    return ball_in_tube_volume(a.radius, b.radius, g);
  if (beyond_b && std::abs(closest.s) + half_width(b.radius, g - a.radius) <= a.segment.half_length)
    return ball_in_tube_volume(b.radius, a.radius, g);
  return std::nullopt;
}

}  // namespace

BoundedVolume overlap_volume(const Capsule &a, const Capsule &b, double tolerance)
{
  const ClosestPoints closest = closest_points(a.segment, b.segment);
  const double distance = std::sqrt(closest.distance_squared);
  const double depth = a.radius + b.radius - distance;
  if (!(depth > 0.0)) return {0.0, 0.0};

  if (const auto quick = quick_volume(a, b, closest, distance))
    return {*quick, kQuickError * *quick};
  const Crossing c = crossing_of(a.segment, b.segment);
  if (crosses_clear_of_ends(a, b, c)) {
    const double volume = crossing_volume(a, b, c);
    return {volume, kQuickError * volume};
  }

  const double low = std::max(-a.radius, c.apart - b.radius);
  const double high = std::min(a.radius, c.apart + b.radius);
  // A point inside both, on the way from the closest point of a to that of b.
  const double way = std::clamp(a.radius - 0.5 * depth, 0.0, distance);
  const Vec3 to_b = distance > 0.0 ? (-way / distance) * closest.delta : Vec3{0.0, 0.0, 0.0};
  const double inner = dot(to_b, c.n);
  if (!(low < inner && inner < high)) return {0.0, 0.0};  // round-off

  const auto section_a = [&](double x) {
    return Stadium{{1.0, 0.0}, a.segment.half_length, half_width(a.radius, x)};
  };
  const auto section_b = [&](double x) {
    return Stadium{c.axis_b, b.segment.half_length, half_width(b.radius, x - c.apart)};
  };
  const auto common = [&](double x) {
    const Stadium cut_a = section_a(x), cut_b = section_b(x);
    if (cut_a.radius == 0.0 || cut_b.radius == 0.0) return 0.0;
    return intersection_area(cut_a, cut_b, c.centre_b);
  };
  const auto largest = [&](double from, double to) {
    const double near_a = std::clamp(0.0, from, to), near_b = std::clamp(c.apart, from, to);
    return std::min(area(section_a(near_a)), area(section_b(near_b)));
  };
  return convex_volume({common, largest, low, inner, high}, tolerance,
                       kLeast * std::min(volume(a), volume(b)));
}

}  // namespace spherocylinder
