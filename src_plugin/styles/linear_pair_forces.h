// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/linear_contact.h"
#include "pointers.h"

class PropertyRegistry;

namespace LAMMPS_NS {

// What model linear's keywords and properties come to, for the batched contact loop.
//
// LIGGGHTS's contact models are called once a contact, each through a common record. For the
// combination most decks with rods use (linear; tangential off, no_history or history; no cohesion,
// no rolling friction) the same forces are worked out in batches instead (core/linear_contact.h).
// The models themselves remain in charge of settings, history and material properties, and of every
// step in which some other command wants to see single contacts.
class LinearPairForces : protected Pointers {
 public:
  explicit LinearPairForces(LAMMPS *lmp) : Pointers(lmp) {}

  // Keywords of pair_style gran behind the models. False if one of them needs the models' own loop.
  bool understand(int nargs, char **args);
  void connect(PropertyRegistry &registry, spherocylinder::Tangential tangential);

  const spherocylinder::LinearLaw &law() const { return law_; }

  // Sets stiffness, damping and friction of contact k. `scale`: 1 or, with aspect_scaling, the
  // harmonic mean of the aspect ratios.
  void set_material(spherocylinder::LinearContacts &contacts, int k, int itype, int jtype,
                    double scale) const
  {
    contacts.stiffness[k] = scale * kn_[itype][jtype];
    contacts.tangential_stiffness[k] = scale * kt_[itype][jtype];
    contacts.two_beta[k] = -2.0 * beta_[itype][jtype];
    contacts.friction[k] = friction_ ? friction_[itype][jtype] : 0.0;
  }
  bool aspect_scaling() const { return aspect_scaling_; }

 private:
  spherocylinder::LinearLaw law_{spherocylinder::Tangential::Off, true, false, 0.0};
  bool aspect_scaling_ = false;
  double **kn_ = nullptr, **kt_ = nullptr, **beta_ = nullptr, **friction_ = nullptr;
};

}  // namespace LAMMPS_NS
