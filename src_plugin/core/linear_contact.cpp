// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/linear_contact.h"

#include <cmath>

namespace spherocylinder {

namespace {

// The three never share memory, which keeps the loop in vector registers.
#define APART __restrict__

template <Tangential tangential, SliderLimits limits, bool tangential_damping, bool limit_force>
SPHEROCYLINDER_INLINE void all_contacts(ContactArms &APART c, LinearMaterials &APART m,
                                        ContactLoads &APART out, const LinearOptions &law)
{
  const double dt = law.dt, spring_dt = law.spring_dt;
  for (int k = 0; k < kBatch; k++) {
    const ContactPlace place = place_of(c, k, dt);
    const Vec3 n = place.normal;
    const Vec3 between = place.velocity_i - place.velocity_j;
    const double vn = dot(between, n);
    const double kn = m.stiffness[k], kt = m.tangential_stiffness[k];
    const double effective_mass = c.mass_share[k] / place.inverse_mass;
    const double root = m.two_beta[k] * std::sqrt(effective_mass);
    const double Fn = normal_force(kn, place.overlap, root * std::sqrt(kn), vn, limit_force);

    Vec3 Ft = {0.0, 0.0, 0.0};
    if (tangential != Tangential::Off) {
      const Vec3 omega_i = c.omega_i.get(k), omega_j = c.omega_j.get(k);
      const Vec3 spin = place.from_i * omega_i + place.from_j * omega_j;
      const Vec3 slip = between - vn * n + cross(n, spin);
      const double damping = tangential_damping ? root * std::sqrt(kt) : 0.0;
      const double most = m.friction[k] * std::fabs(Fn);
      if (tangential == Tangential::NoHistory) {
        // The dashpot alone, up to the limit of friction.
        Ft = -damping_within(damping, slip, most) * slip;
      } else {
        Vec3 spring = turned_spring(m.spring.get(k), n, omega_i, omega_j, c.turning[k], spring_dt);
        spring = loaded_spring(spring, slip, n, spring_dt);
        Ft = sliding_force<limits>(spring, slip, kt, damping, most);
        m.spring.set(k, spring);
      }
    }

    const Vec3 force = Fn * n + Ft;
    const Vec3 twist = cross(n, Ft);
    out.force.set(k, force);
    out.torque_i.set(k, cross(c.arm_i.get(k), force) - place.from_i * twist);
    out.torque_j.set(k, -cross(c.arm_j.get(k), force) - place.from_j * twist);
    out.stiffness[k] = kn;
    out.tangential_stiffness[k] = tangential == Tangential::Off ? 0.0 : kt;
    out.inverse_mass[k] = place.inverse_mass;
    out.effective_mass[k] = effective_mass;
    c.normal.set(k, n);
    c.distance[k] = place.distance;
    c.overlap[k] = place.overlap;
  }
}

// Every way a deck can ask for, each a function of its own: nothing is decided per contact.
template <Tangential tangential, SliderLimits limits>
SPHEROCYLINDER_INLINE void with_options(ContactArms &APART arms, LinearMaterials &APART materials,
                                        ContactLoads &APART loads, const LinearOptions &law)
{
  if (law.tangential_damping) {
    if (law.limit_force)
      all_contacts<tangential, limits, true, true>(arms, materials, loads, law);
    else
      all_contacts<tangential, limits, true, false>(arms, materials, loads, law);
  } else {
    if (law.limit_force)
      all_contacts<tangential, limits, false, true>(arms, materials, loads, law);
    else
      all_contacts<tangential, limits, false, false>(arms, materials, loads, law);
  }
}

}  // namespace

SPHEROCYLINDER_VECTOR void linear_contacts(ContactArms &APART arms,
                                           LinearMaterials &APART materials,
                                           const LinearOptions &law, ContactLoads &APART loads)
{
  constexpr SliderLimits kWhole = SliderLimits::WholeForce, kSpring = SliderLimits::SpringAlone;
  switch (law.tangential) {
    case Tangential::Off: with_options<Tangential::Off, kWhole>(arms, materials, loads, law); break;
    case Tangential::NoHistory:
      with_options<Tangential::NoHistory, kWhole>(arms, materials, loads, law);
      break;
    case Tangential::History:
      if (law.slider == kWhole)
        with_options<Tangential::History, kWhole>(arms, materials, loads, law);
      else
        with_options<Tangential::History, kSpring>(arms, materials, loads, law);
      break;
  }
}

}  // namespace spherocylinder
