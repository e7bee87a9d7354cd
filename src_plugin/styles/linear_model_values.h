// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/linear_contact.h"

class PropertyRegistry;

namespace LAMMPS_NS {

// What model linear's keywords and material properties come to, for batches of contacts.
struct LinearModelValues {
  spherocylinder::LinearLaw law{spherocylinder::Tangential::Off, true, false,
                                spherocylinder::SliderLimits::WholeForce, 0.0};
  bool aspect_scaling = false;
  bool effective_mass = true;  // of damping: that of the contact, else of the rods' masses

  // Keywords behind the models. False if one of them needs the models themselves.
  bool understand(int nargs, char **args);
  // After the models have registered the properties.
  void connect(PropertyRegistry &registry, spherocylinder::Tangential tangential);
  // Whether a property is another than at the last call: some fix may change it during a run.
  bool have_changed();
  // Of contact k between materials itype and jtype; `scale`: of the stiffness.
  void set(spherocylinder::LinearContacts &contacts, int k, int itype, int jtype,
           double scale) const;

 private:
  double **kn_ = nullptr, **kt_ = nullptr, **beta_ = nullptr, **friction_ = nullptr;
  int types_ = 0;  // of the properties: LIGGGHTS holds those up to the highest type in use on any rank
  std::vector<double> seen_;  // all properties, of all pairs of materials
};

}  // namespace LAMMPS_NS
