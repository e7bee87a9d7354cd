// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_DISPLACE_RODS_H
#define LMP_DISPLACE_RODS_H

#include "core/rotation.h"
#include "displace_atoms.h"

namespace LAMMPS_NS {

// Command displace_atoms of decks with rods: LIGGGHTS's own, and under `rotate` the axes and angular
// velocities turn with the centres.
//
// The name of the command is LIGGGHTS's; the loader runs this class for rods.
class DisplaceRods : protected DisplaceAtoms {
 public:
  explicit DisplaceRods(LAMMPS *lmp) : DisplaceAtoms(lmp) {}
  void command(int narg, char **arg);

 private:
  void check_nothing_drives(int groupbit, const char *group_name);
  void check_nothing_left();
  void turn_rods(int groupbit, char **arg);
  void turn_springs(int groupbit, const spherocylinder::Quaternion &rotation);
};

}  // namespace LAMMPS_NS

#endif
