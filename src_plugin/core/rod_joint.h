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

#include "core/numbers.h"
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

// What of a joint is energy. Rest not taken off.
struct JointStrain {
  double stretch;                // u.n (m); > 0: the points are apart
  Vec3 shear;                    // u - (u.n) n (m)
  double bend_x, bend_y, twist;  // rad

  double bend_squared() const { return bend_x * bend_x + bend_y * bend_y; }  // |b|^2
};

// And what loads need beside.
struct JointDeformation : JointStrain {
  Vec3 gap;                      // u, space frame (m)
  Vec3 mean;                     // n
  Vec3 middle;                   // between the shared points
  Vec3 first_axis, second_axis;  // of the rods
  double inverse_sum;            // 1/|first_axis + second_axis|
  Quaternion relative;           // of the second rod in the first's body frame, w >= 0
  double bend_cosine;            // cos(|b|/2)
  double bend_by_sine;           // |b|/sin(|b|/2): (x, y) of `relative` times it is the bend
  double bend_slope;             // its derivative by s = sin(|b|/2), its cosine aside, over s
};

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

struct RodMotion {
  Vec3 velocity, omega;  // space frame
};

// Beyond these the split of the rotation is about to become ambiguous: half a turn but for one degree.
constexpr double kLargestJointAngle = 179.0 / 180.0 * pi;

// The second rod's orientation in the first's body frame, with w >= 0: of q and -q, the same rotation,
// that whose twist is below half a turn.
SPHEROCYLINDER_INLINE Quaternion relative_orientation(const Quaternion &first,
                                                      const Quaternion &second)
{
  const Quaternion q = Quaternion{first.w, -first.x, -first.y, -first.z} * second;
  return q.w < 0.0 ? Quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}

// Below this square of a sine or tangent angles are worked out by series, whose next terms are below
// 1e-16 of the first. There, differences of nearly equal numbers would be left of the formulas.
constexpr double kSmallSquare = 0.01;

// From the highest term down.
template <size_t N>
SPHEROCYLINDER_INLINE double polynomial(const double (&terms)[N], double y)
{
  double sum = terms[N - 1];
  for (size_t k = N - 1; k-- > 0;) sum = terms[k] + y * sum;
  return sum;
}

// With s = sin and c = cos of half the bend: bend/s, that is 2 asin(s)/s, and (2 c - bend/s)/s^2.
SPHEROCYLINDER_INLINE void set_bend(const Quaternion &q, JointDeformation &d)
{
  constexpr double kBySine[] = {2.0,          1.0 / 3.0,     3.0 / 20.0,     5.0 / 56.0,
                                35.0 / 576.0, 63.0 / 1408.0, 231.0 / 6656.0, 143.0 / 5120.0};
  constexpr double kSlope[] = {4.0 / 3.0,    2.0 / 5.0,    3.0 / 14.0,    5.0 / 36.0,
                               35.0 / 352.0, 63.0 / 832.0, 77.0 / 1280.0, 429.0 / 8704.0};
  const double squared = q.x * q.x + q.y * q.y;
  d.bend_cosine = std::sqrt(q.w * q.w + q.z * q.z);
  if (squared < kSmallSquare) {
    d.bend_by_sine = polynomial(kBySine, squared);
    d.bend_slope = -polynomial(kSlope, squared);
  } else {
    const double sine = std::sqrt(squared);
    d.bend_by_sine = 2.0 * std::atan2(sine, d.bend_cosine) / sine;
    d.bend_slope = (2.0 * d.bend_cosine - d.bend_by_sine) / squared;
  }
  d.bend_x = d.bend_by_sine * q.x;
  d.bend_y = d.bend_by_sine * q.y;
}

SPHEROCYLINDER_INLINE double twist_of(const Quaternion &q)
{
  constexpr double kArcTangent[] = {2.0,       -2.0 / 3.0,  2.0 / 5.0,  -2.0 / 7.0,
                                    2.0 / 9.0, -2.0 / 11.0, 2.0 / 13.0, -2.0 / 15.0};
  if (q.z * q.z >= kSmallSquare * q.w * q.w) return 2.0 * std::atan2(q.z, q.w);
  const double tangent = q.z / q.w;
  return tangent * polynomial(kArcTangent, tangent * tangent);
}

SPHEROCYLINDER_INLINE JointDeformation joint_deformation(const JointedRod &first,
                                                         const JointedRod &second)
{
  JointDeformation d;
  d.first_axis = first.axis();
  d.second_axis = second.axis();
  const Vec3 head = first.centre + first.half_length * d.first_axis;
  const Vec3 tail = second.centre - second.half_length * d.second_axis;
  const Vec3 sum = d.first_axis + d.second_axis;
  d.gap = tail - head;
  d.middle = 0.5 * (head + tail);
  d.inverse_sum = 1.0 / norm(sum);
  d.mean = d.inverse_sum * sum;
  d.stretch = dot(d.gap, d.mean);
  d.shear = d.gap - d.stretch * d.mean;
  d.relative = relative_orientation(first.orientation, second.orientation);
  set_bend(d.relative, d);
  d.twist = twist_of(d.relative);
  return d;
}

