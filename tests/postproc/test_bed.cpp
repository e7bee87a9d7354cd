// SPDX-License-Identifier: GPL-2.0-or-later
#include "test_bed.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "core/closest_points.h"
#include "core/rotation.h"

namespace spherocylinder {
namespace {

Vec3 random_direction(std::mt19937 &random, double flatness)
{
  std::normal_distribution<double> normal;
  Vec3 u{normal(random), normal(random), normal(random) / flatness};
  return (1.0 / norm(u)) * u;
}

bool inside_vessel(const Capsule &rod, double vessel_radius)
{
  for (const double s : {-rod.segment.half_length, rod.segment.half_length}) {
    const Vec3 end = rod.segment.at(s);
    if (std::hypot(end.x, end.y) + rod.radius > vessel_radius || end.z < rod.radius) return false;
  }
  return true;
}

bool overlap(const Capsule &a, const Capsule &b)
{
  const double reach = a.radius + b.radius;
  return closest_points(a.segment, b.segment).distance_squared < reach * reach;
}

}  // namespace

std::vector<Rod> random_bed(const BedOptions &o)
{
  constexpr int kMostTriesPerRod = 3000;
  std::mt19937 random(o.seed);
  std::uniform_real_distribution<double> across(-o.vessel_radius, o.vessel_radius);
  std::uniform_real_distribution<double> up(0.0, o.height);
  std::vector<Rod> rods;
  std::size_t tries = kMostTriesPerRod * o.rods;
  while (rods.size() < o.rods && tries-- > 0) {
    const Capsule rod{{{across(random), across(random), up(random)},
                       random_direction(random, o.flatness),
                       0.5 * (o.length - o.diameter)},
                      0.5 * o.diameter};
    if (!inside_vessel(rod, o.vessel_radius)) continue;
    if (std::none_of(rods.begin(), rods.end(),
                     [&](const Rod &other) { return overlap(rod, other.capsule); }))
      rods.push_back({static_cast<std::int64_t>(rods.size()) + 1, 1, rod});
  }
  return rods;
}

std::string dump_text(const std::vector<Rod> &rods, std::int64_t step)
{
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 "
      "11\nITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz shapex shapey shapez quat1 "
      "quat2 quat3 quat4 c_contacts \n",
      step, rods.size());
  for (const Rod &rod : rods) {
    const Segment &s = rod.capsule.segment;
    const double r = rod.capsule.radius;
    const Quaternion q = orientation_of(s.axis);
    const double wobble = 0.01 * static_cast<double>(rod.id % 7);
    text += fmt::format(
        "{} {} {:g} {:g} {:g} {:g} 0 {:g} 0 {:g} 0 {:g} {:g} {:g} {:g} {:g} {:g} {:g} {} \n",
        rod.id, rod.type, s.centre.x, s.centre.y, s.centre.z, wobble, -wobble, 10.0 * wobble, r, r,
        r + s.half_length, q.w, q.x, q.y, q.z, rod.id % 9);
  }
  return text;
}

std::vector<Vec3> random_directions(std::size_t count, std::mt19937 &random)
{
  std::normal_distribution<double> normal;
  std::vector<Vec3> axes;
  for (std::size_t i = 0; i < count; i++) {
    const Vec3 u{normal(random), normal(random), normal(random)};
    axes.push_back((1.0 / norm(u)) * u);
  }
  return axes;
}

std::vector<Vec3> even_directions(std::size_t count)
{
  const double golden_angle = std::acos(-1.0) * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < count; i++) {
    const double z = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double across = std::sqrt(1.0 - z * z);
    const double turn = golden_angle * static_cast<double>(i);
    directions.push_back({across * std::cos(turn), across * std::sin(turn), z});
  }
  return directions;
}

}  // namespace spherocylinder
