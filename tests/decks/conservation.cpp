// SPDX-License-Identifier: GPL-2.0-or-later
#include "conservation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace decks {

namespace {

constexpr int kStepsPerContact = 50;  // with damping; nothing here depends on it
constexpr int kTimeLimit = 1800;      // s

std::string with_friction(double stiffness)
{
  return linear_material(stiffness, 0.5 * stiffness, 0.9, 0.3) +
         rod_pair("linear tangential history") + "fix motion all nve/spherocylinder\n";
}

Scene gas_with_friction(const RodGas &gas, long steps)
{
  Scene scene = scene_of(gas);
  scene.physics = with_friction(gas.stiffness);
  scene.dt = shortest_contact(gas) / kStepsPerContact;
  scene.steps = steps;
  scene.dump_every = kStepsPerContact;  // each contact is seen
  scene.time_limit = kTimeLimit;
  return scene;
}

// The gas without walls, turning round the z axis in a central force -mass * constant * position.
Scene trapped_gas_with_friction(const RodGas &gas, long steps)
{
  Scene scene = gas_with_friction(gas, steps);
  const double half = scene.box_hi[0];
  const double rate = norm(scene.rods[0].velocity) / half;
  for (Rod &rod : scene.rods)
    rod.velocity = rod.velocity + cross(Vec3{0.0, 0.0, 0.5 * rate}, rod.position);
  scene.boundary = "f f f";
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -4.0 * half;
    scene.box_hi[d] = 4.0 * half;
  }
  for (const char *axis : {"x", "y", "z"})
    scene.physics += fmt::format("variable pull_{0} atom -{1}*mass*{0}\n", axis, 4.0 * rate * rate);
  scene.physics += "fix trap all addforce v_pull_x v_pull_y v_pull_z\n";
  return scene;
}

template <class Total>
Conserved worst_change(const Scene &scene, double scale, Total total)
{
  const std::vector<Frame> frames = run(scene);
  Conserved result;
  result.collisions = collisions(frames);
  result.energy_left = kinetic_energy(frames.back().rods) / kinetic_energy(scene.rods);
  for (const Frame &frame : frames) {
    const double change = norm(total(frame.rods) - total(scene.rods)) / scale;
    if (!(change <= result.error)) result.error = change;
  }
  return result;
}

double difference(const std::vector<Rod> &a, const std::vector<Rod> &b)
{
  double largest = 0.0;
  for (size_t i = 0; i < a.size(); i++) {
    largest = std::max({largest, norm(a[i].position - b[i].position),
                        norm(a[i].axis - b[i].axis) * a[i].half_cylinder()});
  }
  return largest;
}

}  // namespace

Conserved momentum_in_periodic_gas(const RodGas &gas, long steps)
{
  const Scene scene = gas_with_friction(gas, steps);
  double scale = 0.0;
  for (const Rod &rod : scene.rods) scale += rod.mass() * norm(rod.velocity);
  return worst_change(scene, scale, [](const std::vector<Rod> &rods) { return momentum(rods); });
}

Conserved angular_momentum_in_a_trap(const RodGas &gas, long steps)
{
  const Scene scene = trapped_gas_with_friction(gas, steps);
  double scale = 0.0;
  for (const Rod &rod : scene.rods)
    scale += rod.mass() * norm(rod.velocity) * norm(rod.position) + norm(rod.angular_momentum());
  return worst_change(scene, scale, [](const std::vector<Rod> &rods) {
    return angular_momentum(rods, {0.0, 0.0, 0.0});
  });
}

namespace {

Scene elastic_gas(const RodGas &gas, int steps_per_contact, double contacts, bool spread_contact)
{
  Scene scene = scene_of(gas);
  scene.physics = linear_material(gas.stiffness, gas.stiffness, 1.0, 0.0) +
                  fmt::format("pair_style gran model linear tangential off surface spherocylinder "
                              "spread_contact {}\npair_coeff * *\n",
                              spread_contact ? "on" : "off") +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = shortest_contact(gas) / steps_per_contact;
  scene.dump_every = steps_per_contact / 2;  // each contact is seen
  scene.steps = steps_per_contact * std::lround(contacts);
  scene.time_limit = kTimeLimit;
  return scene;
}

}  // namespace

EnergyDrift energy_of_elastic_gas(const RodGas &gas, int steps_per_contact, double contacts,
                                  bool spread_contact)
{
  const Scene scene = elastic_gas(gas, steps_per_contact, contacts, spread_contact);
  const std::vector<Frame> frames = run(scene);

  const double start = total_energy(scene.rods, scene, gas.stiffness);
  const double unit = start / static_cast<double>(scene.rods.size());
  EnergyDrift result;
  result.dt = scene.dt;
  result.collisions = collisions(frames);
  const size_t stride = std::max<size_t>(1, frames.size() / 20);
  for (size_t f = frames.size() - 1; f >= stride; f -= stride) {  // the last one first
    const double error = (total_energy(frames[f].rods, scene, gas.stiffness) - start) / unit;
    if (f == frames.size() - 1) result.drift = error;
    if (!(std::fabs(error) <= result.largest)) result.largest = std::fabs(error);
  }
  return result;
}

EnergyBetweenContacts energy_between_contacts(const RodGas &gas, int steps_per_contact,
                                              double contacts, bool spread_contact)
{
  const Scene scene = elastic_gas(gas, steps_per_contact, contacts, spread_contact);
  const std::vector<Frame> frames = run(scene);
  const double start = kinetic_energy(scene.rods);
  const double unit = start / static_cast<double>(scene.rods.size());
  EnergyBetweenContacts result;
  result.dt = scene.dt;
  result.collisions = collisions(frames);
  for (const Frame &frame : frames) {
    if (std::any_of(frame.contacts.begin(), frame.contacts.end(), [](double n) { return n > 0.0; }))
      continue;
    const double error = (kinetic_energy(frame.rods) - start) / unit;
    result.readings++;
    result.largest_change = std::max(result.largest_change, std::fabs(error - result.drift));
    result.drift = error;
    if (!(std::fabs(error) <= result.largest)) result.largest = std::fabs(error);
  }
  return result;
}

std::vector<RankDifference> difference_of_ranks(const RodGas &gas, const std::vector<Mode> &modes,
                                                long steps, long every)
{
  Scene scene = trapped_gas_with_friction(gas, steps);
  scene.dump_every = every;
  const std::vector<Frame> one = run(scene);
  std::vector<RankDifference> result;
  for (const Mode mode : modes) {
    const std::vector<Frame> many = run(scene, mode);
    for (size_t f = 1; f < one.size() && f < many.size(); f++) {
      const double touching = std::accumulate(one[f].contacts.begin(), one[f].contacts.end(), 0.0);
      result.push_back({mode, one[f].step, 0.5 * touching, difference(many[f].rods, one[f].rods)});
    }
  }
  return result;
}

}  // namespace decks
