// SPDX-License-Identifier: GPL-2.0-or-later
#include "fibres.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/numbers.h"
#include "run_mode.h"

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

spherocylinder::MassProperties properties_of(const Rod &rod, int shared_ends)
{
  return spherocylinder::mass_properties(rod.diameter, rod.length, rod.density, shared_ends);
}

int shared_ends(int k, int n) { return (k > 0) + (k < n - 1); }

Totals totals_of(const std::vector<Rod> &rods)
{
  Totals totals;
  const int n = static_cast<int>(rods.size());
  for (int k = 0; k < n; k++) {
    const Rod &rod = rods[k];
    const auto p = properties_of(rod, shared_ends(k, n));
    totals.momentum = totals.momentum + p.mass * rod.velocity;
    totals.angular_momentum = totals.angular_momentum + p.mass * cross(rod.position, rod.velocity) +
                              spherocylinder::angular_momentum(rod.omega, rod.axis, p.inertia_axial,
                                                               p.inertia_transverse);
  }
  return totals;
}

void shake(std::vector<Rod> &rods, double speed, double omega, unsigned prime_seed)
{
  std::mt19937_64 engine(prime_seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (Rod &rod : rods) {
    rod.velocity = {speed * any(engine), speed * any(engine), speed * any(engine)};
    rod.omega = {omega * any(engine), omega * any(engine), omega * any(engine)};
  }
}

Scene tangle(const std::string &keywords)
{
  Fibre fibre;
  fibre.segments = 7;
  fibre.joint_distance = 0.018;
  Scene scene = fibre_scene(fibre);
  scene.boundary = "p p p";
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -0.08;
    scene.box_hi[d] = 0.08;
  }
  scene.rods.clear();
  for (int f = 0; f < 24; f++) {
    const double azimuth = 2.4 * f;
    const Vec3 along = {std::cos(azimuth), std::sin(azimuth), 0.0};
    const Vec3 across = {-std::sin(azimuth), std::cos(azimuth), 0.0};
    Vec3 end = {0.05 * std::cos(1.3 * f), 0.05 * std::sin(1.3 * f), -0.075 + 0.0064 * f};
    for (int k = 0; k < fibre.segments; k++) {
      Rod rod = straight_rods(fibre, end, along)[0];
      const double angle = 0.12 * (k - 3) * (f % 3 - 1);
      rod.axis = std::cos(angle) * along + std::sin(angle) * across;
      rod.position = end + (0.5 * fibre.joint_distance) * rod.axis;
      end = end + fibre.joint_distance * rod.axis;
      const double *lo = scene.box_lo, *hi = scene.box_hi;
      const auto wrapped = [&](double x, int d) {
        return x < lo[d] ? x + hi[d] - lo[d] : x >= hi[d] ? x - hi[d] + lo[d] : x;
      };
      rod.position = {wrapped(rod.position.x, 0), wrapped(rod.position.y, 1),
                      wrapped(rod.position.z, 2)};
      scene.rods.push_back(rod);
    }
  }
  shake(scene.rods, 0.7, 5.0, 49979687);
  scene.physics = fibre_physics(fibre, keywords) + "fix weight all gravity 9.81 vector 1 2 -5\n";
  scene.steps = 1000;
  scene.dump_every = 250;
  return scene;
}

double difference_in_period(const Scene &scene, const std::vector<Frame> &a,
                            const std::vector<Frame> &b)
{
  double worst = a.size() == b.size() && !a.empty() ? 0.0 : spherocylinder::none;
  for (size_t f = 0; f < a.size(); f++)
    for (size_t k = 0; k < a[f].rods.size(); k++) {
      const Vec3 d = a[f].rods[k].position - b[f].rods[k].position;
      const double period = scene.box_hi[0] - scene.box_lo[0];
      for (const double x : {d.x, d.y, d.z})
        worst = std::max(worst, std::fabs(x - period * std::round(x / period)));
      worst = std::max(worst, norm(a[f].rods[k].axis - b[f].rods[k].axis));
    }
  return worst;
}

}  // namespace decks

const char *const decks::kStateColumns =
    "id x y z vx vy vz quat1 quat2 quat3 quat4 omegax omegay omegaz";

decks::Snapshot decks::expect_same_bits_from_half(const DeckFolder &folder, const Scene &scene,
                                                  const std::string &columns,
                                                  const std::string &thermo)
{
  folder.write("rods.data", data_file(scene));
  const std::string settings = "neighbor 0.002 bin\nneigh_modify delay 0\n" + scene.physics +
                               fmt::format("timestep {}\nthermo 500\n", scene.dt) + thermo;
  const std::string start = preamble(scene, Mode::TwoRanks);
  folder.write("in.first", start + "read_data rods.data\n" + settings +
                               "run 500\nwrite_restart half\n" +
                               exact_dump("dump.on", 500, columns) + "run 500\n");
  folder.write("in.second", start + "read_restart half\n" + settings +
                                exact_dump("dump.again", 500, columns) + "run 500\n");
  for (const char *deck : {"in.first", "in.second"}) {
    const Outcome outcome = folder.run(deck, {Program::Lmp, 2});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    if (outcome.exit_code != 0) return {};
  }
  const auto on = read_dump(folder / "dump.on"), again = read_dump(folder / "dump.again");
  EXPECT_EQ(on.back().step, 1000);
  EXPECT_EQ(again.back().step, 1000);
  EXPECT_EQ(on.back().atoms.rows, again.back().atoms.rows);
  return on.back();
}
