// SPDX-License-Identifier: GPL-2.0-or-later
#include "figures/paper_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "analysis/csv_table.h"
#include "analysis/input_error.h"
#include "analysis/packing_theory.h"

namespace spherocylinder {
namespace {

constexpr double radians = 0.017453292519943296;  // in a degree

constexpr Symbol own_symbols[] = {{Marker::circle, okabe_ito::blue},
                                  {Marker::square, okabe_ito::vermilion},
                                  {Marker::diamond, okabe_ito::green},
                                  {Marker::triangle, okabe_ito::purple},
                                  {Marker::circle, okabe_ito::orange},
                                  {Marker::square, okabe_ito::sky_blue}};
constexpr Symbol literature_symbols[] = {{Marker::triangle, grey, true, 12.0},
                                         {Marker::diamond, grey, true, 11.0},
                                         {Marker::square, grey, true, 11.0},
                                         {Marker::circle, grey, true, 11.0}};

Symbol own_symbol(std::size_t i) { return own_symbols[i % std::size(own_symbols)]; }

// `otherwise` if the value has no name of its own.
std::string name_of(const std::string &value, const Names &names, const std::string &otherwise)
{
  const auto found = names.find(value);
  return found == names.end() ? otherwise : found->second;
}

std::string name_of_group(const std::string &value, const Names &names)
{
  return name_of(value, names, value.empty() ? "this program" : value);
}

// Values in the order they appear, each once.
template <class Items, class Text>
std::vector<std::string> different(const Items &items, Text text)
{
  std::vector<std::string> values;
  for (const auto &item : items)
    if (std::find(values.begin(), values.end(), text(item)) == values.end())
      values.push_back(text(item));
  return values;
}

std::string number_of_beds(std::size_t least, std::size_t most)
{
  if (least != most) return fmt::format("{} to {} beds", least, most);
  return most == 1 ? "one bed" : fmt::format("{} beds", most);
}

Curve theory(const std::function<double(double)> &fraction, double from, const Axis &lambda,
             const Colour &colour, Dash dash)
{
  constexpr int steps = 200;
  Curve curve{{}, colour, dash};
  for (int i = 0; i <= steps; ++i) {
    const double x = from + (lambda.high - from) * i / steps;
    curve.points.push_back({x, fraction(x)});
  }
  return curve;
}

void add_theory(Panel &panel)
{
  struct Line {
    std::string text;
    std::function<double(double)> fraction;
    double from;
    Colour colour;
    Dash dash;
  };
  const Line lines[] = {
      {"Parkhouse & Kelly", parkhouse_kelly_fraction, parkhouse_kelly_from,
       okabe_ito::black, Dash::solid},
      {"random, horizontal",
       [](double x) { return random_contact_fraction(x, horizontal_sin_gamma); },
       random_contacts_from, okabe_ito::green, Dash::dashed},
      {"random, isotropic",
       [](double x) { return random_contact_fraction(x, isotropic_sin_gamma); },
       random_contacts_from, okabe_ito::purple, Dash::dash_dotted}};
  for (const Line &line : lines) {
    panel.curves.push_back(theory(line.fraction, line.from, panel.x, line.colour, line.dash));
    panel.labels.push_back({{panel.x.high, line.fraction(panel.x.high)}, 12, 0, line.text,
                            for_letters(line.colour)});
  }
}

double upper_end(const MeanWithError &value)
{
  return value.mean + (std::isnan(value.error) ? 0.0 : value.error);
}

// Several curves end closely above each other at large lambda: labels at least a line apart.
void spread_labels(Panel &panel, double height_of_panel)
{
  constexpr double apart = 28.0;
  const double unit = height_of_panel / (panel.y.high - panel.y.low);
  auto &labels = panel.labels;
  std::sort(labels.begin(), labels.end(),
            [](const Label &a, const Label &b) { return a.at.y < b.at.y; });
  for (std::size_t i = 1; i < labels.size(); ++i) {
    const double below = labels[i - 1].at.y * unit + labels[i - 1].shift_y;
    labels[i].shift_y = std::max(0.0, below + apart - labels[i].at.y * unit);
  }
}

// Random contacts for a bed's own <|sin gamma|>; NaN if there is none or the theory is not for it.
double expected_fraction(const PackingMean &mean)
{
  return random_contact_fraction(mean.lambda, mean.sin_gamma.mean);
}

// Random contacts for the beds' own <|sin gamma|>, which is taken as linear in lambda between them.
Curve expected_curve(const std::vector<PackingMean> &beds, const Colour &colour)
{
  constexpr int steps = 40;  // between two aspect ratios
  Curve curve{{}, colour, Dash::dotted, 2.0};
  for (std::size_t i = 1; i < beds.size(); ++i)
    for (int k = 0; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      const double lambda = beds[i - 1].lambda + part * (beds[i].lambda - beds[i - 1].lambda);
      const double s = beds[i - 1].sin_gamma.mean +
                       part * (beds[i].sin_gamma.mean - beds[i - 1].sin_gamma.mean);
      curve.points.push_back({lambda, random_contact_fraction(lambda, s)});
    }
  return curve;
}

void add_beds(Panel &panel, const std::vector<PackingMean> &means, const Names &names)
{
  const auto groups = different(means, [](const PackingMean &m) { return m.group; });
  bool has_axes = false;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::vector<PackingMean> beds, with_axes;
    for (const PackingMean &mean : means)
      if (mean.group == groups[i]) beds.push_back(mean);
    std::copy_if(beds.begin(), beds.end(), std::back_inserter(with_axes),
                 [](const PackingMean &mean) { return !std::isnan(expected_fraction(mean)); });

    Series measured{{}, own_symbol(i)}, expected{{}, own_symbol(i)};
    expected.symbol.marker = Marker::bar;
    for (const PackingMean &mean : beds)
      measured.points.push_back({mean.lambda, mean.vf.mean, mean.vf.error});
    for (const PackingMean &mean : with_axes)
      expected.points.push_back(
          {mean.lambda, expected_fraction(mean), 0.0});
    if (with_axes.size() > 1)
      panel.curves.push_back(expected_curve(with_axes, own_symbol(i).colour));
    panel.series.push_back(expected);
    panel.series.push_back(measured);
    has_axes = has_axes || !with_axes.empty();

    const auto [least, most] =
        std::minmax_element(beds.begin(), beds.end(), [](const auto &a, const auto &b) {
          return a.beds < b.beds;
        });
    const std::string name = name_of_group(groups[i], names);
    panel.key.push_back({fmt::format("{}, {}{}", name, number_of_beds(least->beds, most->beds),
                                     beds.size() > 1 ? " each" : ""),
                         okabe_ito::black, own_symbol(i), {}});
  }
  if (!has_axes) return;
  Symbol bar = own_symbol(0);
  bar.marker = Marker::bar;
  if (groups.size() > 1) bar.colour = okabe_ito::black;
  panel.key.push_back(
      {"random contacts at these beds' orientation", okabe_ito::black, bar, Dash::dotted});
}

void add_literature(Panel &panel, const std::vector<LiteraturePoint> &literature,
                    std::vector<std::string> &left_out)
{
  const auto labels = different(literature, [](const LiteraturePoint &p) { return p.label; });
  std::size_t used = 0;
  for (const std::string &label : labels) {
    Symbol symbol = literature_symbols[used % std::size(literature_symbols)];
    std::vector<Measured> points;
    std::string text;
    for (const LiteraturePoint &point : literature) {
      if (point.label != label) continue;
      if (!panel.x.holds(point.lambda) || !panel.y.holds(point.vf)) {
        left_out.push_back(fmt::format("{} at lambda = {:g}, V_f = {:g} is beyond the axes", label,
                                       point.lambda, point.vf));
        continue;
      }
      points.push_back({point.lambda, point.vf, point.error});
      symbol.filled = point.checked;
      text = label + (point.checked ? "" : " (not checked)");
    }
    if (points.empty()) continue;
    ++used;
    panel.series.push_back({points, symbol});
    panel.key.push_back({text, okabe_ito::black, symbol, {}});
  }
}

}  // namespace

