// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/linear_keywords.h"

namespace LAMMPS_NS {

class LAMMPS;

// Keywords behind the models' names that surface spherocylinder brings, of a pair style or a wall. (A
// wall may be given the pair style's, too.)
class RodKeywords {
 public:
  bool spread_contact = true;   // continuous rule for nearly parallel rods
  bool effective_mass = true;   // of damping: that of the contact, else of the rods' masses
  bool sudden_overlap = false;  // allowed
  double close_skin = 0.0;      // of the close pairs (m), 0: chosen automatically
  bool five_step = false;       // search five_step
  int threads = 0;              // of a rank, 0: as many as OMP_NUM_THREADS says
  bool all_ghosts = false;      // sent in each step
  LinearKeywords linear{};      // of model linear
  bool are_all_of_rods = true;  // none of another model was given

  static const OnOffKeyword<RodKeywords> kOnOff[3];

  // Takes those whose value is no on or off, and returns the words that are left for LIGGGHTS's reader.
  std::vector<char *> take_from(LAMMPS *lmp, int nargs, char **args);
  // The others, for that reader.
  void register_settings(Settings &settings, bool is_linear);
};

inline constexpr OnOffKeyword<RodKeywords> RodKeywords::kOnOff[3] = {
    {"spread_contact", &RodKeywords::spread_contact, true},
    {"effective_mass", &RodKeywords::effective_mass, true},
    {"sudden_overlap", &RodKeywords::sudden_overlap, false},
};

}  // namespace LAMMPS_NS
