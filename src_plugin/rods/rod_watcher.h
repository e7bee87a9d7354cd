// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

// Told by the rods' atom style what happens to all rods at once.
class RodWatcher {
 public:
  virtual ~RodWatcher() = default;

  // At the start of each run, by all ranks.
  virtual void run_begins() = 0;

  // Rods are about to take other places in memory, or a new one that of a ghost.
  virtual void places_change() = 0;

  // By all ranks, also within a run: rods are about to be written to a restart file.
  virtual void rods_are_written() = 0;

  // By all ranks, before rods go from rank to rank: box and cuts are new, histories with their rods.
  virtual void rods_migrate() = 0;
};

}  // namespace LAMMPS_NS
