// SPDX-License-Identifier: GPL-2.0-or-later
// Rods as bodies of spheres and back: closed forms, and a journey through stock LIGGGHTS.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "../program_folder.h"
#include "core/numbers.h"
#include "core/rotation.h"
#include "io/dump_reader.h"
#include "io/frame_columns.h"
#include "io/glued_rods.h"
#include "io/input_error.h"
#include "io/multisphere_input.h"
#include "page_examples.h"
#include "scratch_folder.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

double distance(const Vec3 &a, const Vec3 &b) { return norm(a - b); }

// A rod and how it moves.
struct MovingRod {
  Rod rod;
  Vec3 velocity, omega;
};

std::vector<MovingRod> random_rods(std::size_t count)
{
  std::mt19937 random(15485863);
  std::uniform_real_distribution<double> place(-0.5, 0.5), size(0.5, 1.5);
  const auto any = [&] { return Vec3{place(random), place(random), place(random)}; };
  std::vector<MovingRod> rods;
  for (const Vec3 &u : random_directions(count, random)) {
    const double r = 0.01 * size(random);
    const auto id = static_cast<std::int64_t>(rods.size() + 1);
    rods.push_back({{id, 1 + static_cast<int>(id % 2), {{any(), u, 0.1 * size(random)}, r}},
                    any(),
                    10.0 * any()});
  }
  return rods;
}

// The dump of spheres, in a cube of side 1 about the origin, periodic in x and y, that LIGGGHTS
// would write of rigid bodies: `places` "" for those inside the box, "u" for those of whole bodies.
// `own_spin` (rad/s) is added to the spheres' own omegas, of one sign and the other in turn.
std::string sphere_dump(const std::vector<MovingRod> &rods, const SphereCount &count,
                        const std::string &places, bool shuffled, const Vec3 &own_spin = {0, 0, 0},
                        int digits = 17)
{
  std::vector<std::string> lines;
  for (const MovingRod &m : rods) {
    const Segment &s = m.rod.capsule.segment;
    const int n = count.of(m.rod.capsule);
    double sign = 1.0;
    for (const double at : sphere_places(s.half_length, n)) {
      Vec3 x = s.at(at);
      const Vec3 v = m.velocity + cross(m.omega, at * s.axis), w = m.omega + sign * own_spin;
      sign = -sign;
      if (places.empty()) {
        x.x -= std::floor(x.x + 0.5);
        x.y -= std::floor(x.y + 0.5);
      }
      std::string line = fmt::format("{} {} {}", lines.size() + 1, m.rod.id, m.rod.type);
      for (const double number :
           {x.x, x.y, x.z, m.rod.capsule.radius, v.x, v.y, v.z, w.x, w.y, w.z})
        line += fmt::format(" {:.{}g}", number, digits);
      lines.push_back(line);
    }
  }
  if (shuffled) std::shuffle(lines.begin(), lines.end(), std::mt19937(32452843));
  return fmt::format(
      "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n-0.5 0.5\n-0.5 "
      "0.5\n-1 1\nITEM: ATOMS id mol type x{} y{} z{} radius vx vy vz omegax omegay omegaz\n{}\n",
      lines.size(), places, places, places, fmt::join(lines, "\n"));
}

class Multisphere : public ScratchFolder {
 protected:
  std::vector<DumpFrame> frames(const std::string &name) const
  {
    DumpReader reader(path(name));
    std::vector<DumpFrame> all;
    for (DumpFrame frame; reader.next(frame);) all.push_back(frame);
    return all;
  }

  std::vector<GluedRod> glued(const std::string &text, const GluedRodOptions &options = {}) const
  {
    write("glued.dump", text);
    return glued_rods(frames("glued.dump").at(0), options);
  }

