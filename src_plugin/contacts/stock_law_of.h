// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's contact models as a law: a batch one contact after the other, each through the record that
// the models are called with.
#pragma once

#include <string>
#include <vector>

#include "atom.h"
#include "contacts/contact_model_headers.h"
#include "contacts/linear_slider.h"
#include "contacts/rod_keywords.h"
#include "contacts/stock_law.h"
#include "core/linear_law.h"
#include "pointers.h"
#include "settings.h"

namespace LAMMPS_NS {

template <typename ContactModel>
class StockLawOf : public StockLaw, private Pointers {
 public:
  using SurfacesIntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;

  template <typename Parent>
  StockLawOf(LAMMPS *lmp, Parent *parent, bool is_wall, int64_t hash)
      : Pointers(lmp),
        is_wall_(is_wall),
        layout_(*parent),
        model_(lmp, &layout_, is_wall, hash),
        slider_(lmp)
  {
    sidata_.is_wall = is_wall_;
    sidata_.area_ratio = 1.0;
    sidata_.v_i = velocity_i_;
    sidata_.v_j = velocity_j_;
  }

  std::string read_keywords(RodKeywords &keywords, std::vector<char *> words) override
  {
    Settings settings(lmp);
    model_.registerSettings(settings);
    keywords.register_settings(settings, is("normal", "linear"));
    const bool understood = settings.parseArguments(static_cast<int>(words.size()), words.data());
    set_up_history();
    return understood ? "" : settings.error_message;
  }

  void set_up_history() override { model_.postSettings(&layout_); }

  void connect(PropertyRegistry &registry, const RodKeywords &keywords) override
  {
    model_.connectToProperties(registry);
    slider_.connect(model_, registry, keywords.linear.limit_tangential_damping);
    has_tangential_ = has_tangential();
    spring_ = spring();
  }

  HistoryLayout &layout() override { return layout_; }
  bool is(const std::string &kind, const std::string &name) override
  {
    return model_.contact_match(kind, name);
  }
  int history_offset(const std::string &name) override { return model_.get_history_offset(name); }
  int64_t hashcode() override { return model_.hashcode(); }
  double stress_strain_exponent() override { return model_.stressStrainExponent(); }

  void begin(const LawStep &step) override;
  void evaluate(ContactBatch &batch) override;
  void contact_ended(int i, int j, int *flags, double *history) override;
  void end() override;

 private:
  const bool is_wall_;
  HistoryLayout layout_;
  ContactModel model_;
  LinearSlider slider_;
  bool has_tangential_ = false;
  int spring_ = -1;
  LawStep step_{};
  SurfacesIntersectData sidata_{};
  ForceData i_forces_, j_forces_;
  double velocity_i_[3], velocity_j_[3];