std::vector<LiteraturePoint> read_literature(const std::string &path)
{
  const CsvTable table(path);
  std::vector<LiteraturePoint> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string &checked = table.text(row, "checked");
    if (checked != "yes" && checked != "no")
      throw InputError(
          fmt::format("{}: checked is '{}', wanted yes or no", table.place(row), checked));
    const double error = table.is_empty(row, "vf_error")
                             ? 0.0
                             : number_between(table, row, "vf_error", 0.0, unbounded);
    points.push_back({number_between(table, row, "lambda", 1.0, unbounded),
                      number_between(table, row, "vf", 0.0, 1.0), error, table.text(row, "kind"),
                      table.text(row, "label"), checked == "yes"});
  }
  return points;
}

Figure packing_figure(const std::vector<PackingMean> &means,
                      const std::vector<LiteraturePoint> &literature, const Names &names,
                      std::vector<std::string> &left_out)
{
  double longest = 0.0, densest = 0.0;
  for (const PackingMean &mean : means) {
    longest = std::max(longest, mean.lambda);
    densest = std::max(densest, upper_end(mean.vf));
    if (!std::isnan(expected_fraction(mean)))
      densest = std::max(densest, expected_fraction(mean));
  }
  Figure figure;
  figure.right_margin = 245;
  Panel &panel = figure.panels.emplace_back();
  panel.x = round_axis("aspect ratio λ = total length / diameter", 0.0,
                       std::max(40.0, 1.1 * longest));
  panel.y = round_axis("solid volume fraction", 0.0, std::max(0.8, 1.1 * densest));
  panel.key_at = {0.28, 1.0};
  add_theory(panel);
  spread_labels(panel, 780.0);
  add_literature(panel, literature, left_out);
  const std::vector<KeyEntry> literature_key = std::move(panel.key);
  panel.key.clear();
  add_beds(panel, means, names);
  panel.key.insert(panel.key.end(), literature_key.begin(), literature_key.end());
  return figure;
}

