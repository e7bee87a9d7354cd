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

// Forces at several points of the two axes, over the stiffness.
class Forces {
 public:
  Forces(const Segment &i, const Segment &j, double reach) : i_(i), j_(j), reach_(reach) {}

  // Between the points s and t.
  void add(double overlap, double s, double t)
  {
    const Vec3 delta = between(s, t);
    const double distance = norm(delta);
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    // Midway between the points, from the centre of i.
    forces_[count_++] = {overlap, s * i_.axis - 0.5 * delta, inverse * delta};
    overlap_ += overlap;
    s_ += overlap * s;
    t_ += overlap * t;
  }
  double overlap_at(double s, double t) const
  {
    return std::max(0.0, reach_ - norm(between(s, t)));
  }

  // The one contact they come to.
  double overlap() const { return overlap_; }
  ClosestPoints points() const
  {
    const double s = s_ / overlap_, t = t_ / overlap_;
    const Vec3 delta = between(s, t);
    return {s, t, delta, norm_squared(delta)};
  }
  // What turns i beside it: each force has its own direction.
  Vec3 couple(const ClosestPoints &points) const
  {
    const Vec3 contact = points.s * i_.axis - 0.5 * points.delta;
    Vec3 sum = {0.0, 0.0, 0.0};
    for (int k = 0; k < count_; k++)
      sum = sum + cross(forces_[k].at - contact, forces_[k].overlap * forces_[k].normal);
    return sum;
  }

 private:
  struct Force {
    double overlap;
    Vec3 at, normal;
  };
  const Segment &i_, &j_;
  double reach_;
  Force forces_[5];
  int count_ = 0;
  double overlap_ = 0.0, s_ = 0.0, t_ = 0.0;

  Vec3 between(double s, double t) const
  {
    return (i_.centre - j_.centre) + s * i_.axis - t * j_.axis;
  }
};

}  // namespace

RodContact spread_contact(const Segment &i, const Segment &j, double reach,
                          const ClosestPoints &closest)
{
  const double overlap = reach - std::sqrt(closest.distance_squared);
  const double cosine = dot(i.axis, j.axis);
  const Range on_i = beside(i, j, std::fabs(cosine)), on_j = beside(j, i, std::fabs(cosine));
  // The first two: end to end, there is nothing to spread over.
  if (!(on_i.low < on_i.high) || !(on_j.low < on_j.high) || !(overlap > 0.0))
    return {closest, overlap};

  const double squared_sine = norm_squared(cross(i.axis, j.axis));
  // q^2 = lengths sin^2 (1 + deep^2)/overlap.
  const double shorter = std::min(i.half_length, j.half_length);
  const double lengths = shorter * shorter / (2.0 * reach);
  const double deep = overlap / (kDeep * reach);
  const double by_sine = lengths * (1.0 + deep * deep) / overlap;
  const double squared_ratio = by_sine * squared_sine;
  if (squared_ratio >= 1.0) return {closest, overlap};
  const double fade = shallowness(overlap / reach) * std::min(on_i.half(), on_j.half()) /
                      std::max(on_i.half(), on_j.half());
  const double clear = 1.0 - squared_ratio;
  const double g = clear * clear * fade;

  // The half springs, a quarter on each rod, and the sum of their squares (overlap_A^2 +
  // overlap_B^2)/2.
  Forces forces(i, j, reach);
  double squares = 0.0;
  const auto add_end = [&](double s, double t) {
    const double at_end = forces.overlap_at(s, t);
    forces.add(0.25 * g * at_end, s, t);
    squares += 0.25 * at_end * at_end;
  };
  for (const double s : {on_i.low, on_i.high}) add_end(s, closest_position(j, i.at(s)));
  for (const double t : {on_j.low, on_j.high}) add_end(closest_position(i, j.at(t)), t);

  const double by_g = 0.5 * (squares - overlap * overlap);  // dE/dg, per stiffness
  const double by_q2 = by_g * -2.0 * clear * fade;          // dE/d(q^2)
  const double q2_by_overlap = lengths * squared_sine * (deep * deep - 1.0) / (overlap * overlap);
  forces.add((1.0 - g) * overlap + by_q2 * q2_by_overlap, closest.s, closest.t);
  if (!(forces.overlap() > 0.0)) return {closest, overlap};

  const ClosestPoints points = forces.points();
  if (points.distance_squared == 0.0) return {closest, overlap};
  // sin^2 = |u x v|^2 changes by -2 (u.v)(u x v) as i turns, by the opposite as j turns.
  const Vec3 couple =
      forces.couple(points) + (2.0 * by_q2 * by_sine * cosine) * cross(i.axis, j.axis);
  return {points, forces.overlap(), forces.overlap() / overlap, couple};
}

}  // namespace spherocylinder