  std::string refusal(const std::string &text, const GluedRodOptions &options = {}) const
  {
    try {
      glued(text, options);
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  }

  // Runs in the test's folder; what it prints ends up in out_.
  int run(const std::string &command)
  {
    const int status = std::system(
        fmt::format("cd '{}' && mkdir -p mpi && export OMPI_MCA_ess_singleton_isolated=1 "
                    "OMPI_MCA_orte_tmpdir_base=$PWD/mpi PATH='{}':\"$PATH\" && {} >out.txt 2>&1",
                    folder().string(), program_folder(PROGRAM_FOLDER), command)
            .c_str());
    out_ = read("out.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string out_;
};

// A dump of one body of spheres of radius 1 at these places.
std::string body_dump(const std::vector<Vec3> &places, const std::string &box = "ff ff ff")
{
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n3\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n-50 50\n-50 50\n-50 "
      "50\nITEM: ATOMS id mol x y z radius\n",
      places.size(), box);
  for (std::size_t i = 0; i < places.size(); i++)
    text += fmt::format("{} 4 {} {} {} 1\n", i + 1, places[i].x, places[i].y, places[i].z);
  return text;
}

// 2 r apart: lambda spheres; r: 2 lambda - 1; r/2: 4 lambda - 3.
TEST_F(Multisphere, SpheresOfASpacing)
{
  for (const int lambda : {2, 3, 10, 30, 100}) {
    const Capsule rod{{{0, 0, 0}, {0, 0, 1}, 0.5 * 0.01 * (lambda - 1)}, 0.005};
    EXPECT_EQ((SphereCount{std::nullopt, 2.0}.of(rod)), lambda);
    EXPECT_EQ((SphereCount{std::nullopt, 1.0}.of(rod)), 2 * lambda - 1);
    EXPECT_EQ((SphereCount{std::nullopt, 0.5}.of(rod)), 4 * lambda - 3);
    EXPECT_EQ((SphereCount{std::nullopt, 1.999}.of(rod)), lambda + 1);
    EXPECT_EQ((SphereCount{7, std::nullopt}.of(rod)), 7);
  }
  const auto places = sphere_places(0.3, 4);
  ASSERT_EQ(places.size(), 4u);
  for (int k = 0; k < 4; k++) EXPECT_NEAR(places[k], -0.3 + 0.2 * k, 1e-15);
}

// Spheres at any place of the rod's own line give the rod back, whatever the order of the rows.
TEST_F(Multisphere, SpheresOfRigidRodsGiveThemBack)
{
  const auto rods = random_rods(60);
  for (const SphereCount count : {SphereCount{40, {}}, SphereCount{{}, 2.0}, SphereCount{{}, 0.3}})
    for (const std::string places : {"", "u"}) {
      const auto found = glued(sphere_dump(rods, count, places, true));
      ASSERT_EQ(found.size(), rods.size());
      for (std::size_t i = 0; i < rods.size(); i++) {
        const Segment &a = found[i].rod.capsule.segment, &b = rods[i].rod.capsule.segment;
        EXPECT_EQ(found[i].rod.id, rods[i].rod.id);
        EXPECT_EQ(found[i].rod.type, rods[i].rod.type);
        EXPECT_EQ(found[i].spheres, static_cast<std::size_t>(count.of(rods[i].rod.capsule)));
        EXPECT_LT(distance(a.axis, b.axis), 1e-13);
        EXPECT_NEAR(a.half_length, b.half_length, 1e-14);
        EXPECT_LT(distance(found[i].velocity, rods[i].velocity), 1e-13);
        EXPECT_LT(distance(found[i].omega, rods[i].omega), 1e-12);
        EXPECT_LT(found[i].deviation, 1e-12);
        EXPECT_NEAR(found[i].least_spacing, found[i].largest_spacing, 1e-11);
        // Bodies that lie across a boundary are one rod, its centre inside the box.
        Vec3 d = a.centre - b.centre;
        if (places.empty()) d = d - Vec3{std::round(d.x), std::round(d.y), 0.0};
        EXPECT_LT(norm(d), 1e-14);
        if (places.empty()) {
          EXPECT_LE(std::abs(a.centre.x), 0.5);
          EXPECT_LE(std::abs(a.centre.y), 0.5);
        }
      }
    }
}

// Bonded spheres spin each for itself: across the axis the body turns as its places do.
TEST_F(Multisphere, BondedSpheresTurnAsTheirPlaces)
{
  const auto rods = random_rods(20);
  const Vec3 spin{3.0, -1.0, 2.0};
  const auto found = glued(sphere_dump(rods, {{40}, {}}, "", false, spin));
  ASSERT_EQ(found.size(), rods.size());
  for (std::size_t i = 0; i < rods.size(); i++)
    EXPECT_LT(distance(found[i].omega, rods[i].omega), 1e-11);
}

// A rod that is more than half the period long, along and across the boundary.
TEST_F(Multisphere, RodsLongerThanHalfThePeriod)
{
  std::vector<Vec3> places;
  for (int k = 0; k < 61; k++) places.push_back({k * 1.4 - 20.0, 0.0, 0.0});
  for (Vec3 &x : places) x.x -= 100.0 * std::floor((x.x + 50.0) / 100.0);
  const auto found = glued(body_dump(places, "pp pp pp"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].rod.capsule.segment.half_length, 42.0, 1e-12);
  EXPECT_NEAR(found[0].rod.capsule.segment.centre.x, 22.0, 1e-12);
}

// Spheres evenly on an arc of radius R: the line of least squares is parallel to the chord, and the
// farthest are those in the middle or at the ends.
TEST_F(Multisphere, BentRodsAreOffByTheArc)
{
  const double R = 100.0, half_angle = 0.15;
  const int n = 21;
  std::vector<Vec3> places;
  double mean = 0.0;
  for (int k = 0; k < n; k++) {
    const double a = half_angle * (2.0 * k / (n - 1) - 1.0);
    places.push_back({R * std::sin(a), R * (std::cos(a) - 1.0), 0.0});
    mean += places.back().y / n;
  }
  const double off = std::max(-mean, mean - places[0].y);
  const auto found = glued(body_dump(places), {"mol", 1.0});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].deviation, off, 1e-12);
  EXPECT_NEAR(found[0].rod.capsule.segment.half_length, R * std::sin(half_angle), 1e-12);
  EXPECT_NEAR(found[0].rod.capsule.segment.axis.x, 1.0, 1e-15);
  // The chords of neighbours along the axis: 2 R sin(step/2) cos(angle half-way).
  const double step = 2.0 * half_angle / (n - 1);
  EXPECT_NEAR(found[0].largest_spacing, 2.0 * R * std::sin(step / 2) * std::cos(step / 2), 1e-12);
  EXPECT_NEAR(found[0].least_spacing,
              2.0 * R * std::sin(step / 2) * std::cos(half_angle - step / 2), 1e-12);
  EXPECT_NE(refusal(body_dump(places), {"mol", 0.5})
                .find(fmt::format("body 4 is no rod: sphere 1 lies {:.4g} radii off its axis, "
                                  "wanted at most 0.5",
                                  mean - places[0].y)),
            std::string::npos);
}

