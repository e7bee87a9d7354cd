// SPDX-License-Identifier: GPL-2.0-or-later
// Writes a data file for read_data: a periodic box of rods at random, clear of each other, with
// random velocities.
//   place_rods LAMBDA SOLID_FRACTION RODS COPIES_X COPIES_Y COPIES_Z [floor] > gas.data
// RODS rods are placed in a cube one after the other (random sequential addition: a trial that
// touches a rod already there is thrown away). The box is that cube repeated; each copy has its own
// velocities. Large and small gases so have the same surroundings a rod, and cost a rod can be
// compared. With "floor" the box is not periodic in z: it is a rod's length higher, and all rods are
// above z = 0. Rods are numbered at random, as an insertion would leave them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "core/closest_points.h"

using spherocylinder::Segment;
using spherocylinder::Vec3;

namespace {

constexpr double kDiameter = 0.01;        // unit: m; that of input/in.rods
constexpr double kDensity = 2700.0;       // unit: kg/m^3
constexpr double kSpeed = 0.5;            // unit: m/s, standard deviation of each component
constexpr double kPi = 3.14159265358979323846;

std::mt19937_64 random_bits(86028121);
double uniform() { return std::uniform_real_distribution<double>()(random_bits); }
double normal() { return std::normal_distribution<double>()(random_bits); }

// With alignment 0 every direction is as likely. Else Onsager's distribution of a nematic along z,
// f(theta) ~ cosh(alignment cos theta), drawn from the inverse of its integral (either sense of the
// axis is the same rod).
Vec3 random_direction(double alignment)
{
  const double u = uniform(), turn = 2.0 * kPi * uniform();
  const double z =
      alignment == 0.0 ? u : 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * alignment)) / alignment;
  const double side = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {side * std::cos(turn), side * std::sin(turn), z};
}

// Points one diameter apart along each axis, in cells two diameters wide. If the axes of two rods
// are nearer than a diameter, two of their points, each at most half a diameter from a closest point,
// are nearer than two: in the same cell or in neighbours.
class Cube {
 public:
  Cube(double side)
      : side_(side), cells_(std::max(3, static_cast<int>(side / (2.0 * kDiameter)))),
        points_(static_cast<std::size_t>(cells_) * cells_ * cells_)
  {
  }

  // Adds the rod if it touches no other, nor an image of one.
  bool add(const Segment &rod)
  {
    const int last = static_cast<int>(std::ceil(2.0 * rod.half_length / kDiameter));
    const auto point = [&](int k) {
      const double along = last == 0 ? 0.0 : rod.half_length * (2.0 * k / last - 1.0);
      return rod.centre + along * rod.axis;
    };
    for (int k = 0; k <= last; ++k)
      if (touches(rod, point(k))) return false;
    for (int k = 0; k <= last; ++k) {
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
  double side_;
  int cells_;
  std::vector<std::vector<Point>> points_;

  int index(double x) const { return static_cast<int>(std::floor(x / side_ * cells_)); }
  std::size_t cell(int i, int j, int k) const
  {
    const auto wrap = [this](int n) { return static_cast<std::size_t>((n % cells_ + cells_) % cells_); };
    return (wrap(i) * cells_ + wrap(j)) * cells_ + wrap(k);
  }
  double image(double d) const { return side_ * std::round(d / side_); }

  bool touches(const Segment &rod, const Vec3 &p) const
  {
    const int i = index(p.x), j = index(p.y), k = index(p.z);
    for (int a = i - 1; a <= i + 1; ++a)
      for (int b = j - 1; b <= j + 1; ++b)
        for (int c = k - 1; c <= k + 1; ++c)
          for (const Point &near : points_[cell(a, b, c)]) {
            const Vec3 d = p - near.position;
            Segment other = rods[near.rod];
            other.centre = other.centre + Vec3{image(d.x), image(d.y), image(d.z)};
            if (closest_points(rod, other).distance_squared < kDiameter * kDiameter) return true;
          }
    return false;
  }
};

}  // namespace

int main(int argc, char **argv)
{
  const bool has_floor = argc == 8 && std::string(argv[7]) == "floor";
  if (argc != 7 && !has_floor) {
    fmt::print(stderr, "usage: place_rods LAMBDA SOLID_FRACTION RODS COPIES_X COPIES_Y COPIES_Z "
                       "[floor]\n");
    return 2;
  }
  const double lambda = std::atof(argv[1]), solid = std::atof(argv[2]);
  const std::size_t wanted = std::strtoul(argv[3], nullptr, 10);
  const int copies[3] = {std::atoi(argv[4]), std::atoi(argv[5]), std::atoi(argv[6])};

  const double half_length = 0.5 * (lambda - 1.0) * kDiameter;
  const double volume = kPi * std::pow(kDiameter, 3) * ((lambda - 1.0) / 4.0 + 1.0 / 6.0);
  const double side = std::cbrt(wanted * volume / solid);
  // Above lambda x solid fraction = 3.34 thin rods at random directions are not the state of
  // equilibrium, and soon there is no room for them: 18.58 is the alignment of the nematic phase where
  // it begins (Onsager 1949, Ann. N. Y. Acad. Sci. 51, 627).
  const double alignment = lambda * solid > 3.34 ? 18.58 : 0.0;
  Cube cube(side);
  for (long trial = 0; cube.rods.size() < wanted; ++trial) {
    if (trial == 100'000'000) {
      fmt::print(stderr, "place_rods: no room for more than {} of {} rods\n", cube.rods.size(), wanted);
      return 1;
    }
    cube.add({side * Vec3{uniform(), uniform(), uniform()}, random_direction(alignment), half_length});
  }

  std::vector<Segment> rods;
  for (int a = 0; a < copies[0]; ++a)
    for (int b = 0; b < copies[1]; ++b)
      for (int c = 0; c < copies[2]; ++c)
        for (Segment rod : cube.rods) {
          rod.centre = rod.centre + side * Vec3{double(a), double(b), double(c)};
          if (has_floor) rod.centre.z += 0.5 * lambda * kDiameter;
          rods.push_back(rod);
        }
  std::shuffle(rods.begin(), rods.end(), random_bits);

  fmt::print("Rods of aspect ratio {} at random, {} of the volume\n\n{} atoms\n1 atom types\n\n", lambda,
             solid, rods.size());
  for (int d = 0; d < 3; ++d) {
    const double headroom = d == 2 && has_floor ? lambda * kDiameter : 0.0;
    fmt::print("0 {:.17g} {}lo {}hi\n", copies[d] * side + headroom, "xyz"[d], "xyz"[d]);
  }
  fmt::print("\nAtoms\n\n");
  for (std::size_t n = 0; n < rods.size(); ++n) {
    const Segment &r = rods[n];
    fmt::print("{} 1 {} {:.17g} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", n + 1, kDiameter,
               lambda * kDiameter, kDensity, r.centre.x, r.centre.y, r.centre.z, r.axis.x, r.axis.y,
               r.axis.z);
  }
  // A thin rod has as much energy in each direction of turning as of travelling at
  // omega = v sqrt(12)/length. About its axis it does not turn.
  fmt::print("\nVelocities\n\n");
  for (std::size_t n = 0; n < rods.size(); ++n) {
    const double turn = kSpeed * std::sqrt(12.0) / (lambda * kDiameter);
    const Vec3 &u = rods[n].axis;
    Vec3 omega{turn * normal(), turn * normal(), turn * normal()};
    omega = omega - dot(omega, u) * u;
    fmt::print("{} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", n + 1, kSpeed * normal(),
               kSpeed * normal(), kSpeed * normal(), omega.x, omega.y, omega.z);
  }
}
