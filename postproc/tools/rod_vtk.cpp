// SPDX-License-Identifier: GPL-2.0-or-later
// rod_vtk: rods of a dump as VTK poly data for ParaView. docs/rod_vtk.md
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/beds.h"
#include "cli/command_line.h"
#include "cli/frame_choice.h"
#include "io/input_error.h"
#include "io/mesh_file.h"
#include "io/output_file.h"
#include "pictures/mesh_surface.h"
#include "pictures/ovito_file.h"
#include "pictures/rod_data.h"
#include "pictures/rod_surface.h"
#include "pictures/shown_part.h"
#include "pictures/time_series.h"
#include "pictures/vessel_surface.h"

using namespace spherocylinder;

namespace {

struct Options {
  InputOptions input{"", "all"};
  FibreOptions fibres;
  std::string out = "rods";
  std::string geometry = "capsules";
  int resolution = 12;
  VesselOptions vessel;
  std::optional<std::string> vessel_axis;
  std::optional<double> vessel_height, timestep;
  bool ovito = false;
  std::vector<std::string> meshes;
  std::vector<double> box;
};

double time_of(const DumpFrame &frame, const Options &options)
{
  if (frame.time) return *frame.time;
  return static_cast<double>(frame.step) * options.timestep.value_or(1.0);
}

void write_piece(const std::string &file, vtkPolyData *data, FilesTogether &pieces)
{
  write_poly_data(file, data);
  pieces.add(file);
}

// The wall and the floor, each in a file of its own; returns their names.
std::vector<std::string> write_vessel(const UprightCylinder &vessel, int axis,
                                      const std::string &out, FilesTogether &pieces)
{
  std::vector<std::string> files{out + "_vessel.vtp", out + "_floor.vtp"};
  const vtkSmartPointer<vtkPolyData> meshes[] = {vessel_wall(vessel), vessel_floor(vessel)};
  for (std::size_t i = 0; i < files.size(); i++) {
    turn_to_space(meshes[i], axis);
    write_piece(files[i], meshes[i], pieces);
  }
  return files;
}

// The meshes and the box's faces; each is written once, or for each step if there is a file of it.
class Walls {
 public:
  Walls(const Options &options) : out_(options.out), meshes_(options.meshes)
  {
    if (!options.box.empty()) box_ = box_of(options.box, "--box");
    for (const std::string &name : meshes_)
      if (name.find('*') == std::string::npos) (void) read_mesh(name);  // can be read
  }

  // Writes what is new at this step; returns the files that belong to it.
  std::vector<std::string> write(std::int64_t step, FilesTogether &pieces)
  {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < meshes_.size(); i++) {
      const std::string file = mesh_file_at(meshes_[i], step);
      const bool of_all_steps = file == meshes_[i];
      files.push_back(of_all_steps ? fmt::format("{}_mesh{}.vtp", out_, i + 1)
                                   : fmt::format("{}_mesh{}_{:010}.vtp", out_, i + 1, step));
      if (!of_all_steps || is_first_) write_piece(files.back(), read_mesh(file), pieces);
    }
    if (box_) {
      files.push_back(out_ + "_box.vtp");
      if (is_first_) write_piece(files.back(), box_faces(*box_), pieces);
    }
    is_first_ = false;
    return files;
  }

 private:
  std::string out_;
  std::vector<std::string> meshes_;
  std::optional<UprightBox> box_;
  bool is_first_ = true;
};

