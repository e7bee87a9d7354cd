// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef ATOM_CLASS

AtomStyle(spherocylinder, AtomVecSpherocylinder)

#else

#ifndef LMP_ATOM_VEC_SPHEROCYLINDER_H
#define LMP_ATOM_VEC_SPHEROCYLINDER_H

#include <memory>

#include "atom_vec.h"
#include "core/capsule.h"
#include "core/rotation.h"
#include "rods/attachments.h"
#include "rods/fibre_segments.h"
#include "rods/field_travel.h"
#include "rods/needed_ghosts.h"
#include "rods/rod_watcher.h"

namespace LAMMPS_NS {

// Rods: one atom is one sphero-cylinder.
//
// State, in LIGGGHTS's own per-atom arrays so that stock commands read and write it:
//   radius      bounding radius = half the total length
//   shape       (r, r, half the total length)
//   quaternion  (w, x, y, z), body to space frame; the rod's axis is body z
//   density, volume, area, rmass, inertia (transverse, transverse, axial; body frame)
//   omega, angmom   space frame; omega is what input and restarts set, angmom follows from it at
//                   the start of each run
// A rod whose length equals its diameter is a sphere.
class AtomVecSpherocylinder : public AtomVec {
 public:
  explicit AtomVecSpherocylinder(LAMMPS *lmp);
  ~AtomVecSpherocylinder() override;
  void settings(int narg, char **arg) override;
  void init() override;

  void grow(int n) override;
  void grow_reset() override;
  void copy(int i, int j, int delflag) override;
  void clear_bonus() override;

  int pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  int pack_comm_vel(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  void unpack_comm(int n, int first, double *buf) override;
  void unpack_comm_vel(int n, int first, double *buf) override;
  int pack_reverse(int n, int first, double *buf) override;
  void unpack_reverse(int n, int *list, double *buf) override;
  int pack_border(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  int pack_border_vel(int n, int *list, double *buf, int pbc_flag, int *pbc) override;
  void unpack_border(int n, int first, double *buf) override;
  void unpack_border_vel(int n, int first, double *buf) override;
  int pack_exchange(int i, double *buf) override;
  int unpack_exchange(double *buf) override;
  int size_restart() override;
  int pack_restart(int i, double *buf) override;
  int unpack_restart(double *buf) override;

  void create_atom(int itype, double *coord) override;
  void data_atom(double *coord, tagint imagetmp, char **values) override;
  void data_vel(int m, char **values) override;
  void pack_data(double **buf) override;
  void pack_data(double **buf, int tag_offset) override;
  void write_data(FILE *fp, int n, double **buf) override;
  void pack_vel(double **buf) override;
  void pack_vel(double **buf, int tag_offset) override;
  void write_vel(FILE *fp, int n, double **buf) override;
  bigint memory_usage() override;

  // Size and density of rod i; sets everything that follows from them. A diameter or length of 0 is
  // one not given yet: no mass, volume and inertia then. `shared_ends`: of a segment of a fibre, see
  // core/mass_properties.h.
  void set_rod(int i, double diameter, double total_length, double rod_density,
               int shared_ends = 0);

  // Rod i as geometry (space frame, m), for owned and ghost rods.
  SPHEROCYLINDER_INLINE spherocylinder::Capsule capsule(int i) const
  {
    return {{spherocylinder::load(x_[i]),
             spherocylinder::axis_of(spherocylinder::load_quaternion(quaternion_[i])),
             shape_[i][2] - shape_[i][0]},
            shape_[i][0]};
  }

  // What others keep for all rods of the simulation.
  template <typename T>
  T &attached()
  {
    return attachments_.of<T>();
  }

  NeededGhosts &ghosts() { return ghosts_; }

  void watch(std::unique_ptr<RodWatcher> watcher) { watcher_ = std::move(watcher); }

 private:
  // Of Atom's arrays, those that make up a capsule.
  double **x_ = nullptr, **quaternion_ = nullptr, **shape_ = nullptr;
  Attachments attachments_;
  FibreSegments &fibres_;
  std::unique_ptr<RodWatcher> watcher_;
  NeededGhosts ghosts_;

  GhostGain gain_across(unsigned travel, const int *pbc) const;
  int pack(unsigned travel, int n, const int *list, double *buf, int pbc_flag,
           const int *pbc) const;
  int pack_needed(unsigned travel, int n, const int *list, double *buf, int pbc_flag,
                  const int *pbc);
  int pack_new_ghosts(unsigned travel, int n, int *list, double *buf, int pbc_flag, const int *pbc);
  const double *unpack(unsigned travel, int n, int first, const double *buf);
  int pack_border_of_fixes(int n, int *list, double *buf);
  void unpack_ghosts(unsigned travel, int n, int first, double *buf);
  int new_atom();
};

// The rods' atom style, or an error that names `who` if the simulation has another one.
AtomVecSpherocylinder &rods_of(LAMMPS *lmp, const char *who);

}  // namespace LAMMPS_NS

#endif
#endif
