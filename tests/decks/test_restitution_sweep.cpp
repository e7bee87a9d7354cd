// SPDX-License-Identifier: GPL-2.0-or-later
// Restitution of impacts off the centre over e, elevation and aspect ratio, and how it converges in
// the time step; bench/sweep_restitution does the whole range.
//
// Closed form: the contact point parts with e times its velocity of approach. The damping force
// uses the velocity half a step earlier and jumps where a contact begins and ends inside a step:
// the error is of first order in the step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "claim.h"
#include "convergence.h"
#include "off_centre_impact.h"

using namespace decks;

namespace {

class RestitutionSweep : public testing::TestWithParam<Partner> {};

double worst_over_aspect_ratios(Partner partner, int steps_per_contact,
                                const std::vector<double> &restitutions)
{
  double worst = 0.0;
  for (const double aspect_ratio : {1.0, 5.0, 20.0, 100.0}) {
    ImpactSet set;
    set.partner = partner;
    set.aspect_ratio = aspect_ratio;
    set.restitutions = restitutions;
    set.elevations = {5.0, 25.0, 45.0, 65.0, 85.0};
    set.steps_per_contact = steps_per_contact;
    const double error = worst_error(measure_restitution(set));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

TEST_P(RestitutionSweep, ConvergesToTheCoefficient)
{
  const std::vector<double> steps = {100, 400, 1600, 6400};
  std::vector<double> dt, errors;
  for (const double n : steps) {
    dt.push_back(1.0 / n);
    errors.push_back(worst_over_aspect_ratios(GetParam(), static_cast<int>(n), {0.1, 0.5, 0.9}));
  }
  const double order = order_of_convergence(dt, errors);
  fmt::print("worst error {:.1e} {:.1e} {:.1e} {:.1e} at 100, 400, 1600, 6400 steps a contact: "
             "order {:.2f}\n",
             errors[0], errors[1], errors[2], errors[3], order);
  const std::string what = GetParam() == Partner::Wall ? "on a wall" : "on a rod";
  expect_holds({"Restitution " + what + ", e 0.1-0.9, 5-85 deg, lambda 1-100: relative", "e", 1e-3},
               errors.back());
  EXPECT_GT(order, 0.8);
}

// Without damping only the spring's kink at touch and separation is left. Inside the contact Verlet
// keeps v^2 + w^2 x^2 (1 - (w dt)^2/4). A contact whose first step ends at the depth a v dt, and
// whose last begins at b v dt, therefore parts with v^2 (1 + (w dt)^2 (b (1 - b) - a (1 - a))): off
// by up to (w dt)^2/8 of the speed, second order. Spheres are in the set: lambda = 1.
TEST_P(RestitutionSweep, ElasticImpactsAreElastic)
{
  const std::string what = GetParam() == Partner::Wall ? "on a wall" : "on a rod";
  // (pi/200)^2/8 = 3.1e-5, and the arm turns by less than 4e-6 in a contact.
  expect_holds({"Elastic impact " + what + ", 5-85 deg, lambda 1-100: restitution", "1", 3.5e-5},
               worst_over_aspect_ratios(GetParam(), 200, {1.0}));
}

// With effective_mass off the dashpot is that of the rods' masses M = m, or m/2 of two, on a contact
// that moves m_eff: damping ratio beta sqrt(M/m_eff), and so
//   e' = exp(-pi z/sqrt(1 - z^2)), z = beta sqrt(M/m_eff), beta = -ln e/sqrt(pi^2 + ln^2 e).
// A long rod that comes down on its end has M/m_eff near 4: e = 0.5 becomes 0.22.
TEST_P(RestitutionSweep, DampedByMassesALongRodHardlyRebounds)
{
  const std::string what = GetParam() == Partner::Wall ? "on a wall" : "on a rod";
  const double pi = std::acos(-1.0);
  double error = 0.0, least = 1.0;
  for (const double aspect_ratio : {1.0, 5.0, 20.0, 100.0}) {
    ImpactSet set;
    set.partner = GetParam();
    set.aspect_ratio = aspect_ratio;
    set.restitutions = {0.5, 0.9};
    set.elevations = {5.0, 25.0, 45.0, 65.0, 85.0};
    set.steps_per_contact = 6400;
    set.keywords = "effective_mass off";
    for (const MeasuredRestitution &m : measure_restitution(set)) {
      const double beta = -std::log(m.restitution) / std::hypot(pi, std::log(m.restitution));
      const double z = beta * std::sqrt(m.mass_ratio);
      const double expected = std::exp(-pi * z / std::sqrt(1.0 - z * z));
      error = std::max(error, std::fabs(m.measured / expected - 1.0));
      if (m.restitution == 0.5) least = std::min(least, expected);
    }
  }
  EXPECT_LT(least, 0.3);
  expect_holds({"effective_mass off, " + what +
                    ", e 0.5-0.9, 5-85 deg, lambda 1-100: restitution, "
                    "relative",
                "exp(-pi z/sqrt(1 - z^2)), z = beta sqrt(M/m_eff)", 1e-3},
               error);
}

INSTANTIATE_TEST_SUITE_P(, RestitutionSweep, testing::Values(Partner::Wall, Partner::Rod),
                         [](const auto &info) {
                           return info.param == Partner::Wall ? "OnAWall" : "OnARod";
                         });

}  // namespace
