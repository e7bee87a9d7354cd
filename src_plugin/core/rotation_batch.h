// SPDX-License-Identifier: GPL-2.0-or-later
// rotate_freely and angular_velocity for a batch of rods.
#pragma once

#include "core/batch.h"
#include "core/rotation.h"

namespace spherocylinder {

struct RodRotations {
  // In (space frame, SI units).
  Vec3s angular_momentum;
  Doubles inertia_axial, inertia_transverse;
  Doubles w, x, y, z;  // orientation
  // Out.
  Doubles new_w, new_x, new_y, new_z;  // of rotate_freely
  Vec3s omega;                         // at the end
  // Not 0 where a step turns the rod too far for the batch: rotate_freely of one rod must be asked.
  Doubles uncertain;

  SPHEROCYLINDER_INLINE void set(int k, const Vec3 &momentum, const double *inertia,
                                 const double *quaternion)
  {
    angular_momentum.set(k, momentum);
    inertia_transverse[k] = inertia[0];
    inertia_axial[k] = inertia[2];
    w[k] = quaternion[0];
    x[k] = quaternion[1];
    y[k] = quaternion[2];
    z[k] = quaternion[3];
  }
  SPHEROCYLINDER_INLINE Quaternion before(int k) const { return {w[k], x[k], y[k], z[k]}; }
  SPHEROCYLINDER_INLINE Quaternion after(int k) const
  {
    return {new_w[k], new_x[k], new_y[k], new_z[k]};
  }
};

// Both work out all kBatch rods; those that were not set are of no meaning.
void rotate_freely(RodRotations &rods, double dt);
void angular_velocities(RodRotations &rods);  // of the orientations that went in

}  // namespace spherocylinder
