// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/clipped_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/numbers.h"
#include "solid/capsule_measures.h"
#include "solid/plane_volume.h"
#include "solid/section_area.h"

namespace spherocylinder {
namespace {

// A sliver need not be known to the same relative error as a rod: its share in any sum is small.
constexpr double kSliver = 1e-3;

// Areas below this part of the rod's round section are round-off of disjoint sections.
constexpr double kNoArea = 1e-13;

double clamp_to(double value, double low, double high)
{
  return std::min(std::max(value, low), high);
}

// Closest point of the solid body to p.
Vec3 closest_point(const UprightCylinder &cylinder, const Vec3 &p)
{
  const double dx = p.x - cylinder.x;
  const double dy = p.y - cylinder.y;
  const double from_axis = std::hypot(dx, dy);
  const double shrink = from_axis > cylinder.radius ? cylinder.radius / from_axis : 1.0;
  return {cylinder.x + shrink * dx, cylinder.y + shrink * dy,
          clamp_to(p.z, cylinder.z_low, cylinder.z_high)};
}

Vec3 closest_point(const UprightBox &box, const Vec3 &p)
{
  return {clamp_to(p.x, box.x_low, box.x_high), clamp_to(p.y, box.y_low, box.y_high),
          clamp_to(p.z, box.z_low, box.z_high)};
}

Vec3 middle_of(const UprightCylinder &cylinder)
{
  return {cylinder.x, cylinder.y, 0.5 * (cylinder.z_low + cylinder.z_high)};
}

Vec3 middle_of(const UprightBox &box)
{
  return {0.5 * (box.x_low + box.x_high), 0.5 * (box.y_low + box.y_high),
          0.5 * (box.z_low + box.z_high)};
}

constexpr double kOutOfReach = std::numeric_limits<double>::max();

double volume_between(const Capsule &rod, double z_low, double z_high)
{
  return volume_below(rod, z_high) - volume_below(rod, z_low);
}

// What the body leaves of a rod that only parallel planes of it cut.
std::optional<double> volume_cut_by_planes(const UprightCylinder &c, const Capsule &rod)
{
  if (!holds({c.x, c.y, c.radius, -kOutOfReach, kOutOfReach}, rod)) return std::nullopt;
  return volume_between(rod, c.z_low, c.z_high);
}

std::optional<double> volume_cut_by_planes(const UprightBox &b, const Capsule &rod)
{
  constexpr double kAll = kOutOfReach;
  if (holds(UprightBox(b.x_low, b.x_high, b.y_low, b.y_high, -kAll, kAll), rod))
    return volume_between(rod, b.z_low, b.z_high);
  Capsule turned = rod;  // with x or y up
  Vec3 &centre = turned.segment.centre, &axis = turned.segment.axis;
  if (holds(UprightBox(-kAll, kAll, b.y_low, b.y_high, b.z_low, b.z_high), rod)) {
    std::swap(centre.x, centre.z);
    std::swap(axis.x, axis.z);
    return volume_between(turned, b.x_low, b.x_high);
  }
  if (holds(UprightBox(b.x_low, b.x_high, -kAll, kAll, b.z_low, b.z_high), rod)) {
    std::swap(centre.y, centre.z);
    std::swap(axis.y, axis.z);
    return volume_between(turned, b.y_low, b.y_high);
  }
  return std::nullopt;
}

// An empty one has low >= high.
struct Interval {
  double low, high;
};

// Lines in the horizontal plane through the rod's centre, at right angles to `normal` and at the
// offset x from the centre along it; t runs along them from the point nearest to the centre. Of the
// disc or rectangle that a body leaves in that plane: the offsets between which it lies, and the
// part of a line that is in it.
class Disc {
 public:
  Disc(const UprightCylinder &cylinder, const Vec3 &centre, const Vec3 &normal, const Vec3 &along)
      : radius_(cylinder.radius)
  {
    const Vec3 to_axis{cylinder.x - centre.x, cylinder.y - centre.y, 0.0};
    x_ = dot(to_axis, normal);
    t_ = dot(to_axis, along);
  }

