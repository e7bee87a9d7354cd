// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(nve/spherocylinder, FixNVESpherocylinder)

#else

#ifndef LMP_FIX_NVE_SPHEROCYLINDER_H
#define LMP_FIX_NVE_SPHEROCYLINDER_H

#include "core/rotation_batch.h"
#include "fix_nve.h"

namespace LAMMPS_NS {

class RodThreads;

// Velocity-Verlet translation, and rotation as half kick of the angular momentum, exact free
// rotation of a symmetric top, half kick. For comparison, rotation by core/plain_rotation.h.
class FixNVESpherocylinder : public FixNVE {
 public:
  FixNVESpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;

 private:
  bool plain_ = false;  // rotation plain
  const RodThreads *threads_ = nullptr;

  // Rods of one thread.
  struct Batch {
    spherocylinder::RodRotations rotations{};
    int rods[spherocylinder::kBatch];
    int count = 0;
  };
  template <typename Move, typename Finish>
  void for_each_batch(Move move, Finish finish);
  void rotate_one(int i);
  void half_step_plainly(bool drift);
  void move_plainly(int i, bool drift);
};

}  // namespace LAMMPS_NS

#endif
#endif
