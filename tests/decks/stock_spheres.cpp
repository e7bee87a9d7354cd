// SPDX-License-Identifier: GPL-2.0-or-later
#include "stock_spheres.h"

#include <fmt/format.h>

std::string decks::granular_data_file(const std::vector<Rod> &balls, double low, double high)
{
  std::string atoms, velocities;
  for (size_t i = 0; i < balls.size(); i++) {
    const Rod &b = balls[i];
    atoms += fmt::format("{} 1 {} {} {} {} {}\n", i + 1, b.diameter, b.density, b.position.x,
                         b.position.y, b.position.z);
    velocities += fmt::format("{} {} {} {} {} {} {}\n", i + 1, b.velocity.x, b.velocity.y,
                              b.velocity.z, b.omega.x, b.omega.y, b.omega.z);
  }
  return fmt::format("balls\n\n{0} atoms\n1 atom types\n{1} {2} xlo xhi\n{1} {2} ylo yhi\n"
                     "{1} {2} zlo zhi\n\nAtoms\n\n{3}\nVelocities\n\n{4}",
                     balls.size(), low, high, atoms, velocities);
}
