// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/vec3.h"
#include "lmptype.h"

namespace LAMMPS_NS {

class ComputePairGranLocal;
class FixWallGran;
class MeshSurface;

// A contact of rod i, in space frame and SI units. Torque about the rod's centre.
struct ContactRow {
  int i, j;                            // j: of a pair
  spherocylinder::Vec3 force, torque;  // on rod i
  spherocylinder::Vec3 normal;         // unit, towards rod i
  spherocylinder::Vec3 point;          // where the force acts
  spherocylinder::Vec3 wall_velocity;  // there, of a wall
  const double *history;               // null without
  double radius_i, radius_j;
  double distance;  // along the normal, between the points on the axes, or from it to the wall
  double overlap;
};

// Who writes rows of single contacts in the steps whose output asks for them: compute pair/gran/local
// and wall/gran/local of rods.
class ContactRows {
 public:
  virtual ~ContactRows() = default;

  // What is registered with a pair style or a wall, if it wants this step's contacts; else null.
  static ContactRows *collecting(ComputePairGranLocal *registered, bigint step);

  virtual void begin_rows() = 0;  // of this step
  virtual void add_pair_contact(const ContactRow &contact) = 0;
  // Of end 0 (at -u) or 1 (at +u) of rod i.
  virtual void add_wall_contact(const FixWallGran &wall, int end, const ContactRow &contact) = 0;
  // With a triangle of a mesh, by LIGGGHTS's number.
  virtual void add_mesh_contact(const FixWallGran &wall, const MeshSurface &mesh, int triangle_id,
                                const ContactRow &contact) = 0;
};

}  // namespace LAMMPS_NS
