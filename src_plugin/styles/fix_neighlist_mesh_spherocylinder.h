// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_NEIGHLIST_MESH_SPHEROCYLINDER_H
#define LMP_FIX_NEIGHLIST_MESH_SPHEROCYLINDER_H

#include "fix_neighlist_mesh.h"

namespace LAMMPS_NS {

// LIGGGHTS's list of a mesh: for each triangle every particle whose bounding sphere is near. Of long rods
// and small triangles it would take far longer to make than all contacts take, so that with a wall of rods
// it stays empty, and only tells a servo wall how many rods are near. Lists that count particles
// (fix massflow/mesh) are LIGGGHTS's.
class FixNeighlistMeshSpherocylinder : public FixNeighlistMesh {
 public:
  using FixNeighlistMesh::FixNeighlistMesh;

  // The wall finds its rods itself.
  void leave_to_wall() { is_left_to_wall_ = true; }
  bool wants_count() const { return globalNumAllContacts_; }
  void set_count(int rods_of_all_ranks) { numAllContacts_ = rods_of_all_ranks; }

  void initializeNeighlist() override
  {
    if (!is_left_to_wall_) FixNeighlistMesh::initializeNeighlist();
  }
  void setup_pre_force(int flag) override
  {
    if (!is_left_to_wall_) FixNeighlistMesh::setup_pre_force(flag);
  }
  void pre_force(int flag) override
  {
    if (!is_left_to_wall_) FixNeighlistMesh::pre_force(flag);
  }

 private:
  bool is_left_to_wall_ = false;
};

}  // namespace LAMMPS_NS

#endif
