// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(hinge/spherocylinder, FixHingeSpherocylinder)

#else

#ifndef LMP_FIX_HINGE_SPHEROCYLINDER_H
#define LMP_FIX_HINGE_SPHEROCYLINDER_H

#include <string>

#include "core/vec3.h"
#include "fix.h"

namespace LAMMPS_NS {

// Holds the centre of one end's hemisphere of each rod of a group by a spring, at the place where it was or at one
// that moves on from there; the rod turns freely about it.
class FixHingeSpherocylinder : public Fix {
 public:
  FixHingeSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  ~FixHingeSpherocylinder() override;
  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int n) override;

  // What the hinge of owned rod i adds to the square of its highest frequency at most (1/s^2).
  double squared_frequency(int i) const;

  // What is held travels with its rod.
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  double memory_usage() override;

 private:
  enum class End { Tail, Head, Free };
  // Of a rod: -1 its tail is held, 1 its head, 0 nothing; the point where.
  enum Column { kSide, kX, kY, kZ, kColumns };

  End end_ = End::Free;
  double stiffness_ = 0.0;  // N/m, 0: that of the fibre's joints across
  double ratio_ = 0.0;      // of damping
  spherocylinder::Vec3 velocity_{0.0, 0.0, 0.0};
  class FixJointSpherocylinder *joints_ = nullptr;
  double **held_ = nullptr;
  bool is_set_up_ = false;
  double energy_ = 0.0;                        // of this rank, in the last step
  spherocylinder::Vec3 force_{0.0, 0.0, 0.0};  // on all its rods

  std::string name() const;
  void clear(int i);
  double side_of(int i) const;
  double stiffness(int i) const;
  spherocylinder::Vec3 arm(int i) const;
  void hold(int i);
};

}  // namespace LAMMPS_NS

#endif
#endif