TEST_F(Multisphere, WhatIsNoRodIsRefused)
{
  const auto expect = [&](const std::string &text, const std::string &words,
                          const GluedRodOptions &options = {}) {
    const std::string sentence = refusal(text, options);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  };
  const std::string good = body_dump({{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(refusal(good), "");
  const auto with = [](std::string text, const std::string &from, const std::string &to) {
    return text.replace(text.find(from), from.size(), to);
  };
  expect(body_dump({{0, 0, 0}}), "glued.dump:10: step 3: body 4 is no rod: it has 1 sphere");
  expect(body_dump({{0, 0, 0}, {0, 0, 0}}), "its spheres are in one place");
  expect(body_dump({{0, 0, 0}, {2.5, 0, 0}}), "lie 2.5 radii apart with none between them");
  expect(body_dump({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}), "radii off its axis, wanted at most 0.05");
  expect(with(good, "1 0 0 1\n", "1 0 0 1.1\n"), "its spheres have the radii 1 and 1.1");
  expect(with(good, "1 0 0 1\n", "1 0 0 0\n"), "its spheres have the radii 1 and 0");
  expect(with(with(good, "0 0 0 1\n", "0 0 0 0\n"), "1 0 0 1\n", "1 0 0 0\n"), "a radius is 0");
  expect(with(good, "2 4 1", "2 0 1"), "glued.dump:11: sphere 2 is of no body: mol is 0");
  expect(with(good, "2 4 1", "2 0.5 1"), "mol is 0.5, wanted a whole number >= 1");
  expect(with(with(with(good, " mol x", " mol type x"), "1 4 0", "1 4 0 0"), "2 4 1", "2 4 0 1"),
         "type is 0, wanted a whole number >= 1");
  expect(with(good, " mol", " body"), "column 'mol' is missing, wanted it or --body");
  expect(good, "column 'f_b' is missing", {"f_b", 0.05});
  expect(with(good, " radius", " size"), "column 'radius' is missing, wanted it or 'diameter'");
  expect(with(good, "1 0 0 1\n", "1e300 0 0 1\n"), "x is 1e+300 m, wanted less");
  expect(with(good, "BOUNDS ff ff ff\n-50 50\n-50 50\n-50 50",
              "BOUNDS xy xz yz ff ff ff\n-50 50 0\n-50 50 0\n-50 50 0"),
         "the box is tilted");
}

// Mass and inertia of the template are the true rod's: two half balls on a cylinder, the half
// ball's own inertia moved by Steiner from its centroid, 3 r/8 above the flat face.
TEST_F(Multisphere, TemplatesHaveTheRodsMassAndInertia)
{
  const double r = 0.005, h = 0.09, density = 2700.0;  // h: of the cylinder
  write("rod.dump", dump_text({{1, 1, {{{0, 0, 0.5}, {0, 0, 1}, h / 2}, r}}}, 0));
  const DumpFrame frame = frames("rod.dump").at(0);
  const auto rods = rods_of(frame);
  const auto kinds = rod_kinds(frame, rods, {{19}, {}}, density);
  const std::string text = body_commands(frame, rods, kinds, frame.box, {"rod.spheres"});
  const double cylinder = density * pi * r * r * h,
               half_ball = density * 2.0 / 3.0 * pi * r * r * r;
  const double axial = cylinder * r * r / 2 + 2 * half_ball * 0.4 * r * r;
  const double centroid = half_ball * (0.4 - 9.0 / 64.0) * r * r;
  const double transverse = cylinder * (h * h / 12 + r * r / 4) +
                            2 * (centroid + half_ball * std::pow(h / 2 + 3 * r / 8, 2));
  const auto number_after = [&](const std::string &words, int which) {
    std::string_view rest = std::string_view(text).substr(text.find(words) + words.size());
    double number = 0.0;
    for (int i = 0; i <= which; i++) {
      std::size_t length = 0;
      number = std::stod(std::string(rest), &length);
      rest.remove_prefix(length);
    }
    return number;
  };
  EXPECT_NEAR(number_after(" mass ", 0) / (cylinder + 2 * half_ball), 1.0, 1e-14);
  EXPECT_NEAR(number_after("inertia_tensor", 0) / transverse, 1.0, 1e-14);
  EXPECT_NEAR(number_after("inertia_tensor", 3) / transverse, 1.0, 1e-14);
  EXPECT_NEAR(number_after("inertia_tensor", 5) / axial, 1.0, 1e-14);
  for (const int off_diagonal : {1, 2, 4})
    EXPECT_EQ(number_after("inertia_tensor", off_diagonal), 0.0);
}

TEST_F(Multisphere, BoxHoldsAllSpheres)
{
  write("rod.dump", dump_text({{1, 1, {{{0.99, 0, 0.5}, {1, 0, 0}, 0.045}, 0.005}}}, 0));
  const DumpFrame frame = frames("rod.dump").at(0);
  const auto rods = rods_of(frame);
  const BoxBounds box =
      multisphere_box(frame, rods, std::nullopt);  // the dump's is -1 1 -1 1 -1 11
  EXPECT_NEAR(box[0][1], 1.04, 1e-12);
  EXPECT_EQ(box[0][0], -1.0);
  EXPECT_EQ(box[2][1], 11.0);
  const BoxBounds fit = multisphere_box(frame, rods, 0.02);
  EXPECT_NEAR(fit[0][0], 0.92, 1e-12);
  EXPECT_NEAR(fit[0][1], 1.06, 1e-12);
  EXPECT_NEAR(fit[2][0], 0.475, 1e-12);
  DumpFrame periodic = frame;
  periodic.periodic = {true, true, true};
  EXPECT_EQ(multisphere_box(periodic, rods, 0.02), frame.box);
}

// Rods of two lengths and types to stock LIGGGHTS and back: the same poses and motions, and the
// beds' tools read them. Half of them lie across the box's periodic faces.
TEST_F(Multisphere, RodsComeBackFromStockLiggghts)
{
  const auto rods = random_rods(20);
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n-0.5 0.5\n-0.5 "
      "0.5\n-1 1\nITEM: ATOMS id type x y z shapex shapez quat1 quat2 quat3 quat4 vx vy vz omegax "
      "omegay omegaz density\n",
      rods.size());
  for (const MovingRod &m : rods) {
    const Segment &s = m.rod.capsule.segment;
    const Quaternion q = orientation_of(s.axis);
    const bool is_long = m.rod.type == 2;
    text += fmt::format("{} {} {} {} {} 0.01 {} {} {} {} {} {} {} {} {} {} {} 2500\n", m.rod.id,
                        m.rod.type, s.centre.x, s.centre.y, s.centre.z, is_long ? 0.15 : 0.05, q.w,
                        q.x, q.y, q.z, m.velocity.x, m.velocity.y, m.velocity.z, m.omega.x,
                        m.omega.y, m.omega.z);
  }
  write("rods.dump", text);
  ASSERT_EQ(run("rods_to_multisphere rods.dump --spacing 1 --out peer"), 0) << out_;
  const std::string deck = PROJECT_FOLDER "/examples/multisphere/";
  for (const char *name : {"in.multisphere", "in.law"})
    std::filesystem::copy(deck + name, folder() / name);
  // What the deck cannot know is asked for.
  run("liggghts -in in.multisphere -var rods peer");
  EXPECT_NE(out_.find("ERROR: in.law: rods must be of type 1, of type 2 are walls, with damping of "
                      "their own (got rods of type 2)"),
            std::string::npos)
      << out_;
  run("liggghts -in in.multisphere -var rods peer -var rod_types 1");
  EXPECT_NE(out_.find("ERROR: in.law: rod_mass must be > 0"), std::string::npos) << out_;
  // No contact is asked for in no steps.
  ASSERT_EQ(run("liggghts -in in.multisphere -var rods peer -var rod_types 1 -var rod_mass 1 "
                "-var steps 0 -var dump_every 1"),
            0)
      << out_;
  EXPECT_EQ(out_.find("ERROR"), std::string::npos) << out_;
  ASSERT_EQ(run("multisphere_to_rods peer.dump --out back.dump --csv straight.csv"), 0) << out_;
  EXPECT_NE(out_.find("spheres a rod          9 to 29"), std::string::npos) << out_;

  const auto before = frames("rods.dump"), after = frames("back.dump");
  ASSERT_EQ(after.size(), 1u);
  const auto a = rods_of(before[0]), b = rods_of(after[0]);
  ASSERT_EQ(b.size(), a.size());
  for (std::size_t i = 0; i < a.size(); i++) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].type, b[i].type);
    Vec3 d = a[i].capsule.segment.centre - b[i].capsule.segment.centre;
    d = d - Vec3{std::round(d.x), std::round(d.y), 0.0};
    EXPECT_LT(norm(d), 1e-9);
    EXPECT_LT(distance(a[i].capsule.segment.axis, b[i].capsule.segment.axis), 1e-9);
    EXPECT_NEAR(a[i].capsule.length(), b[i].capsule.length(), 1e-9);
  }
  for (const std::array<std::string, 3> &names :
       {std::array<std::string, 3>{"vx", "vy", "vz"}, {"omegax", "omegay", "omegaz"}}) {
    const VectorColumns motion_before(before[0], names), motion_after(after[0], names);
    ASSERT_TRUE(motion_after.are_there());
    for (std::size_t i = 0; i < a.size(); i++)
      EXPECT_LT(distance(motion_before.of(i), motion_after.of(i)), 1e-9);
  }
  for (const char *tool : {"rod_packing back.dump --box -0.5 0.5 -0.5 0.5 -1 1",
                           "rod_orientation back.dump", "rod_contacts back.dump"})
    EXPECT_EQ(run(tool), 0) << out_;
}

