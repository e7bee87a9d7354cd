// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/rod_gas.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include <fmt/format.h>

#include "core/closest_points.h"
#include "core/mass_properties.h"
#include "core/numbers.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

class Random {
 public:
  explicit Random(unsigned long seed) : bits_(seed) {}

  double uniform() { return std::uniform_real_distribution<double>()(bits_); }
  double normal() { return std::normal_distribution<double>()(bits_); }
  Vec3 uniform_vector()
  {
    const double x = uniform(), y = uniform();
    return {x, y, uniform()};
  }
  Vec3 normal_vector()
  {
    const double x = normal(), y = normal();
    return {x, y, normal()};
  }

  // With alignment 0 every direction is as likely. Else Onsager's distribution of a nematic along
  // z, f(theta) ~ cosh(alignment cos theta), drawn from the inverse of its integral (either sense
  // of the axis is the same rod).
  Vec3 direction(double alignment)
  {
    const double u = uniform(), turn = 2.0 * pi * uniform();
    const double z = alignment == 0.0
                         ? u
                         : 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * alignment)) / alignment;
    const double side = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {side * std::cos(turn), side * std::sin(turn), z};
  }

  template <class Values>
  void shuffle(Values &values)
  {
    std::shuffle(values.begin(), values.end(), bits_);
  }

 private:
  std::mt19937_64 bits_;
};

// Points one diameter apart along each axis, in cells two diameters wide. If the axes of two rods
// are nearer than a diameter, two of their points, each at most half a diameter from a closest
// point, are nearer than two: in the same cell or in neighbours.
class Cube {
 public:
  Cube(double side, double diameter)
      : side_(side),
        diameter_(diameter),
        cells_(std::clamp(static_cast<int>(side / (2.0 * diameter)), 3, kMostCells)),
        points_(static_cast<std::size_t>(cells_) * cells_ * cells_)
  {
  }

  // Adds the rod if it touches no other, nor an image of one.
  bool add(const Segment &rod)
  {
    const int last = static_cast<int>(std::ceil(2.0 * rod.half_length / diameter_));
    const auto point = [&](int k) {
      const double along = last == 0 ? 0.0 : rod.half_length * (2.0 * k / last - 1.0);
      return rod.at(along);
    };
    for (int k = 0; k <= last; k++)
      if (touches(rod, point(k))) return false;
    for (int k = 0; k <= last; k++) {
      const Vec3 p = point(k);
      points_[cell(index(p.x), index(p.y), index(p.z))].push_back({rods.size(), p});
    }
    rods.push_back(rod);
    return true;
  }

  std::vector<Segment> rods;

 private:
  struct Point {
    std::size_t rod;
    Vec3 position;
  };
  static constexpr int kMostCells = 300;  // a direction, of which a thin gas needs no more
  double side_, diameter_;
  int cells_;
  std::vector<std::vector<Point>> points_;

  int index(double x) const { return static_cast<int>(std::floor(x / side_ * cells_)); }
  std::size_t cell(int i, int j, int k) const
  {
    const auto wrap = [this](int n) {
      return static_cast<std::size_t>((n % cells_ + cells_) % cells_);
    };
    return (wrap(i) * cells_ + wrap(j)) * cells_ + wrap(k);
  }
  double image(double d) const { return side_ * std::round(d / side_); }

  bool touches(const Segment &rod, const Vec3 &p) const
  {
    const int i = index(p.x), j = index(p.y), k = index(p.z);
    for (int a = i - 1; a <= i + 1; a++)
      for (int b = j - 1; b <= j + 1; b++)
        for (int c = k - 1; c <= k + 1; c++)
          for (const Point &near : points_[cell(a, b, c)]) {
            const Vec3 d = p - near.position;
            Segment other = rods[near.rod];
            other.centre = other.centre + Vec3{image(d.x), image(d.y), image(d.z)};
            if (closest_points(rod, other).distance_squared < diameter_ * diameter_) return true;
          }
    return false;
  }
};

}  // namespace

