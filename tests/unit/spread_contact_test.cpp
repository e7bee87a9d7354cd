// SPDX-License-Identifier: GPL-2.0-or-later
// The contact rule for nearly parallel rods: where the closest point jumps, it must not.
#include "core/spread_contact.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "test_support.h"

using namespace spherocylinder;

namespace {

constexpr double kReach = 1.0;     // two rods of diameter 1
constexpr double kHalf = 4.5;      // lambda = 10
constexpr double kOverlap = 0.01;  // of the rods when parallel

// Rod j lies on rod i, shifted along it, tilted by `tilt` (its ends up and down) and turned by
// `turn` (crossing it) about its centre.
struct Scene {
  Segment i, j;
};

Scene stacked(double tilt, double turn, double shift)
{
  const Vec3 axis = {std::cos(tilt) * std::cos(turn), std::cos(tilt) * std::sin(turn),
                     std::sin(tilt)};
  return {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, kHalf},
          {{shift, 0.0, kReach - kOverlap}, axis, kHalf}};
}

// Unit stiffness: force on i and its torque about i's centre.
struct Load {
  Vec3 force, torque;
};

// The same and the torque on j about j's centre.
struct PairLoad {
  Vec3 force, torque_i, torque_j;
};

PairLoad pair_load(const Segment &i, const Segment &j, const RodContact &contact)
{
  const ClosestPoints &c = contact.points;
  const Vec3 force = (contact.overlap / norm(c.delta)) * c.delta + contact.sideways;
  return {force, cross(c.s * i.axis, force) + contact.couple_i,
          contact.couple_j - cross(c.t * j.axis, force)};
}

Load load_of(const Scene &scene, bool spread)
{
  const ClosestPoints closest = closest_points(scene.i, scene.j);
  if (closest.distance_squared >= kReach * kReach) return {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  RodContact contact{closest, kReach - std::sqrt(closest.distance_squared)};
  if (spread) contact = spread_contact(scene.i, scene.j, kReach, closest);
  const PairLoad load = pair_load(scene.i, scene.j, contact);
  return {load.force, load.torque_i};
}

// Largest change of the torque between neighbouring poses while an angle goes through zero in
// steps of 1e-6 rad.
double largest_jump(bool spread, bool tilting, double shift)
{
  double worst = 0.0;
  Load last = load_of(tilting ? stacked(-5e-3, 0.0, shift) : stacked(0.0, -5e-3, shift), spread);
  for (int k = -4999; k <= 5000; k++) {
    const double angle = 1e-6 * k;
    const Load load =
        load_of(tilting ? stacked(angle, 0.0, shift) : stacked(0.0, angle, shift), spread);
    worst = std::max({worst, norm(load.torque - last.torque), norm(load.force - last.force)});
    last = load;
  }
  return worst;
}

}  // namespace

// Closed form: parallel rods touch at the middle of their common length, with the whole overlap.
TEST(SpreadContact, ParallelRodsTouchAtTheMiddleOfTheirCommonLength)
{
  for (const double shift : {0.0, 1.0, -3.0, 7.0}) {
    const Scene scene = stacked(0.0, 0.0, shift);
    const RodContact c = spread_contact(scene.i, scene.j, kReach, closest_points(scene.i, scene.j));
    EXPECT_NEAR(c.points.s, 0.5 * shift, 1e-12);
    EXPECT_NEAR(c.points.t, -0.5 * shift, 1e-12);
    EXPECT_NEAR(c.overlap, kOverlap, 1e-15);
  }
}

// Closed form: half springs at the two ends of the rod feel overlap +- H tilt (the tilt is small
// against q = 1, so that the candidates sit at the ends), force k overlap and torque k H^2 tilt; once
// one end has come free only the other half spring pushes.
TEST(SpreadContact, TiltedRodRestsOnTwoHalfSprings)
{
  for (const double overlap_at_b : {0.009, 0.001, 0.0, -0.003}) {
    const double overlap_at_a = 0.011, half = 0.5 * (overlap_at_a - overlap_at_b) / kHalf;
    const double tilt = std::asin(half);
    Scene scene = stacked(tilt, 0.0, 0.0);
    scene.j.centre.z = kReach - 0.5 * (overlap_at_a + overlap_at_b);
    const Load load = load_of(scene, true);
    const double a = overlap_at_a, b = std::max(0.0, overlap_at_b);
    // The candidates have left the ends by q^2 = (H tilt)^2/(2 reach overlap) < 0.3 %, twice.
    EXPECT_NEAR(norm(load.force), 0.5 * (a + b), 0.01 * a) << overlap_at_b;
    EXPECT_NEAR(norm(load.torque), 0.5 * kHalf * (a - b), 0.01 * kHalf * a) << overlap_at_b;
  }
}

