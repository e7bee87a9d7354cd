// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/contact_kinematics.h"
#include "core/linear_contact.h"
#include "pointers.h"
#include "rod_contact.h"
#include "touching_rod_pairs.h"

class PropertyRegistry;

namespace LAMMPS_NS {

class PairGran;

// What a contact needs of a rod's motion.
struct RodMotion {
  spherocylinder::Vec3 velocity, omega;
  spherocylinder::InverseInertia inverse;  // zero for a frozen rod
};

// Where a pair's history keeps the remembered normal and the tangential spring, -1 if it does not.
struct HistoryOffsets {
  int side, spring;
};

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

  // Adds the forces and torques of all touching pairs to their rods, and keeps the histories.
  void compute(PairGran &pair, const TouchingRodPairs &pairs,
               const std::vector<spherocylinder::Capsule> &rods,
               const std::vector<RodMotion> &motions, HistoryOffsets offsets, bool spread,
               ContactMonitor &monitor);

 private:
  spherocylinder::LinearLaw law_{spherocylinder::Tangential::Off, true, false, 0.0};
  bool aspect_scaling_ = false;
  double **kn_ = nullptr, **kt_ = nullptr, **beta_ = nullptr, **friction_ = nullptr;
  spherocylinder::LinearContacts contacts_{};

  // Stiffness, damping and friction of contact k. `scale`: 1 or, with aspect_scaling, the harmonic
  // mean of the aspect ratios.
  void set_material(spherocylinder::LinearContacts &contacts, int k, int itype, int jtype,
                    double scale) const
  {
    contacts.stiffness[k] = scale * kn_[itype][jtype];
    contacts.tangential_stiffness[k] = scale * kt_[itype][jtype];
    contacts.two_beta[k] = -2.0 * beta_[itype][jtype];
    contacts.friction[k] = friction_ ? friction_[itype][jtype] : 0.0;
  }
};

}  // namespace LAMMPS_NS
