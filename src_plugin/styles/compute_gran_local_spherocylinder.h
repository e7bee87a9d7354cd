// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "compute_pair_gran_local.h"
#include "contacts/contact_rows.h"

namespace LAMMPS_NS {

class FixMeshSurface;

// compute pair/gran/local and wall/gran/local of decks with rods: LIGGGHTS's columns, with what it
// works out from sphere centres taken from the contacts themselves, and the column group `normal`.
//
// The contacts hand over their values in the steps whose output asks for them, so that the forces
// are those the rods have felt. (LIGGGHTS computes all contacts a second time at output, when the
// velocities of owned particles, but not of ghosts, have moved on by half a step.)
//
// The style names are LIGGGHTS's; the loader creates this class for rods and LIGGGHTS's own for
// everything else.
class ComputeGranLocalSpherocylinder : public ComputePairGranLocal, public ContactRows {
 public:
  ComputeGranLocalSpherocylinder(LAMMPS *lmp, int &iarg, int narg, char **arg);
  void init() override;
  void init_cpgl(bool) override;
  void pre_delete(bool uncomputeflag) override;
  void compute_local() override;
  double memory_usage() override;

  void begin_rows() override;
  void add_pair_contact(const ContactRow &contact) override;
  void add_wall_contact(const FixWallGran &wall, int end, const ContactRow &contact) override;
  void add_mesh_contact(const FixWallGran &wall, const MeshSurface &mesh, int triangle_id,
                        const ContactRow &contact) override;

 private:
  struct Keywords {
    std::vector<char *> stock;  // the command without `normal`
    bool normal = false;
    Keywords(int narg, char **arg);
  };
  ComputeGranLocalSpherocylinder(LAMMPS *lmp, int &iarg, Keywords keywords);

  // A row before its columns are chosen. Space frame; force and torque on rod i, the torque about
  // its centre.
  struct Contact {
    spherocylinder::Vec3 positions[2], velocities[2];
    double ids[3];
    spherocylinder::Vec3 force, torque, normal, point;
    const double *history;
    double area, overlap;
  };

  bool normal_;
  // Primitive walls, and each mesh of mesh walls, in the order of the deck.
  struct Wall {
    const FixWallGran *fix;
    const FixMeshSurface *mesh;  // null: primitive
  };
  std::vector<Wall> walls_;
  bigint collected_step_ = -1;
  int rows_ = 0;

  void register_with_walls();
  void add_row_of_wall(const Wall &wall, int part, const ContactRow &contact);
  void add_row(const Contact &contact);
};

}  // namespace LAMMPS_NS
