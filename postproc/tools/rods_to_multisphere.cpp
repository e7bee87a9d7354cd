// SPDX-License-Identifier: GPL-2.0-or-later
// rods_to_multisphere: the rods of a dump as bodies of spheres for stock LIGGGHTS.
// docs/rods_to_multisphere.md
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command_line.h"
#include "cli/frame_choice.h"
#include "io/input_error.h"
#include "io/multisphere_input.h"
#include "io/output_file.h"

using namespace spherocylinder;

namespace {

struct Options {
  InputOptions input;
  FibreOptions fibres;
  SphereCount count;
  std::optional<double> density, margin;
  std::string out = "rods";
};

// Files that take their places together, once all of them are on the disk.
class OutputFiles {
 public:
  void add(const std::string &path, const std::string &text)
  {
    files_.emplace_back(path);
    std::ofstream file(files_.back().working_path());
    file << text;
    file.close();
    if (!file) throw InputError(fmt::format("{}: could not be written to its end", path));
  }

  void finish()
  {
    for (OutputFile &file : files_) file.finish();
  }

 private:
  std::vector<OutputFile> files_;
};

void write_input(const Options &options, const DumpFrame &frame)
{
  if (frame.box_is_tilted)
    throw InputError(fmt::format("{}: step {}: the box is tilted, wanted an orthogonal one",
                                 frame.path, frame.step));
  const std::vector<Rod> rods = rods_of(frame);
  if (rods.empty())
    throw InputError(
        fmt::format("{}: step {} holds no rods, wanted at least one", frame.path, frame.step));
  need_no_fibres(frame, rods, options.fibres, "bodies of fix multisphere do not bend");
  const std::vector<RodKind> kinds = rod_kinds(frame, rods, options.count, options.density);
  const BoxBounds box = multisphere_box(frame, rods, options.margin);
  std::size_t spheres = 0;
  for (const RodKind &kind : kinds)
    spheres += kind.rods.size() * static_cast<std::size_t>(kind.spheres);

  OutputFiles files;
  std::vector<std::string> template_paths;
  for (std::size_t k = 0; k < kinds.size(); k++) {
    template_paths.push_back(kinds.size() == 1 ? options.out + ".spheres"
                                               : fmt::format("{}.spheres{}", options.out, k + 1));
    files.add(template_paths.back(), template_file(kinds[k]));
  }
  files.add(options.out + ".box", box_commands(box, frame.periodic, kinds));
  files.add(options.out + ".bodies", body_commands(frame, rods, kinds, box, template_paths));
  files.finish();
  fmt::print("step {}: {} rods as bodies of {} spheres: {}.box, {}.bodies\n", frame.step,
             rods.size(), spheres, options.out, options.out);
  for (const char *missing : {"vx", "omegax"})
    if (!frame.find_column(missing))
      fmt::print("  no column {}: the bodies are put in without\n", missing);
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("The rods of a dump as bodies of spheres, fix multisphere of stock LIGGGHTS.",
               "rods_to_multisphere");
  app.footer("Example: rods_to_multisphere bed.dump --spheres 30 --density 2700 --out bed\n"
             "         rods_to_multisphere gas.dump --spacing 0.5 --out gas\n"
             "         rods_to_multisphere bed.dump --spacing 1 --fit 0.05 --out bed");
  add_input_options(app, options.input);
  add_fibre_options(app, options.fibres);
  auto *how_many = app.add_option_group("spheres", "");
  how_many->add_option("--spheres", options.count.spheres, "spheres a rod")
      ->check(CLI::Range(2, 100000));
  how_many
      ->add_option("--spacing", options.count.spacing,
                   "as few spheres as lie no further apart than so many radii")
      ->check(positive_number());
  how_many->require_option(1);
  app.add_option("--density", options.density,
                 "of the rods (kg/m^3); else the dump's column `density`")
      ->check(positive_number());
  app.add_option("--fit", options.margin,
                 "box about the rods, so much wider on either side (m), where it is not periodic; "
                 "else the dump's")
      ->check(number_between(0.0, 1e9));
  app.add_option("--out", options.out, "PREFIX of the files to write")->capture_default_str();
  return run_tool(app, argc, argv, [&] {
    const FrameChoice choice = parse_frame_choice(options.input.frame);
    if (choice.kind == FrameChoice::Kind::All)
      throw InputError("--frame: must be first, last or a step (got 'all')");
    for_each_frame(options.input.dump, choice,
                   [&](const DumpFrame &frame) { write_input(options, frame); });
  });
}
