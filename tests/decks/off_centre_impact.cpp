// SPDX-License-Identifier: GPL-2.0-or-later
#include "off_centre_impact.h"

#include <algorithm>
#include <cmath>

namespace decks {

namespace {

constexpr double kApproach = 1e-5;   // normal velocity of the contact points, m/s
constexpr double kStiffness = 1e4;   // N/m
constexpr double kPartnerEnd = 0.7;  // where the horizontal rod is hit, of its half cylinder

struct Impact {
  Rod rod, partner;  // the partner is not used for a wall
  double restitution = 0.0, elevation = 0.0;
};

Vec3 lower_end(const Rod &rod) { return -rod.half_cylinder() * rod.axis; }
Vec3 struck_point(const Rod &partner)
{
  return kPartnerEnd * partner.half_cylinder() * partner.axis;
}

double end_velocity(const Rod &rod, const Vec3 &arm)
{
  return rod.velocity.z + cross(rod.omega, arm).z;
}

double inverse_mass(const Rod &rod, const Vec3 &arm)
{
  const auto p = rod.properties();
  return 1.0 / p.mass + norm_squared(cross(arm, Vec3{0.0, 0.0, 1.0})) / p.inertia_transverse;
}

double inverse_effective_mass(const Impact &impact, Partner partner)
{
  const double of_rod = inverse_mass(impact.rod, lower_end(impact.rod));
  if (partner == Partner::Wall) return of_rod;
  return of_rod + inverse_mass(impact.partner, struck_point(impact.partner));
}

// pi sqrt(m_eff/k) / sqrt(1 - beta^2), beta = -ln e / sqrt(pi^2 + ln^2 e)
double contact_time(const Impact &impact, Partner partner)
{
  const double pi = std::acos(-1.0), log_e = std::log(impact.restitution);
  const double root = pi / std::hypot(pi, log_e);  // sqrt(1 - beta^2)
  return pi / std::sqrt(kStiffness * inverse_effective_mass(impact, partner)) / root;
}

std::vector<Impact> impacts_of(const ImpactSet &set)
{
  std::vector<Impact> impacts;
  for (size_t e = 0; e < set.restitutions.size(); e++)
    for (const double elevation : set.elevations) {
      Impact impact;
      impact.restitution = set.restitutions[e];
      impact.elevation = elevation;
      Rod &rod = impact.rod;
      rod.length = set.aspect_ratio * rod.diameter;
      rod.type = static_cast<int>(e) + 1;
      impact.partner = rod;
      impact.partner.axis = {0.0, 1.0, 0.0};
      rod.axis = {std::cos(degrees(elevation)), 0.0, std::sin(degrees(elevation))};
      rod.velocity.z = -kApproach;
      impacts.push_back(impact);
    }
  return impacts;
}

// Rods side by side along y above a floor at z = 0, or on a grid in y and z that keeps each pair
// on its own. The contacts begin after 2 to 3 steps.
void place(std::vector<Impact> &impacts, const ImpactSet &set, double dt)
{
  const double length = impacts[0].rod.length;
  const double spacing = set.partner == Partner::Wall ? 0.05 : 1.2 * length + 0.05;
  const double count = static_cast<double>(impacts.size());
  const double columns = set.partner == Partner::Wall ? count : std::ceil(std::sqrt(count));
  for (size_t k = 0; k < impacts.size(); k++) {
    Rod &rod = impacts[k].rod, &partner = impacts[k].partner;
    const double n = static_cast<double>(k), row = std::floor(n / columns);
    const double phase = std::fmod(0.6180339887 * (n + 1.0), 1.0);
    const double gap = (2.0 + phase) * kApproach * dt;
    Vec3 struck = {0.0, spacing * (n - row * columns - 0.5 * columns), 0.0};
    if (set.partner == Partner::Rod) {
      struck.z = spacing * (row - 0.5 * columns);
      partner.position = struck - struck_point(partner);
      struck.z += partner.radius();
    }
    rod.position = struck + Vec3{0.0, 0.0, rod.radius() + gap} - lower_end(rod);
  }
}

Scene scene_of(const std::vector<Impact> &impacts, const ImpactSet &set)
{
  Scene scene;
  scene.types = static_cast<int>(set.restitutions.size());
  double reach = 1.0;
  for (const Impact &impact : impacts) {
    scene.rods.push_back(impact.rod);
    if (set.partner == Partner::Rod) scene.rods.push_back(impact.partner);
    reach = std::max(reach, norm(impact.rod.position) + impact.rod.length);
  }
  for (int d = 0; d < 3; d++) {
    scene.box_lo[d] = -reach;
    scene.box_hi[d] = reach;
  }
  const auto restitution = [&](int i, int j) { return set.restitutions[std::max(i, j) - 1]; };
  scene.physics =
      pair_property("kn", scene.types, kStiffness) + pair_property("kt", scene.types, kStiffness) +
      pair_property("coefficientRestitution", scene.types, restitution) +
      rod_pair("linear tangential off", set.keywords) + "fix motion all nve/spherocylinder\n";
  if (set.partner == Partner::Wall)
    scene.physics +=
        rod_wall("floor", "linear tangential off", "type 1 zplane 0.0 " + set.keywords);
  return scene;
}

}  // namespace

double MeasuredRestitution::error() const
{
  return std::fabs(measured - restitution) / restitution;
}

std::vector<MeasuredRestitution> measure_restitution(const ImpactSet &set)
{
  std::vector<Impact> impacts = impacts_of(set);
  std::vector<double> times;
  for (const Impact &impact : impacts) times.push_back(contact_time(impact, set.partner));
  const auto [shortest, longest] = std::minmax_element(times.begin(), times.end());
  const double dt = *shortest / set.steps_per_contact;
  place(impacts, set, dt);
  Scene scene = scene_of(impacts, set);
  scene.dt = dt;
  scene.steps = static_cast<long>(1.1 * *longest / dt) + 10;

  const std::vector<Rod> after = run(scene).back().rods;
  std::vector<MeasuredRestitution> measured;
  for (size_t k = 0; k < impacts.size(); k++) {
    const Rod &rod = after[set.partner == Partner::Rod ? 2 * k : k];
    double velocity = end_velocity(rod, lower_end(rod));
    if (set.partner == Partner::Rod)
      velocity -= end_velocity(after[2 * k + 1], struck_point(after[2 * k + 1]));
    const double particles = set.partner == Partner::Rod ? 0.5 * rod.mass() : rod.mass();
    measured.push_back({impacts[k].restitution, impacts[k].elevation, dt / times[k],
                        velocity / kApproach,
                        particles * inverse_effective_mass(impacts[k], set.partner)});
  }
  return measured;
}

double worst_error(const std::vector<MeasuredRestitution> &measured)
{
  double worst = 0.0;
  for (const MeasuredRestitution &m : measured)
    if (!(m.error() <= worst)) worst = m.error();
  return worst;
}

}  // namespace decks
