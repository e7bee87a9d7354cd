// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/spread_contact.h"

#include <algorithm>

namespace spherocylinder {

namespace {

// Overlap, over the sum of the radii, above which the rule fades, and crossed rods are left to their
// closest point: contacts of hard rods are well below.
constexpr double kDeep = 0.1;

// Distance of the axes, over the sum of the radii, below which they count as meeting: f is below 1e-11
// there, and the direction from axis to axis may be round-off.
constexpr double kMeeting = 1e-6;

// A value and its derivative by what it depends on.
struct Smooth {
  double value, slope;
};

// 0 below x = 0, 1 above x = 1, without a kink.
Smooth smooth_step(double x)
{
  x = std::min(1.0, std::max(0.0, x));
  return {x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)};
}

// 1 up to kDeep, 0 where the axes meet; slope by the depth.
Smooth shallowness(double depth)
{
  const Smooth step = smooth_step((1.0 - depth) / (1.0 - kDeep));
  return {step.value, -step.slope / (1.0 - kDeep)};
}

// The part of a segment that lies beside another one, as positions on its axis.
struct Range {
  double low, high;
  bool own_low, own_high;  // the segment's own end, not where the other one's ends

  double half() const { return 0.5 * (high - low); }
};

Range beside(const Segment &segment, const Segment &other, double abs_cosine)
{
  const double h = segment.half_length;
  const double middle = dot(other.centre - segment.centre, segment.axis);
  const double reach = other.half_length * abs_cosine;
  const double low = middle - reach, high = middle + reach;
  return {std::max(-h, low), std::min(h, high), low <= -h, high >= h};
}

// Where and how the energy pushes rod i, over the stiffness; the energy's derivatives are gathered
// one after the other.
class Push {
 public:
  Push(const Segment &i, const Segment &j, double reach) : i_(i), j_(j), reach_(reach) {}

  struct Gap {
    Vec3 normal;     // towards i
    double overlap;  // >= 0
  };
  Gap gap(double s, double t) const
  {
    const Vec3 delta = between(s, t);
    const double distance = norm(delta);
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    return {inverse * delta, std::max(0.0, reach_ - distance)};
  }

  // By the overlap between the points s and t.
  void add_spring(double by_overlap, double s, double t, const Vec3 &normal)
  {
    const Vec3 force = by_overlap * normal;
    force_ = force_ + force;
    torque_ = torque_ + cross(s * i_.axis, force);
    weight_ += by_overlap;
    s_ += by_overlap * s;
    t_ += by_overlap * t;
  }

  // By the middle of the part of i beside j, (x_j - x_i).u: it moves with i's centre and turns with
  // i's axis. Of j, (x_i - x_j).v, with i's centre only.
  void add_middle_on_i(double by_middle)
  {
    force_ = force_ + by_middle * i_.axis;
    torque_ = torque_ - by_middle * cross(i_.axis, j_.centre - i_.centre);
  }
  void add_middle_on_j(double by_middle) { force_ = force_ - by_middle * j_.axis; }

  // By u.v, which changes by u x v as i turns.
  void add_cosine(double by_cosine) { torque_ = torque_ - by_cosine * cross(i_.axis, j_.axis); }

  // Makes of the closest point's contact the one that it all comes to.
  void resultant(RodContact &result) const
  {
    if (!(weight_ > 0.0)) return;
    const double plain_overlap = result.overlap;
    const double s = s_ / weight_, t = t_ / weight_;
    const Vec3 delta = between(s, t);
    const double distance_squared = norm_squared(delta);
    if (distance_squared == 0.0) return;
    const Vec3 normal = (1.0 / std::sqrt(distance_squared)) * delta;
    const double overlap = dot(force_, normal);
    if (!(overlap > 0.0)) return;
    const Vec3 torque_on_j = -torque_ - cross(i_.centre - j_.centre, force_);  // no moment in all
    result.points = {s, t, delta, distance_squared};
    result.overlap = overlap;
    result.share = overlap / plain_overlap;
    result.sideways = force_ - overlap * normal;
    result.couple_i = torque_ - cross(s * i_.axis, force_);
    result.couple_j = torque_on_j + cross(t * j_.axis, force_);
  }

 private:
  const Segment &i_, &j_;
  double reach_;
  Vec3 force_{0.0, 0.0, 0.0}, torque_{0.0, 0.0, 0.0};  // torque about i's centre
  double weight_ = 0.0, s_ = 0.0, t_ = 0.0;

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
  if (reach - overlap < kMeeting * reach) return {closest, overlap};

