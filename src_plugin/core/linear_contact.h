// SPDX-License-Identifier: GPL-2.0-or-later
// Spring, dashpot and slider between two rods, for a batch of contacts: what model linear with
// tangential off, no_history or history makes of them, without a call a contact.
#pragma once

#include "batch.h"
#include "linear_law.h"

namespace spherocylinder {

enum class Tangential { Off, NoHistory, History };

struct LinearLaw {
  Tangential tangential;
  bool tangential_damping;
  bool limit_force;     // the normal force does not pull
  SliderLimits slider;  // of Tangential::History
  double dt;            // s
};

// Space frame, SI units. i and j are the two rods of a contact.
struct LinearContacts {
  // In. Of each rod:
  Vec3s axis_i, axis_j;          // unit
  Vec3s velocity_i, velocity_j;  // of its centre
  Vec3s omega_i, omega_j;
  Doubles inverse_mass_i, inverse_mass_j;
  Doubles inverse_inertia_i, inverse_inertia_j;  // transverse
  Doubles radius_i, radius_j;
  // Of each contact:
  Doubles s, t;                     // where on the axes it sits
  Vec3s normal;                     // unit, along p - q
  Doubles distance;                 // of p and q along it
  Doubles overlap;                  // that it feels
  Doubles stiffness, tangential_stiffness;
  Doubles share;                    // of the stiffness that it is worth, see RodContact
  Doubles two_beta;                 // damping 2 beta sqrt(k share m_eff)
  Doubles friction;
  Doubles turning;                  // 1 if the spring turns with the pair about its normal, else 0
  // History, in and out: the normal of the last step (zero for a new contact), the spring (m).
  Vec3s side, spring;

  // Out.
  Vec3s force;                // on rod i; rod j feels its opposite
  Vec3s torque_i, torque_j;   // about the rods' centres
  Doubles inverse_mass;       // 1/m_eff; 0 if neither rod can move, and the force is then not a number
  Doubles effective_mass;     // share m_eff, of the damping
};

// Works out all kBatch contacts; those that were not set are of no meaning.
void linear_contacts(LinearContacts &contacts, const LinearLaw &law);

}  // namespace spherocylinder
