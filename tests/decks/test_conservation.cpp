// SPDX-License-Identifier: GPL-2.0-or-later
// A gas of colliding rods keeps momentum, angular momentum and, elastic and frictionless, energy;
// and does not depend on the number of ranks. bench/sweep_conservation goes on for longer.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "conservation.h"
#include "convergence.h"

using namespace decks;

namespace {

RodGas small_gas()
{
  RodGas gas;
  gas.rods = 150;
  gas.shortest = 0.3;
  gas.volume_fraction = 0.06;  // the box is wider than two rods
  return gas;
}

TEST(Conservation, MomentumOfAGasWithFriction)
{
  const Conserved gas = momentum_in_periodic_gas(small_gas(), 8000);
  EXPECT_GT(gas.collisions, 150.0);
  // Each step rounds a momentum at 1e-16; 8000 add up at random.
  expect_holds({"Periodic gas with friction, lambda 3-10: momentum, relative", "conserved", 1e-13},
               gas.error);
}

TEST(Conservation, AngularMomentumOfATrappedGasWithFriction)
{
  const Conserved gas = angular_momentum_in_a_trap(small_gas(), 8000);
  EXPECT_GT(gas.collisions, 150.0);
  expect_holds(
      {"Trapped gas with friction, lambda 3-10: angular momentum, relative", "conserved", 1e-12},
      gas.error);
}

// A collision that begins at the depth a v dt after its first step and ends at b v dt changes the
// energy of its normal motion by the part (w dt)^2 (b (1 - b) - a (1 - a)) (see
// test_restitution_sweep.cpp): no mean, root mean square 0.105 (w dt)^2, so that the error of n
// collisions is of the order sqrt(n) 0.105 (w dt)^2 times the energy of one.
TEST(Conservation, EnergyOfAnElasticGas)
{
  RodGas gas = small_gas();
  gas.shortest = 1.0;
  gas.volume_fraction = 0.1;
  std::vector<double> dt, errors;
  for (const int steps : {20, 80}) {
    const EnergyDrift drift = energy_of_elastic_gas(gas, steps, 30.0, false);
    EXPECT_GT(drift.collisions, 50.0);
    fmt::print("{} steps a contact: {:.0f} collisions, error {:.1e} of a rod's energy\n", steps,
               drift.collisions, drift.largest);
    dt.push_back(1.0 / steps);
    errors.push_back(drift.largest);
  }
  EXPECT_GT(order_of_convergence(dt, errors), 1.5);
  // sqrt(130) 0.105 (pi/80)^2 = 1.8e-3.
  expect_holds(
      {"Elastic gas, lambda 10, 80 steps a contact: energy / that of one rod", "conserved", 2e-3},
      errors.back());
}

// spread_contact, the default. The few contacts that are spread at a reading hold less energy than
// the k overlap^2/2 they are counted for.
TEST(Conservation, EnergyOfAnElasticGasWithSpreadContact)
{
  RodGas gas = small_gas();
  gas.shortest = 1.0;
  gas.volume_fraction = 0.1;
  const EnergyDrift drift = energy_of_elastic_gas(gas, 80, 30.0, true);
  EXPECT_GT(drift.collisions, 50.0);
  expect_holds(
      {"Elastic gas with spread_contact, lambda 10: energy / that of one rod", "conserved", 2e-3},
      drift.largest);
}

// Short rods, of which most contacts are spread (docs/notes/parallel_rods.md): what is read while
// nothing touches is kinetic energy, whatever the energy of a contact.
TEST(Conservation, EnergyOfShortRodsBetweenContacts)
{
  std::vector<double> dt, errors;
  for (const int steps : {20, 80}) {
    double largest = 0.0;
    for (const double aspect_ratio : {1.5, 3.0}) {
      RodGas gas;
      gas.rods = 24;
      gas.aspect_ratio = aspect_ratio;
      gas.volume_fraction = 0.08;
      gas.overlap = 0.02;
      const EnergyBetweenContacts energy = energy_between_contacts(gas, steps, 150.0, true);
      EXPECT_GT(energy.collisions, 40.0);
      EXPECT_GT(energy.readings, 30);
      fmt::print(
          "lambda {}, {} steps a contact: {:.0f} collisions, {} readings, error {:.1e}, largest "
          "change {:.1e}\n",
          aspect_ratio, steps, energy.collisions, energy.readings, energy.largest,
          energy.largest_change);
      largest = std::max(largest, energy.largest);
    }
    dt.push_back(1.0 / steps);
    errors.push_back(largest);
  }
  EXPECT_GT(order_of_convergence(dt, errors), 1.5);
  // sqrt(60) 0.105 (pi/80)^2 = 1.3e-3, as for the closest point.
  expect_holds({"Elastic gas of short rods, 80 steps a contact: energy / that of one rod",
                "conserved", 1.3e-3},
               errors.back());
}

// Sums of forces in another order: round-off, which collisions make grow.
TEST(Conservation, RanksAgree)
{
  const std::vector<RankDifference> differences =
      difference_of_ranks(small_gas(), {Mode::TwoRanks, Mode::FourRanks}, 2000, 2000);
  for (const RankDifference &d : differences)
    expect_holds({"Trapped gas with friction, 1 and " +
                      std::string(d.mode == Mode::TwoRanks ? "2" : "4") +
                      " ranks, 2000 steps: position (m)",
                  "same scene", 1e-12},
                 d.position);
}

}  // namespace
