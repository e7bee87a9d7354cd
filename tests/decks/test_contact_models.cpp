// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS's own contact models on rods, each against what its formulas say for the two virtual
// spheres of a resting, creeping, hanging or rolling rod. On a floor, whose contacts are the rod's
// ends, and across two fixed rods.
#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

constexpr double kGravity = 9.81;
const double kPi = std::acos(-1.0);

std::string gravity(const Vec3 &direction)
{
  return fmt::format("fix weight all gravity {} vector {} {} {}\n", kGravity, direction.x,
                     direction.y, direction.z);
}

// Rods of type 1 are loose, those of type 2 fixed; the floor is of type 2.
std::string contacts(const std::string &models)
{
  return rod_pair(models) + rod_wall("floor", models, "type 2 zplane 0.0") +
         "group loose type 1\ngroup fixed type 2\nfix hold fixed freeze\n"
         "fix motion loose nve/spherocylinder\n";
}

// Rod 0 lies on the floor, rod 1 across two fixed rods at rods_arm either side of its centre.
Scene lying_rods(const Rod &rod, double sink_on_floor, double sink_on_rods, double rods_arm)
{
  Scene scene;
  scene.types = 2;
  scene.box_lo[2] = -0.1;
  Rod on_floor = rod, on_rods = rod;
  on_floor.position = {0.0, -0.4, rod.radius() - sink_on_floor};
  on_rods.position = {0.0, 0.4, 0.2 + rod.diameter - sink_on_rods};
  scene.rods = {on_floor, on_rods};
  for (const double arm : {-rods_arm, rods_arm}) {
    Rod bar;
    bar.type = 2;
    bar.axis = cross(Vec3{0.0, 0.0, 1.0}, rod.axis);
    bar.position = Vec3{0.0, 0.4, 0.2} + arm * rod.axis;
    scene.rods.push_back(bar);
  }
  return scene;
}

// A normal model: at rest under a load N a contact has the overlap delta, the tangential stiffness
// kt and the tangential damping gammat, and kn = dN/d(delta). R: r on a wall, r/2 of two rods.
struct AtRest {
  double delta, kn, kt, gammat;
};

constexpr double kYoung = 5e7, kPoisson = 0.3, kRestitution = 0.4, kVelocity = 0.1;
constexpr double kNormal = 1e5, kTangential = 4e4, kDamping = 1500.0;  // of hooke/stiffness

const char *const kMaterial = R"(
fix y all property/global youngsModulus peratomtype 5e7 5e7
fix nu all property/global poissonsRatio peratomtype 0.3 0.3
fix cv all property/global characteristicVelocity scalar 0.1
fix gn all property/global gamman peratomtypepair 2 2000 2000 2000 2000
fix gt all property/global gammat peratomtypepair 2 1500 1500 1500 1500
)";

AtRest at_rest(const std::string &model, double N, double R, double m_eff)
{
  const double Y = kYoung / (2.0 * (1.0 - kPoisson * kPoisson));
  const double G = kYoung / (4.0 * (2.0 - kPoisson) * (1.0 + kPoisson));
  const double log_e = std::log(kRestitution), beta = -log_e / std::hypot(log_e, kPi);
  if (model == "hooke/stiffness") return {N / kNormal, kNormal, kTangential, m_eff * kDamping};
  if (model == "hooke") {
    const double scale = 16.0 / 15.0 * std::sqrt(R) * Y;
    const double kn = scale * std::pow(m_eff * kVelocity * kVelocity / scale, 0.2);
    return {N / kn, kn, kn, 2.0 * beta * std::sqrt(m_eff * kn)};  // kt = kn, gammat = gamman
  }
  // hertz: N = 4/3 Y sqrt(R) delta^1.5, kt = 8 G sqrt(R delta)
  const double delta = std::pow(0.75 * N / (Y * std::sqrt(R)), 2.0 / 3.0);
  const double kt = 8.0 * G * std::sqrt(R * delta);
  return {delta, 1.5 * N / delta, kt, 2.0 * std::sqrt(5.0 / 6.0) * beta * std::sqrt(kt * m_eff)};
}