  const double squared_sine = norm_squared(cross(i.axis, j.axis));
  // q^2 = lengths sin^2 (1 + deep^2)/overlap.
  const double shorter = std::min(i.half_length, j.half_length);
  const double lengths = shorter * shorter / (2.0 * reach);
  const double deep = overlap / (kDeep * reach);
  const double by_sine = lengths * (1.0 + deep * deep) / overlap;
  const double squared_ratio = by_sine * squared_sine;
  if (squared_ratio >= 1.0) return {closest, overlap};

  const double H_i = on_i.half(), H_j = on_j.half();
  const bool less_on_i = H_i < H_j;
  const double ratio = less_on_i ? H_i / H_j : H_j / H_i;
  const Smooth m = smooth_step(ratio), f = shallowness(overlap / reach);
  const double clear = 1.0 - squared_ratio;
  const double g = clear * clear * m.value * f.value;

  // The half springs, a quarter on each rod; `squares`: (overlap_A^2 + overlap_B^2)/2. An end that is
  // where the other rod's ends moves along the axis: by_low and by_high are the derivatives by that.
  Push push(i, j, reach);
  double squares = 0.0;
  struct ByEnds {
    double low, high;
  };
  const auto add_end = [&](double s, double t, bool moves_on_i) {
    const Push::Gap gap = push.gap(s, t);
    const double spring = 0.25 * g * gap.overlap;
    push.add_spring(spring, s, t, gap.normal);
    squares += 0.25 * gap.overlap * gap.overlap;
    return moves_on_i ? -spring * dot(gap.normal, i.axis) : spring * dot(gap.normal, j.axis);
  };
  const auto add_end_on_i = [&](double s) {
    return add_end(s, closest_position(j, i.at(s)), true);
  };
  const auto add_end_on_j = [&](double t) {
    return add_end(closest_position(i, j.at(t)), t, false);
  };
  ByEnds by_i = {add_end_on_i(on_i.low), add_end_on_i(on_i.high)};
  ByEnds by_j = {add_end_on_j(on_j.low), add_end_on_j(on_j.high)};

  const double by_g = 0.5 * (squares - overlap * overlap);
  const double by_q2 = by_g * -2.0 * clear * m.value * f.value;
  const double by_m = by_g * clear * clear * f.value;
  const double by_f = by_g * clear * clear * m.value;
  const double q2_by_overlap = lengths * squared_sine * (deep * deep - 1.0) / (overlap * overlap);
  const double distance = reach - overlap;
  const double by_overlap = (1.0 - g) * overlap + by_q2 * q2_by_overlap + by_f * f.slope / reach;
  push.add_spring(by_overlap, closest.s, closest.t,
                  distance > 0.0 ? (1.0 / distance) * closest.delta : Vec3{0.0, 0.0, 0.0});

  // m by the two halves, each half of high - low.
  const double by_ratio = by_m * m.slope;
  const double by_less = by_ratio / std::max(H_i, H_j), by_more = -ratio * by_less;
  const double half_i = 0.5 * (less_on_i ? by_less : by_more);
  const double half_j = 0.5 * (less_on_i ? by_more : by_less);
  by_i.low -= half_i;
  by_i.high += half_i;
  by_j.low -= half_j;
  by_j.high += half_j;
  double by_cosine = 0.0;  // of |u.v|
  const auto ends_move = [&by_cosine](const Range &range, const ByEnds &by, double other_half) {
    const double low = range.own_low ? 0.0 : by.low, high = range.own_high ? 0.0 : by.high;
    by_cosine += other_half * (high - low);
    return low + high;
  };
  push.add_middle_on_i(ends_move(on_i, by_i, j.half_length));
  push.add_middle_on_j(ends_move(on_j, by_j, i.half_length));
  // sin^2 = 1 - (u.v)^2
  push.add_cosine((cosine < 0.0 ? -by_cosine : by_cosine) - 2.0 * cosine * by_q2 * by_sine);

  RodContact contact{closest, overlap};
  push.resultant(contact);
  return contact;
}

RodContact swapped(const RodContact &contact)
{
  const ClosestPoints &points = contact.points;
  return {{points.t, points.s, -points.delta, points.distance_squared},
          contact.overlap,
          contact.share,
          -contact.sideways,
          contact.couple_j,
          contact.couple_i};
}

}  // namespace spherocylinder
