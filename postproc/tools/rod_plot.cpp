// SPDX-License-Identifier: GPL-2.0-or-later
// rod_plot: the study's plots from the CSV files of rod_packing and rod_orientation.
// docs/rod_plot.md
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "analysis/command_line.h"
#include "analysis/input_error.h"
#include "analysis/packing_theory.h"
#include "figures/paper_figures.h"
#include "pictures/display.h"

using namespace spherocylinder;

namespace {

struct Options {
  std::vector<std::string> files, out, names;
  std::string by, panels, literature;
  std::string volume = "inner";
};

Names names_of(const std::vector<std::string> &words)
{
  Names names;
  for (const std::string &word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("--name: must be VALUE=TEXT (got '{}')", word));
    names[word.substr(0, equals)] = word.substr(equals + 1);
  }
  return names;
}

void write_all(const Figure &figure, const Options &options, char **argv)
{
  for (const std::string &path : options.out) open_figure(path);  // can it be done?
  need_display(argv);  // starts the program again: nothing is printed, no file open before
  std::vector<OutputFile> files;
  for (const std::string &path : options.out) files.push_back(open_figure(path));
  for (OutputFile &file : files) write_figure(file, figure);
}

void plot_packing(const Options &options, char **argv)
{
  const auto means = packing_means(options.files, "vf_" + options.volume, options.by);
  std::vector<LiteraturePoint> literature;
  if (!options.literature.empty()) literature = read_literature(options.literature);
  std::vector<std::string> left_out;
  write_all(packing_figure(means, literature, names_of(options.names), left_out), options, argv);

  const auto number = [](double value) {
    return std::isnan(value) ? std::string("-") : fmt::format("{:.4f}", value);
  };
  fmt::print("{:>12} {:>8} {:>5} {:>10} {:>8} {:>16}\n", options.by.empty() ? "" : options.by,
             "lambda", "beds", "V_f", "error", "random contacts");
  for (const PackingMean &mean : means)
    fmt::print("{:>12} {:8.4g} {:5} {:>10} {:>8} {:>16}\n", mean.group, mean.lambda, mean.beds,
               number(mean.vf.mean), number(mean.vf.error),
               number(random_contact_fraction(mean.lambda, mean.sin_gamma.mean)));
  const auto has_axes_only = [](const PackingMean &mean) {
    return !std::isnan(mean.sin_gamma.mean) &&
           std::isnan(random_contact_fraction(mean.lambda, mean.sin_gamma.mean));
  };
  if (std::any_of(means.begin(), means.end(), has_axes_only))
    fmt::print("random contacts: for slender rods, lambda >= {:g}, that are not nearly parallel\n",
               random_contacts_from);
  for (const std::string &sentence : left_out) fmt::print("left out: {}\n", sentence);
}

void plot_orientation(const Options &options, char **argv)
{
  const auto means = orientation_means(options.files, options.by, options.panels);
  write_all(orientation_figure(means, names_of(options.names), options.by == "lambda"), options,
            argv);
  for (const OrientationMean &mean : means)
    fmt::print("{} {}: {} beds, {} bins\n", mean.panel, mean.group, mean.beds, mean.bins.size());
}

void add_common_options(CLI::App &plot, Options &options, const std::string &files)
{
  plot.add_option("FILES", options.files, files)->required();
  plot.add_option("--out", options.out, "figure to write, .png or .svg; more than one will do")
      ->required();
  plot.add_option("--by", options.by, "column whose values get a symbol each");
  plot.add_option("--name", options.names, "VALUE=TEXT: what a value is called in the figure");
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Plots of solid fraction and orientation, for print.", "rod_plot");
  app.footer(
      "Example: rod_plot packing packing.csv --out figure3.svg figure3.png\n"
      "         rod_plot packing beds.csv --by limits --literature literature.csv --out f.png\n"
      "         rod_plot orientation elevation.csv --by lambda --panels limits --out figure4.svg");
  app.require_subcommand(1);

  CLI::App *packing = app.add_subcommand("packing", "solid volume fraction against aspect ratio");
  add_common_options(*packing, options, "CSV files of rod_packing, or a table of many beds");
  packing->add_option("--volume", options.volume, "'inner' cylinder or 'whole' vessel")
      ->check(CLI::IsMember({"inner", "whole"}))
      ->capture_default_str();
  packing->add_option("--literature", options.literature, "CSV file with published values");
  CLI::App *orientation =
      app.add_subcommand("orientation", "distribution of the elevation per equal solid angle");
  add_common_options(*orientation, options, "CSV files of rod_orientation --csv, or a table");
  orientation->add_option("--panels", options.panels, "column whose values get a panel each");

  return run_tool(app, argc, argv, [&] {
    if (packing->parsed()) plot_packing(options, argv);
    if (orientation->parsed()) plot_orientation(options, argv);
  });
}
