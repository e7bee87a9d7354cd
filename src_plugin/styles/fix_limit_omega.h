// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(limit/omega, FixLimitOmega)

#else

#ifndef LMP_FIX_LIMIT_OMEGA_H
#define LMP_FIX_LIMIT_OMEGA_H

#include "fix.h"

namespace LAMMPS_NS {

// Holds the rods' angular velocity at or below a limit at the end of each step, angular momentum
// kept consistent; counts how often it acts and the energy it removes.
class FixLimitOmega : public Fix {
 public:
  FixLimitOmega(LAMMPS *lmp, int narg, char **arg);
  ~FixLimitOmega() override;
  void init() override;
  int setmask() override;
  void end_of_step() override;
  double compute_vector(int n) override;

  // The per-rod sums travel with their rods.
  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  double memory_usage() override;

 private:
  enum class Component { Total, Transverse, Axial };
  Component component_ = Component::Total;
  double limit_;                 // rad/s
  int driven_ = 0;               // groups of fix move, which gives the angular velocity itself
  double actions_ = 0.0;         // rods limited, summed over the steps, this rank
  double energy_removed_ = 0.0;  // J, this rank
  double acted_last_ = 0.0;      // rods limited in the last step, this rank
  double **of_rod_ = nullptr;    // of each rod: times limited, energy removed (J)

  static constexpr int kPerRod = 2;
  void limit_rod(int i);
  void most_limited(double &times, double &id) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
