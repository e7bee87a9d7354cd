// SPDX-License-Identifier: GPL-2.0-or-later
// What stock commands, fixes and computes ask of pair and wall contacts.
#pragma once

#include "contacts/contact_observer.h"
#include "pointers.h"

namespace LAMMPS_NS {

class ContactRows;
class FixWallGran;
class MeshSurface;
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

// Rows of compute pair/gran/local, and of wall/gran/local where `wall` is given.
class RowWriter : public ContactObserver, private Pointers {
 public:
  RowWriter(LAMMPS *lmp, ContactRows &rows, const FixWallGran *wall = nullptr,
            const MeshSurface *mesh = nullptr)
      : Pointers(lmp), rows_(rows), wall_(wall), mesh_(mesh)
  {
  }
  void see(const ContactBatch &batch) override;

 private:
  ContactRows &rows_;
  const FixWallGran *wall_;
  const MeshSurface *mesh_;  // of a mesh wall
};

}  // namespace LAMMPS_NS