// Into (-pi, pi]: a twist beyond its rest state.
SPHEROCYLINDER_INLINE double less_than_half_turn(double angle)
{
  return angle > pi ? angle - 2.0 * pi : angle <= -pi ? angle + 2.0 * pi : angle;
}

// The couple on the first rod, space frame. A small turn w of the second rod, in the first's body frame,
// changes its quaternion (q, v) by dq = -w.v/2, dv = (q w + w x v)/2; the couple is the derivative of the
// energy by w.
SPHEROCYLINDER_INLINE Vec3 elastic_couple(const JointedRod &first, const JointDeformation &d,
                                          const JointChannels &stiffness, const JointRest &rest)
{
  const Quaternion &q = d.relative;
  const double excess_x = d.bend_x - rest.bend_x, excess_y = d.bend_y - rest.bend_y;
  const double along = excess_x * q.x + excess_y * q.y;
  const double twist = less_than_half_turn(d.twist - rest.twist);
  const double inverse_cosine = 1.0 / d.bend_cosine;

  const double by_cosine = -2.0 * stiffness.bend * along * inverse_cosine;
  const double by_twist = 2.0 * stiffness.twist * twist * inverse_cosine * inverse_cosine;
  const double by_w = by_cosine * q.w - by_twist * q.z;
  const Vec3 by_v = {stiffness.bend * (d.bend_by_sine * excess_x + along * d.bend_slope * q.x),
                     stiffness.bend * (d.bend_by_sine * excess_y + along * d.bend_slope * q.y),
                     by_cosine * q.z + by_twist * q.w};
  const Vec3 v = {q.x, q.y, q.z};
  return rotated(0.5 * (q.w * by_v + cross(v, by_v) - by_w * v), first.orientation);
}

// With u = gap, n = sum/|sum| of the axes a and b, and the derivatives of the energy by u and by n,
//   G = K_shear u + (K_stretch - K_shear)(u.n) n,  D = (K_stretch - K_shear)(u.n) u,
// the first rod feels G at its shared point and -a x D_across/|sum| by its turn, the second -G at its own
// and -b x D_across/|sum|. Moved to the point midway, with u x G = -n x D, couples +-(b - a) x
// D_across/(2 |sum|) are left.
SPHEROCYLINDER_INLINE JointLoad elastic_load(const JointedRod &first, const JointDeformation &d,
                                             const JointChannels &stiffness, const JointRest &rest)
{
  const double difference = (stiffness.stretch - stiffness.shear) * d.stretch;
  JointLoad load;
  load.point = d.middle;
  load.force = stiffness.shear * d.gap + difference * d.mean;
  load.couple = (0.5 * d.inverse_sum * difference) * cross(d.second_axis - d.first_axis, d.shear) +
                elastic_couple(first, d, stiffness, rest);
  return load;
}

inline JointChannels joint_energies(const JointStrain &d, const JointChannels &stiffness,
                                    const JointRest &rest)
{
  const double bend_x = d.bend_x - rest.bend_x, bend_y = d.bend_y - rest.bend_y;
  const double twist = less_than_half_turn(d.twist - rest.twist);
  return {0.5 * stiffness.stretch * d.stretch * d.stretch,
          0.5 * stiffness.shear * norm_squared(d.shear),
          0.5 * stiffness.bend * (bend_x * bend_x + bend_y * bend_y),
          0.5 * stiffness.twist * twist * twist};
}

// Adds to `load` what opposes the relative motion at the joint, that of the two bodies at the common
// point; none if they move as one.
SPHEROCYLINDER_INLINE void add_damping(const JointedRod &first, const RodMotion &motion_of_first,
                                       const JointedRod &second, const RodMotion &motion_of_second,
                                       const JointDeformation &d, const JointChannels &c,
                                       JointLoad &load)
{
  const Vec3 velocity =
      motion_of_second.velocity + cross(motion_of_second.omega, load.point - second.centre) -
      motion_of_first.velocity - cross(motion_of_first.omega, load.point - first.centre);
  const Vec3 omega = motion_of_second.omega - motion_of_first.omega;
  load.force =
      load.force + c.shear * velocity + ((c.stretch - c.shear) * dot(velocity, d.mean)) * d.mean;
  load.couple = load.couple + c.bend * omega + ((c.twist - c.bend) * dot(omega, d.mean)) * d.mean;
}

}  // namespace spherocylinder