Figure orientation_figure(const std::vector<OrientationMean> &means, const Names &names,
                          bool by_lambda)
{
  const auto panels = different(means, [](const OrientationMean &m) { return m.panel; });
  const auto groups = different(means, [](const OrientationMean &m) { return m.group; });
  double highest = 1.0;
  for (const OrientationMean &mean : means)
    for (const ElevationMean &bin : mean.bins)
      highest = std::max({highest, upper_end(bin.density), 1.0 + bin.isotropic_scatter});

  Figure figure;
  figure.width = panels.size() > 1 ? 700.0 * static_cast<double>(panels.size()) : 1000.0;
  figure.height = 760;
  for (const std::string &part : panels) {
    Panel &panel = figure.panels.emplace_back();
    panel.title = name_of(part, names, part);
    panel.x = {"elevation above the horizontal (equal lengths: equal solid angle)", 0.0, 1.0, {}};
    if (panels.size() > 1) panel.x.title = "elevation (equal lengths: equal solid angle)";
    for (const double degrees : {0., 10., 20., 30., 40., 50., 60., 90.})
      panel.x.ticks.push_back({std::sin(degrees * radians), fmt::format("{:g}°", degrees)});
    panel.y = round_axis("rods per solid angle / isotropic", 0.0, highest);
    double scatter = 0.0, isotropic_rods = 0.0;  // of the widest band
    for (const OrientationMean &mean : means) {
      if (mean.panel != part) continue;
      const auto group = static_cast<std::size_t>(
          std::find(groups.begin(), groups.end(), mean.group) - groups.begin());
      // Error bars of several groups stand beside each other.
      const double aside =
          0.006 * (static_cast<double>(group) - 0.5 * static_cast<double>(groups.size() - 1));
      Series series{{}, own_symbol(group)};
      series.symbol.size = 11;
      Curve link{{}, own_symbol(group).colour, Dash::solid, 1.8};
      for (const ElevationMean &bin : mean.bins) {
        const double x =
            0.5 * (std::sin(bin.low * radians) + std::sin(bin.high * radians)) + aside;
        series.points.push_back({x, bin.density.mean, bin.density.error});
        link.points.push_back({x, bin.density.mean});
        if (bin.isotropic_scatter > scatter) {
          scatter = bin.isotropic_scatter;
          isotropic_rods = mean.isotropic_rods;
        }
      }
      panel.curves.push_back(link);
      panel.series.push_back(series);
      const std::string name = by_lambda ? name_of(mean.group, names, "λ = " + mean.group)
                                         : name_of_group(mean.group, names);
      panel.key.push_back({fmt::format("{}, {}", name, number_of_beds(mean.beds, mean.beds)),
                           okabe_ito::black, series.symbol, Dash::solid});
    }
    panel.bands.push_back({1.0 - scatter, 1.0 + scatter, grey, 0.25});
    panel.curves.insert(panel.curves.begin(),
                        Curve{{{0.0, 1.0}, {1.0, 1.0}}, grey, Dash::dashed, 2.0});
    panel.labels.push_back({{1.0, 1.0 + scatter}, -330, 18,
                            fmt::format("±1 s.d. of {:.0f} isotropic rods", isotropic_rods),
                            for_letters(grey)});
    panel.key_at = {0.42, 0.98};
  }
  return figure;
}

}  // namespace spherocylinder
