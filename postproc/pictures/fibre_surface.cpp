// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/fibre_surface.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"
#include "solid/shared_end.h"

namespace spherocylinder {
namespace {

// A ring at least every so many radians of bend.
constexpr double kBendOfAStep = 0.12;
constexpr int kMostHalfSteps = 16;

Vec3 unit(const Vec3 &a) { return (1.0 / norm(a)) * a; }

// Any direction at right angles.
Vec3 across(const Vec3 &along)
{
  const Vec3 side = along.z * along.z < 0.5 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  return unit(cross(along, side));
}

// Turned as little as possible so that it is at right angles to `to`, as it was to `from`.
Vec3 carried(const Vec3 &direction, const Vec3 &from, const Vec3 &to)
{
  const Vec3 axis = cross(from, to);
  const double cosine = dot(from, to);
  if (!(cosine > -1.0 + 1e-12)) return direction;
  const Vec3 turned =
      cosine * direction + cross(axis, direction) + (dot(axis, direction) / (1.0 + cosine)) * axis;
  return unit(turned - dot(turned, to) * to);
}

struct End {
  Vec3 place;
  Vec3 direction;  // of the curve; zero where the fibre ends
};

// Where a segment's part of the curve begins (end 0) or stops (end 1).
End end_of(std::uint32_t rod, int end, const Fibres &fibres, const std::vector<Rod> &rods)
{
  const Segment &segment = rods[rod].capsule.segment;
  const std::int32_t at = fibres.joints_of_rod[rod][end];
  if (at == kNoJoint) return {end == 0 ? tail_of(segment) : head_of(segment), {0.0, 0.0, 0.0}};
  const FibreJoint &joint = fibres.joints[at];
  const Vec3 mean = rods[joint.i].capsule.segment.axis + rods[joint.j].capsule.segment.axis;
  const bool folded = norm(mean) < 1e-6;  // back upon itself
  return {end == 0 ? joint.place - joint.shift : joint.place, folded ? segment.axis : unit(mean)};
}

// The cubic with these ends and directions there; an end without one has no curvature.
class Curve {
 public:
  Curve(const End &begin, const End &stop, const Vec3 &axis) : p_(begin.place), q_(stop.place)
  {
    const Vec3 chord = q_ - p_;
    const double length = norm(chord);
    const bool is_point = !(length > 0.0);
    m_ = length * begin.direction;
    n_ = length * stop.direction;
    const bool free_begin = norm(begin.direction) == 0.0, free_stop = norm(stop.direction) == 0.0;
    if (free_begin && free_stop)
      m_ = n_ = chord;
    else if (free_begin)
      m_ = 1.5 * chord - 0.5 * n_;
    else if (free_stop)
      n_ = 1.5 * chord - 0.5 * m_;
    axis_ = is_point ? axis : unit(chord);
  }

  Vec3 at(double s) const
  {
    const double t = 1.0 - s;
    return t * t * (1.0 + 2.0 * s) * p_ + s * t * t * m_ + s * s * (3.0 - 2.0 * s) * q_ -
           s * s * t * n_;
  }

  Vec3 direction(double s) const
  {
    const double t = 1.0 - s;
    const Vec3 d = 6.0 * s * t * (q_ - p_) + t * (t - 2.0 * s) * m_ + s * (s - 2.0 * t) * n_;
    return norm(d) > 0.0 ? unit(d) : axis_;
  }

 private:
  Vec3 p_, q_, m_, n_, axis_;
};

TubePart part_of(std::uint32_t rod, const Fibres &fibres, const std::vector<Rod> &rods)
{
  const auto joint = [&](int end) {
    const std::int32_t at = fibres.joints_of_rod[rod][end];
    return at == kNoJoint ? nullptr : &fibres.joints[at];
  };
  const auto is_open = [&](const FibreJoint *there) { return !there || norm(there->shift) > 0.0; };
  const FibreJoint *tail = joint(0), *head = joint(1);
  TubePart part{rod, tail ? tail->i : rod, head ? head->j : rod, {}, is_open(tail), is_open(head)};
  const Segment &segment = rods[rod].capsule.segment;
  const Curve curve(end_of(rod, 0, fibres, rods), end_of(rod, 1, fibres, rods), segment.axis);
  const double bend = bend_angle(curve.direction(0.0), curve.direction(0.5)) +
                      bend_angle(curve.direction(0.5), curve.direction(1.0));
  const int half =
      std::clamp(static_cast<int>(std::ceil(0.5 * bend / kBendOfAStep)), 1, kMostHalfSteps);
  for (int k = 0; k <= 2 * half; k++) {
    const double s = 0.5 * k / half;
    part.rings.push_back({curve.at(s), curve.direction(s), {}});
  }
  return part;
}

void turn_about_axis(TubeRing &ring, double angle)
{
  ring.across = std::cos(angle) * ring.across + std::sin(angle) * cross(ring.along, ring.across);
}

}  // namespace

std::vector<TubePart> tube_of(const Fibre &fibre, const Fibres &fibres,
                              const std::vector<Rod> &rods, int corners)
{
  std::vector<TubePart> tube;
  std::size_t count = 0;
  for (const std::uint32_t rod : fibre.segments) {
    tube.push_back(part_of(rod, fibres, rods));
    count += tube.back().rings.size();
  }
  Vec3 along = tube[0].rings[0].along, side = across(along);
  for (TubePart &part : tube)
    for (TubeRing &ring : part.rings) {
      side = carried(side, along, ring.along);
      along = ring.along;
      ring.across = side;
    }
  if (!fibre.is_ring) return tube;
  const TubeRing &first = tube.front().rings.front();
  side = carried(side, along, first.along);
  const double left = std::remainder(
      std::atan2(dot(cross(side, first.across), first.along), dot(side, first.across)),
      2.0 * pi / corners);
  std::size_t k = 0;
  for (TubePart &part : tube)
    for (std::size_t i = 0; i < part.rings.size(); i++, k += i < part.rings.size())
      turn_about_axis(part.rings[i],
                      left * static_cast<double>(k) / static_cast<double>(count - tube.size()));
  return tube;
}

}  // namespace spherocylinder
