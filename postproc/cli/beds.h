// SPDX-License-Identifier: GPL-2.0-or-later
// One or several dumps of beds, and the vessel they may lie in, on a tool's command line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "io/dump_frame.h"
#include "io/rods.h"
#include "measures/fibre_measures.h"
#include "measures/packing_measures.h"

namespace spherocylinder {

struct BedFiles {
  std::vector<std::string> dumps;
  std::string frame = "last";
  FibreOptions fibres;

  bool several() const { return dumps.size() > 1; }
};

// Adds DUMP ..., --frame and what tells fibres.
void add_bed_options(CLI::App &app, BedFiles &options);

struct Bed {
  const DumpFrame &frame;
  std::vector<Rod> rods;  // at least one
  std::size_t file;       // index into the dumps
  Fibres fibres = {};     // that rods are segments of

  // Fibres, each as the straight rod of its length, and rods of their own: see fibre_bodies.
  std::vector<Rod> stretched = {};

  const std::vector<Rod> &bodies() const { return fibres.are_there() ? stretched : rods; }
};

// Calls `work` for each chosen frame of each dump; leaves out frames without rods if all are
// chosen. Throws InputError if there is nothing to work on, for all frames of several files, for a
// file given twice, and for files whose rods differ in mean diameter or aspect ratio.
void for_each_bed(const BedFiles &options, const std::function<void(const Bed &)> &work);

struct VesselOptions {
  std::optional<double> radius, floor;  // m
  std::optional<std::vector<double>> centre;

  // Nothing if neither radius nor floor is given; a floor alone is a vessel of infinite radius.
  // Throws InputError for a centre without a radius.
  std::optional<Vessel> vessel() const;

  // The same, to be drawn: a floor without a radius is refused too.
  std::optional<Vessel> walled_vessel() const;
};

// Adds --vessel-radius, --centre and --floor.
void add_vessel_options(CLI::App &app, VesselOptions &options);

// The box of the six numbers that follow `option`. Throws InputError unless it has an inside.
UprightBox box_of(const std::vector<double> &bounds, const std::string &option);

// The highest centre is that of a fibre, or of a rod of its own.
BedHeight height_of(const Bed &bed);

// "fibres              12 of 96 segments, ...", for a table on the screen.
std::string fibre_count_line(const FibreShapes &shapes);

// The place among the bodies of each rod's own, where there are fibres.
std::vector<std::uint32_t> bodies_of_rods(const Fibres &fibres);

// Whether a body has an axis: rods no longer than thick and rings have none.
bool has_axis(const Bed &bed, std::uint32_t body);

// Rods no longer than thick and rings have no axis.
std::vector<Rod> bodies_with_axis(const Bed &bed);

// Throws InputError unless the highest centre lies above the bottom of the vessel or box.
void need_height(const Bed &bed, const UprightCylinder &whole);

// Throws InputError if centres of rods lie outside.
void need_rods_inside(const Bed &bed, const Vessel &vessel);
void need_rods_inside(const Bed &bed, const UprightBox &box);

}  // namespace spherocylinder
