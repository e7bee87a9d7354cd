// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace LAMMPS_NS {

class LAMMPS;

// A fix that wants some ghosts as they are in each step, whether they are near a rod or not. A fix or compute that
// loader/host_checks.cpp does not know, and that is none of these, gets all of them (NeededGhosts).
class GhostUser {
 public:
  virtual ~GhostUser() = default;

  // After LIGGGHTS has chosen ghosts anew, and at any time until it does so again: no others until then.
  virtual void add_used_ghosts(std::vector<int> &ghosts) const = 0;
};

// Of all these fixes.
void add_used_ghosts(LAMMPS *lmp, std::vector<int> &ghosts);

}  // namespace LAMMPS_NS
