// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/joint_constants.h"

#include <initializer_list>

#include "core/numbers.h"

namespace spherocylinder {

JointChannels joint_stiffness(const BeamHalf &first, const BeamHalf &second)
{
  JointChannels compliance = {0.0, 0.0, 0.0, 0.0};
  for (const BeamHalf *half : {&first, &second}) {
    const double squared = half->radius * half->radius;
    const double area = pi * squared, second_moment = 0.25 * area * squared;
    const double shear_modulus = 0.5 * half->youngs_modulus / (1.0 + half->poissons_ratio);
    const double length = half->half_length;
    compliance.stretch += length / (half->youngs_modulus * area);
    compliance.shear += length / (kShearCoefficient * shear_modulus * area);
    compliance.bend += length / (half->youngs_modulus * second_moment);
    compliance.twist += length / (shear_modulus * 2.0 * second_moment);
  }
  return {1.0 / compliance.stretch, 1.0 / compliance.shear, 1.0 / compliance.bend,
          1.0 / compliance.twist};
}

JointChannels effective_masses(const JointedMass &first, const JointedMass &second)
{
  JointChannels inverse = {0.0, 0.0, 0.0, 0.0};
  for (const JointedMass *rod : {&first, &second}) {
    inverse.stretch += 1.0 / rod->mass;
    inverse.shear +=
        1.0 / rod->mass + rod->half_length * rod->half_length / rod->inertia_transverse;
    inverse.bend += 1.0 / rod->inertia_transverse;
    inverse.twist += 1.0 / rod->inertia_axial;
  }
  return {1.0 / inverse.stretch, 1.0 / inverse.shear, 1.0 / inverse.bend, 1.0 / inverse.twist};
}

JointChannels damping_coefficients(const JointChannels &ratios, const JointChannels &stiffness,
                                   const JointChannels &masses)
{
  const auto of = [](double ratio, double k, double m) { return 2.0 * ratio * std::sqrt(k * m); };
  return {of(ratios.stretch, stiffness.stretch, masses.stretch),
          of(ratios.shear, stiffness.shear, masses.shear),
          of(ratios.bend, stiffness.bend, masses.bend),
          of(ratios.twist, stiffness.twist, masses.twist)};
}

JointChannels squared_joint_frequencies(const JointedMass &rod, const JointChannels &stiffness_sum)
{
  const JointChannels &k = stiffness_sum;
  return {2.0 * k.stretch / rod.mass,
          2.0 * k.shear * rod.half_length * rod.half_length / rod.inertia_transverse,
          2.0 * k.bend / rod.inertia_transverse, 2.0 * k.twist / rod.inertia_axial};
}

}  // namespace spherocylinder
