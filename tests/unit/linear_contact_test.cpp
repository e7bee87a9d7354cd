// SPDX-License-Identifier: GPL-2.0-or-later
// The batched spring, dashpot and slider against the law written down once more, one contact at a
// time in long double: the effective mass from the full inertia tensor, velocities and torques from
// the contact point in space, the spring turned by Rodrigues' formula.
#include "core/linear_contact.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "inertia_tensor.h"
#include "test_support.h"

using namespace spherocylinder;

namespace {

struct Long3 {
  long double x = 0.0L, y = 0.0L, z = 0.0L;

  Long3() = default;
  Long3(long double a, long double b, long double c) : x(a), y(b), z(c) {}
  Long3(const Vec3 &a) : x(a.x), y(a.y), z(a.z) {}
};

Long3 operator+(const Long3 &a, const Long3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Long3 operator-(const Long3 &a, const Long3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Long3 operator*(long double s, const Long3 &a) { return {s * a.x, s * a.y, s * a.z}; }
long double dot(const Long3 &a, const Long3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
long double norm(const Long3 &a) { return std::sqrt(dot(a, a)); }
Long3 cross(const Long3 &a, const Long3 &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Long3 turned(const Long3 &v, const Long3 &k, long double angle)
{
  return std::cos(angle) * v + std::sin(angle) * cross(k, v) +
         ((1.0L - std::cos(angle)) * dot(k, v)) * k;
}

struct Rod {
  MassProperties properties;
  bool frozen;
  double radius;
  Vec3 centre, axis, velocity, omega;
};

struct Contact {
  Rod i, j;
  double s, t, distance, overlap;  // the last two before the side is minded
  Vec3 normal, side, spring;
  double kn, kt, two_beta, friction;
  double share;  // as spread_contact gives it
};

struct Result {
  Long3 force, torque_i, torque_j, spring, side;
  long double inverse_mass, overlap;
  bool pulls, slides;
  long double force_size, torque_size, spring_size;  // of what adds up
};

constexpr double kStep = 1e-6;  // s

// Rods of 1 to 100 diameters of any size whose axis points, at s and t, are `distance` apart. All
// rates are such that a step turns rods by less than 2e-5: Cayley's turn of the spring, by
// 2 atan(x) for the angle 2x = omega dt/2, is then Rodrigues' to 2x^3/3 < 1e-15.
Contact random_contact(RandomRods &random, double diameter)
{
  const auto rod = [&] {
    Rod r;
    const double d = diameter * random.uniform(0.5, 2.0);
    r.properties = mass_properties(d, d * random.log_uniform(1.0, 100.0), kDensity);
    r.frozen = false;
    r.radius = 0.5 * d;
    r.axis = random.direction();
    r.velocity = random.vector(diameter * random.log_uniform(1.0, 1e3));
    r.omega = random.vector(random.log_uniform(0.1, 10.0));
    return r;
  };
  Contact c;
  c.i = rod();
  c.j = rod();
  const int frozen = random.below(8);  // now and then one of them, never both
  c.i.frozen = frozen == 0;
  c.j.frozen = frozen == 1;
  c.s = 10.0 * diameter * random.uniform(-1.0, 1.0);
  c.t = 10.0 * diameter * random.uniform(-1.0, 1.0);
  const double reach = c.i.radius + c.j.radius;
  c.distance = reach * random.uniform(0.3, 1.0);
  // Half of the contacts feel an overlap of their own, as spread_contact gives them.
  c.share = random.below(2) ? 1.0 : random.uniform(0.5, 1.0);
  c.overlap = (reach - c.distance) * c.share;
  c.normal = random.direction();
  c.i.centre = random.vector(10.0 * diameter);
  c.j.centre = c.i.centre + c.s * c.i.axis - c.distance * c.normal - c.t * c.j.axis;
  // New contacts, old ones and passed ones.
  const Vec3 near = RandomRods::unit(c.normal + 0.01 * random.direction());
  const int past = random.below(3);
  c.side = past == 0 ? Vec3{0.0, 0.0, 0.0} : past == 1 ? near : -near;

  // Spring, dashpot and slider of like strength: a contact of kn R lasts some ten thousand steps.
  const double mass = c.i.properties.mass;
  c.kn = mass * random.log_uniform(1e4, 1e6);
  c.kt = c.kn * random.uniform(0.3, 1.0);
  c.two_beta = random.uniform(0.0, 1.0);
  c.friction = random.log_uniform(0.05, 5.0);
  c.spring = diameter * random.log_uniform(1e-3, 1.0) * random.across(c.normal);
  if (past == 0) c.spring = {0.0, 0.0, 0.0};
  return c;
}

Contact swapped(const Contact &c)
{
  Contact other = c;
  std::swap(other.i, other.j);
  std::swap(other.s, other.t);
  other.normal = -c.normal;
  other.side = -c.side;
  other.spring = -c.spring;  // the way i's surface has gone on j's
  return other;
}

struct Batch {
  ContactArms arms{};
  LinearMaterials materials{};
  ContactLoads loads{};

  void work_out(const LinearOptions &law) { linear_contacts(arms, materials, law, loads); }
};

void set(Batch &all, int k, const Contact &c)
{
  all.arms.arm_i.set(k, c.s * c.i.axis);
  all.arms.arm_j.set(k, c.t * c.j.axis);
  all.arms.velocity_i.set(k, c.i.velocity);
  all.arms.velocity_j.set(k, c.j.velocity);
  all.arms.omega_i.set(k, c.i.omega);
  all.arms.omega_j.set(k, c.j.omega);
  all.arms.inverse_mass_i[k] = c.i.frozen ? 0.0 : 1.0 / c.i.properties.mass;
  all.arms.inverse_mass_j[k] = c.j.frozen ? 0.0 : 1.0 / c.j.properties.mass;
  all.arms.inverse_inertia_i[k] = c.i.frozen ? 0.0 : 1.0 / c.i.properties.inertia_transverse;
  all.arms.inverse_inertia_j[k] = c.j.frozen ? 0.0 : 1.0 / c.j.properties.inertia_transverse;
  all.arms.radius_i[k] = c.i.radius;
  all.arms.radius_j[k] = c.j.radius;
  all.arms.normal.set(k, c.normal);
  all.arms.distance[k] = c.distance;
  all.arms.overlap[k] = c.overlap;
  all.materials.stiffness[k] = c.kn;
  all.arms.mass_share[k] = c.share;
  all.materials.tangential_stiffness[k] = c.kt;
  all.materials.two_beta[k] = c.two_beta;
  all.materials.friction[k] = c.friction;
  all.arms.turning[k] = k % 4 ? 1.0 : 0.0;
  all.arms.side.set(k, c.side);
  all.materials.spring.set(k, c.spring);
}

// 1/m + (a x n)^T I^-1 (a x n)
long double inverse_mass_at(const Rod &rod, const Long3 &arm, const Long3 &n)
{
  if (rod.frozen) return 0.0L;
  return 1.0L / rod.properties.mass +
         contracted(inverse(inertia_tensor(rod.axis, rod.properties)), cross(arm, n));
}

Result by_hand(const Contact &c, const LinearOptions &law, bool turning)
{
  Result r;
  const long double dt = law.dt, reach = static_cast<long double>(c.i.radius) + c.j.radius;
  // The normal of the last step tells on which side i is. If p - q points the other way the axes
  // have passed each other.
  const bool passed = dot(Long3(c.normal), Long3(c.side)) < 0.0L;
  const Long3 n = (passed ? -1.0L : 1.0L) * Long3(c.normal);
  const Long3 p = Long3(c.i.centre) + static_cast<long double>(c.s) * Long3(c.i.axis);
  const Long3 q = Long3(c.j.centre) + static_cast<long double>(c.t) * Long3(c.j.axis);
  const long double distance = dot(p - q, n);
  r.overlap = passed ? reach - distance : c.overlap;
  r.side = n;

  // Where the surfaces, i's at p - r_i n and j's at q + r_j n, have their middle.
  const Long3 at = 0.5L * ((p - static_cast<long double>(c.i.radius) * n) +
                           (q + static_cast<long double>(c.j.radius) * n));

  const auto velocity = [&](const Rod &rod, const Long3 &on_axis) {
    const Long3 omega(rod.omega), arm = on_axis - Long3(rod.centre);
    const Long3 half_a_step_ago = arm - (0.5L * dt) * cross(omega, arm);
    return Long3(rod.velocity) + cross(omega, half_a_step_ago) + cross(omega, at - on_axis);
  };
  const Long3 between = velocity(c.i, p) - velocity(c.j, q);
  const long double vn = dot(between, n);
  const Long3 slip = between - vn * n;

  const Long3 arm_i = at - Long3(c.i.centre), arm_j = at - Long3(c.j.centre);
  r.inverse_mass = inverse_mass_at(c.i, arm_i, n) + inverse_mass_at(c.j, arm_j, n);
  const long double m_eff = c.share / r.inverse_mass;  // damped for its share of the stiffness
  const long double gamma_n = c.two_beta * std::sqrt(c.kn * m_eff);
  const long double gamma_t = law.tangential_damping ? c.two_beta * std::sqrt(c.kt * m_eff) : 0.0L;

  long double Fn = c.kn * r.overlap - gamma_n * vn;
  r.pulls = Fn < 0.0L;
  if (law.limit_force) Fn = std::max(Fn, 0.0L);
  const long double most = c.friction * std::fabs(Fn);

  Long3 Ft;
  r.slides = false;
  r.spring = c.spring;
  if (law.tangential == Tangential::NoHistory) {
    Ft = -gamma_t * slip;
    r.slides = norm(Ft) > most;
    if (r.slides) Ft = (-most / norm(slip)) * slip;
  } else if (law.tangential == Tangential::History) {
    // By the mean of the two spins about the normal.
    const long double rate = 0.5L * dot(Long3(c.i.omega) + Long3(c.j.omega), n);
    r.spring = (turning ? turned(c.spring, n, rate * dt) : Long3(c.spring)) + dt * slip;
    r.spring = r.spring - dot(r.spring, n) * n;
    Ft = -static_cast<long double>(c.kt) * r.spring - gamma_t * slip;
    if (law.slider == SliderLimits::WholeForce) {
      r.slides = norm(Ft) > most;
      if (r.slides) {
        // What the dashpot, itself within the limit, leaves to the spring.
        Ft = (most / norm(Ft)) * Ft;
        const long double dragging = gamma_t * norm(slip);
        const long double drag = std::min(dragging, most);
        r.spring =
            (-1.0L / c.kt) * (Ft + (dragging > 0.0L ? drag / dragging * gamma_t : 0.0L) * slip);
      }
    } else {
      r.slides = c.kt * norm(r.spring) > most;  // the spring decides, its dashpot does not
      if (r.slides) {
        r.spring = (most / (c.kt * norm(r.spring))) * r.spring;
        Ft = -static_cast<long double>(c.kt) * r.spring;
      }
    }
  }

  r.force = Fn * n + Ft;
  r.torque_i = cross(arm_i, r.force);
  r.torque_j = cross(arm_j, -1.0L * r.force);
  const long double speed = norm(c.i.velocity) + norm(c.j.velocity) +
                            norm(c.i.omega) * norm(arm_i) + norm(c.j.omega) * norm(arm_j);
  r.spring_size = norm(c.spring) + dt * speed;
  r.force_size =
      (c.kn * (r.overlap + r.spring_size) + (gamma_n + gamma_t) * speed) * (1.0L + c.friction);
  if (r.slides) r.spring_size += r.force_size / c.kt;  // the normal force sets its length
  r.torque_size = r.force_size * (norm(arm_i) + norm(arm_j));
  return r;
}

using Options = std::tuple<Tangential, bool, bool, SliderLimits>;

class LinearContact : public testing::TestWithParam<Options> {
 protected:
  LinearOptions law() const
  {
    const auto [tangential, damping, limit, slider] = GetParam();
    return {tangential, damping, limit, slider, kStep, kStep};
  }
};

std::string name_of(const Options &options)
{
  const auto [tangential, damping, limit, slider] = options;
  return std::string(tangential == Tangential::Off         ? "Off"
                     : tangential == Tangential::NoHistory ? "NoHistory"
                                                           : "History") +
         (damping ? "" : "WithoutDamping") + (limit ? "LimitForce" : "") +
         (slider == SliderLimits::WholeForce ? "" : "SpringAlone");
}

// Some ten roundings of what adds up.
constexpr double kRoundOff = 64.0 * kEpsilon;

}  // namespace

TEST_P(LinearContact, AgreesWithTheLawInLongDouble)
{
  RandomRods random(15485867);
  double worst_force = 0.0, worst_torque = 0.0, worst_spring = 0.0, worst_mass = 0.0;
  int pulling = 0, sliding = 0, passed = 0, contacts = 0;
  Batch all{};
  for (const double diameter : kDiameters)
    for (int batch = 0; batch < 100; batch++) {
      Contact input[kBatch];
      for (int k = 0; k < kBatch; k++) {
        input[k] = random_contact(random, diameter);
        set(all, k, input[k]);
      }
      all.work_out(law());
      for (int k = 0; k < kBatch; k++) {
        const Result r = by_hand(input[k], law(), k % 4 != 0);
        const auto error = [](const Vec3 &got, const Long3 &expected, long double size) {
          return static_cast<double>(norm(Long3(got) - expected) / size);
        };
        worst_force = std::max(worst_force, error(all.loads.force.get(k), r.force, r.force_size));
        worst_torque =
            std::max({worst_torque, error(all.loads.torque_i.get(k), r.torque_i, r.torque_size),
                      error(all.loads.torque_j.get(k), r.torque_j, r.torque_size)});
        // Tangential off and no_history leave the spring alone.
        worst_spring =
            std::max(worst_spring, error(all.materials.spring.get(k), r.spring, r.spring_size));
        worst_mass = std::max(worst_mass, static_cast<double>(std::fabs(
                                              all.loads.inverse_mass[k] / r.inverse_mass - 1.0L)));
        ASSERT_EQ(error(all.arms.normal.get(k), r.side, 1.0L), 0.0);
        ASSERT_NEAR(all.arms.overlap[k], static_cast<double>(r.overlap), 1e-13 * diameter);
        pulling += r.pulls;
        sliding += r.slides;
        passed += r.overlap > input[k].i.radius + input[k].j.radius;
        contacts++;
      }
    }
  std::printf("worst: force %.1e, torque %.1e, spring %.1e, 1/m_eff %.1e; %d pull, %d slide, "
              "%d passed of %d\n",
              worst_force, worst_torque, worst_spring, worst_mass, pulling, sliding, passed,
              contacts);
  EXPECT_LT(worst_force, kRoundOff);
  EXPECT_LT(worst_torque, kRoundOff);
  EXPECT_LT(worst_spring, kRoundOff);
  // The full tensor weighs what rounding leaves of a x n along the axis with I_t/I_a < 7e3.
  EXPECT_LT(worst_mass, 1e-13);
  // All branches are taken.
  EXPECT_GT(pulling, contacts / 50);
  EXPECT_GT(passed, contacts / 4);
  const bool can_slide = law().tangential == Tangential::History ||
                         (law().tangential == Tangential::NoHistory && law().tangential_damping);
  if (can_slide) {
    EXPECT_GT(sliding, contacts / 20);
    EXPECT_LT(sliding, contacts - contacts / 20);
  }
}

// Which rod is i means nothing: the force on it is the opposite of the force on j, the torques
// trade places, the spring and the normal turn round.
TEST_P(LinearContact, IsTheSameFromEitherRod)
{
  RandomRods random(32452867);
  double worst = 0.0;
  Batch one{}, other{};
  for (int batch = 0; batch < 200; batch++) {
    Contact input[kBatch];
    for (int k = 0; k < kBatch; k++) {
      input[k] = random_contact(random, 0.01);
      set(one, k, input[k]);
      set(other, k, swapped(input[k]));
    }
    one.work_out(law());
    other.work_out(law());
    for (int k = 0; k < kBatch; k++) {
      const Result r = by_hand(input[k], law(), k % 4 != 0);
      const auto sum = [](const Vec3 &a, const Vec3 &b, long double size) {
        return static_cast<double>(norm(Long3(a + b)) / size);
      };
      worst =
          std::max({worst, sum(one.loads.force.get(k), other.loads.force.get(k), r.force_size),
                    sum(one.loads.torque_i.get(k), -other.loads.torque_j.get(k), r.torque_size),
                    sum(one.loads.torque_j.get(k), -other.loads.torque_i.get(k), r.torque_size),
                    sum(one.materials.spring.get(k), other.materials.spring.get(k), r.spring_size),
                    sum(one.arms.normal.get(k), other.arms.normal.get(k), 1.0L)});
    }
  }
  EXPECT_LT(worst, kRoundOff);
}

// A contact has one point: force and counterforce have no moment about any fixed point,
// T_i + T_j + x_i x F - x_j x F = 0.
TEST_P(LinearContact, HasNoTotalTorque)
{
  RandomRods random(49979687);
  double worst = 0.0;
  Batch all{};
  for (int batch = 0; batch < 200; batch++) {
    Contact input[kBatch];
    for (int k = 0; k < kBatch; k++) {
      input[k] = random_contact(random, 0.01);
      set(all, k, input[k]);
    }
    all.work_out(law());
    for (int k = 0; k < kBatch; k++) {
      const Vec3 force = all.loads.force.get(k), xi = input[k].i.centre, xj = input[k].j.centre;
      const Vec3 total =
          all.loads.torque_i.get(k) + all.loads.torque_j.get(k) + cross(xi - xj, force);
      const double size = norm(all.loads.torque_i.get(k)) + norm(all.loads.torque_j.get(k)) +
                          (norm(xi) + norm(xj)) * norm(force);
      worst = std::max(worst, norm(total) / size);
    }
  }
  EXPECT_LT(worst, kRoundOff);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, LinearContact,
    testing::Combine(testing::Values(Tangential::Off, Tangential::NoHistory, Tangential::History),
                     testing::Bool(), testing::Bool(),
                     testing::Values(SliderLimits::WholeForce, SliderLimits::SpringAlone)),
    [](const auto &info) { return name_of(info.param); });

// By this the caller knows to leave a contact out; the others of the batch feel nothing of it.
TEST(LinearContacts, TwoFrozenRodsHaveNoInverseMass)
{
  RandomRods random(67867967);
  const LinearOptions law = {Tangential::History,      true,  false,
                             SliderLimits::WholeForce, kStep, kStep};
  Batch all{}, mixed{};
  for (int k = 0; k < kBatch; k++) {
    Contact c = random_contact(random, 0.01);
    set(all, k, c);
    if (k % 2) c.i.frozen = c.j.frozen = true;
    set(mixed, k, c);
  }
  all.work_out(law);
  mixed.work_out(law);
  for (int k = 0; k < kBatch; k++) {
    if (k % 2) {
      EXPECT_EQ(mixed.loads.inverse_mass[k], 0.0);
    } else {
      EXPECT_GT(mixed.loads.inverse_mass[k], 0.0);
      EXPECT_EQ(mixed.loads.force.x[k], all.loads.force.x[k]);
      EXPECT_EQ(mixed.loads.torque_i.x[k], all.loads.torque_i.x[k]);
      EXPECT_EQ(mixed.materials.spring.x[k], all.materials.spring.x[k]);
    }
  }
}

// When a run is set up, LIGGGHTS has the forces of the step before worked out once more: springs pull as
// they are. (That each is across the normal by then makes them stay.)
TEST(LinearContacts, SpringsThatDoNotGoOnStay)
{
  RandomRods random(86028121);
  const LinearOptions law = {Tangential::History,      false, false,
                             SliderLimits::WholeForce, kStep, 0.0};
  Batch all{};
  Contact input[kBatch];
  for (int k = 0; k < kBatch; k++) {
    input[k] = random_contact(random, 0.01);
    input[k].friction = 1e9;
    set(all, k, input[k]);
  }
  all.work_out(law);
  for (int k = 0; k < kBatch; k++) {
    const Vec3 spring = all.materials.spring.get(k), n = all.arms.normal.get(k);
    EXPECT_LT(norm(spring - (input[k].spring - dot(input[k].spring, n) * n)), 1e-15 * 0.01);
    const Vec3 force = all.loads.force.get(k), across = force - dot(force, n) * n;
    const double size = norm(force) + input[k].kt * norm(spring);
    EXPECT_LT(norm(across + input[k].kt * (spring - dot(spring, n) * n)), 1e-12 * size);
  }
}
