// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/section_area.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"

namespace spherocylinder {
namespace {

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

// A stadium about a centre of its own, its outline in four pieces.
class PlacedStadium {
 public:
  PlacedStadium(const Stadium &stadium, const Point2 &centre)
      : centre_(centre), u_(stadium.axis), half_(stadium.half_length), radius_(stadium.radius)
  {
  }

  // Whether the point is inside, an outline as wide as `rim` included or left out (rim < 0).
  bool holds(const Point2 &point, double rim) const
  {
    const Point2 d = point - centre_;
    const double along = std::clamp(dot(d, u_), -half_, half_);
    const Point2 off{d.t - along * u_.t, d.z - along * u_.z};
    return dot(off, off) <= (radius_ + rim) * std::abs(radius_ + rim);
  }

  // Twice the area between the centre and the part of the outline inside `other`, by Green's
  // theorem: integral of t dz - z dt, counter-clockwise.
  double outline_inside(const PlacedStadium &other, const Point2 &centre, double rim) const
  {
    const Point2 across{-u_.z, u_.t};
    double sum = 0.0;
    for (const double side : {-1.0, 1.0}) {
      // The straight piece along side * u, at -side * across, and the round end at side * u.
      const auto on_side = [&](double s) {
        return Point2{centre_.t + side * (s * u_.t - radius_ * across.t),
                      centre_.z + side * (s * u_.z - radius_ * across.z)};
      };
      const Point2 from = on_side(-half_), to = on_side(half_);
      if (half_ > 0.0)
        for_parts_inside(
            other, other.cuts_of_line(from, to), rim, [&](double s) { return along(from, to, s); },
            [&](double a, double b) {
              sum += cross(along(from, to, a) - centre, along(from, to, b) - centre);
            });

      const Point2 end{centre_.t + side * half_ * u_.t, centre_.z + side * half_ * u_.z};
      const double first = std::atan2(-side * across.z, -side * across.t);
      const auto on_arc = [&](double part) {
        const double angle = first + part * pi;
        return Point2{end.t + radius_ * std::cos(angle), end.z + radius_ * std::sin(angle)};
      };
      for_parts_inside(other, other.cuts_of_arc(end, radius_, first), rim, on_arc,
                       [&](double a, double b) {
                         const Point2 chord = on_arc(b) - on_arc(a);
                         sum += radius_ * radius_ * (b - a) * pi + cross(end - centre, chord);
                       });
    }
    return sum;
  }

 private:
  // Numbers from 0 to 1, sorted, between which a piece is wholly inside or outside.
  using Cuts = std::vector<double>;

  template <class Point, class Add>
  static void for_parts_inside(const PlacedStadium &other, Cuts cuts, double rim, Point point,
                               Add add)
  {
    cuts.push_back(0.0);
    cuts.push_back(1.0);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); i++)
      if (cuts[i] > cuts[i - 1] && other.holds(point(0.5 * (cuts[i - 1] + cuts[i])), rim))
        add(cuts[i - 1], cuts[i]);
  }

  Point2 end(double side) const
  {
    return {centre_.t + side * half_ * u_.t, centre_.z + side * half_ * u_.z};
  }

  // Where the line meets the circles about the ends and the lines along the sides.
  Cuts cuts_of_line(const Point2 &from, const Point2 &to) const
  {
    Cuts cuts;
    const auto add = [&](double s) {
      if (s > 0.0 && s < 1.0) cuts.push_back(s);
    };
    const Point2 d = to - from;
    const double dd = dot(d, d);
    for (const double side : {-1.0, 1.0}) {
      const Point2 to_end = end(side) - from;
      const double height = cross(d, to_end);
      const double rest = radius_ * radius_ * dd - height * height;
      if (rest > 0.0) {
        add((dot(d, to_end) - std::sqrt(rest)) / dd);
        add((dot(d, to_end) + std::sqrt(rest)) / dd);
      }
      const double slope = cross(u_, d);
      if (slope != 0.0) add((cross(u_, centre_ - from) + side * radius_) / slope);
    }
    return cuts;
  }

