// SPDX-License-Identifier: GPL-2.0-or-later
// make_large_bed FILE TILES [RODS_A_TILE ASPECT_RATIO SOLID_FRACTION INFLATED]: writes a dump of a
// cylindrical bed, for timing the post-processors. A periodic cube of rods placed at random without
// overlap is repeated TILES times in x, y and z; rods with their centre in the cylinder that fits
// into the square stay. Their radii are then INFLATED, so that near ones overlap as soft rods do.
// Prints the number of rods and the vessel's radius.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <fmt/format.h>
#include <fmt/os.h>

#include "core/closest_points.h"
#include "core/rotation.h"
#include "test_bed.h"

using namespace spherocylinder;

namespace {

constexpr double kDiameter = 0.01;  // m

double nearest_image(double distance, double side)
{
  return distance - side * std::round(distance / side);
}

std::vector<Segment> random_cube(std::size_t rods, double half_length, double side)
{
  std::mt19937 random(86028121);
  std::uniform_real_distribution<double> place(0.0, side);
  std::normal_distribution<double> normal;
  std::vector<Segment> placed;
  while (placed.size() < rods) {
    const Vec3 u{normal(random), normal(random), normal(random)};
    const Segment trial{{place(random), place(random), place(random)},
                        (1.0 / norm(u)) * u,
                        half_length};
    bool free = true;
    for (std::size_t i = 0; i < placed.size() && free; i++) {
      Segment other = placed[i];
      const Vec3 d = other.centre - trial.centre;
      other.centre = trial.centre + Vec3{nearest_image(d.x, side), nearest_image(d.y, side),
                                         nearest_image(d.z, side)};
      free = closest_points(trial, other).distance_squared >= kDiameter * kDiameter;
    }
    if (free) placed.push_back(trial);
  }
  return placed;
}

}  // namespace

int main(int argc, char **argv)
{
  if (argc < 3) return 2;
  const auto number = [&](int i, double otherwise) {
    return argc > i ? std::atof(argv[i]) : otherwise;
  };
  const int tiles = std::atoi(argv[2]);
  const double rods = number(3, 1000.0), lambda = number(4, 10.0);
  const double fraction = number(5, 0.12), inflated = number(6, 1.03);
  const double half_length = 0.5 * kDiameter * (lambda - 1.0);
  const double pi = std::acos(-1.0);
  const double rod_volume = pi * kDiameter * kDiameter * (0.5 * half_length + kDiameter / 6.0);
  const double side = std::cbrt(rods * rod_volume / fraction);
  const auto cube = random_cube(static_cast<std::size_t>(rods), half_length, side);

  const double radius = 0.5 * tiles * side;
  std::string rows;
  std::size_t id = 0;
  for (int i = 0; i < tiles; i++)
    for (int j = 0; j < tiles; j++)
      for (int k = 0; k < tiles; k++)
        for (const Segment &s : cube) {
          const Vec3 c = s.centre + Vec3{i * side - radius, j * side - radius, k * side};
          if (std::hypot(c.x, c.y) > radius) continue;
          const Quaternion q = orientation_of(s.axis);
          const double r = 0.5 * kDiameter * inflated;
          id++;
          rows += fmt::format(
              "{} 1 {:g} {:g} {:g} 0 0 -0.01 0 0 0 {:g} {:g} {:g} {:g} {:g} {:g} {:g} {} \n", id,
              c.x, c.y, c.z, r, r, r + half_length, q.w, q.x, q.y, q.z, id % 9);
        }
  auto file = fmt::output_file(argv[1]);
  file.print(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n{} {}\n{} {}\n0 "
      "{}\nITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz shapex shapey shapez quat1 "
      "quat2 quat3 quat4 c_contacts \n",
      id, -radius, radius, -radius, radius, tiles * side);
  file.print("{}", rows);
  std::printf("%zu rods, --vessel-radius %.6g\n", id, radius);
}
