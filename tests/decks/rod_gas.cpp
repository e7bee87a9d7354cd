// SPDX-License-Identifier: GPL-2.0-or-later
#include "rod_gas.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "slow_distance.h"

namespace decks {

namespace {

// The image of b nearest to a; none where the box is not periodic.
Rod nearest_image(const Rod &a, Rod b, const Scene &scene)
{
  if (scene.boundary != "p p p") return b;
  const double side = scene.box_hi[0] - scene.box_lo[0];
  const auto shift = [side](double from) { return -side * std::round(from / side); };
  const Vec3 between = b.position - a.position;
  b.position = b.position + Vec3{shift(between.x), shift(between.y), shift(between.z)};
  return b;
}

double overlap(const Rod &a, const Rod &b, const Scene &scene)
{
  const Rod image = nearest_image(a, b, scene);
  if (norm(image.position - a.position) > 0.5 * (a.length + b.length)) return 0.0;
  return std::max(0.0, a.radius() + b.radius() - slow_distance(a, image));
}

bool is_free(const Rod &rod, const Scene &scene)
{
  return std::none_of(scene.rods.begin(), scene.rods.end(),
                      [&](const Rod &other) { return overlap(rod, other, scene) > 0.0; });
}

}  // namespace

double shortest_contact(const RodGas &gas)
{
  Rod rod;
  rod.length = gas.shortest * gas.aspect_ratio * rod.diameter;
  const auto p = rod.properties();
  const double inverse = 1.0 / p.mass + std::pow(rod.half_cylinder(), 2) / p.inertia_transverse;
  return std::acos(-1.0) * std::sqrt(0.5 / inverse / gas.stiffness);
}

Scene scene_of(const RodGas &gas)
{
  std::mt19937 random(gas.seed);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return normalized({normal(random), normal(random), normal(random)});
  };

  Scene scene;
  scene.boundary = "p p p";
  double volume = 0.0;
  std::vector<Rod> rods(gas.rods);
  for (int k = 0; k < gas.rods; k++) {
    Rod &rod = rods[k];
    const double part = gas.shortest + (1.0 - gas.shortest) * (k + 0.5) / gas.rods;
    rod.length = part * gas.aspect_ratio * rod.diameter;
    volume += rod.mass() / rod.density;
  }
  const double half = 0.5 * std::cbrt(volume / gas.volume_fraction);
  if (half < rods.back().length) throw std::invalid_argument("rod_gas: box below two rod lengths");
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -half;
    scene.box_hi[d] = half;
  }

  std::uniform_real_distribution<double> place(-half, half);
  for (Rod rod : rods) {
    // overlap = v sqrt(m_eff/kn) with m_eff = m/2, two rods middle on middle.
    const double mass = rod.mass();
    const double speed = gas.overlap * rod.diameter * std::sqrt(gas.stiffness / (0.5 * mass));
    do {
      rod.position = {place(random), place(random), place(random)};
      rod.axis = direction();
    } while (!is_free(rod, scene));
    rod.velocity = speed * direction();
    // I_t omega^2 = (2/3) m v^2
    const double inertia = rod.properties().inertia_transverse;
    rod.omega =
        speed * std::sqrt(2.0 / 3.0 * mass / inertia) * normalized(cross(rod.axis, direction()));
    scene.rods.push_back(rod);
  }
  const Vec3 excess = momentum(scene.rods);
  for (Rod &rod : scene.rods) rod.velocity = rod.velocity - 1.0 / (gas.rods * rod.mass()) * excess;
  return scene;
}

double total_energy(const std::vector<Rod> &rods, const Scene &scene, double stiffness)
{
  double energy = kinetic_energy(rods);
  for (size_t i = 0; i < rods.size(); i++)
    for (size_t j = i + 1; j < rods.size(); j++)
      energy += 0.5 * stiffness * std::pow(overlap(rods[i], rods[j], scene), 2);
  return energy;
}

double collisions(const std::vector<Frame> &frames)
{
  double begun = 0.0;  // counted on both rods
  for (size_t f = 1; f < frames.size(); f++)
    for (size_t i = 0; i < frames[f].contacts.size(); i++)
      begun += std::max(0.0, frames[f].contacts[i] - frames[f - 1].contacts[i]);
  return 0.5 * begun;
}

}  // namespace decks
