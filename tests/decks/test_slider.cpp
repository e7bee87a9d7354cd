// SPDX-License-Identifier: GPL-2.0-or-later
// The slider of model linear: friction holds spring and dashpot together to mu F_n, or, with
// limit_tangential_damping off, the spring alone as LIGGGHTS's tangential history does.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "claim.h"
#include "run_mode.h"

using namespace decks;

namespace {

class Slider : public RunMode {};

constexpr double kGravity = 9.81;
constexpr double kGap = 1e-8;  // before an impact, m

std::string contacts(const std::string &tangential, const std::string &keywords,
                     const std::string &wall_keywords)
{
  return fmt::format("pair_style gran model linear tangential {} surface spherocylinder {}\n"
                     "pair_coeff * *\n",
                     tangential, keywords) +
         rod_wall("floor", "linear tangential " + tangential,
                  fmt::format("type 1 zplane 0.0 {} {}", wall_keywords, keywords)) +
         "fix motion all nve/spherocylinder\n";
}

// beta of e = exp(-pi beta/sqrt(1 - beta^2))
double damping_ratio(double restitution)
{
  return -std::log(restitution) / std::hypot(std::acos(-1.0), std::log(restitution));
}

// What limitForce on makes of a restitution: Schwager and Poeschel, Granular Matter 9 (2007) 465.
double restitution_without_pull(double restitution)
{
  const double zeta = damping_ratio(restitution), root = std::sqrt(1.0 - zeta * zeta);
  return std::exp(-zeta / root *
                  (std::acos(-1.0) - std::atan(2.0 * zeta * root / (1.0 - 2.0 * zeta * zeta))));
}

// A rod at rest height on a floor or chute, axis across, that starts with a speed sideways.
struct Flat {
  double sideways = 0.0, slope = 0.0, friction = 0.25;
  std::string tangential = "history", keywords, wall_keywords;  // tangential: and what follows it
  double kn = 3e5, kt = 1e5, restitution = 0.4, dt = 2e-6;
  long steps = 20;

  double weight() const { return start(0.0).mass() * kGravity; }
  double load() const { return 0.5 * weight() * std::cos(slope); }  // of each end
  Rod start() const { return start(load() / kn); }
  // gamma_t of each end; both share the rod's mass, so that m_eff = m/2 (flat_landing.md).
  double tangential_damping() const
  {
    return 2.0 * damping_ratio(restitution) * std::sqrt(0.5 * kt * start().mass());
  }

  // What the floor does to the rod in each step.
  struct Force {
    double along, normal;
  };
  std::vector<Force> forces() const
  {
    Scene scene;
    scene.box_lo[2] = -0.1;
    scene.rods = {start()};
    const DeckFolder folder;
    folder.write("rods.data", data_file(scene));
    folder.write("in.flat",
                 preamble(scene) + "read_data rods.data\nneighbor 0.02 bin\n" +
                     linear_material(kn, kt, restitution, friction) +
                     pair_property("coefficientRollingFriction", 1, 0.1) +
                     contacts(tangential, keywords, wall_keywords) +
                     fmt::format("fix weight all gravity {} vector {} 0 {}\ntimestep {}\n",
                                 kGravity, std::sin(slope), -std::cos(slope), dt) +
                     exact_dump("dump.flat", 1, "id fx fy fz") + fmt::format("run {}\n", steps));
    const Outcome outcome = folder.run("in.flat");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    std::vector<Force> all;
    for (const Snapshot &snapshot : read_dump(folder / "dump.flat"))
      all.push_back({snapshot.atoms.at(0, "fx") - weight() * std::sin(slope),
                     snapshot.atoms.at(0, "fz") + weight() * std::cos(slope)});
    return all;
  }

