// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/rotation.h"

namespace decks {

namespace sc = spherocylinder;

const char *const kFrameColumns =
    "id type x y z vx vy vz omegax omegay omegaz shapex shapez density quat1 quat2 quat3 quat4 "
    "c_contacts";

Vec3 Rod::angular_momentum() const
{
  const sc::MassProperties p = properties();
  return sc::angular_momentum(omega, axis, p.inertia_axial, p.inertia_transverse);
}

double Rod::kinetic_energy() const
{
  return 0.5 * mass() * norm_squared(velocity) + 0.5 * dot(omega, angular_momentum());
}

std::string name_of(Mode mode)
{
  switch (mode) {
    case Mode::OneRank: return "OneRank";
    case Mode::TwoRanks: return "TwoRanks";
    case Mode::FourRanks: return "FourRanks";
    case Mode::Restarted: return "Restarted";
  }
  return "";
}

void PrintTo(Mode mode, std::ostream *out) { *out << name_of(mode); }

std::string data_file(const Scene &scene)
{
  std::string atoms, velocities;
  int id = 0;
  for (const Rod &rod : scene.rods) {
    id++;
    atoms += fmt::format("{} {} {} {} {} {} {} {} {} {} {}\n", id, rod.type, rod.diameter,
                         rod.length, rod.density, rod.position.x, rod.position.y, rod.position.z,
                         rod.axis.x, rod.axis.y, rod.axis.z);
    velocities += fmt::format("{} {} {} {} {} {} {}\n", id, rod.velocity.x, rod.velocity.y,
                              rod.velocity.z, rod.omega.x, rod.omega.y, rod.omega.z);
  }
  return fmt::format(R"(rods

{} atoms
{} atom types
{} {} xlo xhi
{} {} ylo yhi
{} {} zlo zhi

Atoms

{}
Velocities

{})",
                     scene.rods.size(), scene.types, scene.box_lo[0], scene.box_hi[0],
                     scene.box_lo[1], scene.box_hi[1], scene.box_lo[2], scene.box_hi[2], atoms,
                     velocities);
}

namespace {

std::string processors(Mode mode)
{
  return mode == Mode::TwoRanks    ? "processors 2 1 1\n"
         : mode == Mode::FourRanks ? "processors 2 2 1\n"
                                   : "";
}

int ranks(Mode mode) { return mode == Mode::TwoRanks ? 2 : mode == Mode::FourRanks ? 4 : 1; }

}  // namespace

std::string preamble(const Scene &scene, Mode mode)
{
  return fmt::format(R"(atom_style spherocylinder
atom_modify map array
boundary {}
newton off
communicate single vel yes
units si
{})",
                     scene.boundary, processors(mode));
}

namespace {

std::string run_commands(const Scene &scene, const std::string &dump, long steps)
{
  return fmt::format(R"(neighbor {} bin
neigh_modify delay 0
{}
compute contacts all contact/spherocylinder
timestep {}
thermo {}
thermo_modify norm no lost error
{}run {}
)",
                     scene.skin, scene.physics, scene.dt, steps,
                     exact_dump(dump, scene.dump_every ? scene.dump_every : steps, kFrameColumns),
                     steps);
}

void run_deck(const DeckFolder &folder, const std::string &deck, const Launch &launch)
{
  const Outcome outcome = folder.run(deck, launch);
  if (outcome.exit_code == 0) return;
  ADD_FAILURE() << deck << " ended with exit code " << outcome.exit_code << "\n" << outcome.output;
  throw std::runtime_error(deck + " did not run");
}

Rod rod_at(const Table &table, size_t row)
{
  const auto vector = [&](const std::string &x, const std::string &y, const std::string &z) {
    return Vec3{table.at(row, x), table.at(row, y), table.at(row, z)};
  };
  Rod rod;
  rod.position = vector("x", "y", "z");
  rod.velocity = vector("vx", "vy", "vz");
  rod.omega = vector("omegax", "omegay", "omegaz");
  rod.axis = sc::axis_of({table.at(row, "quat1"), table.at(row, "quat2"), table.at(row, "quat3"),
                          table.at(row, "quat4")});
  rod.diameter = 2.0 * table.at(row, "shapex");
  rod.length = 2.0 * table.at(row, "shapez");
  rod.density = table.at(row, "density");
  rod.type = static_cast<int>(table.at(row, "type"));
  return rod;
}

}  // namespace

std::vector<Frame> read_frames(const std::filesystem::path &dump, const Scene &scene)
{
  std::vector<Frame> frames;
  for (const Snapshot &snapshot : read_dump(dump)) {
    Frame frame{snapshot.step, scene.dt * static_cast<double>(snapshot.step), {}, {}};
    for (size_t row = 0; row < snapshot.atoms.rows.size(); row++) {
      frame.rods.push_back(rod_at(snapshot.atoms, row));
      frame.contacts.push_back(snapshot.atoms.at(row, "c_contacts"));
    }
    frames.push_back(frame);
  }
  return frames;
}

