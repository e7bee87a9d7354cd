// SPDX-License-Identifier: GPL-2.0-or-later
// Frictionless impacts off the centre, many in one deck, and the restitution each shows.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace decks {

enum class Partner { Wall, Rod };

struct ImpactSet {
  Partner partner = Partner::Wall;
  double aspect_ratio = 10.0;
  std::vector<double> restitutions;
  std::vector<double> elevations;  // of the rod that comes down on one end, degrees
  int steps_per_contact = 800;     // of the shortest contact of the set
  std::string keywords;            // of pair style and wall
};

struct MeasuredRestitution {
  double restitution = 0.0;      // wanted
  double elevation = 0.0;        // degrees
  double dt_over_contact = 0.0;  // time step / duration of this contact
  double measured = 0.0;         // normal velocity of the contact point after / before
  double mass_ratio = 1.0;       // rods' mass (m, or m/2 of two) / effective mass at the contact
  double error() const;          // |measured - wanted| / wanted
};

// All pairs (restitution, elevation) of the set in one run with model linear, after their first
// separation.
//
// A rod comes down on its lower end: on a floor, or across a horizontal rod at 0.7 of its half
// cylinder. The closed form m_eff = 1/(sum 1/m + |a x n|^2/I_t) with a fixed arm holds for an
// impact so slow that nothing turns while it lasts: at 1e-5 m/s and 1e4 N/m the rods turn by less
// than 4e-6 rad. Each rod touches at another fraction of a time step.
std::vector<MeasuredRestitution> measure_restitution(const ImpactSet &set);

// The largest error of a set of measurements, not a number if one is.
double worst_error(const std::vector<MeasuredRestitution> &measured);

}  // namespace decks
