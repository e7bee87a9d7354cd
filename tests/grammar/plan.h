// SPDX-License-Identifier: GPL-2.0-or-later
// A random deck and what must hold when it ends right.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "state.h"

namespace grammar {

struct Material {
  std::string normal = "linear", tangential = "history", cohesion, rolling;
  bool aspect_scaling = false, spread = true;
  double kn = 2e4, restitution = 0.5, friction = 0.3;
  double young = 5e6, poisson = 0.45;
  int types = 1;
  std::vector<double> stiffness_of_type;  // kn of a pair is kn times the factors of its types

  double pair_kn(int i, int j) const
  {
    return kn * stiffness_of_type[i - 1] * stiffness_of_type[j - 1];
  }
  bool elastic() const { return restitution == 1.0; }
  // The force follows from the poses alone: spring forces of the closest points.
  bool forces_by_pose() const
  {
    return normal == "linear" && tangential == "off" && cohesion.empty() && rolling.empty() &&
           elastic() && !spread;
  }
};

struct Wall {
  std::string id;
  bool cylinder = false;
  int dim = 2;                 // of a plane's normal, of a cylinder's axis
  double position = 0.0;       // of a plane, at step 0
  double way_in_a_step = 0.0;  // of a plane along its normal
  double radius = 0.0;         // of a cylinder whose axis goes through the origin
  int type = 1;

  Wall at(long step) const
  {
    Wall there = *this;
    there.position += way_in_a_step * static_cast<double>(step);
    return there;
  }
};

// How a rod that something else drives must stand t after the deck's start.
using Driven = std::function<Rod(const Rod &at_start, double t)>;

// What holds during one run.
struct Effects {
  Vec3 gravity{0.0, 0.0, 0.0};
  std::map<int, Vec3> added_force;  // of a constant addforce, by id
  bool forces_known = true;         // contacts, weight and added forces are all there is
  bool only_internal = true;        // but for weight, rods feel each other alone: momentum
  bool energy_may_grow = false;
  bool conservative = true;  // nothing takes energy but the contacts
  bool inserting = false;
  bool box_changes = false;
  int deformed = -1;             // dimension of a box that grows about its middle
  double rate = 0.0;             // by this share in a unit of time
  long every = 1;                // in one step of so many
  bool remaps_x = false;         // the rods go with it
  bool counts_all_pairs = true;  // false: some pairs are excluded
  std::set<int> still;           // frozen, or without a way to move
  std::map<int, Driven> driven;
  bool unknown_held = false;  // rods whose numbers are not known are still or driven
  double omega_limit = 0.0;   // largest angular velocity, 0: none
};

struct Run {
  std::string before;  // commands
  std::string command;
  std::string dump;
  Effects effects;
  double dt = 2e-5;
  long first_step = 0, steps = 0;
  // What the commands make of the last run's end; start_known: of all rods, else nothing is said.
  std::vector<std::function<void(State &)>> changes;
  bool start_known = true;
  bool new_ids = false;  // rods are found by their place
};

// The same motion must come of the deck in another setting.
enum class Setting { Same, OtherRanks, OtherSkins, HashMap, Restarted, UnusedType, Balanced };
std::string name_of(Setting setting);

struct Plan {
  long number = 0;
  int ranks = 1;
  std::string deck;
  std::map<std::string, std::string> files;  // name, text
  std::vector<Run> runs;
  Box box;                   // at the start
  std::map<int, Rod> start;  // the data file's rods
  Material material;
  std::vector<Wall> walls;
  int fewest_rods = 0, most_rods = 0;
  bool local_rows = false;  // dump.rows: id id periodic force delta point normal of each pair
  Setting twin = Setting::Same;
  bool spoilt = false;  // there is a mistake in it: only how it ends is judged
};

// The deck of a number, always the same; in a setting, with the plan's motion unchanged.
Plan make_plan(long number, Setting setting = Setting::Same);

}  // namespace grammar
