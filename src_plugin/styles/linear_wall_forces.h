// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "core/contact_kinematics.h"
#include "linear_model_values.h"
#include "pointers.h"
#include "rod_contact.h"
#include "rod_wall.h"

namespace LAMMPS_NS {

class FixWallGran;

// How far two ends of a rod that touch a wall at once act as one contact, from 0 to 1: the ratio of
// their overlaps, times the cosine between their normals (0 if they face each other, as across a
// cylinder).
//
// Two ends that push equally along one normal feel each other: the point at end 1 gives way by
// K11 + K12, not by K11 alone, and a rod that lands flat rebounds with e only if its damping knows
// that. With one overlap at zero the other end is alone, so that the damping has no jump.
//
// Returns K12 times that share, in 1/kg: what an end's inverse effective mass gains. With the share
// at most the cosine, their sum is at least 1/m: see the test of mass_coupling.
double coupling_of_ends(const RodEnds &ends, double radius,
                        const spherocylinder::InverseInertia &inverse);

// Wall contacts of model linear in batches: what LinearPairForces is for pairs of rods.
class LinearWallForces : protected Pointers {
 public:
  explicit LinearWallForces(LAMMPS *lmp);

  LinearModelValues &values() { return values_; }

  // Adds the forces and torques of the rods' contacts, and keeps the histories: `history` has a row
  // a rod with the tangential spring of end 0 and that of end 1, or is null.
  void compute(FixWallGran &fix, const MovingWall &wall, const std::vector<int> &rods,
               double **history, ContactMonitor &monitor);

 private:
  LinearModelValues values_;
  spherocylinder::LinearContacts contacts_{};
  struct End {
    int i;
    double *spring;  // null without history
  };
  End ends_[spherocylinder::kBatch];
  int count_ = 0;

  void add(int i, int wall_type, const spherocylinder::Capsule &rod,
           const spherocylinder::InverseInertia &inverse, const spherocylinder::Vec3 &arm,
           const EndContact &contact, double coupling, const spherocylinder::Vec3 &wall_velocity,
           double *spring);
  void finish_batch(ContactMonitor &monitor);
};

// A rod whose centre is outside of the cylinder must not reach it.
void check_not_at_outside(LAMMPS *lmp, const FixWallGran &fix, const WallSurface &surface, int i);

}  // namespace LAMMPS_NS
