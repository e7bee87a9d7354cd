// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "contacts/contact_batch.h"
#include "contacts/mesh_histories.h"
#include "core/contact_kinematics.h"
#include "core/surface_contacts.h"
#include "lists/joint_shares.h"
#include "lists/rods_near_mesh.h"
#include "pointers.h"

namespace LAMMPS_NS {

class ContactLaw;
class FixWallGran;

// From a rod near a mesh to its contacts with it.
//
// A contact goes on as that of the last step at the same place of the rod (either end, or between them)
// and the same part of the same triangle, else the same triangle, else the same smooth patch, else a
// neighbouring triangle whose normal does not turn by a right angle: an end that slides from triangle to
// triangle, also over an edge, keeps its spring, turned into the new tangent plane. Of several the one
// nearest along the rod. Each thread has one for its rods.
class MeshGatherer : protected Pointers {
 public:
  explicit MeshGatherer(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of a step, of one mesh: number `number` of the wall's.
  void begin(const FixWallGran &fix, const MeshSurface &mesh, int number, MeshHistories &histories,
             bool effective_mass, bool types_are_kinds, const JointShares *shares);

  // Finds the contacts of a near rod and what is kept of them; `law` forgets those that ended. Returns how
  // many there are.
  int find(const RodsNearMesh::Near &near, ContactLaw &law);
  // A rod that is no longer near.
  void forget(int rod, ContactLaw &law);

  // Adds those found last to the batch, from `first` on, as many as it has room for. Returns where to go on.
  int add(ContactBatch &batch, int first);

  // Of this step, a rod that is there for the first time and lies through a face; -1 if none.
  int pierced_rod() const { return pierced_rod_; }
  int pierced_triangle() const { return pierced_triangle_; }

 private:
  const FixWallGran *fix_ = nullptr;
  const MeshSurface *mesh_ = nullptr;
  MeshHistories *histories_ = nullptr;
  int number_ = 0, wall_type_ = 0;
  bool types_are_kinds_ = false;
  double turning_ = 1.0;                 // share of the rod's turning that damping knows of
  const JointShares *shares_ = nullptr;  // of fibres, null without
  int pierced_rod_ = -1, pierced_triangle_ = -1;

  int rod_ = 0;
  spherocylinder::Capsule capsule_{};
  std::vector<spherocylinder::SurfaceContact> found_;
  std::vector<spherocylinder::RememberedSide> remembered_;
  MeshHistories::Contacts before_;     // of this mesh, in the last step
  std::vector<int> triangles_before_;  // in surface() now, -1 if not there
  std::vector<int> source_;  // of each of found_: the one of before_ that it goes on from, or -1

  void share();
  void take_before();
  void remember();
  void match();
  int agreement(const spherocylinder::SurfaceContact &now, size_t before) const;
  int64_t kind_of(int type) const;
  double mass_share(size_t k, const spherocylinder::InverseInertia &inverse) const;
};

}  // namespace LAMMPS_NS