struct Models {
  const char *name, *normal;
  bool history;
};
void PrintTo(const Models &models, std::ostream *out) { *out << models.name; }

class RodModels : public testing::TestWithParam<Models> {};

// A rod down a slope, on two contacts at x from its centre, so that 1/m_eff = 1/m + x^2/I_t and
// each carries N = m g cos(slope)/2 and T = m g sin(slope)/2. Friction, r below the axis, pitches
// it by T r/(kn x^2). On the floor the two ends share the load: their loads are N (1 +- b), b =
// T r/(N x), the ratio of their overlaps w (of loads; hertz: to the power 2/3), and 1/m_eff =
// 1/m + x^2/I_t + w (1/m - x^2/I_t). With a history it rests, moved by T/kt + r times the pitch and sunk in by
// delta(N); without, it creeps at T/gammat.
TEST_P(RodModels, RodOnASlope)
{
  const double slope = degrees(10.0), bars_arm = 0.03;
  const std::string normal = GetParam().normal;
  Rod rod;
  const auto p = rod.properties();
  const double N = 0.5 * p.mass * kGravity * std::cos(slope);
  const double T = 0.5 * p.mass * kGravity * std::sin(slope);
  const double unequal = T * rod.radius() / (N * rod.half_cylinder());
  const double shared =
      std::pow((1.0 - unequal) / (1.0 + unequal), normal == "hertz" ? 2.0 / 3 : 1);
  const auto expected = [&](double arm, double R, double w) {
    const double turning = arm * arm / p.inertia_transverse;
    return at_rest(normal, N, R, 1.0 / (1.0 / p.mass + turning + w * (1.0 / p.mass - turning)));
  };
  const AtRest wanted[] = {expected(rod.half_cylinder(), rod.radius(), shared),
                           expected(bars_arm, 0.5 * rod.radius(), 0.0)};
  Scene scene = lying_rods(rod, wanted[0].delta, wanted[1].delta, bars_arm);
  const std::string models =
      normal + " tangential " + (GetParam().history ? "history" : "no_history");
  scene.physics = kMaterial + linear_material(kNormal, kTangential, kRestitution, 0.5, 2) +
                  contacts(models) + gravity({std::sin(slope), 0.0, -std::cos(slope)});
  scene.dt = 1e-5;
  scene.steps = 8000;
  const std::vector<Rod> after = run(scene).back().rods;

  for (int k = 0; k < 2; k++) {
    SCOPED_TRACE(k == 0 ? "on the floor" : "on two rods");
    const double arm = k == 0 ? rod.half_cylinder() : bars_arm, r = rod.radius();
    const double way = T / wanted[k].kt + T * r * r / (wanted[k].kn * arm * arm);
    const double sink = scene.rods[k].position.z + wanted[k].delta - after[k].position.z;
    // The pitch makes the two overlaps unequal, and the rod creeps away from the middle of its
    // supports: both count by their squares.
    expect_holds({"hooke, hooke/stiffness, hertz, rod on a slope: overlap, relative",
                  "delta(m g cos(a)/2)", 3e-4},
                 std::fabs(sink / wanted[k].delta - 1.0));
    if (GetParam().history)
      expect_holds({normal + ", history, rod on a slope: way to rest, relative",
                    "m g sin(a)/2 (1/kt + r^2/(kn x^2))", 1e-3},
                   std::fabs(after[k].position.x / way - 1.0));
    else
      expect_holds({normal + ", no_history, rod on a slope: speed of creep, relative",
                    "m g sin(a)/(2 gammat)", 1e-3},
                   std::fabs(after[k].velocity.x * wanted[k].gammat / T - 1.0));
  }
}

INSTANTIATE_TEST_SUITE_P(, RodModels,
                         testing::Values(Models{"HookeHistory", "hooke", true},
                                         Models{"HookeNoHistory", "hooke", false},
                                         Models{"StiffnessHistory", "hooke/stiffness", true},
                                         Models{"StiffnessNoHistory", "hooke/stiffness", false},
                                         Models{"HertzHistory", "hertz", true},
                                         Models{"HertzNoHistory", "hertz", false}),
                         [](const auto &info) { return info.param.name; });

