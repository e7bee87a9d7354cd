// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// Hands rods that belong further away than to the next rank to their ranks. Comm::exchange, which
// goes on from here, knows neighbouring ranks only and would lose them without a word: where a
// subdomain is thinner than the way of a rod between two rebuilds, where the cuts have moved, or
// the faces of a shrink-wrapped box. Called by all ranks, periodic boundaries enforced, data of
// fixes with their rods.
void hand_over_far_rods(LAMMPS *lmp);

}  // namespace LAMMPS_NS
