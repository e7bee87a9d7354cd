// SPDX-License-Identifier: GPL-2.0-or-later
// What of a bed a picture or a film shows: vessel or box, the rods that are left out, and what the
// camera is aimed at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/beds.h"
#include "pictures/bed_picture.h"

namespace spherocylinder {

struct PartOptions {
  VesselOptions vessel;
  std::optional<std::string> vessel_axis;   // x, y or z
  std::optional<double> vessel_height;      // along the axis (m)
  std::vector<double> box;                  // its six bounds (m), or empty
  std::optional<double> top;                // m
  std::vector<std::string> meshes, bodies;  // files of walls and of what is seen from outside
  bool cut = false;
};

// Adds --vessel-axis, for tools whose vessel may lie.
void add_vessel_axis_option(CLI::App &app, std::optional<std::string> &axis);

// The number of the axis: z, 2, if there is none. Throws InputError for an axis without a radius.
int vessel_axis_of(const std::optional<std::string> &axis, const VesselOptions &vessel);

// The vessel in its own frame. Throws InputError as VesselOptions does.
std::optional<Vessel> vessel_about(int axis, const VesselOptions &options);

class ShownPart {
 public:
  // Of one picture or `several` that are to show the same. Throws InputError for options that do
  // not go together.
  ShownPart(const PartOptions &options, View view, bool several);

  // Takes in a frame with its rods; before the first picture, all frames that are to be drawn.
  // Throws InputError for rods outside the vessel, and for meshes that cannot be read.
  void look_at(const DumpFrame &frame, const std::vector<Rod> &rods);

  // Indices of the rods that are drawn.
  std::vector<std::size_t> rods_shown(const std::vector<Rod> &rods) const;

  // Whether there is something to aim a picture without rods at.
  bool may_be_empty() const;

  // The options that leave rods out.
  std::string left_out_by() const;

  // Sets vessel, boxes, meshes and aim.
  void set(PictureOptions &picture, const DumpFrame &frame) const;

 private:
  struct Ends {
    double low, high;
  };

  bool is_upright() const { return axis_ == 2; }
  bool is_kept(const Rod &rod) const;
  bool is_cut_off(const Rod &rod) const;
  void need_inside(const DumpFrame &frame, const std::vector<Rod> &kept) const;
  std::optional<Ends> given_ends() const;
  Ends ends() const;
  double middle_y() const;
  DrawnVessel drawn_vessel() const;
  std::optional<Box> edges(const DumpFrame &frame) const;
  std::vector<DrawnMesh> meshes_at(std::int64_t step) const;
  vtkSmartPointer<vtkPolyData> shown_mesh(const std::string &file) const;
  DrawnMesh floor_below(const DumpFrame &frame) const;

  PartOptions options_;
  View view_;
  bool several_;
  int axis_;
  std::optional<Vessel> vessel_;  // in its own frame
  std::optional<double> floor_;   // of a heap without a vessel (m)
  std::optional<UprightBox> box_;
  Box reach_;    // of the rods seen so far, whole, but for those left out by --top and --box
  Box bounds_;   // the same, but in periodic directions the dump's box
  Extent seen_;  // these rods, the boxes with edges and the meshes
  mutable std::map<std::string, vtkSmartPointer<vtkPolyData>>
      meshes_;  // of all steps, by their names
};

}  // namespace spherocylinder
