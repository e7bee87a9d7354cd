// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear_model_values.h"

#include <cstring>

#include "contact_model_headers.h"
#include "linear_slider.h"
#include "property_registry.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

bool LinearModelValues::understand(int nargs, char **args)
{
  law.tangential_damping = true;
  law.limit_force = aspect_scaling = false;
  effective_mass = true;
  law.slider = SliderLimits::WholeForce;
  for (int k = 0; k + 1 < nargs; k += 2) {
    const bool on = strcmp(args[k + 1], "on") == 0;
    if (strcmp(args[k], "tangential_damping") == 0)
      law.tangential_damping = on;
    else if (strcmp(args[k], "limitForce") == 0)
      law.limit_force = on;
    else if (strcmp(args[k], kLimitTangentialDamping) == 0)
      law.slider = on ? SliderLimits::WholeForce : SliderLimits::SpringAlone;
    else if (strcmp(args[k], "aspect_scaling") == 0)
      aspect_scaling = on;
    else if (strcmp(args[k], "effective_mass") == 0)
      effective_mass = on;
    else if (strcmp(args[k], "spread_contact") != 0 && strcmp(args[k], "sudden_overlap") != 0)
      return false;
  }
  return true;
}

void LinearModelValues::connect(PropertyRegistry &registry, Tangential tangential)
{
  registry.connect("k_n", kn_, "model linear");
  registry.connect("k_t", kt_, "model linear");
  registry.connect("betaeff", beta_, "model linear");
  friction_ = nullptr;
  if (tangential != Tangential::Off) registry.connect("coeffFrict", friction_, "model linear");
  law.tangential = tangential;
  types_ = registry.max_type();
}

bool LinearModelValues::have_changed()
{
  double **const properties[] = {kn_, kt_, beta_, friction_};
  const size_t values = 4 * static_cast<size_t>(types_) * types_;
  bool changed = seen_.size() != values;
  seen_.resize(values);
  double *seen = seen_.data();
  for (double **property : properties)
    for (int i = 1; i <= types_; i++)
      for (int j = 1; j <= types_; j++, seen++) {
        const double now = property ? property[i][j] : 0.0;
        changed |= *seen != now;
        *seen = now;
      }
  return changed;
}

void LinearModelValues::set(LinearContacts &contacts, int k, int itype, int jtype,
                            double scale) const
{
  contacts.stiffness[k] = scale * kn_[itype][jtype];
  contacts.tangential_stiffness[k] = scale * kt_[itype][jtype];
  contacts.two_beta[k] = -2.0 * beta_[itype][jtype];
  contacts.friction[k] = friction_ ? friction_[itype][jtype] : 0.0;
}
