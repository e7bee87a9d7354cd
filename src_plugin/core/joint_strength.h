// SPDX-License-Identifier: GPL-2.0-or-later
// What a joint of two rods bears before it is bent for good, or breaks: that of a round beam.
#pragma once

#include <limits>

#include "core/rod_joint.h"

namespace spherocylinder {

// Moment at which a round rod of the radius r is plastic all through: (4/3) sigma_0 r^3.
inline double plastic_moment(double yield_stress, double radius)
{
  return 4.0 / 3.0 * yield_stress * radius * radius * radius;
}

// A moment is beyond the one at yield by more than rounding: what has just been brought back to it is not.
constexpr double kYieldRounding = 1e-13;

inline double elastic_bend(const JointStrain &d, const JointRest &rest)
{
  return std::hypot(d.bend_x - rest.bend_x, d.bend_y - rest.bend_y);
}

inline bool yields(const JointStrain &d, const JointRest &rest, double bend_stiffness,
                   double yield_moment)
{
  const double x = d.bend_x - rest.bend_x, y = d.bend_y - rest.bend_y;
  const double most = (1.0 + kYieldRounding) * yield_moment;
  return bend_stiffness * bend_stiffness * (x * x + y * y) > most * most;
}

// The state without load after yielding without hardening: the bend follows, straight towards the present one
// (radial return), so that the moment is `yield_moment`.
inline JointRest rest_after_yielding(const JointStrain &d, const JointRest &rest,
                                     double bend_stiffness, double yield_moment)
{
  const double left = yield_moment / (bend_stiffness * elastic_bend(d, rest));
  return {d.bend_x - left * (d.bend_x - rest.bend_x), d.bend_y - left * (d.bend_y - rest.bend_y),
          rest.twist};
}

// Work that the moment at yield does while the bend without load goes from one to the other (J).
inline double plastic_work(const JointRest &before, const JointRest &after, double yield_moment)
{
  return yield_moment * std::hypot(after.bend_x - before.bend_x, after.bend_y - before.bend_y);
}

struct JointStrength {
  double tensile =
      std::numeric_limits<double>::infinity();  // N/A at which it breaks without bending (Pa)
  double bending =
      std::numeric_limits<double>::infinity();  // M r/I at which it breaks without pull (Pa)

  bool is_finite() const
  {
    return tensile < std::numeric_limits<double>::max() ||
           bending < std::numeric_limits<double>::max();
  }
};

// (N/A)/tensile + (M r/I)/bending, N > 0 pulls: the joint breaks at 1. With one strength for both it is the
// stress at the beam's surface, on the side that is pulled, over the strength.
inline double utilisation(const JointStrain &d, const JointRest &rest,
                          const JointChannels &stiffness, double radius,
                          const JointStrength &strength)
{
  const double area = pi * radius * radius;
  const double moment = stiffness.bend * elastic_bend(d, rest);
  return stiffness.stretch * d.stretch / (area * strength.tensile) +
         4.0 * moment / (area * radius * strength.bending);
}

}  // namespace spherocylinder