  // The same for the half circle that begins at the angle `first`; 1 stands for pi.
  Cuts cuts_of_arc(const Point2 &centre, double radius, double first) const
  {
    Cuts cuts;
    const auto add = [&](double angle) {
      const double part = std::remainder(angle - first, 2.0 * pi) / pi;
      if (part > 0.0 && part < 1.0) cuts.push_back(part);
    };
    for (const double side : {-1.0, 1.0}) {
      // |centre + radius e - end| = radius_: e . d = (|d|^2 + radius^2 - radius_^2)/(2 radius).
      const Point2 d = end(side) - centre;
      const double distance = std::hypot(d.t, d.z);
      const double reach =
          (distance * distance + (radius - radius_) * (radius + radius_)) / (2.0 * radius);
      if (distance > 0.0 && std::abs(reach) < distance) {
        const double turn = std::acos(reach / distance);
        add(std::atan2(d.z, d.t) + turn);
        add(std::atan2(d.z, d.t) - turn);
      }
      // u x (centre + radius e - centre_) = side radius_, with u x e = sin(angle - angle of u).
      const double height = (side * radius_ - cross(u_, centre - centre_)) / radius;
      // A side that only touches the circle, as where both have an end in common, parts it too.
      constexpr double kTouch = 1e-9;
      if (std::abs(height) < 1.0 + kTouch) {
        const double tilt = std::atan2(u_.z, u_.t);
        const double turn = std::asin(std::clamp(height, -1.0, 1.0));
        add(tilt + turn);
        add(tilt + pi - turn);
      }
    }
    return cuts;
  }

  Point2 centre_, u_;
  double half_, radius_;
};

}  // namespace

double area(const Polygon &polygon)
{
  // Relative to the first corner: a small polygon far from the origin keeps its digits.
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); i++)
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
  for (std::size_t i = 0; i < polygon.size(); i++) {
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
  for (std::size_t i = 0; i < polygon.size(); i++)
    sum +=
        disc_triangle_area(polygon[i] - centre, polygon[(i + 1) % polygon.size()] - centre, radius);
  return std::max(sum, 0.0);
}

// The outline of what both have in common is the part of either's outline inside the other. Where
// the two outlines run on top of each other they do so in the same sense, and a's counts.
double intersection_area(const Stadium &a, const Stadium &b, const Point2 &b_centre)
{
  constexpr double kRimRounding = 1e-14;
  const double rim = kRimRounding * (std::hypot(b_centre.t, b_centre.z) + a.half_length +
                                     b.half_length + a.radius + b.radius);
  const PlacedStadium placed_a(a, {0.0, 0.0}), placed_b(b, b_centre);
  const double twice = placed_a.outline_inside(placed_b, b_centre, rim) +
                       placed_b.outline_inside(placed_a, b_centre, -rim);
  return std::max(0.5 * twice, 0.0);
}

// The stadium is a band between its two ends and a half-disc beyond either.
double intersection_area(const Stadium &stadium, const Polygon &polygon)
{
  const Point2 u = stadium.axis;
  const Point2 minus_u{-u.t, -u.z};
  const Point2 across{-u.z, u.t};
  const Point2 minus_across{u.z, -u.t};
  const double h = stadium.half_length;
  const double r = stadium.radius;

  const Polygon band =
      clip(clip(clip(clip(polygon, u, h), minus_u, h), across, r), minus_across, r);
  return area(band) + intersection_area(clip(polygon, minus_u, -h), {h * u.t, h * u.z}, r) +
         intersection_area(clip(polygon, u, -h), {-h * u.t, -h * u.z}, r);
}

double intersection_area(const Stadium &stadium, const Rectangle &rectangle)
{
  // Far corners of a large rectangle only cost digits: nothing lies beyond `reach`.
  const double reach = 2.0 * (stadium.half_length + stadium.radius);
  const double t_low = std::max(rectangle.t_low, -reach);
  const double t_high = std::min(rectangle.t_high, reach);
  const double z_low = std::max(rectangle.z_low, -reach);
  const double z_high = std::min(rectangle.z_high, reach);
  if (!(t_low < t_high && z_low < z_high)) return 0.0;
  return intersection_area(
      stadium, Polygon{{t_low, z_low}, {t_high, z_low}, {t_high, z_high}, {t_low, z_high}});
}

}  // namespace spherocylinder
