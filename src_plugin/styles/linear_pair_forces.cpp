// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear_pair_forces.h"

#include <cstring>

#include "contact_model_headers.h"
#include "property_registry.h"
#include "update.h"

using namespace LAMMPS_NS;
using spherocylinder::Tangential;

bool LinearPairForces::understand(int nargs, char **args)
{
  law_.tangential_damping = true;
  law_.limit_force = aspect_scaling_ = false;
  for (int k = 0; k + 1 < nargs; k += 2) {
    const bool on = strcmp(args[k + 1], "on") == 0;
    if (strcmp(args[k], "tangential_damping") == 0)
      law_.tangential_damping = on;
    else if (strcmp(args[k], "limitForce") == 0)
      law_.limit_force = on;
    else if (strcmp(args[k], "aspect_scaling") == 0)
      aspect_scaling_ = on;
    else if (strcmp(args[k], "spread_contact") != 0)
      return false;
  }
  return true;
}

// The models have registered the properties.
void LinearPairForces::connect(PropertyRegistry &registry, Tangential tangential)
{
  registry.connect("k_n", kn_, "model linear");
  registry.connect("k_t", kt_, "model linear");
  registry.connect("betaeff", beta_, "model linear");
  friction_ = nullptr;
  if (tangential != Tangential::Off) registry.connect("coeffFrict", friction_, "model linear");
  law_.tangential = tangential;
  law_.dt = update->dt;
}
