// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_VELOCITY_OF_RODS_H
#define LMP_VELOCITY_OF_RODS_H

#include "velocity.h"

namespace LAMMPS_NS {

// Command velocity of decks with rods: LIGGGHTS's own, after which angular momentum and angular
// velocity of each rod agree (setAngular writes the one, zero angularIndividual the
// other).
//
// The name of the command is LIGGGHTS's; the loader runs this class for rods.
class VelocityOfRods : protected Velocity {
 public:
  explicit VelocityOfRods(LAMMPS *lmp) : Velocity(lmp) {}
  void command(int narg, char **arg);

 private:
  void check_rods_have_inertia();
  void match_angular_momentum();
  void match_omega();
};

}  // namespace LAMMPS_NS

#endif
