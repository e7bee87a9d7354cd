// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/vector_law.h"

#include <algorithm>

#include "atom.h"
#include "contacts/contact_model_headers.h"
#include "contacts/rod_kinds.h"
#include "property_registry.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

constexpr Vec3 kZero = {0.0, 0.0, 0.0};

double aspect_ratio(const Atom &atom, int i) { return atom.shape[i][2] / atom.shape[i][0]; }

}  // namespace

VectorLaw::VectorLaw(LAMMPS *lmp) : Pointers(lmp) { std::fill_n(kinds_, kBatch, RodKinds::kNone); }

void VectorLaw::connect(PropertyRegistry &registry, Tangential tangential,
                        const LinearKeywords &keywords, const int (&springs)[2])
{
  registry.connect("k_n", kn_, "model linear");
  registry.connect("k_t", kt_, "model linear");
  registry.connect("betaeff", beta_, "model linear");
  friction_ = nullptr;
  if (tangential != Tangential::Off) registry.connect("coeffFrict", friction_, "model linear");
  types_ = registry.max_type();
  seen_.clear();
  law_.tangential = tangential;
  law_.tangential_damping = keywords.tangential_damping;
  law_.limit_force = keywords.limit_force;
  law_.slider =
      keywords.limit_tangential_damping ? SliderLimits::WholeForce : SliderLimits::SpringAlone;
  aspect_scaling_ = keywords.aspect_scaling;
  std::copy_n(springs, 2, springs_);
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
  law_.dt = step.dt;
  law_.spring_dt = step.springs_go_on ? step.dt : 0.0;
  if (properties_have_changed()) std::fill_n(kinds_, kBatch, RodKinds::kNone);
}

void VectorLaw::set_materials(const ContactBatch &batch, int k)
{
  const int itype = batch.type_i[k], jtype = batch.type_j[k];
  double scale = 1.0;
  if (aspect_scaling_) {
    scale = aspect_ratio(*atom, batch.i[k]);
    if (!batch.is_wall) scale = aspect_ratio_in_series(scale, aspect_ratio(*atom, batch.j[k]));
  }
  materials_.stiffness[k] = scale * kn_[itype][jtype];
  materials_.tangential_stiffness[k] = scale * kt_[itype][jtype];
  materials_.two_beta[k] = -2.0 * beta_[itype][jtype];
  materials_.friction[k] = friction_ ? friction_[itype][jtype] : 0.0;
  kinds_[k] = batch.kind[k];
}

void VectorLaw::evaluate(ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++)
    if (batch.kind[k] == RodKinds::kNone || batch.kind[k] != kinds_[k]) set_materials(batch, k);
  const bool has_springs = springs_[0] >= 0;
  if (has_springs)
    for (int k = 0; k < batch.count; k++)
      materials_.spring.set(k, load(batch.history[k] + springs_[batch.end[k]]));

  linear_contacts(batch.arms, materials_, law_, batch.loads);

  if (has_springs && law_.spring_dt > 0.0)
    for (int k = 0; k < batch.count; k++)
      if (batch.can_move(k))
        store(materials_.spring.get(k), batch.history[k] + springs_[batch.end[k]]);
  if (batch.is_wall) return;
  using namespace LIGGGHTS::ContactModels;
  const int flag = CONTACT_NORMAL_MODEL | (has_springs ? CONTACT_TANGENTIAL_MODEL : 0);
  for (int k = 0; k < batch.count; k++)
    if (batch.flags[k] && batch.can_move(k)) *batch.flags[k] |= flag;
}

void VectorLaw::part(int, int, int end, int *flags, double *history)
{
  if (flags) *flags = 0;
  if (history && springs_[0] >= 0) store(kZero, history + springs_[end]);
}