TEST_F(Multisphere, ExamplesOfThePages)
{
  const auto rods = random_rods(5);
  const std::string spheres = sphere_dump(rods, {{40}, {}}, "", false);
  write("spheres.dump", spheres);
  write("fibres.dump", std::string(spheres).replace(spheres.find(" mol "), 5, " f_fibre "));
  write("bed.dump", dump_text({{1, 1, {{{0, 0, 1}, {0, 0, 1}, 0.045}, 0.005}}}, 0));
  write("pour.dump", dump_text({{1, 1, {{{0, 0, 1}, {1, 0, 0}, 0.045}, 0.005}}}, 500));
  for (const std::string tool : {"rods_to_multisphere", "multisphere_to_rods", "place_rods"}) {
    const auto commands = examples_of_page(PROJECT_FOLDER "/docs/" + tool + ".md", tool);
    EXPECT_EQ(commands.size(), tool == "place_rods" ? 4u : 3u);
    for (const std::string &command : commands) EXPECT_EQ(run(command), 0) << command << out_;
    EXPECT_EQ(run(tool + " --help"), 0);
    EXPECT_NE(out_.find("Example: " + tool + " "), std::string::npos) << out_;
  }
  // lambda = 10, spheres r apart and r/2.
  const auto lines = [&](const std::string &name) {
    const std::string text = read(name);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("bed.spheres"), 19);
  EXPECT_EQ(lines("pour.spheres"), 37);
}

