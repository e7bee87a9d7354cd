// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/surface_contacts.h"
#include "pointers.h"
#include "walls/mesh_surface.h"

namespace LAMMPS_NS {

// The rods near a mesh, each with the triangles, edges and corners that it may touch: those nearer to its
// ends, or to its axis, than its radius and a skin. Made anew when LIGGGHTS makes its lists, and when rods
// and mesh may have come nearer by the skin since. Cost goes with what is near, not with the mesh.
class RodsNearMesh : protected Pointers {
 public:
  explicit RodsNearMesh(LAMMPS *lmp) : Pointers(lmp) {}

  struct Near {
    int rod;
    spherocylinder::NearFeatures features;
  };

  // LIGGGHTS's lists are new ones, or are about to be.
  void forget() { known_ = false; }

  // Triangles that a rod touched in the last step: those of their facets stay near however deep it is.
  using Touched = std::function<void(int rod, std::vector<int> &triangles)>;

  // Once a step, with the mesh where it is now. True if the list is new. Rods with ids above
  // `last_known_id` are there for the first time: they may lie through a face.
  bool renew(MeshSurface &mesh, int groupbit, int last_known_id, const Touched &touched);

  // Owned rods of the group, in their order.
  const Near *begin() const { return near_.data(); }
  const Near *end() const { return near_.data() + count_; }

 private:
  bool known_ = false;
  double skin_ = 0.0;     // m
  double longest_ = 0.0;  // half an axis (m)
  int version_ = 0;       // of the rods' poses that the list was made at
  int mesh_version_ = 0;
  std::vector<Near> near_;  // the first count_; the rest keep their memory
  size_t count_ = 0;
  std::vector<int> found_, touched_;

  void find_pierced(const MeshSurface &mesh, const spherocylinder::Segment &axis,
                    std::vector<int> &pierced);
  void add_deep(const spherocylinder::TriangleSurface &surface, const spherocylinder::Vec3 &end,
                double reach, const std::vector<int> &pierced, std::vector<int> &triangles) const;
  // Fills in what is near; false if nothing is.
  bool find(const MeshSurface &mesh, const spherocylinder::Capsule &rod,
            spherocylinder::NearFeatures &features);
};

}  // namespace LAMMPS_NS
