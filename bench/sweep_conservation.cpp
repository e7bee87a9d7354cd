// SPDX-License-Identifier: GPL-2.0-or-later
// What a gas of 500 rods keeps over long runs: momentum, angular momentum, energy at five time
// steps, the same motion on one, two and four ranks.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "claim.h"
#include "conservation.h"
#include "convergence.h"
#include "results_file.h"

using namespace decks;

namespace {

constexpr double kThinContacts = 300.0;  // duration in shortest contacts, of a thin gas

// Rods of a third to the whole length.
RodGas mixed_lengths()
{
  RodGas gas;
  gas.shortest = 0.3;
  return gas;
}

void report(ResultsFile &csv, const std::string &what, long steps, const Conserved &result)
{
  csv.row("{},{},{:.0f},{:.3f},{:.2e}", what, steps, result.collisions, result.energy_left,
          result.error);
  fmt::print("{}: {:.0f} collisions, {:.2f} of the energy left, error {:.1e}\n", what,
             result.collisions, result.energy_left, result.error);
  std::fflush(stdout);
}

}  // namespace

TEST(SweepConservation, MomentumAndAngularMomentum)
{
  constexpr long kSteps = 100000;
  ResultsFile csv("conservation_momentum.csv",
                  "quantity,steps,collisions,kinetic_energy_left,largest_relative_change");
  const Conserved linear = momentum_in_periodic_gas(mixed_lengths(), kSteps);
  report(csv, "momentum (periodic)", kSteps, linear);
  const Conserved angular = angular_momentum_in_a_trap(mixed_lengths(), kSteps);
  report(csv, "angular momentum (trap)", kSteps, angular);
  expect_holds({"500 rods, 10^5 steps: momentum, relative", "conserved", 1e-12}, linear.error);
  expect_holds({"500 rods, 10^5 steps: angular momentum, relative", "conserved", 1e-12},
               angular.error);
}

// At the closest points, whose contacts hold k overlap^2/2 each. Units: the initial energy of one rod.
TEST(SweepConservation, EnergyOfAnElasticGas)
{
  constexpr double kContacts = 100.0;  // duration in shortest contacts
  ResultsFile csv("conservation_energy.csv",
                  "aspect_ratio,steps_per_shortest_contact,dt_s,collisions,"
                  "drift_per_collision_over_energy_of_a_rod,"
                  "largest_error_over_energy_of_a_rod,largest_error_over_sqrt_collisions");
  for (const double aspect_ratio : {3.0, 10.0, 30.0}) {
    RodGas gas;
    gas.aspect_ratio = aspect_ratio;
    gas.volume_fraction = aspect_ratio < 5.0 ? 0.2 : aspect_ratio < 20.0 ? 0.1 : 0.04;
    std::vector<double> dt, errors;
    for (const int steps : {20, 40, 80, 160, 320}) {
      const EnergyDrift d = energy_of_elastic_gas(gas, steps, kContacts, false);
      csv.row("{},{},{:.3e},{:.0f},{:.2e},{:.2e},{:.2e}", aspect_ratio, steps, d.dt, d.collisions,
              d.drift / d.collisions, d.largest, d.largest / std::sqrt(d.collisions));
      fmt::print(
          "lambda {:<3} {:>4} steps: {:.0f} collisions, drift per collision {:+.1e}, largest "
          "error {:.1e}\n",
          aspect_ratio, steps, d.collisions, d.drift / d.collisions, d.largest);
      std::fflush(stdout);
      dt.push_back(d.dt);
      errors.push_back(d.largest);
    }
    const double order = order_of_convergence(dt, errors);
    fmt::print("lambda {:<3}: order {:.2f}\n", aspect_ratio, order);
    EXPECT_GT(order, 1.5) << "aspect ratio " << aspect_ratio;
  }
}

// Short rods are spread over at most of their contacts. A thin gas of 60, read while nothing touches.
TEST(SweepConservation, EnergyBetweenContacts)
{
  ResultsFile csv("conservation_short_rods.csv",
                  "aspect_ratio,spread_contact,steps_per_shortest_contact,collisions,readings,"
                  "drift_over_energy_of_a_rod,largest_error_over_energy_of_a_rod,"
                  "largest_change_over_energy_of_a_rod");
  for (const double aspect_ratio : {1.5, 2.0, 3.0, 5.0, 10.0}) {
    RodGas gas;
    gas.rods = 60;
    gas.aspect_ratio = aspect_ratio;
    gas.volume_fraction = aspect_ratio < 8.0 ? 0.03 : 0.02;
    double largest[2] = {0.0, 0.0};
    for (const bool spread : {false, true}) {
      std::vector<double> dt, errors;
      for (const int steps : {20, 80}) {
        const EnergyBetweenContacts e = energy_between_contacts(gas, steps, kThinContacts, spread);
        csv.row("{},{},{},{:.0f},{},{:.2e},{:.2e},{:.2e}", aspect_ratio, spread ? "on" : "off",
                steps, e.collisions, e.readings, e.drift, e.largest, e.largest_change);
        fmt::print(
            "lambda {:<3} spread_contact {:<3} {:>4} steps: {:.0f} collisions, {} readings, drift "
            "{:+.1e}, largest {:.1e}, largest change {:.1e}\n",
            aspect_ratio, spread ? "on" : "off", steps, e.collisions, e.readings, e.drift,
            e.largest, e.largest_change);
        std::fflush(stdout);
        dt.push_back(e.dt);
        errors.push_back(e.largest);
        if (steps == 80) largest[spread] = e.largest;
      }
      EXPECT_GT(order_of_convergence(dt, errors), 1.5) << "aspect ratio " << aspect_ratio;
    }
    EXPECT_LT(largest[1], 2.0 * largest[0]) << "aspect ratio " << aspect_ratio;
  }
}

TEST(SweepConservation, RanksAgree)
{
  ResultsFile csv("conservation_ranks.csv", "ranks,step,contacts,largest_difference_m");
  double at_2000 = 0.0;
  for (const RankDifference &d :
       difference_of_ranks(mixed_lengths(), {Mode::TwoRanks, Mode::FourRanks}, 20000, 1000)) {
    csv.row("{},{},{:.0f},{:.2e}", d.mode == Mode::TwoRanks ? 2 : 4, d.step, d.contacts,
            d.position);
    if (d.step == 2000) at_2000 = std::max(at_2000, d.position);
  }
  expect_holds({"1, 2 and 4 ranks after 2000 steps: position (m)", "same scene", 1e-12}, at_2000);
}
