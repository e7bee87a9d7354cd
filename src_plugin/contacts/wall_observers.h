// SPDX-License-Identifier: GPL-2.0-or-later
// What LIGGGHTS's fix wall/gran keeps of its contacts.
#pragma once

#include "contacts/contact_observer.h"
#include "pointers.h"

namespace LAMMPS_NS {

class FixWallGran;

// Each rod's whole load at the wall: keywords store_force,
// store_force_contact and ..._stress. Both ends of a rod must be in one batch.
class WallLoads : public ContactObserver, private Pointers {
 public:
  WallLoads(LAMMPS *lmp, FixWallGran &fix) : Pointers(lmp), fix_(fix) {}
  void see(const ContactBatch &batch) override;

 private:
  FixWallGran &fix_;
};

// Heat through a wall's contacts.
class WallHeat : public ContactObserver {
 public:
  explicit WallHeat(FixWallGran &fix) : fix_(fix) {}
  void see(const ContactBatch &batch) override;

 private:
  FixWallGran &fix_;
};

}  // namespace LAMMPS_NS
