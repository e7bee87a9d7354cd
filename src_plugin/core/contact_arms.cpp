// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/contact_arms.h"

#include <cmath>

#include "core/columns.h"

namespace spherocylinder {

namespace {

SPHEROCYLINDER_INLINE void set_rods(const RodState *const (&states)[kBatch], int k,
                                    const Four &along, Vec3s &arm, Vec3s &velocity, Vec3s &omega)
{
  static_assert(sizeof(RodState) >= 9 * sizeof(double));
  FourRows rows;
  for (int row = 0; row < kFour; row++) rows[row] = &states[k + row]->velocity.x;
  Four head[kFour], tail[kFour], axis_z;
  load_columns(rows, 0, head);
  load_columns(rows, 4, tail);
  load_column(rows, 8, axis_z);
  store_column(head[0], velocity.x + k);
  store_column(head[1], velocity.y + k);
  store_column(head[2], velocity.z + k);
  store_column(head[3], omega.x + k);
  store_column(tail[0], omega.y + k);
  store_column(tail[1], omega.z + k);
  store_column(along * tail[2], arm.x + k);
  store_column(along * tail[3], arm.y + k);
  store_column(along * axis_z, arm.z + k);
}

}  // namespace

SPHEROCYLINDER_VECTOR bool place_at_closest_points(ContactArms &arms,
                                                   const RodState *const (&i)[kBatch],
                                                   const RodState *const (&j)[kBatch],
                                                   const ClosestLanes &points, int count)
{
  ContactArms &__restrict__ c = arms;  // shares no memory with the points
  const auto [s, t, x, y, z, distance_squared, nearly_parallel] = points;
  for (int k = 0; k < kBatch; k += kFour) {
    Four on_i, on_j;
    std::memcpy(&on_i, s + k, sizeof on_i);
    std::memcpy(&on_j, t + k, sizeof on_j);
    set_rods(i, k, on_i, c.arm_i, c.velocity_i, c.omega_i);
    set_rods(j, k, on_j, c.arm_j, c.velocity_j, c.omega_j);
  }
  for (int k = 0; k < kBatch; k++) {
    const double distance = std::sqrt(distance_squared[k]);
    c.normal.set(k, (1.0 / distance) * Vec3{x[k], y[k], z[k]});
    c.distance[k] = distance;
    c.overlap[k] = c.radius_i[k] + c.radius_j[k] - distance;
    c.mass_share[k] = 1.0;
  }
  std::int64_t others = 0;
  for (int k = 0; k < count; k++)
    others |= distance_squared[k] == 0.0 || nearly_parallel[k] != 0.0 ? 1 : 0;
  return others == 0;
}

SPHEROCYLINDER_VECTOR void relative_overlaps(const ContactArms &arms, Doubles &overlaps)
{
  Doubles &__restrict__ out = overlaps;
  for (int k = 0; k < kBatch; k++) out[k] = arms.overlap[k] / (arms.radius_i[k] + arms.radius_j[k]);
}

SPHEROCYLINDER_VECTOR bool any_deeper_or_stiffer(const ContactArms &arms, const ContactLoads &loads,
                                                 double overlap, double step_squared, int count)
{
  std::int64_t found = 0;
  for (int k = 0; k < count; k++) {
    const double reach = arms.radius_i[k] + arms.radius_j[k];
    found |= arms.overlap[k] > overlap * reach ? 1 : 0;
    found |= loads.stiffness[k] * step_squared > loads.effective_mass[k] ? 1 : 0;
  }
  return found != 0;
}

}  // namespace spherocylinder
