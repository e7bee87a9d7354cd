// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(rest/spherocylinder, FixRestSpherocylinder)

#else

#ifndef LMP_FIX_REST_SPHEROCYLINDER_H
#define LMP_FIX_REST_SPHEROCYLINDER_H

#include "fix.h"

namespace LAMMPS_NS {

// Ends a run when the rods of its group have been at rest for a while: little kinetic energy, and
// forces and torques in balance on every rod.
class FixRestSpherocylinder : public Fix {
 public:
  FixRestSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void init() override;
  int setmask() override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int n) override;

 private:
  static constexpr bigint kNever = -1;

  int interval_;               // steps between two looks
  double largest_energy_;      // mean kinetic energy over m g D
  double largest_unbalanced_;  // net force over m g, net torque over m g L/2
  double window_ = -1.0;       // s at rest before the run ends; < 0: from gravity and diameter
  double gravity_ = 0.0;       // m/s^2
  double mean_energy_ = 0.0, net_force_ = 0.0, net_torque_ = 0.0;  // at the last look
  double seconds_at_rest_ = 0.0;
  bigint run_began_ = kNever;   // step
  bigint rest_began_ = kNever;  // step
  bigint last_step_ = kNever;   // of the run, once the rods rest
  bool ended_run_ = false;
  bool asked_to_quit_ = false;

  void parse_options(int narg, char **arg);
  double find_gravity() const;
  double default_window() const;
  void begin_run();
  void look();
  void announce_last_step();
  void end_run_now();
};

}  // namespace LAMMPS_NS

#endif
#endif
