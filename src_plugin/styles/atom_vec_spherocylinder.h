// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef ATOM_CLASS

AtomStyle(spherocylinder, AtomVecSpherocylinder)

#else

#ifndef LMP_ATOM_VEC_SPHEROCYLINDER_H
#define LMP_ATOM_VEC_SPHEROCYLINDER_H

#include <memory>

#include "atom_vec.h"
#include "contact_rates.h"
#include "core/capsule.h"
#include "core/rotation.h"

namespace LAMMPS_NS {

class RodInsertionList;
class RodShifts;
struct RodPairCounts;
class SuddenOverlaps;
class TouchingRodPairs;

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
  // one not given yet: no mass, volume and inertia then.
  void set_rod(int i, double diameter, double total_length, double rod_density);

  // Rod i as geometry (space frame, m), for owned and ghost rods.
  SPHEROCYLINDER_INLINE spherocylinder::Capsule capsule(int i) const
  {
    return {{spherocylinder::load(x[i]),
             spherocylinder::axis_of(spherocylinder::load_quaternion(quaternion[i])),
             shape[i][2] - shape[i][0]},
            shape[i][0]};
  }

  // Largest overlap of any contact, walls included, over the (mean) diameter of its rods, since
  // the run began; this rank's contacts.
  double largest_overlap = 0.0;

  // Of the pair style's lists, null without one.
  const RodPairCounts *pair_counts = nullptr;
  SuddenOverlaps *sudden_overlaps = nullptr;

  // The pairs that touched when the forces were last computed, null without a pair style.
  const TouchingRodPairs *touching_pairs = nullptr;

  // Filled by the contacts while a fix has it active.
  ContactRates &contact_rates() { return contact_rates_; }

  // How far rods have come, for the walls.
  RodShifts &rod_shifts();

  // Rods that random insertion must keep clear of, shared by all templates of one insertion.
  RodInsertionList &insertion_list();

 private:
  int *tag, *type, *mask;
  tagint *image;
  double **x, **v, **f;
  double *radius, *density, *rmass, *volume, *area;
  double **omega, **torque, **angmom;
  double **shape, **blockiness, **inertia, **quaternion;
  ContactRates contact_rates_;
  std::unique_ptr<RodInsertionList> insertion_list_;
  std::unique_ptr<RodShifts> rod_shifts_;
  bool images_may_touch_twice_ = false;
  int moved_groups_ = -1;  // groups whose rods a fix moves or freezes; all where nothing runs
  bool is_handing_over_ = false;

  struct PeriodicShift {
    double dx[3] = {0.0, 0.0, 0.0};
    double dv[3] = {0.0, 0.0, 0.0};
  };
  PeriodicShift periodic_shift(const int *pbc, bool lamda) const;
  double *put_motion(double *out, int j, const PeriodicShift &shift) const;
  template <bool VELOCITY>
  int pack_forward(int n, int *list, double *buf, int pbc_flag, int *pbc);
  template <bool VELOCITY>
  void unpack_forward(int n, int first, const double *buf);
  template <bool VELOCITY>
  int pack_ghosts(int n, int *list, double *buf, int pbc_flag, int *pbc);
  template <bool VELOCITY>
  void unpack_ghosts(int n, int first, double *buf);
  int pack_state(int i, double *buf) const;
  int unpack_state(int i, const double *buf);
  int new_atom();
};

}  // namespace LAMMPS_NS

#endif
#endif
