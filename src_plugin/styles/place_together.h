// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

namespace LAMMPS_NS {

class Fix;
class FixParticledistributionDiscrete;
class LAMMPS;
class ParticleToInsertSpherocylinder;

// A try: where a rod or fibre might be, and how it would move there.
struct DrawnPlace {
  double x[3], v[3], omega[3], quat[4];
};

struct PlacingTask {
  FixParticledistributionDiscrete *distribution;
  int wanted;      // this rank's share of rods and fibres
  int most_tries;  // for all of them
  bool keeps_clear;
  // Draws a place with its centre on this rank; false if the one drawn is not.
  std::function<bool(ParticleToInsertSpherocylinder &, DrawnPlace &)> draw;
};

struct PlacingResult {
  int bodies = 0, rods = 0;  // of this rank
  double mass = 0.0;
};

// LIGGGHTS's placing in a simulation with fibres: by all ranks together, so that what is placed may reach
// into any rank's part of the box and across periodic boundaries. Called by all ranks. What is placed comes
// first in the distribution's list afterwards, and fibres have new ids.
PlacingResult place_together(LAMMPS *lmp, const Fix &insertion, const PlacingTask &task);

}  // namespace LAMMPS_NS
