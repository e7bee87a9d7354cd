// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstring>

#include "settings.h"

namespace LAMMPS_NS {

// Keywords of model linear behind the models' names. LIGGGHTS's reader hands their values to all that
// register them: to the model class, and to the law that works out its contacts in batches.
struct LinearKeywords {
  bool tangential_damping = true;
  bool limit_force = false;
  bool aspect_scaling = false;
  bool limit_tangential_damping = true;  // friction limits spring and dashpot together

  void register_settings(Settings &settings)
  {
    settings.registerOnOff("tangential_damping", tangential_damping, true);
    settings.registerOnOff("limitForce", limit_force, false);
    settings.registerOnOff("aspect_scaling", aspect_scaling, false);
    settings.registerOnOff("limit_tangential_damping", limit_tangential_damping, true);
  }

  static bool has(const char *keyword)
  {
    for (const char *own :
         {"tangential_damping", "limitForce", "aspect_scaling", "limit_tangential_damping"})
      if (strcmp(keyword, own) == 0) return true;
    return false;
  }
};

}  // namespace LAMMPS_NS
