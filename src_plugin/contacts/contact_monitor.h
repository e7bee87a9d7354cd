// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces that the rods' pair and wall contacts share.
#pragma once

#include <cmath>

#include "atom.h"
#include "contacts/contact_rates.h"
#include "contacts/contact_state.h"
#include "host/rod_error.h"
#include "pointers.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

namespace LAMMPS_NS {

// An undamped spring contact integrated by velocity Verlet is stable below dt = 2 sqrt(m_eff/k);
// rods have several contacts at once, and accuracy wants more. Recommended: a tenth of that limit.
constexpr double kRecommendedFraction = 0.1;
// Warned about: more than twice the recommended step.
constexpr double kWarnedFraction = 0.2;

// An overlap beyond this share of the diameter is no contact of hard rods any more: rods pass each
// other at 1. Warned about.
constexpr double kWarnedOverlap = 0.5;

// An overlap of this share of the diameter that was not there in the step before is no impact: the
// rod was placed so. An impact that goes up to kWarnedOverlap = 0.5 with the longest step that is not
// warned about, 0.2 of the stability limit 2/omega, begins with at most v dt = (0.5 omega)(0.4/omega)
// = 0.2.
constexpr double kSuddenOverlap = 0.25;

// Watches every contact, whatever model made it: warns once a run if the time step is far too
// long or an overlap far too deep, and keeps the largest overlap.
class ContactMonitor : protected Pointers {
 public:
  explicit ContactMonitor(LAMMPS *lmp) : Pointers(lmp) {}

  // At the start of each run.
  void reset(AtomVecSpherocylinder &rods)
  {
    state_ = &rods.attached<ContactState>();
    rates_ = &rods.attached<ContactRates>();
    state_->largest_overlap = 0.0;
    overlap_warned_ = false;
    step_ = -1;
    const double dt = update->dt;
    threshold_ = dt * dt / (4.0 * kWarnedFraction * kWarnedFraction);
  }

  // Once a contact and step. `j` < 0: a wall. `diameter`: of the rod, or the mean of two rods (m).
  void look(int i, int j, double stiffness, double effective_mass, double overlap, double diameter)
  {
    if (stiffness * threshold_ > effective_mass) warn(i, stiffness, effective_mass);
    if (overlap > state_->largest_overlap * diameter) {
      if (step_ != update->ntimestep) {
        step_ = update->ntimestep;
        largest_before_ = state_->largest_overlap;
      }
      state_->largest_overlap = overlap / diameter;
      if (state_->largest_overlap > kWarnedOverlap && !overlap_warned_) warn_overlap(i, j);
    }
  }

  // Where a fix collects the contacts of this step, null if none does.
  ContactRates *rates() const { return rates_->active ? rates_ : nullptr; }

 private:
  ContactState *state_ = nullptr;
  ContactRates *rates_ = nullptr;
  bool overlap_warned_ = false;
  bigint step_ = -1;             // of the largest overlap so far
  double largest_before_ = 0.0;  // before that step, over the diameter
  double threshold_ = 0.0;  // s^2, so that stiffness * threshold_ > m_eff means too long a step

  void warn_overlap(int i, int j)
  {
    overlap_warned_ = true;
    char partner[40] = "a wall";
    if (j >= 0) snprintf(partner, sizeof(partner), "rod %d", atom->tag[j]);
    const char *advice = "use a stiffer contact or slower rods";
    if (state_->largest_overlap - largest_before_ > kSuddenOverlap)
      advice =
          j >= 0 ? "it was not there in the step before: one of them was placed in the other"
                 : "it was not there in the step before: the rod was placed through the wall; "
                   "keep data files clear of walls, and insertion regions by half a rod, or the "
                   "whole rod in the region (all_in_region of fix particletemplate/spherocylinder)";
    rod_warning(lmp,
                "Rod contacts: rod %d and %s overlap by %g of the diameter at step " BIGINT_FORMAT
                ", more than %g; %s",
                atom->tag[i], partner, state_->largest_overlap, update->ntimestep, kWarnedOverlap,
                advice);
  }

  void warn(int i, double stiffness, double effective_mass)
  {
    threshold_ = 0.0;
    const double limit = 2.0 * std::sqrt(effective_mass / stiffness);
    rod_warning(lmp,
                "Rod contacts: time step %g is far over the recommended %g (%g of the stability "
                "limit %g of the contact of rod %d at step " BIGINT_FORMAT
                "); use a shorter step or a softer contact",
                update->dt, kRecommendedFraction * limit, kRecommendedFraction, limit, atom->tag[i],
                update->ntimestep);
  }
};

}  // namespace LAMMPS_NS
