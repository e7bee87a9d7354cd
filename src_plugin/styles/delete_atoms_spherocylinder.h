// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_DELETE_ATOMS_SPHEROCYLINDER_H
#define LMP_DELETE_ATOMS_SPHEROCYLINDER_H

#include "pointers.h"

namespace LAMMPS_NS {

// delete_atoms of decks with rods: LIGGGHTS's own, after which contact histories know the rods that
// are left by the ids they then have.
//
// The style name is LIGGGHTS's; the loader runs this class for rods and LIGGGHTS's own for
// everything else.
class DeleteAtomsSpherocylinder : protected Pointers {
 public:
  explicit DeleteAtomsSpherocylinder(LAMMPS *lmp) : Pointers(lmp) {}
  void command(int narg, char **arg);

 private:
  bool compresses(int narg, char **arg) const;
};

}  // namespace LAMMPS_NS

#endif