  void fill(const ContactBatch &batch, int k);
  void set_loads(ContactBatch &batch, int k);
};

template <typename ContactModel>
void StockLawOf<ContactModel>::begin(const LawStep &step)
{
  step_ = step;
  sidata_.computeflag = step.adds_forces;
  sidata_.shearupdate = step.springs_go_on;
  if (!is_wall_) model_.beginPass(sidata_, i_forces_, j_forces_);
}

template <typename ContactModel>
void StockLawOf<ContactModel>::end()
{
  if (!is_wall_) model_.endPass(sidata_, i_forces_, j_forces_);
}

template <typename ContactModel>
void StockLawOf<ContactModel>::contact_ended(int i, int j, int *flags, double *history)
{
  sidata_.i = i;
  sidata_.j = j;
  sidata_.contact_flags = flags;
  sidata_.contact_history = history;
  sidata_.has_force_update = false;
  model_.surfacesClose(sidata_, i_forces_, j_forces_);
  if (flags) *flags = 0;
}

// What LIGGGHTS's models want to know of a contact: two spheres of the rods' radii at the ends of the
// arms.
template <typename ContactModel>
void StockLawOf<ContactModel>::fill(const ContactBatch &batch, int k)
{
  using namespace spherocylinder;
  const ContactArms &arms = batch.arms;
  const int i = batch.i[k], j = batch.j[k];
  sidata_.i = i;
  sidata_.j = is_wall_ ? -batch.type_j[k] : j;  // negative for primitive walls, as in LIGGGHTS
  sidata_.itype = batch.type_i[k];
  sidata_.jtype = batch.type_j[k];
  sidata_.contact_flags = batch.flags[k];
  sidata_.contact_history = batch.history[k];
  sidata_.radi = arms.radius_i[k];
  sidata_.radj = arms.radius_j[k];
  sidata_.radsum = batch.reach(k);
  sidata_.mi = atom->rmass[i];
  sidata_.mj = is_wall_ ? 0.0 : atom->rmass[j];
  sidata_.omega_i = atom->omega[i];
  sidata_.omega_j = is_wall_ ? nullptr : atom->omega[j];
  sidata_.deltan = arms.overlap[k];
  sidata_.r = arms.distance[k];
  sidata_.rsq = sidata_.r * sidata_.r;
  sidata_.rinv = sidata_.r != 0.0 ? 1.0 / sidata_.r : 0.0;
  sidata_.cri = batch.depth_i(k);
  sidata_.crj = is_wall_ ? 0.0 : batch.depth_j(k);
  sidata_.meff = batch.loads.effective_mass[k];
  store(arms.normal.get(k), sidata_.en);
  store(arms.distance[k] * arms.normal.get(k), sidata_.delta);
  sidata_.kn = sidata_.kt = 0.0;  // a stock model need not set them
}

// The models' torques are about the ends of the arms.
template <typename ContactModel>
void StockLawOf<ContactModel>::set_loads(ContactBatch &batch, int k)
{
  using namespace spherocylinder;
  const Vec3 force = load(i_forces_.delta_F);
  const Vec3 arm_i = batch.arms.arm_i.get(k), arm_j = batch.arms.arm_j.get(k);
  batch.loads.force.set(k, force);
  batch.loads.torque_i.set(k, cross(arm_i, force) + load(i_forces_.delta_torque));
  batch.loads.torque_j.set(k, load(j_forces_.delta_torque) - cross(arm_j, force));
  batch.loads.stiffness[k] = sidata_.kn;
  batch.loads.tangential_stiffness[k] = has_tangential_ ? sidata_.kt : 0.0;
}

template <typename ContactModel>
void StockLawOf<ContactModel>::evaluate(ContactBatch &batch)
{
  using namespace spherocylinder;
  ContactArms &arms = batch.arms;
  for (int k = 0; k < batch.count; k++) {
    const ContactPlace place = place_of(arms, k, step_.dt);
    arms.normal.set(k, place.normal);
    arms.distance[k] = place.distance;
    arms.overlap[k] = place.overlap;
    batch.loads.inverse_mass[k] = place.inverse_mass;
    batch.loads.effective_mass[k] = arms.mass_share[k] / place.inverse_mass;
    if (!batch.can_move(k)) continue;
    store(place.velocity_i, velocity_i_);
    store(place.velocity_j, velocity_j_);
    fill(batch, k);

    // The tangential spring turns with the pair about its normal, by the mean of the two spins;
    // LIGGGHTS turns it with the normal only.
    double *spring = batch.history[k] && spring_ >= 0 ? batch.history[k] + spring_ : nullptr;
    if (spring && arms.turning[k] != 0.0 && step_.springs_go_on)
      store(turned_spring(load(spring), place.normal, arms.omega_i.get(k), arms.omega_j.get(k),
                          arms.turning[k], step_.dt),
            spring);
    if (spring) slider_.note_spring(spring);
    i_forces_.reset();
    j_forces_.reset();
    model_.surfacesIntersect(sidata_, i_forces_, j_forces_);
    if (spring) slider_.limit(sidata_, spring, i_forces_, j_forces_);
    model_.endSurfacesIntersect(sidata_, nullptr, i_forces_, j_forces_);
    sidata_.has_force_update = true;
    set_loads(batch, k);
  }
}

}  // namespace LAMMPS_NS
