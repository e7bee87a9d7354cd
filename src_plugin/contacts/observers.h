// SPDX-License-Identifier: GPL-2.0-or-later
// What stock commands, fixes and computes ask of pair and wall contacts.
#pragma once

#include "contacts/contact_observer.h"
#include "pointers.h"

namespace LAMMPS_NS {

struct ContactRates;
class ContactRows;
class FixWallGran;
class PairGran;

// The virial of a rigid body takes the distance of the centres, not of the contact points.
class PairVirial : public ContactObserver, private Pointers {
 public:
  PairVirial(LAMMPS *lmp, PairGran &pair) : Pointers(lmp), pair_(pair) {}
  void see(const ContactBatch &batch) override;

 private:
  PairGran &pair_;
};

// Sums of normal forces of each rod, of a pair style or of a wall.
template <typename Host>
class NormalForceSums : public ContactObserver, private Pointers {
 public:
  NormalForceSums(LAMMPS *lmp, Host &host) : Pointers(lmp), host_(host) {}
  void see(const ContactBatch &batch) override;

 private:
  Host &host_;
};

// For fix check/timestep/spherocylinder. Rods of `frozen_groups` do not give way.
class RateCollector : public ContactObserver, private Pointers {
 public:
  RateCollector(LAMMPS *lmp, ContactRates &rates, int frozen_groups)
      : Pointers(lmp), rates_(rates), frozen_groups_(frozen_groups)
  {
  }
  void see(const ContactBatch &batch) override;

 private:
  ContactRates &rates_;
  int frozen_groups_;

  void add(int i, double factor, const ContactBatch &batch, int k, const spherocylinder::Vec3 &arm,
           double depth, const spherocylinder::Vec3 &normal);
};

// Rows of compute pair/gran/local, and of wall/gran/local where `wall` is given.
class RowWriter : public ContactObserver, private Pointers {
 public:
  RowWriter(LAMMPS *lmp, ContactRows &rows, const FixWallGran *wall = nullptr)
      : Pointers(lmp), rows_(rows), wall_(wall)
  {
  }
  void see(const ContactBatch &batch) override;

 private:
  ContactRows &rows_;
  const FixWallGran *wall_;
};

// What LIGGGHTS's fix wall/gran keeps of each rod's whole load at the wall: keywords store_force,
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
