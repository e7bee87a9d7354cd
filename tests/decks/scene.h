// SPDX-License-Identifier: GPL-2.0-or-later
// Rods, their surroundings and a run, written as a deck; what came of it, read back. Space frame,
// SI units.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "core/mass_properties.h"
#include "core/vec3.h"
#include "deck_run.h"

namespace decks {

using spherocylinder::Vec3;

struct Rod {
  Vec3 position{0.0, 0.0, 0.0};
  Vec3 axis{1.0, 0.0, 0.0};
  Vec3 velocity{0.0, 0.0, 0.0};
  Vec3 omega{0.0, 0.0, 0.0};
  double length = 0.1;  // total
  double diameter = 0.01;
  double density = 2700.0;
  int type = 1;

  double radius() const { return 0.5 * diameter; }
  double half_cylinder() const { return 0.5 * (length - diameter); }
  spherocylinder::MassProperties properties() const
  {
    return spherocylinder::mass_properties(diameter, length, density);
  }
  double mass() const { return properties().mass; }
  Vec3 angular_momentum() const;  // about its own centre
  double kinetic_energy() const;  // of translation and rotation
};

struct Scene {
  std::vector<Rod> rods;
  int types = 1;
  std::string boundary = "f f f";
  double box_lo[3] = {-1.0, -1.0, -1.0};
  double box_hi[3] = {1.0, 1.0, 1.0};
  double skin = 0.02;
  std::string physics;  // commands after the rods are read: materials, pair, walls, fixes
  std::map<std::string, std::string> files;  // beside the deck, which name them: name, text
  double dt = 1e-6;
  long steps = 0;
  long dump_every = 0;  // 0: the first and the last step only
  int time_limit = 60;  // of the program (unit: second)
};

struct Frame {
  long step = 0;
  double time = 0.0;
  std::vector<Rod> rods;         // in the order of the scene's
  std::vector<double> contacts;  // with other rods, of each rod
};

// How a scene is run: the result must not depend on it.
enum class Mode {
  OneRank,
  TwoRanks,   // processors 2 1 1: the box is cut at its middle in x
  FourRanks,  // processors 2 2 1: in x and y
  Restarted   // on one rank, by write_restart and read_restart half-way
};

std::string name_of(Mode mode);
void PrintTo(Mode mode, std::ostream *out);  // for GoogleTest

// A rod's line and velocity for a data file, and a whole file.
std::string data_file(const Scene &scene);

// Commands before the rods are there, in LIGGGHTS's order.
std::string preamble(const Scene &scene, Mode mode = Mode::OneRank);

// Runs the scene; a run that does not end with exit code 0 fails the test.
std::vector<Frame> run(const Scene &scene, Mode mode = Mode::OneRank,
                       Program program = Program::Lmp);

std::vector<Frame> read_frames(const std::filesystem::path &dump, const Scene &scene);

// The columns read_frames wants.
extern const char *const kFrameColumns;

// A property/global per pair of atom types; the second form is one value for all pairs.
std::string pair_property(const std::string &name, int types,
                          const std::function<double(int, int)> &value);
std::string pair_property(const std::string &name, int types, double value);

// Models that do the same as these, one contact after the other through LIGGGHTS's own: with a rolling
// friction of no strength, which the law that works in batches does not serve. Its property for so many types.
std::string lane_by_lane(const std::string &models);
std::string no_rolling_friction(int types);

// model linear's four properties for one material.
std::string linear_material(double kn, double kt, double restitution, double friction,
                            int types = 1);

// The pair style of rods with these models ("linear tangential history") and keywords.
std::string rod_pair(const std::string &models, const std::string &keywords = "");

// A wall of rods: `primitive` is "type 1 zplane 0.0" and the like.
std::string rod_wall(const std::string &id, const std::string &models,
                     const std::string &primitive);

// A drag of `constant` (N s/m) on all rods for the first `steps` steps. Springs that start empty let
// rods gather speed before they hold them; friction close to its threshold would take long to stop that.
std::string eased_start(double constant, long steps);

// Largest difference of two runs at any frame (m): of the centres and, with the axes, of the ends. Not a
// number if one is, or if there is nothing to compare.
double largest_difference(const std::vector<Frame> &a, const std::vector<Frame> &b);

// Totals over rods.
Vec3 momentum(const std::vector<Rod> &rods);
Vec3 angular_momentum(const std::vector<Rod> &rods, const Vec3 &about);
double kinetic_energy(const std::vector<Rod> &rods);

Vec3 normalized(const Vec3 &a);
double degrees(double angle);  // to radians

}  // namespace decks
