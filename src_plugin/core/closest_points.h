// SPDX-License-Identifier: GPL-2.0-or-later
// Closest points of two segments: the narrow phase of every rod-rod contact.
#pragma once

#include "core/capsule.h"

namespace spherocylinder {

struct ClosestPoints {
  double s;                 // position of p on segment i, signed distance from its centre
  double t;                 // position of q on segment j, signed distance from its centre
  Vec3 delta;               // p - q, from rod j to rod i
  double distance_squared;  // |p - q|^2
};

// Closest points p on i and q on j.
//
// The squared distance is a convex quadratic in (s, t) over a rectangle. Its minimum is the
// critical point of the two infinite lines if that lies inside the rectangle, else it lies on the
// rectangle's rim: one of the four ends against the other segment. Nothing is compared with an
// absolute or angular tolerance: parallel lines have a zero (or, by round-off, useless)
// determinant, and the rim then holds an equally near pair.
// Of equally near pairs (parallel rods side by side) one at an end is returned.
ClosestPoints closest_points(const Segment &i, const Segment &j);

// Where the lines of two segments are nearest to each other: s = (r x v).n / |n|^2 and
// t = (r x u).n / |n|^2 with n = u x v, each times the determinant |n|^2. Written with cross products
// because 1 - (u.v)^2 loses all digits for nearly parallel rods.
struct LinesNearest {
  double s_scaled, t_scaled, determinant;
};
inline LinesNearest nearest_of_lines(const Segment &i, const Segment &j)
{
  const Vec3 between = j.centre - i.centre;
  const Vec3 normal = cross(i.axis, j.axis);
  return {dot(cross(between, j.axis), normal), dot(cross(between, i.axis), normal),
          norm_squared(normal)};
}

// The points at s on i and at t on j, whatever they are.
inline ClosestPoints points_at(const Segment &i, double s, const Segment &j, double t)
{
  // Not at(s) - at(t): far from the origin the difference of the centres comes first.
  const Vec3 delta = (i.centre - j.centre) + s * i.axis - t * j.axis;
  return {s, t, delta, norm_squared(delta)};
}

// Rounding of the critical point's coordinates times the determinant: a few epsilon of a few products
// of unit vectors and |between|. Nearer to the rectangle's rim than this, all four ends are asked.
constexpr double kClosestPointsRounding = 16.0 * 2.3e-16;

// True if the segments are certainly farther apart than `reach`: the distance of the infinite
// lines, |between . n| / |n| with n = u x v, is a lower bound. Cheap; never true for a pair nearer
// than `reach`, and hardly ever for (nearly) parallel ones.
//
// Each component of n is off by up to two epsilon, whatever |n|: for parallel rods that is all there
// is of it, pointing anywhere. With m = 4 epsilon (|between| + reach) the test must not be passed
// before |along| > reach |n| + m, of which 1.01 (reach |n|)^2 + 101 m^2 is an upper bound squared.
inline bool lines_are_apart(const Segment &i, const Segment &j, double reach)
{
  constexpr double kRounding = 202.0 * (4.0 * 2.3e-16) * (4.0 * 2.3e-16);  // 2 x 101 (m/length)^2
  const Vec3 normal = cross(i.axis, j.axis);
  const Vec3 between = j.centre - i.centre;
  const double along = dot(between, normal);
  return along * along > 1.01 * reach * reach * norm_squared(normal) +
                             kRounding * (norm_squared(between) + reach * reach);
}

// Position on the segment nearest to a point, signed distance from the segment's centre.
inline double closest_position(const Segment &segment, const Vec3 &point)
{
  const double along = dot(point - segment.centre, segment.axis);
  return along > segment.half_length    ? segment.half_length
         : along < -segment.half_length ? -segment.half_length
                                        : along;
}

}  // namespace spherocylinder
