// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <type_traits>

#include "contact_model_headers.h"
#include "core/linear_contact.h"

namespace LAMMPS_NS {

// The combinations of models whose contacts can be worked out in batches (core/linear_contact.h).
template <typename ContactModel>
struct BatchedLinear : std::false_type {
  static constexpr spherocylinder::Tangential kTangential = spherocylinder::Tangential::Off;
};
template <int TANGENTIAL>
struct BatchedLinear<LIGGGHTS::ContactModels::ContactModel<LIGGGHTS::ContactModels::GranStyle<
    LIGGGHTS::ContactModels::NORMAL_LINEAR, TANGENTIAL, LIGGGHTS::ContactModels::COHESION_OFF,
    LIGGGHTS::ContactModels::ROLLING_OFF, LIGGGHTS::ContactModels::SURFACE_SPHEROCYLINDER>>> {
  static constexpr bool value = TANGENTIAL == LIGGGHTS::ContactModels::TANGENTIAL_OFF ||
                                TANGENTIAL == LIGGGHTS::ContactModels::TANGENTIAL_NO_HISTORY ||
                                TANGENTIAL == LIGGGHTS::ContactModels::TANGENTIAL_HISTORY;
  static constexpr spherocylinder::Tangential kTangential =
      TANGENTIAL == LIGGGHTS::ContactModels::TANGENTIAL_HISTORY
          ? spherocylinder::Tangential::History
      : TANGENTIAL == LIGGGHTS::ContactModels::TANGENTIAL_NO_HISTORY
          ? spherocylinder::Tangential::NoHistory
          : spherocylinder::Tangential::Off;
};

}  // namespace LAMMPS_NS
