// SPDX-License-Identifier: GPL-2.0-or-later
#include "spread_contact.h"

#include <algorithm>

namespace spherocylinder {

namespace {

struct Candidate {
  double s, t;
  double overlap;  // 0 if the rods do not overlap there
};

Candidate candidate_at(const Segment &i, double s, const Segment &j, double reach)
{
  const Vec3 point = i.at(s);
  const double t = closest_position(j, point);
  return {s, t, std::max(0.0, reach - norm(point - j.at(t)))};
}

}  // namespace

ClosestPoints spread_contact(const Segment &i, const Segment &j, double reach,
                             const ClosestPoints &closest)
{
  const double overlap = reach - std::sqrt(closest.distance_squared);
  const double middle = dot(j.centre - i.centre, i.axis);
  const double beside = j.half_length * std::fabs(dot(i.axis, j.axis));
  const double a = std::max(-i.half_length, middle - beside);
  const double b = std::min(i.half_length, middle + beside);
  if (!(a < b) || !(overlap > 0.0)) return closest;  // end to end: nothing to spread over

  const double half = 0.5 * (b - a);
  const double squared_sine = norm_squared(cross(i.axis, j.axis));
  const double squared_ratio = half * half * squared_sine / (2.0 * reach * overlap);
  const double spread = 1.0 / (1.0 + squared_ratio);

  const Candidate A = candidate_at(i, closest.s + spread * (a - closest.s), j, reach);
  const Candidate B = candidate_at(i, closest.s + spread * (b - closest.s), j, reach);
  const double sum = A.overlap + B.overlap;
  if (sum == 0.0) return closest;

  const double weight = A.overlap / sum;
  const double s = weight * A.s + (1.0 - weight) * B.s;
  const double t = weight * A.t + (1.0 - weight) * B.t;
  const Vec3 delta = i.at(s) - j.at(t);
  return {s, t, delta, norm_squared(delta)};
}

}  // namespace spherocylinder
