// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_batch.h"

namespace LAMMPS_NS {

// Sees every contact of a step once its forces are known, whatever law made them.
class ContactObserver {
 public:
  virtual ~ContactObserver() = default;
  virtual void see(const ContactBatch &batch) = 0;
};

using ContactObservers = std::vector<ContactObserver *>;

inline void show(const ContactBatch &batch, const ContactObservers &observers)
{
  for (ContactObserver *observer : observers) observer->see(batch);
}

}  // namespace LAMMPS_NS
