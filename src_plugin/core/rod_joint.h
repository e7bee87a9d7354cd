// SPDX-License-Identifier: GPL-2.0-or-later
// The elastic joint of two rods whose ends share a point: a slice of a beam between their middles.
//
// Everything is measured afresh from the two poses; a joint has no history. Two rods, the first and the
// second: the head of the first (its end along +axis) meets the tail of the second.
//
// Energy, of which force and couple are the exact gradient:
//   U = K_stretch (u.n)^2/2 + K_shear |u - (u.n) n|^2/2 + K_bend |b - b_0|^2/2 + K_twist (t - t_0)^2/2
// u: from the first's shared point to the second's; n: the mean axis. The relative rotation is split as
// twist t/2, bend, twist t/2: with the quaternion (w, x, y, z) of the second in the first's body frame
//   t = 2 atan(z/w),  |b| = 2 atan(sqrt(x^2 + y^2)/sqrt(w^2 + z^2)) along (x, y).
// |b| is the angle between the axes, b lies about their binormal; both are unique below 180 degrees, and
// swapping the rods turns their signs only.
#pragma once

#include "core/rotation.h"

namespace spherocylinder {

struct JointedRod {
  Vec3 centre;
  Quaternion orientation;
  double half_length;  // from the centre to the shared point (m)

  Vec3 axis() const { return axis_of(orientation); }
  Vec3 head() const { return centre + half_length * axis(); }
  Vec3 tail() const { return centre - half_length * axis(); }
};

// One value for each way in which a joint gives way.
struct JointChannels {
  double stretch, shear, bend, twist;
};

// What a joint is without load: bend about body x and y of the frame midway in the twist, and twist (rad).
struct JointRest {
  double bend_x = 0.0, bend_y = 0.0, twist = 0.0;
};

struct JointDeformation {
  Vec3 gap;                      // u, space frame (m)
  Vec3 mean;                     // n
  double stretch;                // u.n (m); > 0: the points are apart
  Vec3 shear;                    // u - (u.n) n (m)
  double bend_x, bend_y, twist;  // rest not taken off (rad)

  double bend() const { return std::hypot(bend_x, bend_y); }  // between the axes (rad)

  // What loads need beside.
  Vec3 middle;                   // between the shared points
  Vec3 first_axis, second_axis;  // of the rods
  double inverse_sum;            // 1/|first_axis + second_axis|
  Quaternion relative;           // of the second rod in the first's body frame, w >= 0
  double bend_cosine;            // cos(|b|/2)
  double bend_by_sine;           // |b|/sin(|b|/2): (x, y) of `relative` times it is the bend
  double bend_slope;             // its derivative by s = sin(|b|/2) at fixed cosine, over s
};

JointDeformation joint_deformation(const JointedRod &first, const JointedRod &second);

// `force` on the first rod at `point`, its opposite on the second at the same point; `couple` on the
// first rod, its opposite on the second. So momentum and angular momentum are kept to the last digit.
struct JointLoad {
  Vec3 point;   // midway between the shared points
  Vec3 force;   // N
  Vec3 couple;  // N m

  Vec3 torque_on_first(const JointedRod &first) const
  {
    return cross(point - first.centre, force) + couple;
  }
  Vec3 torque_on_second(const JointedRod &second) const
  {
    return -(cross(point - second.centre, force) + couple);
  }
};

JointLoad elastic_load(const JointedRod &first, const JointDeformation &deformation,
                       const JointChannels &stiffness, const JointRest &rest);

JointChannels joint_energies(const JointDeformation &deformation, const JointChannels &stiffness,
                             const JointRest &rest);

struct RodMotion {
  Vec3 velocity, omega;  // space frame
};

// Adds to `load` what opposes the relative motion at the joint, that of the two bodies at the common
// point; none if they move as one.
void add_damping(const JointedRod &first, const RodMotion &motion_of_first,
                 const JointedRod &second, const RodMotion &motion_of_second,
                 const JointDeformation &deformation, const JointChannels &coefficients,
                 JointLoad &load);

// Beyond these the split of the rotation is about to become ambiguous: half a turn but for one degree.
constexpr double kLargestJointAngle = 179.0 / 180.0 * 3.14159265358979323846;

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
