// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_law.h"
#include "contacts/linear_keywords.h"
#include "core/linear_contact.h"
#include "pointers.h"

class PropertyRegistry;

namespace LAMMPS_NS {

// Model linear with tangential off, no_history or history, no cohesion and no rolling friction: whole
// batches in vector registers (core/linear_contact.h).
class VectorLaw : public ContactLaw, protected Pointers {
 public:
  explicit VectorLaw(LAMMPS *lmp);

  // After the models have registered their properties. `springs`: where the histories, which then are
  // there, keep the tangential spring of end 0 and 1; -1 for none.
  void connect(PropertyRegistry &registry, spherocylinder::Tangential tangential,
               const LinearKeywords &keywords, const int (&springs)[2]);

  void begin(const LawStep &step) override;
  void evaluate(ContactBatch &batch) override;
  void part(int i, int j, int end, int *flags, double *history) override;
  void end() override {}

 private:
  spherocylinder::LinearLaw law_{};
  spherocylinder::LinearMaterials materials_{};
  bool aspect_scaling_ = false;
  int springs_[2] = {-1, -1};
  int kinds_[spherocylinder::kBatch];  // that materials_ are of

  double **kn_ = nullptr, **kt_ = nullptr, **beta_ = nullptr, **friction_ = nullptr;
  // Of the properties: LIGGGHTS holds those up to the highest type in use on any rank.
  int types_ = 0;
  std::vector<double> seen_;  // all properties, of all pairs of materials

  bool properties_have_changed();
  void set_materials(const ContactBatch &batch, int k);
};

}  // namespace LAMMPS_NS
