// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_interface.h"
#include "core/linear_law.h"
#include "pointers.h"
#include "property_registry.h"
#include "update.h"

namespace LAMMPS_NS {

// Where single contacts are worked out by LIGGGHTS's models one after the other, model linear with
// tangential history: LIGGGHTS's tangential model limits its spring alone, and this makes of its
// force what model linear wants (spherocylinder::SliderLimits), as VectorLaw does by itself.
class LinearSlider : protected Pointers {
 public:
  explicit LinearSlider(LAMMPS *lmp) : Pointers(lmp) {}

  // After the models have registered the properties.
  template <typename ContactModel>
  void connect(ContactModel &model, PropertyRegistry &registry, bool limits_whole)
  {
    active_ = limits_whole && model.contact_match("normal", "linear") &&
              model.contact_match("tangential", "history");
    if (active_) registry.connect("coeffFrict", friction_, "model linear");
  }

  // Before the models see the contact whose tangential spring is at `spring`.
  void note_spring(const double *spring)
  {
    if (active_) spring_ = spherocylinder::load(spring);
  }

  // After they have: forces and torques (about the points on the axes) of the two and the spring.
  void limit(const LIGGGHTS::ContactModels::SurfacesIntersectData &sidata, double *spring,
             LIGGGHTS::ContactModels::ForceData &i_forces,
             LIGGGHTS::ContactModels::ForceData &j_forces) const
  {
    using namespace spherocylinder;
    if (!active_) return;
    const Vec3 slip = {sidata.vtr1, sidata.vtr2, sidata.vtr3}, n = load(sidata.en);
    const bool updating = sidata.computeflag && sidata.shearupdate;
    const double most = friction_[sidata.itype][sidata.jtype] * std::fabs(sidata.Fn);
    Vec3 ours = updating ? loaded_spring(spring_, slip, n, update->dt) : spring_, theirs = ours;
    const Vec3 wanted =
        sliding_force<SliderLimits::WholeForce>(ours, slip, sidata.kt, sidata.gammat, most);
    const Vec3 there =
        sliding_force<SliderLimits::SpringAlone>(theirs, slip, sidata.kt, sidata.gammat, most);
    if (updating) store(ours, spring);
    const Vec3 change = wanted - there, twist = cross(n, change);
    add_to(i_forces.delta_F, change);
    add_to(i_forces.delta_torque, -sidata.cri * twist);
    if (sidata.is_wall) return;
    add_to(j_forces.delta_F, -change);
    add_to(j_forces.delta_torque, -sidata.crj * twist);
  }

 private:
  bool active_ = false;
  double **friction_ = nullptr;
  spherocylinder::Vec3 spring_{0.0, 0.0, 0.0};
};

}  // namespace LAMMPS_NS
