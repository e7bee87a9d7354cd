// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(check/timestep/spherocylinder, FixCheckTimestepSpherocylinder)

#else

#ifndef LMP_FIX_CHECK_TIMESTEP_SPHEROCYLINDER_H
#define LMP_FIX_CHECK_TIMESTEP_SPHEROCYLINDER_H

#include "contacts/rate_collector.h"
#include "fix.h"

namespace LAMMPS_NS {

class ContactState;

// Works out the stable time step from the contacts that are there, their stiffness and the rods'
// effective masses, and compares the run's step with it; warns or stops the run.
class FixCheckTimestepSpherocylinder : public Fix {
 public:
  FixCheckTimestepSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  ~FixCheckTimestepSpherocylinder() override;
  int setmask() override;
  void init() override;
  void pre_force(int vflag) override;
  void end_of_step() override;
  double compute_vector(int n) override;

 private:
  RateCollector rates_;
  double allowed_fraction_;  // of the stable step
  bool warn_ = true;
  bool stop_ = false;
  bool warned_ = false;         // in this run
  double fraction_ = 0.0;       // time step / stable step, 0 without contacts
  double stable_step_ = 0.0;    // s, 0 without contacts
  double most_contacts_ = 0.0;  // of one rod, walls included
  double largest_move_ = 0.0;   // of a rod's surface in one step, over its diameter

  ContactState *contacts();
  void parse_options(int narg, char **arg);
  double largest_surface_move() const;
};

}  // namespace LAMMPS_NS

#endif
#endif
