// SPDX-License-Identifier: GPL-2.0-or-later
// What LIGGGHTS's fix wall/gran keeps of its contacts.
#pragma once

#include <optional>

#include "contacts/contact_observer.h"
#include "contacts/observers.h"
#include "pointers.h"
#include "walls/mesh_surface.h"

namespace LAMMPS_NS {

class FixWallGran;

// Each rod's whole load at a primitive wall, or at each triangle of a mesh: keywords store_force,
// store_force_contact and ..._stress. Both ends of a rod must be in one batch.
class WallLoads : public ContactObserver, private Pointers {
 public:
  WallLoads(LAMMPS *lmp, FixWallGran &fix, const MeshSurface *mesh)
      : Pointers(lmp), fix_(fix), mesh_(mesh)
  {
  }
  void see(const ContactBatch &batch) override;

 private:
  FixWallGran &fix_;
  const MeshSurface *mesh_;  // null at a primitive wall

  bool are_one_load(const ContactBatch &batch, int k, int other) const;
};

// Heat through a wall's contacts.
class WallHeat : public ContactObserver {
 public:
  WallHeat(FixWallGran &fix, const MeshSurface *mesh) : fix_(fix), mesh_(mesh) {}
  void see(const ContactBatch &batch) override;

 private:
  FixWallGran &fix_;
  const MeshSurface *mesh_;
};

// Forces, torques and wear of fix mesh/surface/stress, from where each contact is and how fast the rod is
// there.
class MeshStress : public ContactObserver, private Pointers {
 public:
  MeshStress(LAMMPS *lmp, const MeshSurface &mesh) : Pointers(lmp), mesh_(mesh) {}
  void see(const ContactBatch &batch) override;

 private:
  const MeshSurface &mesh_;
};

// All that see a wall's contacts in this step: the fix's own, and `others`.
class WallObservers {
 public:
  // `mesh`: of a mesh wall.
  WallObservers(LAMMPS *lmp, FixWallGran &fix, const ContactObservers &others,
                const MeshSurface *mesh);
  WallObservers(const WallObservers &) = delete;  // all_ has pointers to the others
  WallObservers &operator=(const WallObservers &) = delete;

  const ContactObservers &all() const { return all_; }

 private:
  NormalForceSums<FixWallGran> sums_;
  WallLoads loads_;
  WallHeat heat_;
  std::optional<MeshStress> stress_;
  std::optional<RowWriter> rows_;
  ContactObservers all_;
};

}  // namespace LAMMPS_NS