// sjkr pulls with the energy density c times the contact area of the virtual spheres:
//   on a wall  pi (r^2 - (r - d)^2) = pi (2 r d - d^2)
//   two rods of one radius  pi/4 (4 r^2 - (2 r - d)^2) = pi/4 (4 r d - d^2)
// so that a contact of stiffness k carries (k - 2 pi c r) d + pi c d^2 on a wall and
// (k - pi c r) d + pi c d^2/4 between rods. Where the bracket is positive a rod lies at the root
// for m g/2; where it is negative a rod hangs below at the larger root for -m g/2, if it is not
// heavier than the largest pull: bracket^2/(4 x the factor of the square).
struct Cohesion {
  double linear, square;  // force of a contact: linear d + square d^2
  double overlap(double load) const
  {
    return (-linear + std::sqrt(linear * linear + 4.0 * square * load)) / (2.0 * square);
  }
  double largest_pull() const { return linear * linear / (4.0 * square); }
};

TEST(RodCohesion, Sjkr)
{
  const double k = 1e6, r = Rod().radius();
  enum Case { kLies, kHangs, kFalls };
  for (const Case kind : {kLies, kHangs, kFalls}) {
    for (const bool floor : {true, false}) {
      const double share = kind == kLies ? 0.4 : 1.02;  // of c at which the bracket is 0
      const double c = share * k / ((floor ? 2.0 : 1.0) * kPi * r);
      const Cohesion contact = floor ? Cohesion{k - 2.0 * kPi * c * r, kPi * c}
                                     : Cohesion{k - kPi * c * r, 0.25 * kPi * c};
      Rod rod;
      if (kind != kLies) {
        const double times = kind == kHangs ? 0.8 : 1.2;
        rod.density *= times * 2.0 * contact.largest_pull() / (rod.mass() * kGravity);
      }
      const double load = 0.5 * rod.mass() * kGravity;
      const double overlap =
          contact.overlap(kind == kLies ? load : -std::min(load, 0.8 * contact.largest_pull()));
      Scene scene = lying_rods(rod, 1.02 * overlap, 1.02 * overlap, 0.03);
      scene.rods.erase(floor ? scene.rods.begin() + 1 : scene.rods.begin());
      if (floor) scene.rods.resize(1);
      scene.physics = linear_material(k, k, 0.6, 0.5, 2) +
                      pair_property("cohesionEnergyDensity", 2, c) +
                      contacts("linear tangential history cohesion sjkr") +
                      gravity({0.0, 0.0, kind == kLies ? -1.0 : 1.0});
      scene.box_hi[2] = 3.0;
      scene.dt = 5e-6;
      scene.steps = 60000;
      const Rod after = run(scene).back().rods[0];
      const double now = 1.02 * overlap + scene.rods[0].position.z - after.position.z;
      if (kind == kFalls) {
        EXPECT_LT(now, 0.0) << "a rod of 1.2 of the largest pull must come off";
        continue;
      }
      SCOPED_TRACE(floor ? "on the floor" : "on two rods");
      expect_holds(
          {fmt::format("sjkr, rod {}: overlap, relative", kind == kLies ? "lies" : "hangs"),
           "root of m g/2 = k d - c A(d)", 1e-6},
          std::fabs(now / overlap - 1.0));
    }
  }
}

