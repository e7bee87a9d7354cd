// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contacts/contact_batch.h"

namespace LAMMPS_NS {

// What a step asks of a law.
struct LawStep {
  double dt;           // s; a fix may change it during a run
  bool adds_forces;    // else they are only looked at
  bool springs_go_on;  // histories are written
};

// Makes forces of contacts.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  virtual void begin(const LawStep &step) = 0;
  // From the arms, types and histories of a batch its loads; arms as spherocylinder::ContactPlace has
  // them. Histories go on.
  virtual void evaluate(ContactBatch &batch) = 0;
  // Contact of rod i, with rod j or with its end `end` at a wall (j < 0), has ended.
  virtual void part(int i, int j, int end, int *flags, double *history) = 0;
  virtual void end() = 0;
};

}  // namespace LAMMPS_NS
