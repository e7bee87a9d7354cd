// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "contacts/mesh_histories.h"
#include "granular_wall.h"
#include "lists/rods_near_mesh.h"
#include "walls/moving_wall.h"

namespace LAMMPS_NS {

// What fix wall/gran of rods asks of a combination of contact models, beyond LIGGGHTS's interface.
class RodWall : public LIGGGHTS::Walls::IGranularWall {
 public:
  // Adds the forces of all contacts of these rods with a primitive wall. `history`: a row a rod, null if
  // the models keep none.
  virtual void compute_forces(FixWallGran &fix, const MovingWall &wall,
                              const std::vector<int> &rods, double **history) = 0;

  // Both ends of a rod no longer touch; `history`: their row.
  virtual void contacts_ended(int i, double *history) = 0;

  // Adds the forces of all contacts with a mesh, number `number` of the wall's. `is_new`: rods that have
  // left the list since the last step must forget their contacts.
  virtual void compute_mesh_forces(FixWallGran &fix, const MeshSurface &mesh, int number,
                                   const RodsNearMesh &rods, bool is_new,
                                   MeshHistories &histories) = 0;

  // Values that the models keep of one contact.
  virtual int history_values() = 0;
  // Of the combination of models: LIGGGHTS's.
  virtual int64_t hashcode() = 0;
};

}  // namespace LAMMPS_NS
