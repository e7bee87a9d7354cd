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

// Makes forces of contacts: between begin and end, of as many batches as the step has. The same law may
// be shown several batches in turn. contact_ended needs neither.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  virtual void begin(const LawStep &step) = 0;
  // From the arms, types and histories of a batch its loads; arms as spherocylinder::ContactPlace has
  // them. Histories go on.
  virtual void evaluate(ContactBatch &batch) = 0;
  // Rod i no longer touches rod j, or the wall where j < 0: its history is forgotten. Flags and history
  // as in ContactBatch.
  virtual void contact_ended(int i, int j, int *flags, double *history) = 0;
  virtual void end() = 0;
};

}  // namespace LAMMPS_NS
