// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

class LAMMPS;

// A fix that moves its group's rods by hand, whatever pushes them.
class RodDriver {
 public:
  virtual ~RodDriver() = default;

  // Whether the centres do not give way in any direction.
  virtual bool drives_centres() const = 0;
};

// Groups of all these fixes, whose rods' rotation is prescribed; and of those that drive the centres
// in all directions, too.
int driven_groups(LAMMPS *lmp);
int groups_with_driven_centres(LAMMPS *lmp);

// Groups of all fixes freeze.
int frozen_groups(LAMMPS *lmp);

// Of rods whose centres do not give way: frozen, or driven.
inline int standing_groups(LAMMPS *lmp)
{
  return frozen_groups(lmp) | groups_with_driven_centres(lmp);
}

}  // namespace LAMMPS_NS