  Interval offsets() const { return {x_ - radius_, x_ + radius_}; }

  Interval chord(double x) const
  {
    const double from_axis = x - x_;
    const double half_width_squared = (radius_ - from_axis) * (radius_ + from_axis);
    if (half_width_squared <= 0.0) return {0.0, 0.0};
    const double half_width = std::sqrt(half_width_squared);
    return {t_ - half_width, t_ + half_width};
  }

 private:
  double radius_, x_, t_;
};

class Quadrangle {
 public:
  Quadrangle(const UprightBox &box, const Vec3 &centre, const Vec3 &normal, const Vec3 &along)
      : sides_{{{box.x_low - centre.x, box.x_high - centre.x}, normal.x, along.x},
               {{box.y_low - centre.y, box.y_high - centre.y}, normal.y, along.y}}
  {
  }

  Interval offsets() const
  {
    Interval found{0.0, 0.0};
    for (const Side &side : sides_) {
      const double at_low = side.room.low * side.normal, at_high = side.room.high * side.normal;
      found.low += std::min(at_low, at_high);
      found.high += std::max(at_low, at_high);
    }
    return found;
  }

  Interval chord(double x) const
  {
    Interval found{-kOutOfReach, kOutOfReach};
    for (const Side &side : sides_) {
      const double at = x * side.normal;
      if (side.along == 0.0) {
        if (at <= side.room.low || at >= side.room.high) return {0.0, 0.0};
        continue;
      }
      const double to_low = (side.room.low - at) / side.along;
      const double to_high = (side.room.high - at) / side.along;
      found.low = std::max(found.low, std::min(to_low, to_high));
      found.high = std::min(found.high, std::max(to_low, to_high));
    }
    return found;
  }