void run(const Options &options)
{
  const int axis = vessel_axis_of(options.vessel_axis, options.vessel);
  const std::optional<Vessel> walls = vessel_about(axis, options.vessel);
  if (walls.has_value() != options.vessel_height.has_value())
    throw InputError("--vessel-radius, --vessel-height: must be given together (got one of them)");
  const FrameChoice choice = parse_frame_choice(options.input.frame);
  TimeSeries series(options.out + ".pvd");
  std::optional<OvitoFile> ovito;   // opened only once there is something to write
  std::vector<std::string> vessel;  // files
  Walls others(options);
  std::size_t frames = 0;
  FilesTogether pieces;
  for_each_frame(options.input.dump, choice, [&](const DumpFrame &frame) {
    const std::vector<Rod> rods = rods_of(frame);
    const double time = time_of(frame, options);
    if (options.ovito) {
      if (!ovito) ovito.emplace(options.out + ".xyz");
      ovito->add(frame, rods, time);
    }
    const Fibres fibres = fibres_of(frame, rods, options.fibres);
    const RodGeometry geometry = options.geometry == "lines" ? rod_lines(rods)
                                 : options.geometry == "segments"
                                     ? rod_surfaces(rods, options.resolution)
                                     : rod_surfaces(rods, fibres, options.resolution);
    attach_rod_data(geometry, frame, rods, fibres);
    const std::string file = fmt::format("{}_{:010}.vtp", options.out, frame.step);
    if (series.has(file))
      throw InputError(
          fmt::format("{}: step {} appears twice, wanted each step once", frame.path, frame.step));
    if (++frames == 1 && walls)
      vessel = write_vessel(vessel_up_to(*walls, walls->floor + *options.vessel_height), axis,
                            options.out, pieces);
    write_piece(file, geometry.mesh, pieces);
    series.add(time, file);
    std::vector<std::string> about = vessel;
    for (const std::string &other : others.write(frame.step, pieces)) about.push_back(other);
    for (std::size_t i = 0; i < about.size(); i++)
      series.add(time, about[i], static_cast<int>(i) + 1);
  });
  series.write();
  pieces.add(options.out + ".pvd");
  if (ovito) ovito->close();
  pieces.keep();
  fmt::print("{} frames, open {}.pvd in ParaView", frames, options.out);
  fmt::print("{}\n", options.ovito ? fmt::format(", {}.xyz in OVITO", options.out) : "");
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Rods of a dump as VTK files (.vtp, and .pvd for the series) for ParaView.",
               "rod_vtk");
  app.footer("Example: rod_vtk pour.dump --out vtk/pour --timestep 2e-5\n"
             "         rod_vtk pour.dump.gz --out lines --geometry lines --ovito\n"
             "         rod_vtk bed.dump --out bed --frame last --vessel-radius 0.305 "
             "--vessel-height 0.6");
  add_input_options(app, options.input);
  add_fibre_options(app, options.fibres);
  app.add_option("--out", options.out, "PREFIX of the files to write")->capture_default_str();
  app.add_option(
         "--geometry", options.geometry,
         "capsules (triangles; fibres as smooth tubes), segments (of fibres as capsules, too) or lines")
      ->check(CLI::IsMember({"capsules", "segments", "lines"}))
      ->capture_default_str();
  app.add_option("--resolution", options.resolution, "corners around a capsule")
      ->check(CLI::Range(8, 200))
      ->capture_default_str();
  app.add_flag("--ovito", options.ovito, "also write PREFIX.xyz for OVITO");
  app.add_option("--timestep", options.timestep,
                 "seconds a step, so that the series has times, not steps")
      ->check(positive_number());
  add_vessel_options(app, options.vessel);
  add_vessel_axis_option(app, options.vessel_axis);
  app.add_option("--vessel-height", options.vessel_height,
                 "with --vessel-radius: also write the wall of this height (m), or length along "
                 "another axis, "
                 "PREFIX_vessel.vtp, and PREFIX_floor.vtp")
      ->check(positive_number());
  app.add_option(
         "--mesh", options.meshes,
         "STL or VTK file of a mesh (m), repeatable: also write PREFIX_mesh1.vtp and so on; "
         "a * in its name stands for the step")
      ->allow_extra_args(false);
  app.add_option("--box", options.box,
                 "XLO XHI YLO YHI ZLO ZHI: also write the faces of this box (m), PREFIX_box.vtp")
      ->expected(6)
      ->check(finite_number());
  return run_tool(app, argc, argv, [&] { run(options); });
}