RodGas rod_gas(const RodGasOptions &o)
{
  Random random(o.seed);
  const double length = o.lambda * o.diameter;
  const double volume = mass_properties(o.diameter, length, 1.0).volume;
  RodGas gas{std::cbrt(static_cast<double>(o.rods) * volume / o.solid), {}, {}};
  // A rod that meets its own image would have to be put into less room than it takes.
  if (gas.side < length + o.diameter)
    throw InputError(fmt::format(
        "{} rods of aspect ratio {} at a solid fraction of {} make a cube of side {:.4g} m, wanted "
        "more than a rod and a diameter, {:.4g} m: more rods",
        o.rods, o.lambda, o.solid, gas.side, length + o.diameter));
  // Above lambda x solid fraction = 3.34 thin rods at random directions are not the state of
  // equilibrium, and soon there is no room for them: 18.58 is the alignment of the nematic phase
  // where it begins (Onsager 1949, Ann. N. Y. Acad. Sci. 51, 627).
  const double alignment = o.lambda * o.solid > 3.34 ? 18.58 : 0.0;
  constexpr long kMostTrials = 100'000'000;
  Cube cube(gas.side, o.diameter);
  for (long trial = 0; cube.rods.size() < o.rods; trial++) {
    if (trial == kMostTrials)
      throw InputError(fmt::format("there is no room for more than {} of {} rods, wanted a lower "
                                   "solid fraction than {}",
                                   cube.rods.size(), o.rods, o.solid));
    const Vec3 place = gas.side * random.uniform_vector();
    cube.add({place, random.direction(alignment), 0.5 * (length - o.diameter)});
  }

  for (int a = 0; a < o.copies[0]; a++)
    for (int b = 0; b < o.copies[1]; b++)
      for (int c = 0; c < o.copies[2]; c++)
        for (Segment rod : cube.rods) {
          rod.centre = rod.centre + gas.side * Vec3{double(a), double(b), double(c)};
          if (o.floor) rod.centre.z += 0.5 * length;
          gas.rods.push_back({rod, {}, {}});
        }
  random.shuffle(gas.rods);
  // A thin rod has as much energy in each direction of turning as of travelling at
  // omega = v sqrt(12)/length.
  const double turn = o.speed * std::sqrt(12.0) / length;
  for (GasRod &rod : gas.rods) {
    const Vec3 omega = turn * random.normal_vector(), &u = rod.segment.axis;
    rod.omega = omega - dot(omega, u) * u;
    rod.velocity = o.speed * random.normal_vector();
  }
  for (int d = 0; d < 3; d++)
    gas.box[d] = o.copies[d] * gas.side + (d == 2 && o.floor ? length : 0.0);
  return gas;
}

namespace {

// The rods, or the segments of each one after the other.
std::vector<GasRod> segments_of(const RodGasOptions &o, const std::vector<GasRod> &rods)
{
  if (o.segments == 1) return rods;
  std::vector<GasRod> segments;
  for (const GasRod &rod : rods) {
    const double half = rod.segment.half_length / o.segments;
    for (int k = 0; k < o.segments; k++) {
      const Vec3 arm = (half * (2 * k + 1 - o.segments)) * rod.segment.axis;
      segments.push_back({{rod.segment.centre + arm, rod.segment.axis, half},
                          rod.velocity + cross(rod.omega, arm),
                          rod.omega});
    }
  }
  return segments;
}

}  // namespace

std::string gas_data_file(const RodGasOptions &o, const RodGas &gas)
{
  const double radii_apart = 2.0 * (o.lambda - 1.0) / o.segments;
  if (o.segments > 1 && !(radii_apart >= 1.0))
    throw InputError(fmt::format("{} segments of a rod of aspect ratio {} have joints {:.3g} radii "
                                 "apart, wanted at least 1",
                                 o.segments, o.lambda, radii_apart));
  const std::vector<GasRod> segments = segments_of(o, gas.rods);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "Rods of aspect ratio {} at random, {} of the volume\n\n{} atoms\n1 atom types\n",
                 o.lambda, o.solid, segments.size());
  if (o.segments > 1) fmt::format_to(out, "{} segments\n", segments.size());
  fmt::format_to(out, "\n");
  for (int d = 0; d < 3; d++)
    fmt::format_to(out, "0 {:.17g} {}lo {}hi\n", gas.box[d], "xyz"[d], "xyz"[d]);
  const auto put = [&](const Vec3 &a) {
    fmt::format_to(out, " {:.17g} {:.17g} {:.17g}", a.x, a.y, a.z);
  };
  const double length = o.diameter * (1.0 + (o.lambda - 1.0) / o.segments);
  fmt::format_to(out, "\nAtoms\n");
  std::size_t id = 0;
  for (const GasRod &rod : segments) {
    fmt::format_to(out, "\n{} 1 {} {} {}", ++id, o.diameter,
                   o.segments == 1 ? o.lambda * o.diameter : length, o.density);
    put(rod.segment.centre);
    put(rod.segment.axis);
  }
  fmt::format_to(out, "\n\nVelocities\n");
  id = 0;
  for (const GasRod &rod : segments) {
    fmt::format_to(out, "\n{}", ++id);
    put(rod.velocity);
    put(rod.omega);
  }
  if (o.segments > 1) {
    const auto n = static_cast<std::size_t>(o.segments);
    fmt::format_to(out, "\n\nFibres\n");
    for (std::size_t k = 0; k < segments.size(); k++)
      fmt::format_to(out, "\n{} {} {}", k + 1, k / n + 1, k % n + 1);
  }
  fmt::format_to(out, "\n");
  return fmt::to_string(text);
}

}  // namespace spherocylinder
