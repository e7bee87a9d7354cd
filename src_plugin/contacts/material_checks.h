// SPDX-License-Identifier: GPL-2.0-or-later
// What contact models take for granted of a deck's materials.
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// LIGGGHTS's property matrices end at the highest type that was in use when the run began.
void check_types_have_properties(LAMMPS *lmp, int highest);

// Of contact models with a tangential force: friction would push with a coefficient < 0.
void check_friction(LAMMPS *lmp);

}  // namespace LAMMPS_NS
