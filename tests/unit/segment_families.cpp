// SPDX-License-Identifier: GPL-2.0-or-later
#include "segment_families.h"

#include <ostream>

using namespace spherocylinder;

namespace {

// Half the cylinder part of a rod of 1 to 1000 diameters.
double half_length(RandomRods &random, double diameter)
{
  return 0.5 * diameter * random.log_uniform(1.0, 1000.0);
}

Segment random_segment(RandomRods &random, double diameter)
{
  return {random.vector(3.0 * diameter), random.direction(), half_length(random, diameter)};
}

// j with its point at t beside i's point at s, `gap` away along `normal`.
Segment placed(const Segment &i, double s, const Vec3 &normal, double gap, const Vec3 &axis,
               double half_length, double t)
{
  return {i.at(s) + gap * normal - t * axis, axis, half_length};
}

// A position on a segment, now and then past its ends.
double position(RandomRods &random, double half_length)
{
  return half_length * random.uniform(-1.3, 1.3);
}

Pair any_pose(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  return {i,
          placed(i, position(random, i.half_length), random.direction(),
                 d * random.log_uniform(1e-3, 3.0), random.direction(), hj, position(random, hj))};
}

Pair parallel_side_by_side(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along = random.uniform(-1.0, 1.0) * (i.half_length + hj);
  return {i, placed(i, along, random.across(i.axis), d * random.uniform(0.0, 2.0),
                    random.sign() * i.axis, hj, 0.0)};
}

// Beyond each other's ends, or end beside end to round-off.
Pair parallel_offset(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along =
      random.sign() * (i.half_length + hj + (random.below(2) ? d * random.uniform(0.0, 2.0) : 0.0));
  return {i, placed(i, along, random.across(i.axis), d * random.uniform(0.0, 2.0),
                    random.sign() * i.axis, hj, 0.0)};
}

Pair coaxial(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double along = random.uniform(-2.0, 2.0) * (i.half_length + hj);
  return {i, placed(i, along, i.axis, 0.0, random.sign() * i.axis, hj, 0.0)};
}

// Axes that meet, or miss each other by next to nothing.
Pair crossing(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const Vec3 axis = random.direction();
  const double hj = half_length(random, d);
  const double gap = random.below(2) ? 0.0 : d * random.log_uniform(1e-16, 1e-3);
  return {i, placed(i, i.half_length * random.uniform(-1.0, 1.0),
                    RandomRods::unit(cross(i.axis, axis)), gap, axis, hj,
                    hj * random.uniform(-1.0, 1.0))};
}

// An end of j before i's side, end or corner, square on or not.
Pair end_on(RandomRods &random, double d)
{
  const Segment i = random_segment(random, d);
  const double hj = half_length(random, d);
  const double positions[] = {i.half_length, -i.half_length, 0.0, position(random, i.half_length)};
  const Vec3 side = random.across(i.axis);
  const Vec3 axis = random.below(2) ? side : random.direction();
  const double gap = d * random.log_uniform(1e-3, 2.0);
  return {i, placed(i, positions[random.below(4)], side, gap, axis, hj, -hj)};
}

Pair one_sphere(RandomRods &random, double d)
{
  Pair pair = any_pose(random, d);
  (random.below(2) ? pair.i : pair.j).half_length = 0.0;
  return pair;
}

Pair nearly_parallel_at(RandomRods &random, double d, double angle)
{
  const Segment i = random_segment(random, d);
  const Vec3 side = random.across(i.axis);
  const Vec3 axis = RandomRods::unit(i.axis + angle * side);
  const double hj = half_length(random, d);
  const double gap = d * (random.below(4) ? random.log_uniform(1e-6, 3.0) : 0.0);
  return {i, placed(i, position(random, i.half_length), RandomRods::unit(cross(i.axis, side)), gap,
                    random.sign() * axis, hj, position(random, hj))};
}

Pair nearly_parallel(RandomRods &random, double d)
{
  return nearly_parallel_at(random, d, random.log_uniform(1e-12, 1e-3));
}

// The angle drowns in the round-off of the axes, in part or wholly.
Pair parallel_to_round_off(RandomRods &random, double d)
{
  return nearly_parallel_at(random, d, random.log_uniform(1e-18, 1e-12));
}

Pair unequal_lengths(RandomRods &random, double d)
{
  Segment i = random_segment(random, d);
  i.half_length = 500.0 * d;
  const double hj = 0.5 * d;
  const Vec3 axis =
      random.below(2)
          ? random.direction()
          : RandomRods::unit(i.axis + random.log_uniform(1e-12, 1e-3) * random.direction());
  return {i, placed(i, position(random, i.half_length), random.direction(),
                    d * random.log_uniform(1e-3, 3.0), axis, hj, position(random, hj))};
}

// Whole coordinates and axes along the coordinate axes: ties everywhere, all sums exact.
Pair lattice(RandomRods &random, double d)
{
  const auto coordinate = [&] { return d * (random.below(9) - 4); };
  const auto segment = [&]() -> Segment {
    const Vec3 axes[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    return {{coordinate(), coordinate(), coordinate()},
            random.sign() * axes[random.below(3)],
            d * random.below(5)};
  };
  return {segment(), segment()};
}

// A scene a thousand rod lengths or more away from the origin.
Pair far_from_origin(RandomRods &random, double d)
{
  Pair pair = any_pose(random, d);
  const Vec3 away = (1e6 * d) * random.direction();
  pair.i.centre = pair.i.centre + away;
  pair.j.centre = pair.j.centre + away;
  return pair;
}

}  // namespace

double scale_of(const Pair &pair)
{
  return norm(pair.i.centre) + norm(pair.j.centre) + pair.i.half_length + pair.j.half_length;
}

void PrintTo(const Family &family, std::ostream *out) { *out << family.name; }

const std::vector<Family> &families()
{
  static const std::vector<Family> all = {
      {"any_pose", any_pose},
      {"parallel_side_by_side", parallel_side_by_side},
      {"parallel_offset", parallel_offset},
      {"coaxial", coaxial},
      {"crossing", crossing},
      {"end_on", end_on},
      {"one_sphere", one_sphere},
      {"nearly_parallel", nearly_parallel},
      {"parallel_to_round_off", parallel_to_round_off},
      {"unequal_lengths", unequal_lengths},
      {"lattice", lattice},
      {"far_from_origin", far_from_origin},
  };
  return all;
}

SizedPair any_size(const Family &family, RandomRods &random)
{
  const double diameter = random.log_uniform(1e-6, 1e3);
  return {diameter, family.make(random, diameter)};
}