std::vector<Frame> run(const Scene &scene, Mode mode, Program program)
{
  const DeckFolder folder;
  const Launch launch{program, ranks(mode), scene.time_limit};
  folder.write("rods.data", data_file(scene));
  for (const auto &[name, text] : scene.files) folder.write(name, text);
  const std::string start = preamble(scene, mode);
  if (mode != Mode::Restarted) {
    folder.write("in.scene",
                 start + "read_data rods.data\n" + run_commands(scene, "dump.scene", scene.steps));
    run_deck(folder, "in.scene", launch);
    return read_frames(folder / "dump.scene", scene);
  }

  // LIGGGHTS dumps at multiples of the interval, so that both runs must be equally long to end
  // with one.
  if (scene.steps % 2)
    throw std::invalid_argument("a restarted scene needs an even number of steps");
  const long half = scene.steps / 2;
  folder.write("in.first", start + "read_data rods.data\n" +
                               run_commands(scene, "dump.first", half) + "write_restart half\n");
  folder.write("in.second", start + "read_restart half\n" +
                                run_commands(scene, "dump.second", scene.steps - half));
  run_deck(folder, "in.first", launch);
  run_deck(folder, "in.second", launch);
  std::vector<Frame> frames = read_frames(folder / "dump.first", scene);
  for (const Frame &frame : read_frames(folder / "dump.second", scene))
    if (frame.step > frames.back().step) frames.push_back(frame);
  return frames;
}

std::string pair_property(const std::string &name, int types,
                          const std::function<double(int, int)> &value)
{
  std::string line =
      fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, types);
  for (int i = 1; i <= types; i++)
    for (int j = 1; j <= types; j++) line += fmt::format(" {}", value(i, j));
  return line + "\n";
}

std::string pair_property(const std::string &name, int types, double value)
{
  return pair_property(name, types, [value](int, int) { return value; });
}

std::string lane_by_lane(const std::string &models) { return models + " rolling_friction cdt"; }

std::string no_rolling_friction(int types)
{
  return pair_property("coefficientRollingFriction", types, 0.0);
}

std::string linear_material(double kn, double kt, double restitution, double friction, int types)
{
  return pair_property("kn", types, kn) + pair_property("kt", types, kt) +
         pair_property("coefficientRestitution", types, restitution) +
         pair_property("coefficientFriction", types, friction);
}

std::string rod_pair(const std::string &models, const std::string &keywords)
{
  return fmt::format("pair_style gran model {} surface spherocylinder {}\npair_coeff * *\n", models,
                     keywords);
}

std::string rod_wall(const std::string &id, const std::string &models, const std::string &primitive)
{
  return fmt::format("fix {} all wall/gran model {} surface spherocylinder primitive {}\n", id,
                     models, primitive);
}

std::string eased_start(double constant, long steps)
{
  std::string commands;
  for (const char *axis : {"x", "y", "z"})
    commands += fmt::format("variable ease_{0} atom -{1}*v{0}*(step<{2})\n", axis, constant, steps);
  return commands + "fix ease all addforce v_ease_x v_ease_y v_ease_z\n";
}

Vec3 momentum(const std::vector<Rod> &rods)
{
  Vec3 sum{0.0, 0.0, 0.0};
  for (const Rod &rod : rods) sum = sum + rod.mass() * rod.velocity;
  return sum;
}

Vec3 angular_momentum(const std::vector<Rod> &rods, const Vec3 &about)
{
  Vec3 sum{0.0, 0.0, 0.0};
  for (const Rod &rod : rods)
    sum = sum + rod.angular_momentum() + cross(rod.position - about, rod.mass() * rod.velocity);
  return sum;
}

double kinetic_energy(const std::vector<Rod> &rods)
{
  double sum = 0.0;
  for (const Rod &rod : rods) sum += rod.kinetic_energy();
  return sum;
}

double largest_difference(const std::vector<Frame> &a, const std::vector<Frame> &b)
{
  if (a.empty() || a.size() != b.size()) return NAN;
  double largest = 0.0;
  for (size_t f = 0; f < a.size(); f++)
    for (size_t k = 0; k < a[f].rods.size(); k++) {
      const Rod &one = a[f].rods[k], &other = b[f].rods[k];
      const double apart = norm(one.position - other.position) +
                           norm(cross(one.axis, other.axis)) * one.half_cylinder();
      if (!std::isfinite(apart)) return NAN;
      largest = std::max(largest, apart);
    }
  return largest;
}

Vec3 normalized(const Vec3 &a) { return (1.0 / norm(a)) * a; }

double degrees(double angle) { return angle * 3.14159265358979323846 / 180.0; }

}  // namespace decks
