// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class AtomVec;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace spherocylinder {

// Adds this plug-in's fixes, computes and commands to one LAMMPS object, and its contact models to the
// process. They are gone with the object, so `clear` asks for them again.
void add_styles(LAMMPS_NS::LAMMPS *lmp);

// The atom style of that name if it is one of ours, null otherwise.
LAMMPS_NS::AtomVec *create_atom_style(const char *name, LAMMPS_NS::LAMMPS *lmp);

// One line: name, version, styles.
const char *banner();

}  // namespace spherocylinder
