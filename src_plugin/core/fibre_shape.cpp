// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/fibre_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/closest_points.h"
#include "core/mass_properties.h"

namespace spherocylinder {

namespace {

// Of the second rod in the first one's body frame, as core/rod_joint.h measures it: twist t/2, bend, twist
// t/2, where turns about z leave the bend's part as it is.
Quaternion relative_at_rest(const JointRest &rest)
{
  const double bend = std::hypot(rest.bend_x, rest.bend_y);
  const double by_sine = bend > 0.0 ? std::sin(0.5 * bend) / bend : 0.5;
  const double cosine = std::cos(0.5 * bend);
  return {cosine * std::cos(0.5 * rest.twist), by_sine * rest.bend_x, by_sine * rest.bend_y,
          cosine * std::sin(0.5 * rest.twist)};
}

double volume_of_segment(const FibreShape &fibre, int k)
{
  return mass_properties(2.0 * fibre.radius, fibre.segment_length, 1.0, shared_ends_of(fibre, k))
      .volume;
}

// The shortest rotation that takes `axis` to z.
Quaternion upright(const Vec3 &axis)
{
  const Quaternion q = orientation_of(axis);
  return {q.w, -q.x, -q.y, -q.z};
}

}  // namespace

FibreShape fibre_shape(int segments, double radius, double total_length, double curvature,
                       double twist)
{
  FibreShape fibre;
  fibre.radius = radius;
  fibre.joint_distance = (total_length - 2.0 * radius) / segments;
  fibre.segment_length = segments > 1 ? fibre.joint_distance + 2.0 * radius : total_length;
  if (segments > 1)
    fibre.rest = {0.0, curvature * fibre.joint_distance, twist * fibre.joint_distance};
  const double half = 0.5 * fibre.joint_distance;
  const Quaternion relative = relative_at_rest(fibre.rest);

  JointedRod rod = {kZero, {1.0, 0.0, 0.0, 0.0}, half};
  for (int k = 0; k < segments; k++) {
    if (k > 0) {
      const Vec3 joint = rod.head();
      rod.orientation = normalized(rod.orientation * relative);
      rod.centre = joint + half * rod.axis();
    }
    fibre.segments.push_back(rod);
  }
  if (segments == 1) return fibre;

  if (curvature != 0.0 || twist != 0.0) {
    const Vec3 chord = fibre.segments.back().head() - fibre.segments.front().tail();
    const Quaternion turn = upright((1.0 / norm(chord)) * chord);
    for (JointedRod &segment : fibre.segments) {
      segment.centre = rotated(segment.centre, turn);
      segment.orientation = normalized(turn * segment.orientation);
    }
  }
  Vec3 moment = kZero;
  for (int k = 0; k < segments; k++)
    moment = moment + volume_of_segment(fibre, k) * fibre.segments[k].centre;
  const Vec3 centre = (1.0 / volume_of(fibre)) * moment;
  for (JointedRod &segment : fibre.segments) segment.centre = segment.centre - centre;
  return fibre;
}

int shared_ends_of(const FibreShape &fibre, int k) { return (k > 0) + (k < fibre.joints()); }

double volume_of(const FibreShape &fibre)
{
  double sum = 0.0;
  for (int k = 0; k <= fibre.joints(); k++) sum += volume_of_segment(fibre, k);
  return sum;
}

double bounding_radius_of(const FibreShape &fibre)
{
  double farthest = norm(fibre.segments.front().tail());
  for (const JointedRod &segment : fibre.segments)
    farthest = std::max(farthest, norm(segment.head()));
  return farthest + fibre.radius;
}

double chord_of(const FibreShape &fibre)
{
  return norm(fibre.segments.back().head() - fibre.segments.front().tail());
}

double narrowest_gap_of(const FibreShape &fibre)
{
  double narrowest = std::numeric_limits<double>::infinity();
  const size_t nearest = fibre.is_short() ? 3 : 2, count = fibre.segments.size();
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + nearest; j < count; j++) {
      const JointedRod &a = fibre.segments[i], &b = fibre.segments[j];
      const double squared =
          closest_points({a.centre, a.axis(), a.half_length}, {b.centre, b.axis(), b.half_length})
              .distance_squared;
      narrowest = std::min(narrowest, std::sqrt(squared) - 2.0 * fibre.radius);
    }
  return narrowest;
}

}  // namespace spherocylinder
