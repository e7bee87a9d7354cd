// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "contacts/contact_law.h"
#include "contacts/rod_keywords.h"
#include "contacts/stock_law.h"
#include "core/linear_contact.h"
#include "pointers.h"

namespace LAMMPS_NS {

// Model linear with tangential off, no_history or history, no cohesion and no rolling friction: whole
// batches in vector registers (core/linear_contact.h).
class VectorLaw : public ContactLaw, protected Pointers {
 public:
  // After the models have registered their properties. `spring`: where the histories, which then are
  // there, keep the tangential spring; -1 for none.
  VectorLaw(LAMMPS *lmp, spherocylinder::Tangential tangential, const LinearKeywords &keywords,
            int spring);

  void begin(const LawStep &step) override;
  void evaluate(ContactBatch &batch) override;
  void contact_ended(int i, int j, int *flags, double *history) override;
  void end() override {}

 private:
  spherocylinder::LinearOptions options_{};
  spherocylinder::LinearMaterials materials_{};
  bool aspect_scaling_;
  int spring_;
  int64_t kinds_[spherocylinder::kBatch];  // that materials_ are of

  double **kn_ = nullptr, **kt_ = nullptr, **beta_ = nullptr, **friction_ = nullptr;
  // Of the properties: LIGGGHTS holds those up to the highest type in use on any rank.
  int types_ = 0;
  std::vector<double> seen_;  // all properties, of all pairs of materials

  bool properties_have_changed();
  void set_materials(const ContactBatch &batch, int k);
};

// It, where it does what the models do; else null.
std::unique_ptr<VectorLaw> vector_law(LAMMPS *lmp, StockLaw &models, const RodKeywords &keywords);

}  // namespace LAMMPS_NS
