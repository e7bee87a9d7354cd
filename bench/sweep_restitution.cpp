// SPDX-License-Identifier: GPL-2.0-or-later
// Restitution of frictionless impacts off the centre, on a wall and of two rods: e 0.1-1.0,
// elevation 5-85 degrees, aspect ratio 1-100, at eight time steps.
//
// A second table says where the error comes from: a single damped oscillator, integrated in the
// same way (kick, drift, force with the velocity of the half step, kick), and with the damping
// force taken from the velocity at the full step instead.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "claim.h"
#include "convergence.h"
#include "off_centre_impact.h"
#include "results_file.h"

using namespace decks;

namespace {

const int kSteps[] = {50, 100, 200, 400, 800, 1600, 3200, 6400};  // of the shortest contact
const double kAspectRatios[] = {1, 2, 3, 5, 10, 20, 30, 60, 100};
const std::vector<double> kRestitutions = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};

ImpactSet impact_set(Partner partner, double aspect_ratio, int steps_per_contact)
{
  ImpactSet set;
  set.partner = partner;
  set.aspect_ratio = aspect_ratio;
  set.restitutions = kRestitutions;
  for (double elevation = 5.0; elevation < 86.0; elevation += 5.0)
    set.elevations.push_back(elevation);
  set.steps_per_contact = steps_per_contact;
  return set;
}

struct Errors {
  double worst = 0.0, sum = 0.0, elevation = 0.0, dt_over_contact = 0.0;
  int count = 0;

  void add(const MeasuredRestitution &m)
  {
    if (!(m.error() <= worst)) {
      worst = m.error();
      elevation = m.elevation;
    }
    dt_over_contact = std::max(dt_over_contact, m.dt_over_contact);
    sum += m.error();
    count++;
  }
  double mean() const { return sum / count; }
};

void sweep(Partner partner, const std::string &name)
{
  ResultsFile csv("restitution_" + name + ".csv",
                  "steps_per_shortest_contact,aspect_ratio,restitution,"
                  "largest_dt_over_contact_time,worst_relative_error,at_elevation_degree,"
                  "mean_relative_error");
  std::vector<double> dt, worst, mean, elastic;
  for (const int steps : kSteps) {
    Errors damped, undamped;
    for (const double aspect_ratio : kAspectRatios) {
      const auto measured = measure_restitution(impact_set(partner, aspect_ratio, steps));
      for (const double e : kRestitutions) {
        Errors row;
        for (const MeasuredRestitution &m : measured)
          if (m.restitution == e) {
            row.add(m);
            (e < 1.0 ? damped : undamped).add(m);
          }
        csv.row("{},{},{},{:.3e},{:.2e},{},{:.2e}", steps, aspect_ratio, e, row.dt_over_contact,
                row.worst, row.elevation, row.mean());
      }
    }
    fmt::print("{:<5} {:>5} steps a contact: e < 1: worst {:.1e}, mean {:.1e}; e = 1: worst "
               "{:.1e}\n",
               name, steps, damped.worst, damped.mean(), undamped.worst);
    std::fflush(stdout);
    dt.push_back(1.0 / steps);
    worst.push_back(damped.worst);
    mean.push_back(damped.mean());
    elastic.push_back(undamped.worst);
  }
  fmt::print("{}: order in dt: worst {:.2f}, mean {:.2f}\n", name, order_of_convergence(dt, worst),
             order_of_convergence(dt, mean));
  expect_holds({"Restitution off the centre, " + name + ", relative", "e", 1e-3}, worst.back());
  expect_holds({"Elastic impact off the centre, " + name + ", relative", "1", 1e-4},
               elastic.back());
}

// What x'' = -x - 2 beta x' (x < 0) makes of v = -1 that starts `phase` + 2 steps before x = 0.
double restitution_of_scheme(double restitution, double dt, double phase, bool half_step_velocity)
{
  const double beta = -std::log(restitution) / std::hypot(std::acos(-1.0), std::log(restitution));
  double x = (2.0 + phase) * dt, v = -1.0, force = 0.0;
  for (bool touched = false;;) {
    const double v_half = v + 0.5 * dt * force;
    x += dt * v_half;
    if (x >= 0.0 && touched) return v_half;
    if (x >= 0.0) continue;
    touched = true;
    v = half_step_velocity ? v_half + 0.5 * dt * (-x - 2.0 * beta * v_half)
                           : (v_half - 0.5 * dt * x) / (1.0 + dt * beta);
    force = -x - 2.0 * beta * (half_step_velocity ? v_half : v);
  }
}

}  // namespace

TEST(SweepRestitution, OnAWall) { sweep(Partner::Wall, "wall"); }
TEST(SweepRestitution, OfTwoRods) { sweep(Partner::Rod, "rods"); }

TEST(SweepRestitution, OfOneOscillatorInTheSameScheme)
{
  ResultsFile csv("restitution_of_the_scheme.csv",
                  "whole_steps_per_undamped_contact,restitution,damping_velocity,"
                  "worst_relative_error,mean_signed_relative_error");
  const double pi = std::acos(-1.0);
  // Not a whole number of steps a contact: entry and exit would miss the spring's kink alike.
  for (const bool half : {true, false})
    for (const int steps : kSteps)
      for (const double e : {0.1, 0.5, 0.9, 1.0}) {
        double worst = 0.0, sum = 0.0;
        constexpr int kPhases = 100;
        for (int k = 0; k < kPhases; k++) {
          const double error =
              restitution_of_scheme(e, pi / (steps + 0.37), (k + 0.5) / kPhases, half) / e - 1.0;
          worst = std::max(worst, std::fabs(error));
          sum += error;
        }
        csv.row("{},{},{},{:.2e},{:.2e}", steps, e, half ? "half_step" : "full_step", worst,
                sum / kPhases);
      }
}
