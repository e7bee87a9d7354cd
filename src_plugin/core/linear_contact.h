// SPDX-License-Identifier: GPL-2.0-or-later
// Spring, dashpot and slider between two rods, for a batch of contacts: what model linear with
// tangential off, no_history or history makes of them, without a call a contact.
#pragma once

#include "core/contact_arms.h"
#include "core/linear_law.h"

namespace spherocylinder {

enum class Tangential { Off, NoHistory, History };

struct LinearOptions {
  Tangential tangential;
  bool tangential_damping;
  bool limit_force;     // the normal force does not pull
  SliderLimits slider;  // of Tangential::History
  double dt;            // s
  double spring_dt;     // s, by which springs go on: dt, or 0 where forces are worked out once more
};

// Of each contact.
struct LinearMaterials {
  Doubles stiffness, tangential_stiffness;  // N/m
  Doubles two_beta;                         // damping 2 beta sqrt(k m_eff)
  Doubles friction;
  Vec3s spring;  // m, in and out
};

// Works out all kBatch contacts; those that were not set are of no meaning. Normal, distance and overlap
// come out as ContactPlace has them.
void linear_contacts(ContactArms &arms, LinearMaterials &materials, const LinearOptions &law,
                     ContactLoads &loads);

}  // namespace spherocylinder
