// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/vector_law.h"

#include <algorithm>
#include <utility>

#include "contacts/aspect_scale.h"
#include "contacts/contact_model_headers.h"
#include "contacts/rod_kinds.h"
#include "force.h"
#include "property_registry.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

constexpr int64_t kNotKnown = -2;  // what no contact has
static_assert(kNotKnown != RodKinds::kNone);

}  // namespace

VectorLaw::VectorLaw(LAMMPS *lmp, Tangential tangential, const LinearKeywords &keywords, int spring)
    : Pointers(lmp), aspect_scaling_(keywords.aspect_scaling), spring_(spring)
{
  PropertyRegistry &registry = force->registry;
  registry.connect("k_n", kn_, "model linear");
  registry.connect("k_t", kt_, "model linear");
  registry.connect("betaeff", beta_, "model linear");
  if (tangential != Tangential::Off) registry.connect("coeffFrict", friction_, "model linear");
  types_ = registry.max_type();
  options_.tangential = tangential;
  options_.tangential_damping = keywords.tangential_damping;
  options_.limit_force = keywords.limit_force;
  options_.slider =
      keywords.limit_tangential_damping ? SliderLimits::WholeForce : SliderLimits::SpringAlone;
  std::fill_n(kinds_, kBatch, kNotKnown);
}

std::unique_ptr<VectorLaw> LAMMPS_NS::vector_law(LAMMPS *lmp, StockLaw &models,
                                                 const RodKeywords &keywords)
{
  if (!models.is("normal", "linear") || !models.is("cohesion", "off") ||
      !models.is("rolling_friction", "off") || !keywords.are_all_of_rods)
    return nullptr;
  for (const auto &[name, tangential] :
       {std::pair("off", Tangential::Off), std::pair("no_history", Tangential::NoHistory),
        std::pair("history", Tangential::History)})
    if (models.is("tangential", name))
      return std::make_unique<VectorLaw>(lmp, tangential, keywords.linear, models.spring());
  return nullptr;
}

// Some fix may change a property during a run.
bool VectorLaw::properties_have_changed()
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

void VectorLaw::begin(const LawStep &step)
{
  options_.dt = step.dt;
  options_.spring_dt = step.springs_go_on ? step.dt : 0.0;
  if (properties_have_changed()) std::fill_n(kinds_, kBatch, kNotKnown);
}

void VectorLaw::set_materials(const ContactBatch &batch, int k)
{
  const int itype = batch.type_i[k], jtype = batch.type_j[k];
  const double scale = aspect_scaling_ ? aspect_scale(*atom, batch.i[k], batch.j[k]) : 1.0;
  materials_.stiffness[k] = scale * kn_[itype][jtype];
  materials_.tangential_stiffness[k] = scale * kt_[itype][jtype];
  materials_.two_beta[k] = -2.0 * beta_[itype][jtype];
  materials_.friction[k] = friction_ ? friction_[itype][jtype] : 0.0;
  kinds_[k] = batch.kind[k] == RodKinds::kNone ? kNotKnown : batch.kind[k];
}

void VectorLaw::evaluate(ContactBatch &batch)
{
  if (any_differs(batch.kind, kinds_, batch.count))
    for (int k = 0; k < batch.count; k++)
      if (batch.kind[k] != kinds_[k]) set_materials(batch, k);
  const bool has_springs = spring_ >= 0;
  if (has_springs)
    for (int k = 0; k < batch.count; k++)
      materials_.spring.set(k, load(batch.history[k] + spring_));

  linear_contacts(batch.arms, materials_, options_, batch.loads);

  if (has_springs && options_.spring_dt > 0.0)
    for (int k = 0; k < batch.count; k++)
      if (batch.can_move(k)) store(materials_.spring.get(k), batch.history[k] + spring_);
  if (batch.is_wall) return;
  using namespace LIGGGHTS::ContactModels;
  const int flag = CONTACT_NORMAL_MODEL | (has_springs ? CONTACT_TANGENTIAL_MODEL : 0);
  for (int k = 0; k < batch.count; k++)
    if (batch.flags[k] && batch.can_move(k)) *batch.flags[k] |= flag;
}

void VectorLaw::contact_ended(int, int, int *flags, double *history)
{
  if (flags) *flags = 0;
  if (history && spring_ >= 0) store(kZero, history + spring_);
}
