// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H
#define LMP_FIX_WALL_GRAN_SPHEROCYLINDER_H

#include "contacts/mesh_histories.h"
#include "contacts/rod_wall.h"
#include "fix_wall_gran.h"
#include "lists/near_wall_rods.h"
#include "lists/rods_near_mesh.h"
#include "styles/wall_arguments.h"

namespace LAMMPS_NS {

// fix wall/gran of decks with rods: LIGGGHTS's own, but for its loop over all rods whose bounding
// spheres reach the wall. Of long rods few of them have an end there, and only those are looked at.
// A plane may move along its normal by a variable, or turn about it; a cylinder's radius may be a variable.
//
// The style name is LIGGGHTS's; the loader creates this class for rods and LIGGGHTS's own for
// everything else.
class FixWallGranSpherocylinder : public FixWallGran {
 public:
  FixWallGranSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  // Where a wall with a variable is, and how fast: the first forces of a continued run want its speed. What
  // contacts are kept of: they go on with the same models and meshes only.
  void write_restart(FILE *file) override;
  void restart(char *state) override;

  // The group's rods begin their contacts with a primitive wall anew. Returns how many had one.
  int forget_contacts(int groupbit_of_rods);
  // That the contact models keep of one contact.
  int history_values() const { return rod_wall_ ? rod_wall_->history_values() : 0; }

  // Of mesh walls: what is kept of contacts goes with the rods.
  void post_create() override;
  void grow_arrays(int rods) override { mesh_histories_.grow(rods); }
  void copy_arrays(int from, int to, int) override { mesh_histories_.copy(from, to); }
  void set_arrays(int rod) override { mesh_histories_.clear(rod); }
  int pack_exchange(int rod, double *buffer) override { return mesh_histories_.pack(rod, buffer); }
  int unpack_exchange(int rod, double *buffer) override
  {
    return mesh_histories_.unpack(rod, buffer);
  }
  int pack_restart(int rod, double *buffer) override;
  void unpack_restart(int rod, int nth) override;
  int size_restart(int rod) override { return 1 + mesh_histories_.size(rod); }
  int maxsize_restart() override;
  double memory_usage() override { return mesh_histories_.memory_usage(); }
  ~FixWallGranSpherocylinder() override;

 protected:
  void pre_neighbor() override;
  void pre_force(int vflag) override;
  void post_force_primitive(int vflag) override;
  void post_force_mesh(int vflag) override;

 private:
  RodWall *rod_wall_ = nullptr;  // null without surface spherocylinder: no rods are run then
  MovingWall wall_{};
  NearWallRods near_rods_;
  WallArguments arguments_;

  struct WallMesh {
    MeshSurface surface;
    RodsNearMesh rods;
  };
  std::vector<WallMesh> meshes_;
  MeshHistories mesh_histories_;
  bool overlaps_are_told_ = false;    // of facets, by the first step
  bool meshes_may_be_others_ = true;  // LIGGGHTS has spread them over the ranks
  std::vector<double> kept_;          // of the restart file: see what_is_kept
  // Of all ranks' rods, and of those that the meshes have met in this run: inserted ones have larger ids.
  int largest_id_ = 0, last_known_id_ = 0;

  // Of a plane whose position, or a cylinder whose radius, is a variable.
  int variable_ = -1;
  double place_ = 0.0;         // position or radius (m)
  double speed_ = 0.0;         // of it over the last step (m/s)
  bigint place_step_ = -2;     // of place_, -2: none yet
  double listed_place_ = 0.0;  // when LIGGGHTS's list was made (m)
  // Of rods of this rank: radii of all and of those within the cylinder, half a length of those outside (m).
  double thinnest_ = 0.0, thickest_in_ = 0.0, longest_out_ = 0.0;

  FixWallGranSpherocylinder(LAMMPS *lmp, WallArguments arguments);
  bool has_variable() const { return !arguments_.variable.empty(); }
  const char *what_varies() const;
  void find_variable();
  void move_wall();
  void look_at_rods();
  void read_sizes();
  MovingWall moving_wall() const;
  void check_shear() const;
  void check_cylinder_is_wide_enough() const;
  void check_no_image_is_missed() const;
  void forget_contacts_of_far_rods(double **history);
  void begin_meshes();
  void forget_false_contacts();
  void warn_of_overlapping_facets();
  std::vector<double> what_is_kept() const;
  void check_models_are_kept_ones(const double *kept);
  void check_meshes_are_kept_ones();
  void check_meshes_are_slow() const;
};

}  // namespace LAMMPS_NS

#endif