// Two half springs at the ends resist a tilt with H^2 per radian and stiffness; the way the contact
// moves on to one end makes it steeper, never more than five times. The closest point alone jumps by
// overlap x H = 0.045 at zero tilt.
TEST(SpreadContact, TorqueHasNoJumpWhereTheClosestPointJumps)
{
  const double steepest = 5.0 * kHalf * kHalf * 1e-6;
  for (const double shift : {0.0, 2.0, -5.0}) {
    EXPECT_LT(largest_jump(true, true, shift), steepest) << "tilt, shift " << shift;
    EXPECT_LT(largest_jump(true, false, shift), steepest) << "turn, shift " << shift;
  }
  EXPECT_GT(largest_jump(false, true, 0.0), kOverlap * kHalf);
}

// A contact that begins or ends does so at zero force, whatever the angle.
TEST(SpreadContact, ForceIsContinuousInTheOverlap)
{
  for (const double tilt : {0.0, 1e-4, 1e-3, 1e-2}) {
    double last = 0.0;
    for (int k = 0; k <= 2000; k++) {
      Scene scene = stacked(tilt, 0.3 * tilt, 1.0);
      scene.j.centre.z = kReach + kHalf * std::sin(tilt) + 0.001 - 1e-5 * k;
      const double force = norm(load_of(scene, true).force);
      EXPECT_NEAR(force, last, 1.1e-5) << "tilt " << tilt << " step " << k;
      last = force;
    }
  }
}

