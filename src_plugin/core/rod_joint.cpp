// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/rod_joint.h"

#include <initializer_list>

#include "core/numbers.h"

namespace spherocylinder {

namespace {

// The second rod's orientation in the first's body frame, with w >= 0: of q and -q, the same rotation,
// that whose twist is below half a turn.
Quaternion relative_orientation(const Quaternion &first, const Quaternion &second)
{
  const Quaternion q = Quaternion{first.w, -first.x, -first.y, -first.z} * second;
  return q.w < 0.0 ? Quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}

// With s = sin and c = cos of half the bend: bend/s, and (2 c - bend/s)/s^2, of which below this s^2
// differences of nearly equal numbers would be left.
constexpr double kSmallSine = 1e-3;

void set_bend(const Quaternion &q, JointDeformation &d)
{
  const double squared = q.x * q.x + q.y * q.y;
  d.bend_cosine = std::sqrt(q.w * q.w + q.z * q.z);
  if (squared >= kSmallSine) {
    const double sine = std::sqrt(squared);
    d.bend_by_sine = 2.0 * std::atan2(sine, d.bend_cosine) / sine;
    d.bend_slope = (2.0 * d.bend_cosine - d.bend_by_sine) / squared;
  } else {
    // Series of 2 asin(s)/s and of 2 sqrt(1 - s^2): the next terms are below 1e-16 of the first.
    const double y = squared;
    d.bend_by_sine =
        2.0 + y * (1.0 / 3.0 + y * (3.0 / 20.0 + y * (5.0 / 56.0 + y * (35.0 / 576.0))));
    d.bend_slope =
        -(4.0 / 3.0 + y * (2.0 / 5.0 + y * (3.0 / 14.0 + y * (5.0 / 36.0 + y * (35.0 / 352.0)))));
  }
  d.bend_x = d.bend_by_sine * q.x;
  d.bend_y = d.bend_by_sine * q.y;
}

// Into (-pi, pi]: a twist beyond its rest state.
double less_than_half_turn(double angle)
{
  return angle > pi ? angle - 2.0 * pi : angle <= -pi ? angle + 2.0 * pi : angle;
}

// The couple on the first rod, space frame. A small turn w of the second rod, in the first's body frame,
// changes its quaternion (q, v) by dq = -w.v/2, dv = (q w + w x v)/2; the couple is the derivative of the
// energy by w.
Vec3 elastic_couple(const JointedRod &first, const JointDeformation &d,
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

}  // namespace

JointDeformation joint_deformation(const JointedRod &first, const JointedRod &second)
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
  d.twist = 2.0 * std::atan2(d.relative.z, d.relative.w);
  return d;
}

// With u = gap, n = sum/|sum| of the axes a and b, and the derivatives of the energy by u and by n,
//   G = K_shear u + (K_stretch - K_shear)(u.n) n,  D = (K_stretch - K_shear)(u.n) u,
// the first rod feels G at its shared point and -a x D_across/|sum| by its turn, the second -G at its own
// and -b x D_across/|sum|. Moved to the point midway, with u x G = -n x D, couples +-(b - a) x
// D_across/(2 |sum|) are left.
JointLoad elastic_load(const JointedRod &first, const JointDeformation &d,
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

JointChannels joint_energies(const JointDeformation &d, const JointChannels &stiffness,
                             const JointRest &rest)
{
  const double bend_x = d.bend_x - rest.bend_x, bend_y = d.bend_y - rest.bend_y;
  const double twist = less_than_half_turn(d.twist - rest.twist);
  return {0.5 * stiffness.stretch * d.stretch * d.stretch,
          0.5 * stiffness.shear * norm_squared(d.shear),
          0.5 * stiffness.bend * (bend_x * bend_x + bend_y * bend_y),
          0.5 * stiffness.twist * twist * twist};
}

void add_damping(const JointedRod &first, const RodMotion &motion_of_first,
                 const JointedRod &second, const RodMotion &motion_of_second,
                 const JointDeformation &d, const JointChannels &c, JointLoad &load)
{
  const Vec3 velocity =
      motion_of_second.velocity + cross(motion_of_second.omega, load.point - second.centre) -
      motion_of_first.velocity - cross(motion_of_first.omega, load.point - first.centre);
  const Vec3 omega = motion_of_second.omega - motion_of_first.omega;
  load.force =
      load.force + c.shear * velocity + ((c.stretch - c.shear) * dot(velocity, d.mean)) * d.mean;
  load.couple = load.couple + c.bend * omega + ((c.twist - c.bend) * dot(omega, d.mean)) * d.mean;
}

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

JointChannels squared_joint_frequencies(const JointedMass &rod, const JointChannels &k)
{
  return {2.0 * k.stretch / rod.mass,
          2.0 * k.shear * rod.half_length * rod.half_length / rod.inertia_transverse,
          2.0 * k.bend / rod.inertia_transverse, 2.0 * k.twist / rod.inertia_axial};
}

}  // namespace spherocylinder
