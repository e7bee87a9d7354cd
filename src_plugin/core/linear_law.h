// SPDX-License-Identifier: GPL-2.0-or-later
// Spring, dashpot and slider of model linear, for one contact: stateless functions that batches of
// contacts and single ones share. Space frame, SI units.
#pragma once

#include "core/vec3.h"

namespace spherocylinder {

// What friction holds to mu F_n: the whole tangential force, or, as LIGGGHTS's tangential history
// does, the spring's alone, with the dashpot on top of it while the spring holds.
enum class SliderLimits { WholeForce, SpringAlone };

// The normal force on rod i along the normal towards it (N): k overlap - gamma v_n. `limited`: it does
// not pull.
SPHEROCYLINDER_INLINE double normal_force(double stiffness, double overlap, double damping,
                                          double normal_velocity, bool limited)
{
  const double force = stiffness * overlap - damping * normal_velocity;
  return limited && force < 0.0 ? 0.0 : force;
}

// A tangential spring of a pair that turns about its normal `n` (unit) with the mean of the two
// spins; `turning` is 1, or 0 for a spring that does not. Cayley's formula, which keeps its length:
// cos = (1 - h^2)/(1 + h^2), sin = 2 h/(1 + h^2), h half the angle.
SPHEROCYLINDER_INLINE Vec3 turned_spring(const Vec3 &spring, const Vec3 &n, const Vec3 &omega_i,
                                         const Vec3 &omega_j, double turning, double dt)
{
  const double h = 0.25 * dt * turning * dot(omega_i + omega_j, n);
  const double scale = 1.0 / (1.0 + h * h);
  return (scale * (1.0 - h * h)) * spring + (scale * 2.0 * h) * cross(n, spring);
}

// The spring (m) after a step in which the surface of rod i has gone on at `slip` (m/s), laid at
// right angles to the normal of now.
SPHEROCYLINDER_INLINE Vec3 loaded_spring(const Vec3 &spring, const Vec3 &slip, const Vec3 &n,
                                         double dt)
{
  const Vec3 loaded = spring + dt * slip;
  return loaded - dot(loaded, n) * n;
}

// The damping constant that friction leaves a dashpot: its force is at most `most`, mu F_n.
SPHEROCYLINDER_INLINE double damping_within(double damping, const Vec3 &slip, double most)
{
  const double dragging = damping * norm(slip);
  return dragging > most ? damping * (most / dragging) : damping;
}

// The tangential force on rod i (N) of a loaded spring and a dashpot of `damping` (N s/m), and what
// it leaves of the spring. `most`: mu F_n, N.
//
// Where spring and dashpot together would pull harder than `most` the contact slides: the force
// keeps their direction and is as large as `most`, and the spring is set to what of it the dashpot
// does not give (Cundall and Strack 1979; Luding, Granular Matter 10 (2008) 235), so that the force goes on without a
// jump when the sliding ends. A dashpot counts for at most `most` there; of a contact that slides
// faster than that the spring would else be wound up the other way, by gamma v/k_t. So set, sliding
// never adds to the energy of the spring.
template <SliderLimits limits>
SPHEROCYLINDER_INLINE Vec3 sliding_force(Vec3 &spring, const Vec3 &slip, double stiffness,
                                         double damping, double most)
{
  if (limits == SliderLimits::SpringAlone) {
    const double pull = stiffness * norm(spring);
    const bool slides = pull > most;
    spring = (slides ? most / pull : 1.0) * spring;
    return -stiffness * spring - (slides ? 0.0 : damping) * slip;
  }
  const Vec3 both = stiffness * spring + damping * slip;
  const double pull = norm(both);
  const bool slides = pull > most;
  const Vec3 pulling = (slides ? most / pull : 1.0) * both;
  const Vec3 held = pulling - damping_within(damping, slip, most) * slip;
  // Without stiffness there is no damping either, and nothing that could slide.
  const double inverse = slides ? 1.0 / stiffness : 0.0;
  spring = slides ? inverse * held : spring;
  return -pulling;
}

}  // namespace spherocylinder