 private:
  struct Side {  // in one of x and y
    Interval room;
    double normal, along;  // components
  };
  Side sides_[2];
};

Disc footprint(const UprightCylinder &c, const Vec3 &centre, const Vec3 &normal, const Vec3 &along)
{
  return {c, centre, normal, along};
}

Quadrangle footprint(const UprightBox &b, const Vec3 &centre, const Vec3 &normal, const Vec3 &along)
{
  return {b, centre, normal, along};
}

// Position along the segment that is nearest to the body. The distance to a convex body is
// convex along a line, so shrinking a bracket by the golden section finds its minimum.
template <class Body>
double position_nearest(const Body &body, const Segment &segment)
{
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 80;  // kGolden^80 < 1e-16
  const auto distance = [&](double s) {
    return norm_squared(segment.at(s) - closest_point(body, segment.at(s)));
  };
  double low = -segment.half_length;
  double high = segment.half_length;
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = distance(left);
  double at_right = distance(right);
  for (int i = 0; i < kSteps && low < high; i++) {
    if (at_left <= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = distance(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = distance(right);
    }
  }
  return 0.5 * (low + high);
}

// Horizontal and along the rod's axis, for an upright rod anywhere.
Vec3 heading_of(const Vec3 &axis)
{
  const double horizontal = std::hypot(axis.x, axis.y);
  return horizontal > 0.0 ? Vec3{axis.x / horizontal, axis.y / horizontal, 0.0}
                          : Vec3{1.0, 0.0, 0.0};
}

Vec3 normal_to(const Vec3 &heading) { return {-heading.y, heading.x, 0.0}; }

// The planes x = const: x runs along `normal`, horizontal and at right angles to the rod.
template <class Body>
class Sections {
 public:
  Sections(const Capsule &capsule, const Body &body)
      : half_length_(capsule.segment.half_length),
        radius_(capsule.radius),
        normal_(normal_to(heading_of(capsule.segment.axis))),
        footprint_(
            footprint(body, capsule.segment.centre, normal_, heading_of(capsule.segment.axis)))
  {
    const Vec3 &u = capsule.segment.axis;
    z_low_ = body.z_low - capsule.segment.centre.z;
    z_high_ = body.z_high - capsule.segment.centre.z;
    stadium_axis_ = {std::hypot(u.x, u.y), u.z};
  }

  const Vec3 &normal() const { return normal_; }
  double lowest() const { return std::max(-radius_, footprint_.offsets().low); }
  double highest() const { return std::min(radius_, footprint_.offsets().high); }

  double common_area(double x) const
  {
    const Interval chord = footprint_.chord(x);
    if (!(chord.low < chord.high)) return 0.0;
    const double shared = intersection_area(stadium(x), {chord.low, chord.high, z_low_, z_high_});
    return shared > kNoArea * radius_ * radius_ ? shared : 0.0;
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
  Vec3 normal_;
  decltype(footprint(std::declval<Body>(), Vec3{}, Vec3{}, Vec3{})) footprint_;
  Point2 stadium_axis_;
  double z_low_, z_high_;
};

// An x whose section certainly has an area: of a point inside both bodies.
double inner_offset(const Capsule &capsule, const Vec3 &middle, const Vec3 &on_axis,
                    const Vec3 &nearest, double distance, const Vec3 &normal)
{
  const Vec3 inwards = middle - nearest;
  const double way = norm(inwards);
  const double step = way > 0.0 ? std::min(0.5 * (capsule.radius - distance) / way, 0.5) : 0.0;
  return dot(nearest + step * inwards - on_axis, normal);
}

template <class Body>
BoundedVolume common_volume(const Capsule &capsule, const Body &body, double tolerance)
{
  if (misses(body, capsule)) return {0.0, 0.0};
  const double whole = volume(capsule);
  if (holds(body, capsule)) return {whole, 0.0};
  if (const auto exact = volume_cut_by_planes(body, capsule)) return {*exact, 0.0};

  const Segment &segment = capsule.segment;
  const Vec3 on_axis = segment.at(position_nearest(body, segment));
  const Vec3 nearest = closest_point(body, on_axis);
  const double distance = norm(on_axis - nearest);
  if (distance >= capsule.radius) return {0.0, 0.0};

  const Sections<Body> sections(capsule, body);
  const double inner =
      inner_offset(capsule, middle_of(body), on_axis, nearest, distance, sections.normal());
  if (!(sections.lowest() < inner && inner < sections.highest())) return {0.0, 0.0};  // round-off
  return convex_volume({[&](double x) { return sections.common_area(x); },
                        [&](double a, double b) { return sections.largest_area(a, b); },
                        sections.lowest(), inner, sections.highest()},
                       tolerance, kSliver * whole);
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

double volume(const UprightBox &box)
{
  return (box.x_high - box.x_low) * (box.y_high - box.y_low) * (box.z_high - box.z_low);
}

bool holds(const UprightBox &box, const Capsule &rod)
{
  for (const double s : {-rod.segment.half_length, rod.segment.half_length}) {
    const Vec3 end = rod.segment.at(s);
    if (end.x - rod.radius < box.x_low || end.x + rod.radius > box.x_high ||
        end.y - rod.radius < box.y_low || end.y + rod.radius > box.y_high ||
        end.z - rod.radius < box.z_low || end.z + rod.radius > box.z_high)
      return false;
  }
  return true;
}

// By the rod's own bounding box.
bool misses(const UprightBox &box, const Capsule &rod)
{
  const Segment &s = rod.segment;
  const auto apart = [&](double centre, double axis, double low, double high) {
    const double reach = s.half_length * std::abs(axis) + rod.radius;
    return centre + reach <= low || centre - reach >= high;
  };
  return apart(s.centre.x, s.axis.x, box.x_low, box.x_high) ||
         apart(s.centre.y, s.axis.y, box.y_low, box.y_high) ||
         apart(s.centre.z, s.axis.z, box.z_low, box.z_high);
}

BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance)
{
  return common_volume(capsule, cylinder, tolerance);
}

BoundedVolume clipped_volume(const Capsule &capsule, const UprightBox &box, double tolerance)
{
  return common_volume(capsule, box, tolerance);
}

}  // namespace spherocylinder