// The data file holds what the dump does, for read_data.
TEST_F(Multisphere, DataFileOfTheRods)
{
  const auto rods = random_rods(4);
  write("spheres.dump", sphere_dump(rods, {{40}, {}}, "u", true));
  ASSERT_EQ(run("multisphere_to_rods spheres.dump --out r.dump --data r.data --density 2500"), 0);
  std::istringstream data(read("r.data"));
  std::string line;
  while (std::getline(data, line) && line != "Atoms") continue;
  for (const MovingRod &m : rods) {
    const Capsule &c = m.rod.capsule;
    int id, type;
    double diameter, length, density;
    Vec3 x, u;
    data >> id >> type >> diameter >> length >> density >> x.x >> x.y >> x.z >> u.x >> u.y >> u.z;
    EXPECT_EQ(id, m.rod.id);
    EXPECT_EQ(type, m.rod.type);
    EXPECT_NEAR(diameter, 2.0 * c.radius, 1e-15);
    EXPECT_NEAR(length, c.length(), 1e-13);
    EXPECT_EQ(density, 2500.0);
    EXPECT_LT(distance(x, c.segment.centre), 1e-13);
    EXPECT_LT(distance(u, c.segment.axis), 1e-13);
  }
  data >> line;
  EXPECT_EQ(line, "Velocities");
  for (const MovingRod &m : rods) {
    int id;
    Vec3 v, w;
    data >> id >> v.x >> v.y >> v.z >> w.x >> w.y >> w.z;
    EXPECT_EQ(id, m.rod.id);
    EXPECT_LT(distance(v, m.velocity), 1e-13);
    EXPECT_LT(distance(w, m.omega), 1e-12);
  }
}