// Rods that slide along each other until they lie side by side, or no longer do, tilted or not: steps
// of 1e-6 along the rod change the force and the torque in proportion. The steepest is the tilt, which
// moves the overlap by tilt a unit, and the way the contact moves on; a jump would be of 1e-3.
TEST(SpreadContact, NoJumpWhereRodsComeToLieSideBySide)
{
  for (const double tilt : {0.0, 0.001, 0.02, 0.05, 0.14}) {
    for (const double turn : {0.0, 0.01}) {
      Scene scene = stacked(tilt, turn, 0.0);
      const double along = 2.0 * kHalf;  // where the ends pass each other
      Load last{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
      double worst = 0.0;
      for (int k = 0; k <= 400000; k++) {
        const double shift = along - 0.2 + 1e-6 * k;
        // The near end of j stays at the same height above i.
        scene.j.centre = {shift, 0.0, kReach - kOverlap + kHalf * std::sin(tilt)};
        const Load load = load_of(scene, true);
        if (k > 0)
          worst = std::max({worst, norm(load.force - last.force), norm(load.torque - last.torque)});
        last = load;
      }
      EXPECT_LT(worst, 2e-5) << "tilt " << tilt << " turn " << turn;
    }
  }
}

// Pushed straight into each other until the axes meet, nearly parallel rods feel no jump either.
TEST(SpreadContact, ForceIsContinuousUntilTheAxesMeet)
{
  for (const double tilt : {0.0, 0.01, 0.03}) {
    for (const double turn : {0.001, 0.01, 0.03}) {
      Load last{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
      double worst = 0.0;
      Scene scene = stacked(tilt, turn, 0.5);
      for (double height = 1.0; height > 0.5; height -= 1e-5) {
        scene.j.centre.z = height;
        const Load load = load_of(scene, true);
        if (height < 1.0)
          worst = std::max({worst, norm(load.force - last.force), norm(load.torque - last.torque)});
        last = load;
      }
      EXPECT_LT(worst, 1e-3) << "tilt " << tilt << " turn " << turn;
    }
  }
}

double smooth_step(double x) { return x * x * (3.0 - 2.0 * x); }

// The energy the rule states, written out once more: E/k =
// ((1 - g) overlap*^2 + g (overlap_A^2 + overlap_B^2)/2)/2.
double energy_of(const Scene &scene)
{
  const Segment &i = scene.i, &j = scene.j;
  const double overlap = kReach - std::sqrt(closest_points(i, j).distance_squared);
  if (overlap <= 0.0) return 0.0;
  const double sine = norm(cross(i.axis, j.axis)), h = std::min(i.half_length, j.half_length);
  const double q2 = h * h * sine * sine * (1.0 + 100.0 * overlap * overlap / (kReach * kReach)) /
                    (2.0 * kReach * overlap);
  double squares = 0.0, half[2];
  for (const bool on_j : {false, true}) {
    const Segment &one = on_j ? j : i, &other = on_j ? i : j;
    const double middle = dot(other.centre - one.centre, one.axis);
    const double reach = other.half_length * std::fabs(dot(one.axis, other.axis));
    const double ends[] = {std::max(-one.half_length, middle - reach),
                           std::min(one.half_length, middle + reach)};
    half[on_j] = 0.5 * (ends[1] - ends[0]);
    for (const double s : ends) {
      const Vec3 point = one.at(s);
      const double at_end =
          std::max(0.0, kReach - norm(point - other.at(closest_position(other, point))));
      squares += 0.25 * at_end * at_end;
    }
  }
  if (q2 >= 1.0 || half[0] <= 0.0 || half[1] <= 0.0) return 0.5 * overlap * overlap;
  const double m = smooth_step(std::min(half[0], half[1]) / std::max(half[0], half[1]));
  const double f = smooth_step(std::min(1.0, (1.0 - overlap / kReach) / 0.9));
  const double g = (1.0 - q2) * (1.0 - q2) * m * f;
  return 0.5 * ((1.0 - g) * overlap * overlap + g * squares);
}

// Any two rods that are spread over, of any aspect ratio from 1.2 to 20, unequal too, from a touch to
// half a diameter deep.
Scene any_spread(RandomRods &random)
{
  for (;;) {
    const double h = 0.5 * random.log_uniform(0.2, 19.0), overlap = random.log_uniform(1e-4, 0.5);
    const double widest = std::sqrt(2.0 * overlap) / h;  // about where q = 1
    Scene scene = stacked(widest * random.uniform(-1.0, 1.0), widest * random.uniform(-1.0, 1.0),
                          2.1 * h * random.uniform(-1.0, 1.0));
    scene.i.half_length = h;
    scene.j.half_length = random.below(2) ? h : h * random.uniform(0.3, 1.0);
    scene.j.centre.y = 0.3 * overlap * random.uniform(-1.0, 1.0);
    scene.j.centre.z = 1.0 - overlap;
    const ClosestPoints closest = closest_points(scene.i, scene.j);
    if (closest.distance_squared >= kReach * kReach || closest.distance_squared < 0.2) continue;
    const RodContact contact = spread_contact(scene.i, scene.j, kReach, closest);
    if (contact.share != 1.0) return scene;
  }
}

// Force and torques are the derivatives of that energy, against central differences over small moves
// and turns of either rod.
TEST(SpreadContact, ForceAndTorquesAreDerivativesOfItsEnergy)
{
  RandomRods random(15485867);
  constexpr double kStep = 1e-6;
  double worst_force = 0.0, worst_torque = 0.0;
  for (int k = 0; k < 20000; k++) {
    const Scene scene = any_spread(random);
    const RodContact contact =
        spread_contact(scene.i, scene.j, kReach, closest_points(scene.i, scene.j));
    const PairLoad load = pair_load(scene.i, scene.j, contact);
    const double size = contact.overlap, lever = 0.5 * kReach + scene.i.half_length;
    for (const bool on_j : {false, true})
      for (const Vec3 direction : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
        double moved[2], turned[2];
        for (const int side : {0, 1}) {
          const double by = side ? kStep * contact.overlap : -kStep * contact.overlap;
          Scene other = scene;
          Segment &rod = on_j ? other.j : other.i;
          rod.centre = rod.centre + by * direction;
          moved[side] = energy_of(other);
          other = scene;
          const Vec3 axis = rod.axis + (by / lever) * cross(direction, rod.axis);
          rod.axis = (1.0 / norm(axis)) * axis;
          turned[side] = energy_of(other);
        }
        const double force = -(moved[1] - moved[0]) / (2.0 * kStep * contact.overlap);
        const double torque = -(turned[1] - turned[0]) / (2.0 * kStep * contact.overlap / lever);
        const Vec3 own = on_j ? -load.force : load.force;
        const Vec3 couple = on_j ? load.torque_j : load.torque_i;
        worst_force = std::max(worst_force, std::fabs(force - dot(own, direction)) / size);
        worst_torque =
            std::max(worst_torque, std::fabs(torque - dot(couple, direction)) / (lever * size));
      }
  }
  std::printf("worst: force %.1e, torque %.1e of force x half length\n", worst_force, worst_torque);
  EXPECT_LT(worst_force, 2e-5);
  EXPECT_LT(worst_torque, 2e-5);
}

// Force and counterforce have no moment together, whatever the directions at the three points.
TEST(SpreadContact, HasNoTotalTorque)
{
  RandomRods random(32452867);
  double worst = 0.0;
  for (int k = 0; k < 20000; k++) {
    const Scene scene = any_spread(random);
    const RodContact contact =
        spread_contact(scene.i, scene.j, kReach, closest_points(scene.i, scene.j));
    const PairLoad load = pair_load(scene.i, scene.j, contact);
    const Vec3 total =
        load.torque_i + load.torque_j + cross(scene.i.centre - scene.j.centre, load.force);
    const double lever = norm(scene.i.centre - scene.j.centre) + scene.i.half_length;
    worst = std::max(worst, norm(total) / (lever * contact.overlap));
  }
  EXPECT_LT(worst, 64.0 * kEpsilon);
}

// One contact of one stiffness: the force is never above that of the closest point, and not below
// half of it.
TEST(SpreadContact, StiffnessIsThatOfOneContact)
{
  RandomRods random(15485863);
  double lowest = 1.0;
  for (int k = 0; k < 200000; k++) {
    const Scene scene =
        stacked(random.uniform(-0.01, 0.01) * random.uniform(0.0, 1.0),
                random.uniform(-0.3, 0.3) * random.uniform(0.0, 1.0), random.uniform(-8.0, 8.0));
    const double plain = norm(load_of(scene, false).force);
    if (plain < 1e-9) continue;
    const double ratio = norm(load_of(scene, true).force) / plain;
    ASSERT_LE(ratio, 1.0 + 1e-12);
    lowest = std::min(lowest, ratio);
  }
  RecordProperty("lowest_ratio", std::to_string(lowest));
  EXPECT_GE(lowest, 0.5 - 1e-12);
}

// Crossed rods: the patch is short against the rods and the closest point is the contact.
TEST(SpreadContact, CrossedRodsKeepTheirClosestPoint)
{
  const Scene scene = stacked(0.0, 1.0, 0.5);
  const ClosestPoints plain = closest_points(scene.i, scene.j);
  const ClosestPoints c = spread_contact(scene.i, scene.j, kReach, plain).points;
  EXPECT_EQ(c.s, plain.s);
  EXPECT_EQ(c.t, plain.t);
  EXPECT_EQ(c.distance_squared, plain.distance_squared);
}

// Which rod is i does not matter: the overlap is the same and the points trade places.
TEST(SpreadContact, IsTheSameFromEitherRod)
{
  RandomRods random(32452843);
  int spread = 0;
  for (int k = 0; k < 200000; k++) {
    Scene scene =
        stacked(random.uniform(-0.01, 0.01), random.uniform(-0.1, 0.1), random.uniform(-8.0, 8.0));
    scene.j.half_length *= random.uniform(0.2, 1.0);
    const ClosestPoints closest = closest_points(scene.i, scene.j);
    if (closest.distance_squared >= kReach * kReach) continue;
    const RodContact one = spread_contact(scene.i, scene.j, kReach, closest);
    const RodContact other = spread_contact(
        scene.j, scene.i, kReach, {closest.t, closest.s, -closest.delta, closest.distance_squared});
    spread += one.overlap < kReach - std::sqrt(closest.distance_squared);
    ASSERT_NEAR(other.overlap, one.overlap, 1e-14);
    ASSERT_NEAR(other.points.s, one.points.t, 1e-10);
    ASSERT_NEAR(other.points.t, one.points.s, 1e-10);
  }
  EXPECT_GT(spread, 10000);
}

// Any size: the rule has no length of its own.
TEST(SpreadContact, Rescales)
{
  for (const double scale : {1e-6, 1e3}) {
    Scene scene = stacked(1e-3, 2e-3, 1.0);
    const ClosestPoints one =
        spread_contact(scene.i, scene.j, kReach, closest_points(scene.i, scene.j)).points;
    for (Segment *segment : {&scene.i, &scene.j}) {
      segment->centre = scale * segment->centre;
      segment->half_length *= scale;
    }
    const ClosestPoints other =
        spread_contact(scene.i, scene.j, scale * kReach, closest_points(scene.i, scene.j)).points;
    EXPECT_NEAR(other.s / scale, one.s, 1e-9);
    EXPECT_NEAR(other.t / scale, one.t, 1e-9);
  }
}
