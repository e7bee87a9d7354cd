// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/section_area.h"

#include <algorithm>
#include <cmath>

namespace spherocylinder {
namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const Point2 &a, const Point2 &b) { return a.t * b.t + a.z * b.z; }
double cross(const Point2 &a, const Point2 &b) { return a.t * b.z - a.z * b.t; }
Point2 operator-(const Point2 &a, const Point2 &b) { return {a.t - b.t, a.z - b.z}; }
Point2 along(const Point2 &a, const Point2 &b, double s)
{
  return {a.t + s * (b.t - a.t), a.z + s * (b.z - a.z)};
}

double sector(const Point2 &a, const Point2 &b, double radius)
{
  return 0.5 * radius * radius * std::atan2(cross(a, b), dot(a, b));
}

// Signed area common to the disc about the origin and the triangle (origin, a, b); positive if
// the edge a-b turns counter-clockwise about the origin. The part of the edge inside the disc
// spans a triangle, the parts outside span sectors.
double disc_triangle_area(const Point2 &a, const Point2 &b, double radius)
{
  const Point2 edge = b - a;
  const double length_squared = dot(edge, edge);
  if (length_squared == 0.0) return 0.0;
  const double middle = -dot(a, edge) / length_squared;  // foot of the perpendicular, 0 at a
  const double height = cross(a, b);                     // times the edge's length
  const double half_chord_squared =
      radius * radius / length_squared - (height / length_squared) * (height / length_squared);
  if (half_chord_squared <= 0.0) return sector(a, b, radius);

  const double half_chord = std::sqrt(half_chord_squared);
  const double enter = std::clamp(middle - half_chord, 0.0, 1.0);
  const double leave = std::clamp(middle + half_chord, 0.0, 1.0);
  if (enter == leave) return sector(a, b, radius);
  double sum = 0.5 * (leave - enter) * height;
  if (enter > 0.0) sum += sector(a, along(a, b, enter), radius);
  if (leave < 1.0) sum += sector(along(a, b, leave), b, radius);
  return sum;
}

}  // namespace

double area(const Polygon &polygon)
{
  // Relative to the first corner: a small polygon far from the origin keeps its digits.
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * twice;
}

double area(const Stadium &stadium)
{
  return stadium.radius * (4.0 * stadium.half_length + pi * stadium.radius);
}

Polygon clip(const Polygon &polygon, const Point2 &normal, double offset)
{
  Polygon kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 &a = polygon[i];
    const Point2 &b = polygon[(i + 1) % polygon.size()];
    const double outside_a = dot(normal, a) - offset;
    const double outside_b = dot(normal, b) - offset;
    if (outside_a <= 0.0) kept.push_back(a);
    if ((outside_a < 0.0 && outside_b > 0.0) || (outside_a > 0.0 && outside_b < 0.0))
      kept.push_back(along(a, b, outside_a / (outside_a - outside_b)));
  }
  return kept;
}

double intersection_area(const Polygon &polygon, const Point2 &centre, double radius)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum +=
        disc_triangle_area(polygon[i] - centre, polygon[(i + 1) % polygon.size()] - centre, radius);
  return std::max(sum, 0.0);
}

// The stadium is a band between its two ends and a half-disc beyond either.
double intersection_area(const Stadium &stadium, const Rectangle &rectangle)
{
  // Far corners of a large rectangle only cost digits: nothing lies beyond `reach`.
  const double reach = 2.0 * (stadium.half_length + stadium.radius);
  const double t_low = std::max(rectangle.t_low, -reach);
  const double t_high = std::min(rectangle.t_high, reach);
  const double z_low = std::max(rectangle.z_low, -reach);
  const double z_high = std::min(rectangle.z_high, reach);
  if (!(t_low < t_high && z_low < z_high)) return 0.0;

  const Polygon frame{{t_low, z_low}, {t_high, z_low}, {t_high, z_high}, {t_low, z_high}};
  const Point2 u = stadium.axis;
  const Point2 minus_u{-u.t, -u.z};
  const Point2 across{-u.z, u.t};
  const Point2 minus_across{u.z, -u.t};
  const double h = stadium.half_length;
  const double r = stadium.radius;

  const Polygon band = clip(clip(clip(clip(frame, u, h), minus_u, h), across, r), minus_across, r);
  return area(band) + intersection_area(clip(frame, minus_u, -h), {h * u.t, h * u.z}, r) +
         intersection_area(clip(frame, u, -h), {-h * u.t, -h * u.z}, r);
}

}  // namespace spherocylinder
