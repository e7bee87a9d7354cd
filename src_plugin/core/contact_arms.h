// SPDX-License-Identifier: GPL-2.0-or-later
// Batches of contacts as a law sees them: two arms that touch, whatever they are the arms of.
#pragma once

#include "core/batch.h"
#include "core/closest_points_batch.h"
#include "core/contact_kinematics.h"
#include "core/prefetch.h"

namespace spherocylinder {

// Space frame, SI units. i and j are the two bodies of a contact; a wall is a j at rest but for its
// surface, of no radius and infinite mass.
struct ContactArms {
  Vec3s arm_i, arm_j;            // from the centre to the point on the axis that holds the contact
  Vec3s velocity_i, velocity_j;  // of the centres
  Vec3s omega_i, omega_j;
  Doubles inverse_mass_i, inverse_mass_j;
  Doubles inverse_inertia_i, inverse_inertia_j;  // transverse
  Doubles radius_i, radius_j;
  Vec3s normal;        // unit, along p - q, the points at the ends of the arms
  Doubles distance;    // of p and q along it
  Doubles overlap;     // that the contact feels
  Doubles mass_share;  // of the effective mass at the contact that it has for itself
  Doubles turning;     // 1 if a spring at the contact turns with the two about the normal, else 0
  Vec3s side;          // normal of the last step, zero for a new contact
};

// What does not stay of a rod: its motion, and the axis that its arms lie on.
struct alignas(kCacheLine) RodState {
  Vec3 velocity, omega, axis;
};

// Puts kBatch contacts of these rods at their closest points. In: the radii. False if the points of one of
// the first `count` do not differ or its rods are nearly parallel.
bool place_at_closest_points(ContactArms &arms, const RodState *const (&i)[kBatch],
                             const RodState *const (&j)[kBatch], const ClosestLanes &points,
                             int count);

// Over the sum of the radii.
void relative_overlaps(const ContactArms &arms, Doubles &overlaps);

// What a law makes of them.
struct ContactLoads {
  Vec3s force;                              // on i; j feels its opposite
  Vec3s torque_i, torque_j;                 // about the centres
  Doubles stiffness, tangential_stiffness;  // N/m
  Doubles inverse_mass;    // 1/m_eff; 0 if neither can move: the rest are no numbers then
  Doubles effective_mass;  // that damping goes by: the contact's share of m_eff (kg)
};

// Whether some contact is deeper than `overlap` of the sum of the radii, or its step longer than where
// stiffness * step_squared is its effective mass. Of those that cannot move it may say so too.
bool any_deeper_or_stiffer(const ContactArms &arms, const ContactLoads &loads, double overlap,
                           double step_squared, int count);

// One contact of a batch on its way to a law.
struct ContactPlace {
  Vec3 normal;      // unit, towards i; as it was if the axes have passed each other
  double distance;  // along it, negative then
  double overlap;
  double from_i, from_j;        // of the contact point, midway in the overlap, from p and q
  Vec3 velocity_i, velocity_j;  // of p and q, half a step ago
  double inverse_mass;          // 1/m_eff; 0 if neither can move
};

SPHEROCYLINDER_INLINE ContactPlace place_of(const ContactArms &c, int k, double dt)
{
  // Rods whose axes have passed each other keep their side: the distance is negative.
  const double reach = c.radius_i[k] + c.radius_j[k];
  const bool passed = dot(c.normal.get(k), c.side.get(k)) < 0.0;
  const double distance = passed ? -c.distance[k] : c.distance[k];
  const double overlap = passed ? reach - distance : c.overlap[k];
  const Vec3 normal = (passed ? -1.0 : 1.0) * c.normal.get(k);
  const double half_overlap = 0.5 * (reach - distance);
  const Vec3 arm_i = c.arm_i.get(k), arm_j = c.arm_j.get(k);
  return {normal,
          distance,
          overlap,
          c.radius_i[k] - half_overlap,
          c.radius_j[k] - half_overlap,
          velocity_half_a_step_ago(c.velocity_i.get(k), c.omega_i.get(k), arm_i, dt),
          velocity_half_a_step_ago(c.velocity_j.get(k), c.omega_j.get(k), arm_j, dt),
          inverse_effective_mass({c.inverse_mass_i[k], c.inverse_inertia_i[k]}, arm_i, normal) +
              inverse_effective_mass({c.inverse_mass_j[k], c.inverse_inertia_j[k]}, arm_j, normal)};
}

}  // namespace spherocylinder
