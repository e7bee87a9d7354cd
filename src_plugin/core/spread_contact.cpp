// SPDX-License-Identifier: GPL-2.0-or-later
#include "spread_contact.h"

#include <algorithm>

namespace spherocylinder {

namespace {

// Overlap, over the sum of the radii, above which the rule fades, and crossed rods are left to their
// closest point, whose force has an energy: contacts of hard rods are well below.
constexpr double kDeep = 0.1;

// 1 up to kDeep, 0 where the axes meet, smooth between.
double shallowness(double depth)
{
  const double x = std::min(1.0, std::max(0.0, (1.0 - depth) / (1.0 - kDeep)));
  return x * x * (3.0 - 2.0 * x);
}

// The part of a segment that lies beside another one, as positions on its axis.
struct Range {
  double low, high;

  double half() const { return 0.5 * (high - low); }
};

Range beside(const Segment &segment, const Segment &other, double abs_cosine)
{
  const double middle = dot(other.centre - segment.centre, segment.axis);
  const double reach = other.half_length * abs_cosine;
  return {std::max(-segment.half_length, middle - reach),
          std::min(segment.half_length, middle + reach)};
}

// Resultant of the forces at several points of the two axes.
struct Resultant {
  double overlap = 0.0, s = 0.0, t = 0.0;  // s, t: times their overlap until divided

  void add(double part, double at_s, double at_t)
  {
    overlap += part;
    s += part * at_s;
    t += part * at_t;
  }
};

double overlap_at(const Segment &i, double s, const Segment &j, double t, double reach)
{
  return std::max(0.0, reach - norm((i.centre - j.centre) + s * i.axis - t * j.axis));
}

}  // namespace

RodContact spread_contact(const Segment &i, const Segment &j, double reach,
                          const ClosestPoints &closest)
{
  const double overlap = reach - std::sqrt(closest.distance_squared);
  const Range on_i = beside(i, j, std::fabs(dot(i.axis, j.axis)));
  const Range on_j = beside(j, i, std::fabs(dot(i.axis, j.axis)));
  // The first two: end to end, there is nothing to spread over.
  if (!(on_i.low < on_i.high) || !(on_j.low < on_j.high) || !(overlap > 0.0))
    return {closest, overlap};

  const double squared_sine = norm_squared(cross(i.axis, j.axis));
  const double depth = overlap / reach, deep = depth / kDeep;
  const double squared_ratio = on_i.half() * on_j.half() * squared_sine * (1.0 + deep * deep) /
                               (2.0 * reach * overlap);
  if (squared_ratio >= 1.0) return {closest, overlap};
  const double opening =
      std::min(on_i.half(), on_j.half()) / std::max(on_i.half(), on_j.half());
  const double share = (1.0 - squared_ratio) * (1.0 - squared_ratio) * opening * shallowness(depth);

  Resultant sum;
  sum.add((1.0 - share) * overlap, closest.s, closest.t);
  for (const double s : {on_i.low, on_i.high}) {
    const double t = closest_position(j, i.at(s));
    sum.add(0.25 * share * overlap_at(i, s, j, t, reach), s, t);
  }
  for (const double t : {on_j.low, on_j.high}) {
    const double s = closest_position(i, j.at(t));
    sum.add(0.25 * share * overlap_at(i, s, j, t, reach), s, t);
  }
  if (!(sum.overlap > 0.0)) return {closest, overlap};

  const double s = sum.s / sum.overlap, t = sum.t / sum.overlap;
  const Vec3 delta = (i.centre - j.centre) + s * i.axis - t * j.axis;
  const double distance_squared = norm_squared(delta);
  if (distance_squared == 0.0) return {closest, overlap};
  return {{s, t, delta, distance_squared}, sum.overlap, sum.overlap / overlap};
}

}  // namespace spherocylinder
