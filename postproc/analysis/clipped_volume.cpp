// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/clipped_volume.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/rods.h"
#include "analysis/section_area.h"

namespace spherocylinder {
namespace {

constexpr double pi = 3.14159265358979323846;

// A sliver need not be known to the same relative error as a rod: its share in any sum is small.
constexpr double sliver = 1e-3;

// Areas below this part of the rod's round section are round-off of disjoint sections.
constexpr double no_area = 1e-13;

// Stops a tolerance below round-off; 1e5 samples reach 1e-9.
constexpr std::size_t most_samples = 100000;

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

bool contains_ball(const UprightCylinder &cylinder, const Vec3 &centre, double radius)
{
  return std::hypot(centre.x - cylinder.x, centre.y - cylinder.y) + radius <= cylinder.radius &&
         centre.z - radius >= cylinder.z_low && centre.z + radius <= cylinder.z_high;
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

struct Sample {
  double x;
  double root;  // sqrt(A)
};

struct Bounds {
  double low, high;
};

// Integral of the square of a straight line between its end values.
double integral_of_square(double width, double left, double right)
{
  return width * (left * left + left * right + right * right) / 3.0;
}

// Value at x of the line through two samples.
double prolonged(const Sample &a, const Sample &b, double x)
{
  return a.root + (b.root - a.root) * (x - a.x) / (b.x - a.x);
}

// Bounds on the integral of A between samples i and i + 1. Samples of zero area may lie beyond
// the common body, where sqrt(A) is not concave: no chord ends in one.
Bounds integral_bounds(const std::vector<Sample> &samples, std::size_t i, double largest_area)
{
  const Sample &a = samples[i];
  const Sample &b = samples[i + 1];
  const double width = b.x - a.x;
  if (a.root == 0.0 && b.root == 0.0) return {0.0, 0.0};  // see clipped_volume: not inside the body

  Bounds bounds{0.0, width * largest_area};
  if (a.root > 0.0 && b.root > 0.0) bounds.low = integral_of_square(width, a.root, b.root);

  const bool from_left = i > 0 && samples[i - 1].root > 0.0 && a.root > 0.0;
  const bool from_right = i + 2 < samples.size() && samples[i + 2].root > 0.0 && b.root > 0.0;
  const double left_at_b = from_left ? prolonged(samples[i - 1], a, b.x) : 0.0;
  const double right_at_a = from_right ? prolonged(samples[i + 2], b, a.x) : 0.0;
  double high = bounds.high;
  if (from_left && from_right) {
    // Two lines, one through either end of the interval: the lower of the two is the bound.
    const double gap_a = std::max(right_at_a - a.root, 0.0);
    const double gap_b = std::max(left_at_b - b.root, 0.0);
    if (gap_a + gap_b > 0.0) {
      const double crossing = gap_a / (gap_a + gap_b);
      const double top = a.root + crossing * (left_at_b - a.root);
      high = integral_of_square(crossing * width, a.root, top) +
             integral_of_square((1.0 - crossing) * width, top, b.root);
    } else {
      high = bounds.low;
    }
  } else if (from_left) {
    high = integral_of_square(width, a.root, std::max(left_at_b, 0.0));
  } else if (from_right) {
    high = integral_of_square(width, std::max(right_at_a, 0.0), b.root);
  }
  bounds.high = std::max(std::min(bounds.high, high), bounds.low);
  return bounds;
}

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

BoundedVolume clipped_volume(const Capsule &capsule, const UprightCylinder &cylinder,
                             double tolerance)
{
  const Segment &segment = capsule.segment;
  const double whole = volume(capsule);
  if (contains_ball(cylinder, segment.at(segment.half_length), capsule.radius) &&
      contains_ball(cylinder, segment.at(-segment.half_length), capsule.radius))
    return {whole, 0.0};

  const Vec3 on_axis = segment.at(position_nearest(cylinder, segment));
  const Vec3 nearest = closest_point(cylinder, on_axis);
  const double distance = norm(on_axis - nearest);
  if (distance >= capsule.radius) return {0.0, 0.0};

  // Starts with a section that has an area, so that the body lies between the zero samples on
  // either side of it.
  const Sections sections(capsule, cylinder);
  const double inner =
      inner_offset(capsule, cylinder, on_axis, nearest, distance, sections.normal());
  if (!(sections.lowest() < inner && inner < sections.highest())) return {0.0, 0.0};  // round-off
  const auto sample = [&](double x) { return Sample{x, std::sqrt(sections.common_area(x))}; };
  std::vector<Sample> samples{sample(sections.lowest()), sample(inner), sample(sections.highest())};
  std::vector<Sample> finer;
  std::vector<Bounds> bounds;
  while (true) {
    Bounds total{0.0, 0.0};
    bounds.clear();
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      bounds.push_back(
          integral_bounds(samples, i, sections.largest_area(samples[i].x, samples[i + 1].x)));
      total.low += bounds.back().low;
      total.high += bounds.back().high;
    }
    const double gap = total.high - total.low;
    const double wanted = 2.0 * tolerance * std::max(total.low, sliver * whole);
    if (gap <= wanted || samples.size() >= most_samples)
      return {0.5 * (total.low + total.high), 0.5 * gap};

    const double share = wanted / static_cast<double>(bounds.size());
    finer.clear();
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      finer.push_back(samples[i]);
      const double middle = 0.5 * (samples[i].x + samples[i + 1].x);
      if (bounds[i].high - bounds[i].low > share && samples[i].x < middle &&
          middle < samples[i + 1].x)
        finer.push_back(sample(middle));
    }
    finer.push_back(samples.back());
    if (finer.size() == samples.size()) return {0.5 * (total.low + total.high), 0.5 * gap};
    samples.swap(finer);
  }
}

}  // namespace spherocylinder