// Six digits stay six: what rod_contacts calls doubtful follows from them.
TEST_F(Multisphere, DigitsStay)
{
  const auto rods = random_rods(5);
  for (const int digits : {17, 6}) {
    write("spheres.dump", sphere_dump(rods, {{40}, {}}, "", false, {0, 0, 0}, digits));
    ASSERT_EQ(run("multisphere_to_rods spheres.dump --out rods.dump"), 0) << out_;
    const DumpFrame frame = frames("rods.dump").at(0);
    const int found = digits_of_column(frame, *frame.find_column("x"));
    EXPECT_TRUE(digits == 6 ? found <= 6 : found >= 14) << found;
  }
}

TEST_F(Multisphere, ProgramsSayWhatIsWrong)
{
  write("spheres.dump", sphere_dump(random_rods(3), {{40}, {}}, "", false));
  write("bed.dump", dump_text({{1, 1, {{{0, 0, 1}, {0, 0, 1}, 0.045}, 0.005}}}, 0));
  write("balls.dump", dump_text({{1, 1, {{{0, 0, 1}, {0, 0, 1}, 0.0}, 0.005}}}, 0));
  write("none.dump", dump_text({}, 0));
  const auto expect = [&](const std::string &command, const std::string &words) {
    EXPECT_EQ(run(command), 2) << command;
    EXPECT_EQ(std::count(out_.begin(), out_.end(), '\n'), 1) << out_;
    EXPECT_EQ(out_.find(command.substr(0, command.find(' ')) + ": "), 0u) << out_;
    EXPECT_NE(out_.find(words), std::string::npos) << out_;
  };
  const std::string to = "rods_to_multisphere ";
  expect(to + "bed.dump --spheres 9", "column 'density' is missing, wanted it or --density");
  expect(to + "bed.dump --density 1", "[--spheres,--spacing] is required");
  expect(to + "bed.dump --density 1 --spheres 1", "--spheres");
  expect(to + "bed.dump --density 1 --spacing 1e-7", "more than 100000 spheres");
  expect(to + "bed.dump --density 1 --spheres 9 --frame all", "--frame: must be first, last or");
  expect(to + "balls.dump --density 1 --spheres 9", "rod 1: it is a sphere, wanted rods longer");
  expect(to + "none.dump --density 1 --spheres 9", "step 0 holds no rods");
  for (const char *name : {"rods.box", "rods.bodies", "rods.spheres", "out.dump"})
    EXPECT_FALSE(std::filesystem::exists(folder() / name)) << name;

  const std::string back = "multisphere_to_rods ";
  expect(back + "spheres.dump", "--out is required");
  expect(back + "spheres.dump --out spheres.dump", "is written by this run");
  expect(back + "spheres.dump --out out.dump --body id", "it has 1 sphere, wanted at least 2");
  expect(back + "bed.dump --out out.dump", "column 'mol' is missing");
  expect(back + "spheres.dump --out out.dump --data out.data", "has no density, wanted --density");
  expect(back + "spheres.dump --out out.dump --density 1", "--density requires --data");
  expect(back + "spheres.dump --out out.dump --data out.dump --density 1", "is named twice");
  expect(back + "spheres.dump --out out.dump --tolerance -1",
         "--tolerance: must be a number from 0");
  expect("place_rods --rods 50 --out out.dump --seed -1", "--seed");
  EXPECT_FALSE(std::filesystem::exists(folder() / "out.dump"));
}

}  // namespace
}  // namespace spherocylinder
