// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_monitor.h"

#include <cmath>
#include <string>

#include "atom.h"
#include "contacts/sudden_overlaps.h"
#include "host/rod_error.h"
#include "rods/rod_driver.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

// An undamped spring contact integrated by velocity Verlet is stable below dt = 2 sqrt(m_eff/k);
// rods have several contacts at once, and accuracy wants more. Recommended: a tenth of that limit.
constexpr double kRecommendedFraction = 0.1;
// Warned about: more than twice the recommended step.
constexpr double kWarnedFraction = 0.2;

// An overlap beyond this share of the diameter is no contact of hard rods any more: rods pass each
// other at 1. Warned about.
constexpr double kWarnedOverlap = 0.5;

}  // namespace

void ContactMonitor::run_begins()
{
  time_step_warned_ = overlap_warned_ = false;
  standing_groups_ = standing_groups(lmp);
  largest_overlap_ = largest_before_ = 0.0;
  step_ = -1;
}

void ContactMonitor::look(const ContactBatch &batch, Seen &seen) const
{
  const double dt = update->dt;
  // The step is too long where stiffness * threshold > m_eff.
  const double threshold = dt * dt / (4.0 * kWarnedFraction * kWarnedFraction);
  double largest = seen.deeper.empty() ? largest_overlap_ : seen.deeper.back().over_diameter;
  // A wall's contact is over the diameter, twice the sum of the radii.
  const double deepest = largest * (batch.is_wall ? 2.0 : 1.0);
  if (!any_deeper_or_stiffer(batch.arms, batch.loads, deepest, threshold, batch.count)) return;
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k];
    if (batch.is_wall && (atom->mask[i] & standing_groups_)) continue;
    const double stiffness = batch.loads.stiffness[k], mass = batch.loads.effective_mass[k];
    if (stiffness * threshold > mass && !time_step_warned_ && !seen.stiff)
      seen.stiff = {i, stiffness, mass};
    const double diameter = batch.is_wall ? 2.0 * batch.arms.radius_i[k] : batch.reach(k);
    if (batch.arms.overlap[k] <= largest * diameter) continue;
    largest = batch.arms.overlap[k] / diameter;
    seen.deeper.push_back({i, batch.j[k], largest});
  }
}

void ContactMonitor::take(Seen &seen)
{
  if (seen.stiff && !time_step_warned_)
    warn_time_step(seen.stiff->i, seen.stiff->stiffness, seen.stiff->mass);
  for (const auto &[i, j, overlap] : seen.deeper)
    if (overlap > largest_overlap_) note_overlap(i, j, overlap);
  seen.stiff.reset();
  seen.deeper.clear();
}

void ContactMonitor::note_overlap(int i, int j, double overlap)
{
  if (step_ != update->ntimestep) {
    step_ = update->ntimestep;
    largest_before_ = largest_overlap_;
  }
  largest_overlap_ = overlap;
  if (overlap > kWarnedOverlap && !overlap_warned_) warn_overlap(i, j);
}

void ContactMonitor::warn_overlap(int i, int j)
{
  overlap_warned_ = true;
  const std::string partner = j >= 0 ? "rod " + std::to_string(atom->tag[j]) : "a wall";
  const char *advice = "use a stiffer contact or slower rods";
  if (largest_overlap_ - largest_before_ > SuddenOverlaps::kSudden)
    advice = j >= 0
                 ? "it was not there in the step before: one of them was placed in the other"
                 : "it was not there in the step before: the rod was placed through the wall; "
                   "keep data files clear of walls, and insertion regions by half a rod, or the "
                   "whole rod in the region (all_in_region of fix particletemplate/spherocylinder)";
  rod_warning(lmp,
              "Rod contacts: rod %d and %s overlap by %g of the diameter at step " BIGINT_FORMAT
              ", more than %g; %s",
              atom->tag[i], partner.c_str(), largest_overlap_, update->ntimestep, kWarnedOverlap,
              advice);
}

void ContactMonitor::warn_time_step(int i, double stiffness, double effective_mass)
{
  time_step_warned_ = true;
  const double limit = 2.0 * std::sqrt(effective_mass / stiffness);
  rod_warning(lmp,
              "Rod contacts: time step %g is far over the recommended %g (%g of the stability "
              "limit %g of the contact of rod %d at step " BIGINT_FORMAT
              "); use a shorter step or a softer contact",
              update->dt, kRecommendedFraction * limit, kRecommendedFraction, limit, atom->tag[i],
              update->ntimestep);
}