 private:
  Rod start(double sink) const
  {
    Rod rod;
    rod.length = 0.12;
    rod.axis = {0.0, 1.0, 0.0};
    rod.velocity.x = sideways;
    rod.position.z = rod.radius() - sink;
    return rod;
  }
};

// Largest |F_t|/F_n of all steps.
double largest_share(const Flat &flat)
{
  double largest = 0.0;
  const std::vector<Flat::Force> forces = flat.forces();
  EXPECT_GT(forces.size(), 10u);
  for (const Flat::Force &f : forces) largest = std::max(largest, std::fabs(f.along) / f.normal);
  return largest;
}

// From the first force on, with either tangential model, worked out in batches, one by one, and with
// further models whose values share the history.
TEST(SliderOfAFlatRod, HoldsFromTheFirstStepOn)
{
  double error = 0.0;
  for (const double sideways : {0.3, 3.0})
    for (const char *tangential : {"history", "no_history", "history rolling_friction epsd2"})
      for (const char *wall_keywords : {"", "store_force yes"}) {
        Flat flat;
        flat.sideways = sideways;
        flat.tangential = tangential;
        flat.wall_keywords = wall_keywords;
        for (const Flat::Force &f : flat.forces())
          error = std::max(error, std::fabs(-f.along / (flat.friction * f.normal) - 1.0));
      }
  expect_holds(
      {"Flat rod thrown sideways: tangential force, relative, from step 0", "mu F_n", 1e-9}, error);
}

// A dashpot alone pulls less than friction would hold: nothing is cut off.
TEST(SliderOfAFlatRod, LeavesASlowDashpotAlone)
{
  Flat flat;
  flat.sideways = 0.1 * flat.friction * flat.load() / flat.tangential_damping();
  const Flat::Force first = flat.forces().front();  // no displacement yet
  expect_holds({"Flat rod, slow: first tangential force, relative", "gamma_t v_t", 1e-6},
               std::fabs(-first.along / (2.0 * flat.tangential_damping() * flat.sideways) - 1.0));
}

// LIGGGHTS's way, for comparison: the first force is the dashpot's, many times mu F_n.
TEST(SliderOfAFlatRod, KeywordKeepsTheDashpotOutside)
{
  double error = 0.0;
  for (const char *wall_keywords : {"", "store_force yes"}) {
    Flat flat;
    flat.sideways = 0.3;
    flat.keywords = "limit_tangential_damping off";
    flat.wall_keywords = wall_keywords;
    const Flat::Force first = flat.forces().front();
    EXPECT_GT(-first.along, 20.0 * flat.friction * first.normal);
    const double expected = 2.0 * flat.tangential_damping() * flat.sideways;
    error = std::max(error, std::fabs(-first.along / expected - 1.0));
  }
  expect_holds({"Flat rod, limit_tangential_damping off: first tangential force, relative",
                "gamma_t v_t", 1e-6},
               error);
}

// A chute steeper than friction holds, axis across and too little friction to roll: the spring loads
// until the rod slides. With the dashpot outside of the slider it feels more than mu F_n on the way.
TEST(SliderOfAFlatRod, HoldsAtTheStartOnAChute)
{
  Flat flat;
  flat.slope = degrees(60.0);
  flat.friction = 0.2;
  flat.steps = 3000;
  const double limited = largest_share(flat);
  expect_holds({"Start on a chute: largest F_t/F_n over mu, less 1", "mu F_n", 1e-9},
               std::max(0.0, limited / flat.friction - 1.0));
  EXPECT_GT(limited, flat.friction * (1.0 - 1e-9)) << "it slides";
  flat.keywords = "limit_tangential_damping off";
  EXPECT_GT(largest_share(flat), 1.5 * flat.friction);
}

// Oblique impacts of a ball and of upright rods, on a floor and on the middle of another rod, fast
// enough sideways that they slide from first to last. Then the tangential impulse is mu times the
// normal one, m_eff (1 + e') v_n, with m_eff = m, or m_i m_j/(m_i + m_j): the normal runs through all
// centres. It acts on rod i at the lever b = h/2 + r and on rod j at r:
//   change of v_t = mu J/m,  of omega = mu J b/I
TEST_P(Slider, ObliqueImpactSlidingThroughout)
{
  const double approach = 1e-3, friction = 0.3, restitution = 0.5;
  const double e = restitution_without_pull(restitution);
  struct Case {
    double ratio;
    bool on_rod;
  };
  const Case cases[] = {{1.0, false}, {3.0, false}, {10.0, false},
                        {1.0, true},  {3.0, true},  {10.0, true}};
  Scene scene;
  scene.box_lo[2] = -0.1;
  std::vector<size_t> falling;
  for (const Case &c : cases) {
    Rod rod;
    rod.length = c.ratio * rod.diameter;
    rod.axis = {0.0, 0.0, 1.0};
    rod.position = {0.0, -0.6 + 0.2 * static_cast<double>(falling.size()),
                    rod.half_cylinder() + rod.radius() + kGap};
    rod.velocity = {4.0 * approach, 0.0, -approach};
    if (c.on_rod) {
      Rod below;
      below.position = {0.0, rod.position.y, 0.4};
      rod.position.z += below.position.z + below.radius();
      scene.rods.push_back(below);
    }
    falling.push_back(scene.rods.size());
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(1e6, 2.0 / 7.0 * 1e6, restitution, friction) +
                  contacts("history", "limitForce on", "");
  scene.dt = 1e-7;
  scene.steps = 6000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  double error = 0.0;
  for (size_t k = 0; k < falling.size(); k++) {
    const Rod &rod = scene.rods[falling[k]];
    const auto p = rod.properties();
    const double lever = rod.half_cylinder() + rod.radius();
    const double partner = cases[k].on_rod ? 1.0 / scene.rods[falling[k] - 1].mass() : 0.0;
    const double J = (1.0 + e) * approach / (1.0 / p.mass + partner);
    Rod wanted = rod;
    wanted.velocity = rod.velocity + J / p.mass * Vec3{-friction, 0.0, 1.0};
    wanted.omega.y = friction * J * lever / p.inertia_transverse;
    const Rod &got = after[falling[k]];
    const double scale = friction * J;
    error = std::max({error, p.mass * norm(got.velocity - wanted.velocity) / scale,
                      p.inertia_transverse / lever * norm(got.omega - wanted.omega) / scale});
    if (!cases[k].on_rod) continue;
    const Rod &below = after[falling[k] - 1];
    const auto q = below.properties();
    const Vec3 pushed = J / q.mass * Vec3{friction, 0.0, -1.0};
    const double spin = scale * below.radius() / q.inertia_transverse;
    error = std::max({error, q.mass * norm(below.velocity - pushed) / scale,
                      std::fabs(below.omega.y / spin - 1.0)});
  }
  // 2 zeta omega dt of the jumps of the force at touch, and how far the rods turn in the meantime.
  expect_holds(
      {"Oblique impact, sliding throughout: impulses, relative", "J_t = mu (1+e) m_eff v_n", 3e-3},
      error);
}

// So rough that nothing slides: the surface of a ball or of an upright rod's end is held by spring
// and dashpot, an oscillator of its own with 1/m_t = 1/m + b^2/I, for as long as the normal one
// takes: m_t x'' = -k_t x - gamma_t x', x(0) = 0, x'(0) = v_t, over pi/omega_d.
TEST_P(Slider, ObliqueImpactThatSticks)
{
  const double approach = 1e-3, restitution = 0.5, kn = 1e6, kt = 3e5, pi = std::acos(-1.0);
  Scene scene;
  scene.box_lo[2] = -0.1;
  for (const double ratio : {1.0, 3.0, 10.0}) {
    Rod rod;
    rod.length = ratio * rod.diameter;
    rod.axis = {0.0, 0.0, 1.0};
    rod.position = {0.0, -0.6 + 0.2 * static_cast<double>(scene.rods.size()),
                    rod.half_cylinder() + rod.radius() + kGap};
    rod.velocity = {0.3 * approach, 0.0, -approach};
    scene.rods.push_back(rod);
  }
  scene.physics = linear_material(kn, kt, restitution, 1e6) + contacts("history", "", "");
  scene.dt = 1e-7;
  scene.steps = 10000;
  const std::vector<Rod> after = run(scene, GetParam()).back().rods;

  double error = 0.0;
  for (size_t k = 0; k < after.size(); k++) {
    const Rod &rod = scene.rods[k];
    const auto p = rod.properties();
    const double b = rod.half_cylinder() + rod.radius(), beta = damping_ratio(restitution);
    const double T = pi / std::sqrt(kn / p.mass * (1.0 - beta * beta));
    const double inverse = 1.0 / p.mass + b * b / p.inertia_transverse;
    const double decay = beta * std::sqrt(kt * p.mass) * inverse;
    const double omega = std::sqrt(kt * inverse - decay * decay);
    const double slip = rod.velocity.x;
    const double left =
        slip * std::exp(-decay * T) * (std::cos(omega * T) - decay / omega * std::sin(omega * T));
    const double J = (left - slip) / inverse;
    error = std::max({error, std::fabs((after[k].velocity.x - slip) * p.mass / J - 1.0),
                      std::fabs(-after[k].omega.y * p.inertia_transverse / (b * J) - 1.0)});
  }
  expect_holds({"Oblique impact that sticks: tangential impulse, relative",
                "damped oscillator of m_t over pi/omega_d", 1e-3},
               error);
}

DECKS_IN_ALL_MODES(Slider);

}  // namespace
