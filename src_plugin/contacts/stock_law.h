// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's contact models as a law: a batch one contact after the other, each through the record that
// the models are called with.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "atom.h"
#include "contacts/contact_model_headers.h"
#include "contacts/linear_slider.h"
#include "contacts/rod_keywords.h"
#include "contacts/stock_models.h"
#include "core/linear_law.h"
#include "pointers.h"
#include "settings.h"

namespace LAMMPS_NS {

// The combinations that VectorLaw serves.
template <typename ContactModel>
struct InBatches : std::false_type {
  static constexpr spherocylinder::Tangential kTangential = spherocylinder::Tangential::Off;
};
template <int TANGENTIAL>
struct InBatches<LIGGGHTS::ContactModels::ContactModel<LIGGGHTS::ContactModels::GranStyle<
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

template <typename ContactModel>
class StockLaw : public StockModels, private Pointers {
 public:
  using SurfacesIntersectData = LIGGGHTS::ContactModels::SurfacesIntersectData;
  using ForceData = LIGGGHTS::ContactModels::ForceData;

  // Of a wall the models are there twice, one an end, so that each end has its history.
  template <typename Parent>
  StockLaw(LAMMPS *lmp, Parent *parent, bool is_wall, int64_t hash)
      : Pointers(lmp), is_wall_(is_wall), slider_(lmp)
  {
    for (int end = 0; end < (is_wall ? 2 : 1); end++)
      models_.push_back(std::make_unique<ContactModel>(lmp, parent, is_wall, hash));
  }

  std::string read_keywords(RodKeywords &keywords, std::vector<char *> words,
                            LIGGGHTS::IContactHistorySetup *history) override
  {
    for (auto &model : models_) {
      Settings settings(lmp);
      model->registerSettings(settings);
      keywords.register_settings(settings, model->contact_match("normal", "linear"));
      const bool understood = settings.parseArguments(static_cast<int>(words.size()), words.data());
      model->postSettings(history);
      if (!understood) return settings.error_message;
    }
    return "";
  }

  void set_up_history(LIGGGHTS::IContactHistorySetup *history) override
  {
    for (auto &model : models_) model->postSettings(history);
  }

  void connect(PropertyRegistry &registry, const RodKeywords &keywords,
               const int (&springs)[2]) override
  {
    for (auto &model : models_) model->connectToProperties(registry);
    slider_.connect(*models_[0], registry, keywords.linear.limit_tangential_damping);
    has_tangential_ = has_tangential();
    std::copy_n(springs, 2, springs_);
  }

  bool is(const std::string &kind, const std::string &name) override
  {
    return models_[0]->contact_match(kind, name);
  }
  int history_offset(const std::string &name) override
  {
    return models_[0]->get_history_offset(name);
  }
  int64_t hashcode() override { return models_[0]->hashcode(); }
  double stress_strain_exponent() override { return models_[0]->stressStrainExponent(); }
  std::optional<spherocylinder::Tangential> in_batches() const override
  {
    if (!InBatches<ContactModel>::value) return std::nullopt;
    return InBatches<ContactModel>::kTangential;
  }

  void begin(const LawStep &step) override;
  void evaluate(ContactBatch &batch) override;
  void part(int i, int j, int end, int *flags, double *history) override;
  void end() override;

 private:
  const bool is_wall_;
  std::vector<std::unique_ptr<ContactModel>> models_;  // of each end
  LinearSlider slider_;
  bool has_tangential_ = false;
  int springs_[2] = {-1, -1};
  LawStep step_{};
  SurfacesIntersectData sidata_{};
  ForceData i_forces_, j_forces_;
  double velocity_i_[3], velocity_j_[3];

  void fill(const ContactBatch &batch, int k);
  void set_loads(ContactBatch &batch, int k);
};

template <typename ContactModel>
void StockLaw<ContactModel>::begin(const LawStep &step)
{
  step_ = step;
  sidata_.is_wall = is_wall_;
  sidata_.area_ratio = 1.0;
  sidata_.computeflag = step.adds_forces;
  sidata_.shearupdate = step.springs_go_on;
  sidata_.v_i = velocity_i_;
  sidata_.v_j = velocity_j_;
  if (!is_wall_) models_[0]->beginPass(sidata_, i_forces_, j_forces_);
}

template <typename ContactModel>
void StockLaw<ContactModel>::end()
{
  if (!is_wall_) models_[0]->endPass(sidata_, i_forces_, j_forces_);
}

template <typename ContactModel>
void StockLaw<ContactModel>::part(int i, int j, int end, int *flags, double *history)
{
  sidata_.i = i;
  sidata_.j = j;
  sidata_.contact_flags = flags;
  sidata_.contact_history = history;
  sidata_.has_force_update = false;
  models_[end]->surfacesClose(sidata_, i_forces_, j_forces_);
  if (flags) *flags = 0;
}

// What LIGGGHTS's models want to know of a contact: two spheres of the rods' radii at the ends of the
// arms.
template <typename ContactModel>
void StockLaw<ContactModel>::fill(const ContactBatch &batch, int k)
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
void StockLaw<ContactModel>::set_loads(ContactBatch &batch, int k)
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
void StockLaw<ContactModel>::evaluate(ContactBatch &batch)
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
    const int end = batch.end[k];
    double *spring =
        batch.history[k] && springs_[end] >= 0 ? batch.history[k] + springs_[end] : nullptr;
    if (spring && arms.turning[k] != 0.0 && step_.springs_go_on)
      store(turned_spring(load(spring), place.normal, arms.omega_i.get(k), arms.omega_j.get(k),
                          arms.turning[k], step_.dt),
            spring);
    if (spring) slider_.note_spring(spring);
    i_forces_.reset();
    j_forces_.reset();
    models_[end]->surfacesIntersect(sidata_, i_forces_, j_forces_);
    if (spring) slider_.limit(sidata_, spring, i_forces_, j_forces_);
    models_[end]->endSurfacesIntersect(sidata_, nullptr, i_forces_, j_forces_);
    sidata_.has_force_update = true;
    set_loads(batch, k);
  }
}

}  // namespace LAMMPS_NS
