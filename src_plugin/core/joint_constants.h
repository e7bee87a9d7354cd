// SPDX-License-Identifier: GPL-2.0-or-later
// What a joint of two rods is made of: stiffness of the beam, damping, and how long a step may be.
#pragma once

#include "core/rod_joint.h"

namespace spherocylinder {

// A round rod as a beam, of its own half of a joint.
struct BeamHalf {
  double radius, half_length;  // m, half the distance of its joints
  double youngs_modulus;       // Pa
  double poissons_ratio;
};

// Of the circle: Timoshenko's coefficient of shear.
constexpr double kShearCoefficient = 0.9;

// EA/h, kappa G A/h, EI/h, GJ/h with G = E/2(1 + nu); of unlike halves both in series.
JointChannels joint_stiffness(const BeamHalf &first, const BeamHalf &second);

struct JointedMass {
  double mass, inertia_transverse, inertia_axial;
  double half_length;
};

// Mass and inertia that each channel moves, of two free rods: 1/m = 1/m_1 + 1/m_2, across with
// (h/2)^2/I_t of each beside; 1/I likewise.
JointChannels effective_masses(const JointedMass &first, const JointedMass &second);

// 2 zeta sqrt(K m) of each channel.
JointChannels damping_coefficients(const JointChannels &ratios, const JointChannels &stiffness,
                                   const JointChannels &masses);

// A bound on the highest omega^2 that joints of these stiffnesses, summed over a rod's ends, give it in
// a chain of its like: 2 K/m stretched, 2 K (h/2)^2/I_t sheared, 2 K/I bent and twisted. Equal joints at
// both ends make it the chain's own 4 K/m, 12 K/m (thin rods), 4 K/I_t, 4 K/I_a.
JointChannels squared_joint_frequencies(const JointedMass &rod, const JointChannels &stiffness_sum);

}  // namespace spherocylinder
