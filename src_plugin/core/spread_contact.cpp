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
  if (squared_ratio >= 1.0) return closest;
  const double g = (1.0 - squared_ratio) * (1.0 - squared_ratio);

  const Candidate A = candidate_at(i, a, j, reach);
  const Candidate B = candidate_at(i, b, j, reach);
  const double at_closest = (1.0 - g) * overlap, at_a = 0.5 * g * A.overlap,
               at_b = 0.5 * g * B.overlap;
  const double felt = at_closest + at_a + at_b;
  const double s = (at_closest * closest.s + at_a * A.s + at_b * B.s) / felt;
  const double t = (at_closest * closest.t + at_a * A.t + at_b * B.t) / felt;
  const Vec3 delta = i.at(s) - j.at(t);
  const double distance = norm(delta);
  if (!(felt > 0.0) || !(distance > 0.0)) return closest;
  return {s, t, ((reach - felt) / distance) * delta, (reach - felt) * (reach - felt)};
}

}  // namespace spherocylinder