// cdt brakes each contact with the torque mu_r kn delta R against the rod's turning, R = r on a
// wall and r/2 between two rods. The two contacts share the weight, so that a rolling rod slows
// down by mu_r g R/r/(1 + kappa), kappa = I_a/(m r^2).
TEST(RodRolling, Cdt)
{
  const double stiffness = 1e5, rolling_friction = 0.02, speed = 0.1;
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  rod.velocity.x = speed;
  rod.omega.y = speed / rod.radius();
  const auto p = rod.properties();
  const double kappa = p.inertia_axial / (p.mass * rod.radius() * rod.radius());
  const double sink = 0.5 * p.mass * kGravity / stiffness;
  Scene scene = lying_rods(rod, sink, sink, 0.03);
  scene.physics = linear_material(stiffness, stiffness, 0.3, 0.5, 2) +
                  pair_property("coefficientRollingFriction", 2, rolling_friction) +
                  contacts("linear tangential history rolling_friction cdt") +
                  gravity({0.0, 0.0, -1.0});
  scene.dt = 1e-5;
  scene.steps = 20000;
  scene.dump_every = 5000;
  const std::vector<Frame> frames = run(scene);
  const Frame &from = frames[1], &to = frames.back();
  for (int k = 0; k < 2; k++) {
    const double slowing =
        (from.rods[k].velocity.x - to.rods[k].velocity.x) / (to.time - from.time);
    const double R = k == 0 ? 1.0 : 0.5;  // over r
    // A rod that has sunk in by 10^-4 r rolls on a shorter radius.
    SCOPED_TRACE(k == 0 ? "on the floor" : "on two rods");
    expect_holds({"cdt, rolling rod: deceleration, relative", "mu_r g (R/r)/(1+kappa)", 5e-4},
                 std::fabs(slowing * (1.0 + kappa) / (rolling_friction * kGravity * R) - 1.0));
  }
}

// epsd2 is a rolling spring kt R^2 up to the torque mu_r N R. Across a slope a rod of radius r
// rests if tan(slope) <= mu_r R/r, after the way m g sin(slope)/(2 kt) (1 + (r/R)^2) of both
// springs; else it rolls with g (sin(slope) - mu_r cos(slope) R/r)/(1 + kappa).
TEST(RodRolling, Epsd2)
{
  const double k = 1e5, kt = 8e4, slope = degrees(5.0);
  Rod rod;
  rod.axis = {0.0, 1.0, 0.0};
  const auto p = rod.properties();
  const double kappa = p.inertia_axial / (p.mass * rod.radius() * rod.radius());
  const double sine = std::sin(slope), cosine = std::cos(slope);
  const double sink = 0.5 * p.mass * kGravity * cosine / k;
  for (const double times_threshold : {0.9, 2.5}) {
    for (const double R : {1.0, 0.5}) {  // over r
      const bool floor = R == 1.0;
      const double rolling_friction = times_threshold * sine / cosine / R;
      Scene scene = lying_rods(rod, sink, sink, 0.03);
      scene.physics = linear_material(k, kt, 0.1, 0.5, 2) +
                      pair_property("coefficientRollingFriction", 2, rolling_friction) +
                      contacts("linear tangential history rolling_friction epsd2") +
                      gravity({sine, 0.0, -cosine});
      scene.dt = 1e-5;
      scene.steps = times_threshold > 1.0 ? 60000 : 20000;
      scene.dump_every = 5000;
      const std::vector<Frame> frames = run(scene);
      const size_t which = floor ? 0 : 1;
      const Rod &from = frames[1].rods[which], &to = frames.back().rods[which];
      const double gained =
          (to.velocity.x - from.velocity.x) / (frames.back().time - frames[1].time);
      SCOPED_TRACE(floor ? "on the floor" : "on two rods");
      if (times_threshold > 1.0) {
        const double way = p.mass * kGravity * sine / (2.0 * kt) * (1.0 + 1.0 / (R * R));
        expect_holds({"epsd2, rod at rest across a slope: way to rest, relative",
                      "m g sin(a)/(2 kt) (1 + (r/R)^2)", 1e-3},
                     std::fabs(to.position.x / way - 1.0));
        EXPECT_LT(std::fabs(to.velocity.x), 1e-9);
      } else {
        // A small difference of the two, and the rod rolls on a radius shorter by its sink.
        const double wanted = kGravity * (sine - rolling_friction * cosine * R) / (1.0 + kappa);
        expect_holds({"epsd2, rod rolling down a slope: acceleration, relative",
                      "g (sin(a) - mu_r cos(a) R/r)/(1+kappa)", 2e-3},
                     std::fabs(gained / wanted - 1.0));
      }
    }
  }
}

}  // namespace
