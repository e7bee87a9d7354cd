// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/rotation_batch.h"

#include <cmath>

#include "core/free_rotation.h"
#include "core/mass_properties.h"

namespace spherocylinder {

SPHEROCYLINDER_VECTOR void rotate_freely(RodRotations &rods, double dt)
{
  for (int k = 0; k < kBatch; k++) {
    const Vec3 momentum = rods.angular_momentum.get(k);
    const Quaternion q = rods.before(k);
    const double inverse_axial = 1.0 / rods.inertia_axial[k];
    const double inverse_transverse = 1.0 / rods.inertia_transverse[k];
    const HalfAngles half = half_angles(q, momentum, inverse_axial, inverse_transverse, dt);
    const double precession = norm_squared(half.precession), spin = half.spin * half.spin;
    const Quaternion product =
        turned(q, half, cosine_and_sinc_by_series(precession), cosine_and_sinc_by_series(spin));
    const double squared = norm_squared(product);
    const Quaternion result = nearly_unit(product, squared);
    rods.new_w[k] = result.w;
    rods.new_x[k] = result.x;
    rods.new_y[k] = result.y;
    rods.new_z[k] = result.z;
    rods.omega.set(k, angular_velocity_by_inverse(momentum, axis_of(result), inverse_axial,
                                                  inverse_transverse));
    const double farther = precession > spin ? precession : spin;
    const double too_far = farther < kSeriesReaches ? 0.0 : 1.0;
    rods.uncertain[k] = std::fabs(squared - 1.0) > kNearlyUnit ? 1.0 : too_far;
  }
}

SPHEROCYLINDER_VECTOR void angular_velocities(RodRotations &rods)
{
  for (int k = 0; k < kBatch; k++)
    rods.omega.set(k, angular_velocity_by_inverse(
                          rods.angular_momentum.get(k), axis_of(rods.before(k)),
                          1.0 / rods.inertia_axial[k], 1.0 / rods.inertia_transverse[k]));
}

}  // namespace spherocylinder
