// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contacts/contact_batch.h"

namespace LAMMPS_NS {

class Atom;
class PairGran;

// Forces and torques of a batch to the rods: to both of a pair where this rank owns them, relaxed as
// LIGGGHTS's pair style has it; to the rod of a wall.
void scatter_pairs(const ContactBatch &batch, PairGran &pair, Atom &atom);
void scatter_walls(const ContactBatch &batch, Atom &atom);

}  // namespace LAMMPS_NS
