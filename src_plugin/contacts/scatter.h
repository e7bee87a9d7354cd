// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "contacts/contact_batch.h"
#include "contacts/contact_observer.h"

namespace LAMMPS_NS {

class Atom;
class PairGran;

using ContactObservers = std::vector<ContactObserver *>;

// Adds what contacts spread over nearly parallel rods push beside the law's force.
void add_spread(ContactBatch &batch);

// Forces and torques of a batch to the rods: to both of a pair where this rank owns them, relaxed as
// LIGGGHTS's pair style has it; to the rod of a wall.
void scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom);
void scatter_walls(const ContactBatch &batch, Atom &atom);

inline void show(const ContactBatch &batch, const ContactObservers &observers)
{
  for (ContactObserver *observer : observers) observer->see(batch);
}

}  // namespace LAMMPS_NS
