// SPDX-License-Identifier: GPL-2.0-or-later
// A plan while it is being made: what its parts need to know of each other. Each choose_ function
// draws the same random numbers in every setting.
#pragma once

#include <string>
#include <vector>

#include "plan.h"
#include "random.h"

namespace grammar {

enum class Making { DataFile, ByHand, Pack, RefilledPack, Rate, Stream };
enum class Surroundings { Periodic, Open, Vessel, Cylinder, Floor };

// One size and material of rod.
struct Kind {
  double radius = 0.005, length = 0.1, density = 2700.0;
  int type = 1;

  double volume() const;
};

struct Draft {
  Draft(long number, Setting in_setting);

  Random random;
  Setting setting;
  Plan plan;

  // scene
  Making making = Making::DataFile;
  Surroundings surroundings = Surroundings::Periodic;
  std::vector<Kind> kinds;
  Box box;
  std::string boundary[3];
  std::map<int, Rod> rods;            // of a data file
  double inside_lo[3], inside_hi[3];  // between the walls
  double dt = 2e-5;
  long unit = 20;  // steps between two dumps; all steps are multiples
  double skin = 0.01;
  bool sorted = false, hash = false;
  bool newton = false;
  std::string close_skin, sudden_overlap, lost = "ignore";

  // Commands from the box to the time step, given again after a restart.
  std::string models, keywords;  // what the pair style and the walls have in common
  std::string wall_text, fix_text, last_fix_text, compute_text, thermo_columns;
  std::string integrated = "all";  // the integrator's group
  std::string part_text;           // the group `part`
  std::vector<int> part;           // its ids

  Effects effects;
  bool ids_known = true;  // groups by id still mean the same rods
  bool can_restart = true;
  long step = 0;
  int groups = 0;  // made between runs, each of its own name

  double longest() const;
  bool has_part() const { return !part.empty(); }
};

void choose_material(Draft &draft);
void choose_scene(Draft &draft);  // kinds, box, walls
void choose_rods(Draft &draft);   // data file or insertion
void choose_fixes(Draft &draft);
void choose_computes(Draft &draft);
void choose_runs(Draft &draft);  // runs and what happens between them
void spoil_deck(Draft &draft);   // a mistake in one line

void place_rods(Draft &draft);
std::string data_file(const Draft &draft);
std::string rods_by_hand(const Draft &draft);
// From atom_style to the time step; the source is read_data, read_restart or a box.
std::string header(const Draft &draft, const std::string &source);
std::string box_command(const Draft &draft);

}  // namespace grammar
