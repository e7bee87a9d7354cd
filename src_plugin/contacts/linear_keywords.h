// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contacts/on_off_keywords.h"

namespace LAMMPS_NS {

// Keywords of model linear behind the models' names. LIGGGHTS's reader hands their values to all that
// register them: to the model class, and to the law that works out its contacts in batches.
struct LinearKeywords {
  bool tangential_damping;
  bool limit_force;
  bool aspect_scaling;
  bool limit_tangential_damping;  // friction limits spring and dashpot together

  static const OnOffKeyword<LinearKeywords> kOnOff[4];
};

inline constexpr OnOffKeyword<LinearKeywords> LinearKeywords::kOnOff[4] = {
    {"tangential_damping", &LinearKeywords::tangential_damping, true},
    {"limitForce", &LinearKeywords::limit_force, false},
    {"aspect_scaling", &LinearKeywords::aspect_scaling, false},
    {"limit_tangential_damping", &LinearKeywords::limit_tangential_damping, true},
};

}  // namespace LAMMPS_NS
