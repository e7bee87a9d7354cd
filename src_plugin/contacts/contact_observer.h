// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contacts/contact_batch.h"

namespace LAMMPS_NS {

// Sees every contact of a step once its forces are known, whatever law made them.
class ContactObserver {
 public:
  virtual ~ContactObserver() = default;
  virtual void see(const ContactBatch &batch) = 0;
};

}  // namespace LAMMPS_NS
