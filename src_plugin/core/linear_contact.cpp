// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear_contact.h"

#include <cmath>

#include "contact_kinematics.h"
#include "linear_law.h"

namespace spherocylinder {

namespace {

template <Tangential tangential, SliderLimits limits, bool tangential_damping, bool limit_force>
SPHEROCYLINDER_INLINE void all_contacts(LinearContacts &c, double dt)
{
  for (int k = 0; k < kBatch; k++) {
    // Rods whose axes have passed each other keep their side: the distance is negative.
    const double reach = c.radius_i[k] + c.radius_j[k];
    const bool passed = dot(c.normal.get(k), c.side.get(k)) < 0.0;
    const double distance = passed ? -c.distance[k] : c.distance[k];
    const double overlap = passed ? reach - distance : c.overlap[k];
    const Vec3 n = (passed ? -1.0 : 1.0) * c.normal.get(k);
    const double half_overlap = 0.5 * (reach - distance);  // the contact is midway
    const double from_i = c.radius_i[k] - half_overlap, from_j = c.radius_j[k] - half_overlap;

    const Vec3 arm_i = c.s[k] * c.axis_i.get(k), arm_j = c.t[k] * c.axis_j.get(k);
    const Vec3 omega_i = c.omega_i.get(k), omega_j = c.omega_j.get(k);
    const Vec3 between = velocity_half_a_step_ago(c.velocity_i.get(k), omega_i, arm_i, dt) -
                         velocity_half_a_step_ago(c.velocity_j.get(k), omega_j, arm_j, dt);
    const double vn = dot(between, n);

    const double inverse_mass =
        inverse_effective_mass({c.inverse_mass_i[k], c.inverse_inertia_i[k]}, arm_i, n) +
        inverse_effective_mass({c.inverse_mass_j[k], c.inverse_inertia_j[k]}, arm_j, n);
    const double kn = c.stiffness[k], kt = c.tangential_stiffness[k];
    const double effective_mass = c.share[k] / inverse_mass;
    const double root = c.two_beta[k] * std::sqrt(effective_mass);
    double Fn = kn * overlap - root * std::sqrt(kn) * vn;
    if (limit_force) Fn = Fn < 0.0 ? 0.0 : Fn;

    Vec3 Ft = {0.0, 0.0, 0.0};
    if (tangential != Tangential::Off) {
      const Vec3 spin = from_i * omega_i + from_j * omega_j;
      const Vec3 slip = between - vn * n + cross(n, spin);
      const double damping = tangential_damping ? root * std::sqrt(kt) : 0.0;
      const double most = c.friction[k] * std::fabs(Fn);
      if (tangential == Tangential::NoHistory) {
        // The dashpot alone, up to the limit of friction.
        Ft = -damping_within(damping, slip, most) * slip;
      } else {
        Vec3 spring = turned_spring(c.spring.get(k), n, omega_i, omega_j, c.turning[k], dt);
        spring = loaded_spring(spring, slip, n, dt);
        Ft = sliding_force<limits>(spring, slip, kt, damping, most);
        c.spring.set(k, spring);
      }
    }

    const Vec3 force = Fn * n + Ft;
    const Vec3 twist = cross(n, Ft);
    c.force.set(k, force);
    c.torque_i.set(k, cross(arm_i, force) - from_i * twist);
    c.torque_j.set(k, -cross(arm_j, force) - from_j * twist);
    c.inverse_mass[k] = inverse_mass;
    c.effective_mass[k] = effective_mass;
    c.overlap[k] = overlap;
    c.side.set(k, n);
  }
}

// Every way a deck can ask for, each a function of its own: nothing is decided per contact.
template <Tangential tangential, SliderLimits limits>
SPHEROCYLINDER_INLINE void with_options(LinearContacts &c, const LinearLaw &law)
{
  if (law.tangential_damping) {
    if (law.limit_force)
      all_contacts<tangential, limits, true, true>(c, law.dt);
    else
      all_contacts<tangential, limits, true, false>(c, law.dt);
  } else {
    if (law.limit_force)
      all_contacts<tangential, limits, false, true>(c, law.dt);
    else
      all_contacts<tangential, limits, false, false>(c, law.dt);
  }
}

}  // namespace

SPHEROCYLINDER_VECTOR void linear_contacts(LinearContacts &contacts, const LinearLaw &law)
{
  constexpr SliderLimits kWhole = SliderLimits::WholeForce, kSpring = SliderLimits::SpringAlone;
  switch (law.tangential) {
    case Tangential::Off: with_options<Tangential::Off, kWhole>(contacts, law); break;
    case Tangential::NoHistory: with_options<Tangential::NoHistory, kWhole>(contacts, law); break;
    case Tangential::History:
      if (law.slider == kWhole)
        with_options<Tangential::History, kWhole>(contacts, law);
      else
        with_options<Tangential::History, kSpring>(contacts, law);
      break;
  }
}

}  // namespace spherocylinder
