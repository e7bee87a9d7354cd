// SPDX-License-Identifier: GPL-2.0-or-later
#include "fibres.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/numbers.h"

namespace decks {

using spherocylinder::pi;

double Fibre::bending_rigidity() const { return youngs_modulus * pi * std::pow(radius, 4) / 4.0; }

double Fibre::shear_stiffness() const
{
  const double shear_modulus = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
  return stretch_factor * 0.9 * shear_modulus * pi * radius * radius / joint_distance;
}

double Fibre::stretch_stiffness() const
{
  return stretch_factor * youngs_modulus * pi * radius * radius / joint_distance;
}

double Fibre::mass_per_length() const { return density * pi * radius * radius; }

double Fibre::cap_mass() const { return density * 2.0 / 3.0 * pi * std::pow(radius, 3); }

double Fibre::lowest_frequency(double length) const
{
  return std::pow(1.8751040687 / length, 2) * std::sqrt(bending_rigidity() / mass_per_length());
}

double Fibre::time_step() const
{
  const double m = segment_mass(), h = joint_distance;
  const double transverse = m * (h * h / 12.0 + radius * radius / 4.0);
  const double axial = m * radius * radius / 2.0;
  return 0.4 *
         std::min({std::sqrt(m / stretch_stiffness()), std::sqrt(m / (3.0 * shear_stiffness())),
                   std::sqrt(transverse / bend_stiffness()), std::sqrt(axial / twist_stiffness())});
}

std::vector<Rod> straight_rods(const Fibre &fibre, const Vec3 &start, const Vec3 &direction)
{
  std::vector<Rod> rods(fibre.segments);
  for (int k = 0; k < fibre.segments; k++) {
    rods[k].position = start + (k * fibre.joint_distance) * direction;
    rods[k].axis = direction;
    rods[k].diameter = 2.0 * fibre.radius;
    rods[k].length = fibre.joint_distance + 2.0 * fibre.radius;
    rods[k].density = fibre.density;
  }
  return rods;
}

std::string fibre_physics(const Fibre &fibre, const std::string &keywords)
{
  return linear_material(1e3, 1e3, 0.5, 0.3) + rod_pair("linear tangential history") +
         fmt::format("fix joints all joint/spherocylinder youngsModulus {} poissonsRatio {} "
                     "stretch_factor {} join 1e-6 {}\n",
                     fibre.youngs_modulus, fibre.poissons_ratio, fibre.stretch_factor, keywords) +
         "fix motion all nve/spherocylinder\n";
}

const char *const kClampFirst = "group clamp id 1\ngroup others subtract all clamp\nunfix motion\n"
                                "fix motion others nve/spherocylinder\nfix clamp clamp freeze\n";

std::string drag_of(const Fibre &fibre, double length, double slower)
{
  return fmt::format("fix drag all viscous {}\n",
                     2.0 * fibre.segment_mass() * slower * fibre.lowest_frequency(length));
}

// Critically damped, exp(-w t)(1 + w t), and all faster modes like exp(-w t).
long steps_to_rest(const Fibre &fibre, double length, double slower)
{
  return std::lround(27.0 / (slower * fibre.lowest_frequency(length) * fibre.time_step()));
}

Scene fibre_scene(const Fibre &fibre)
{
  Scene scene;
  scene.rods = straight_rods(fibre, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  scene.skin = fibre.radius;
  scene.physics = fibre_physics(fibre);
  scene.dt = fibre.time_step();
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.5;
    scene.box_hi[d] = 0.5;
  }
  return scene;
}

}  // namespace decks
