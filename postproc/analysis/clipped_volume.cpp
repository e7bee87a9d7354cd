// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/clipped_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/numbers.h"
#include "analysis/plane_volume.h"
#include "analysis/rods.h"
#include "analysis/section_area.h"

namespace spherocylinder {
namespace {

// A sliver need not be known to the same relative error as a rod: its share in any sum is small.
constexpr double sliver = 1e-3;

// Areas below this part of the rod's round section are round-off of disjoint sections.
constexpr double no_area = 1e-13;

double clamp_to(double value, double low, double high)
{
  return std::min(std::max(value, low), high);
}

// Closest point of the solid cylinder to p.
Vec3 closest_point(const UprightCylinder &cylinder, const Vec3 &p)
{
  const double dx = p.x - cylinder.x;
  const double dy = p.y - cylinder.y;
  const double from_axis = std::hypot(dx, dy);
  const double shrink = from_axis > cylinder.radius ? cylinder.radius / from_axis : 1.0;
  return {cylinder.x + shrink * dx, cylinder.y + shrink * dy,
          clamp_to(p.z, cylinder.z_low, cylinder.z_high)};
}

// Position along the segment that is nearest to the cylinder. The distance to a convex body is
// convex along a line, so shrinking a bracket by the golden section finds its minimum.
double position_nearest(const UprightCylinder &cylinder, const Segment &segment)
{
  constexpr double golden = 0.6180339887498949;
  constexpr int steps = 80;  // golden^80 < 1e-16
  const auto distance = [&](double s) {
    return norm_squared(segment.at(s) - closest_point(cylinder, segment.at(s)));
  };
  double low = -segment.half_length;
  double high = segment.half_length;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double at_left = distance(left);
  double at_right = distance(right);
  for (int i = 0; i < steps && low < high; ++i) {
    if (at_left <= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - golden * (high - low);
      at_left = distance(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + golden * (high - low);
      at_right = distance(right);
    }
  }
  return 0.5 * (low + high);
}

// The planes x = const: x runs along `normal`, horizontal and at right angles to the rod.
class Sections {
 public:
  Sections(const Capsule &capsule, const UprightCylinder &cylinder)
      : half_length_(capsule.segment.half_length), radius_(capsule.radius), cylinder_(cylinder)
  {
    const Vec3 &u = capsule.segment.axis;
    const Vec3 &c = capsule.segment.centre;
    const double horizontal = std::hypot(u.x, u.y);
    const Vec3 t_direction =
        horizontal > 0.0 ? Vec3{u.x / horizontal, u.y / horizontal, 0.0} : Vec3{1.0, 0.0, 0.0};
    normal_ = {-t_direction.y, t_direction.x, 0.0};
    const Vec3 to_axis{cylinder.x - c.x, cylinder.y - c.y, 0.0};
    axis_x_ = dot(to_axis, normal_);
    axis_t_ = dot(to_axis, t_direction);
    z_low_ = cylinder.z_low - c.z;
    z_high_ = cylinder.z_high - c.z;
    stadium_axis_ = {horizontal, u.z};
  }

  const Vec3 &normal() const { return normal_; }
  double lowest() const { return std::max(-radius_, axis_x_ - cylinder_.radius); }
  double highest() const { return std::min(radius_, axis_x_ + cylinder_.radius); }

  double common_area(double x) const
  {
    const double from_axis = x - axis_x_;
    const double half_width_squared =
        (cylinder_.radius - from_axis) * (cylinder_.radius + from_axis);
    if (half_width_squared <= 0.0) return 0.0;
    const double half_width = std::sqrt(half_width_squared);
    const double shared = intersection_area(
        stadium(x), {axis_t_ - half_width, axis_t_ + half_width, z_low_, z_high_});
    return shared > no_area * radius_ * radius_ ? shared : 0.0;
  }

  // No section between a and b is larger: the rod's own is largest nearest to its axis.
  double largest_area(double a, double b) const
  {
    return area(stadium(a > 0.0 ? a : b < 0.0 ? b : 0.0));
  }

 private:
  Stadium stadium(double x) const
  {
    const double radius = std::sqrt(std::max((radius_ - x) * (radius_ + x), 0.0));
    return {stadium_axis_, half_length_, radius};
  }

  double half_length_, radius_;
  const UprightCylinder &cylinder_;
  Vec3 normal_;
  Point2 stadium_axis_;
  double axis_x_, axis_t_, z_low_, z_high_;
};

// An x whose section certainly has an area: of a point inside both bodies.
double inner_offset(const Capsule &capsule, const UprightCylinder &cylinder, const Vec3 &on_axis,
                    const Vec3 &nearest, double distance, const Vec3 &normal)
{
  const Vec3 middle{cylinder.x, cylinder.y, 0.5 * (cylinder.z_low + cylinder.z_high)};
  const Vec3 inwards = middle - nearest;
  const double way = norm(inwards);
  const double step = way > 0.0 ? std::min(0.5 * (capsule.radius - distance) / way, 0.5) : 0.0;
  return dot(nearest + step * inwards - on_axis, normal);
}

}  // namespace

double volume(const UprightCylinder &cylinder)
{
  return pi * cylinder.radius * cylinder.radius * (cylinder.z_high - cylinder.z_low);
}

// Both round ends do, and the cylinder is convex.
bool holds(const UprightCylinder &c, const Capsule &rod)
{
  for (const double s : {-rod.segment.half_length, rod.segment.half_length}) {
    const Vec3 end = rod.segment.at(s);
    const double room = c.radius - rod.radius, dx = end.x - c.x, dy = end.y - c.y;
    if (room < 0.0 || dx * dx + dy * dy > room * room || end.z - rod.radius < c.z_low ||
        end.z + rod.radius > c.z_high)
      return false;
  }
  return true;
}

// By the rod's own upright bounding cylinder.
bool misses(const UprightCylinder &c, const Capsule &rod)
{
  const Segment &s = rod.segment;
  const double up = s.half_length * std::abs(s.axis.z) + rod.radius;
  const double side = s.half_length * std::hypot(s.axis.x, s.axis.y) + rod.radius + c.radius;
  const double dx = s.centre.x - c.x, dy = s.centre.y - c.y;
  return s.centre.z + up <= c.z_low || s.centre.z - up >= c.z_high ||
         dx * dx + dy * dy >= side * side;
}

BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance)
{
  if (misses(cylinder, capsule)) return {0.0, 0.0};
  const double whole = volume(capsule);
  if (holds(cylinder, capsule)) return {whole, 0.0};
  constexpr double out_of_reach = std::numeric_limits<double>::max();
  if (holds({cylinder.x, cylinder.y, cylinder.radius, -out_of_reach, out_of_reach}, capsule))
    return {volume_below(capsule, cylinder.z_high) - volume_below(capsule, cylinder.z_low), 0.0};

  const Segment &segment = capsule.segment;
  const Vec3 on_axis = segment.at(position_nearest(cylinder, segment));
  const Vec3 nearest = closest_point(cylinder, on_axis);
  const double distance = norm(on_axis - nearest);
  if (distance >= capsule.radius) return {0.0, 0.0};

  const Sections sections(capsule, cylinder);
  const double inner =
      inner_offset(capsule, cylinder, on_axis, nearest, distance, sections.normal());
  if (!(sections.lowest() < inner && inner < sections.highest())) return {0.0, 0.0};  // round-off
  return convex_volume({[&](double x) { return sections.common_area(x); },
                        [&](double a, double b) { return sections.largest_area(a, b); },
                        sections.lowest(), inner, sections.highest()},
                       tolerance, sliver * whole);
}

}  // namespace spherocylinder
