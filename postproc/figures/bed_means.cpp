// SPDX-License-Identifier: GPL-2.0-or-later
#include "figures/bed_means.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "analysis/csv_table.h"
#include "analysis/input_error.h"
#include "analysis/mean_with_error.h"
#include "analysis/numbers.h"

namespace spherocylinder {
namespace {

constexpr double same_lambda = 0.005;  // relative; more than the rounding of a dump

std::string field_or_empty(const CsvTable &table, std::size_t row, const std::string &column)
{
  return column.empty() ? std::string() : table.text(row, column);
}

std::string seed_of(const CsvTable &table, std::size_t row)
{
  return table.has("seed") ? table.text(row, "seed") : std::string();
}

// Complains of the second row of one bed.
class SeenBeds {
 public:
  void add(const CsvTable &table, std::size_t row, const std::string &bed)
  {
    if (!beds_.insert(table.path() + '\n' + bed).second)
      throw InputError(
          fmt::format("{}: a second row for one bed, wanted one (a single frame; several beds "
                      "in one file need a column 'seed')",
                      table.place(row)));
  }

 private:
  std::set<std::string> beds_;
};

// The entry that `fits`, or a new one at the end.
template <class Entry, class Fits>
Entry &find_or_add(std::vector<Entry> &entries, Fits fits, const Entry &fresh)
{
  const auto found = std::find_if(entries.begin(), entries.end(), fits);
  if (found != entries.end()) return *found;
  return entries.emplace_back(fresh);
}

struct PackingBeds {
  std::string group;
  double lambda;
  std::vector<double> vf, sin_gamma;
};

struct BinOfBeds {
  double low, high;
  std::vector<double> densities;
  double error, scatter, isotropic;  // of one bed
};

struct OrientationBeds {
  std::string panel, group;
  std::set<std::string> beds;
  std::vector<BinOfBeds> bins;
};

}  // namespace

double number_between(const CsvTable &table, std::size_t row, const std::string &column, double low,
                      double high)
{
  const double value = table.number(row, column);
  if (value >= low && value <= high) return value;
  throw InputError(
      std::isinf(high)
          ? fmt::format("{}: {} is {}, wanted >= {}", table.place(row), column, value, low)
          : fmt::format("{}: {} is {}, wanted from {} to {}", table.place(row), column, value, low,
                        high));
}

std::vector<PackingMean> packing_means(const std::vector<std::string> &files,
                                       const std::string &vf_column, const std::string &by)
{
  std::vector<PackingBeds> kinds;
  std::vector<std::string> groups;
  SeenBeds seen;
  for (const std::string &file : files) {
    const CsvTable table(file);
    const std::string lambda_column = table.has("lambda_mean") ? "lambda_mean" : "lambda";
    const bool has_axes = table.has("mean_sin_gamma");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const std::string group = field_or_empty(table, row, by);
      const double lambda = number_between(table, row, lambda_column, 1.0, unbounded);
      PackingBeds &kind = find_or_add(
          kinds,
          [&](const PackingBeds &k) {
            return k.group == group && std::abs(k.lambda - lambda) <= same_lambda * lambda;
          },
          PackingBeds{group, lambda, {}, {}});
      seen.add(table, row, fmt::format("{}\n{}\n{}", group, kind.lambda, seed_of(table, row)));
      const std::string mean_mark = vf_column + "_error";
      if (table.has(mean_mark) && !table.is_empty(row, mean_mark))
        throw InputError(fmt::format("{}: {} is {}, so that this is a mean over beds, wanted a row "
                                     "for each bed",
                                     table.place(row), mean_mark, table.text(row, mean_mark)));
      kind.vf.push_back(number_between(table, row, vf_column, 0.0, 1.0));
      if (has_axes && !table.is_empty(row, "mean_sin_gamma"))
        kind.sin_gamma.push_back(number_between(table, row, "mean_sin_gamma", 0.0, 1.0));
      find_or_add(
          groups, [&](const std::string &g) { return g == group; }, group);
    }
  }

  std::vector<PackingMean> means;
  std::sort(kinds.begin(), kinds.end(),
            [](const PackingBeds &a, const PackingBeds &b) { return a.lambda < b.lambda; });
  for (const std::string &group : groups)
    for (const PackingBeds &kind : kinds)
      if (kind.group == group)
        means.push_back({group, kind.lambda, kind.vf.size(), mean_of(kind.vf),
                         kind.sin_gamma.size() == kind.vf.size()
                             ? mean_of(kind.sin_gamma)
                             : MeanWithError{none, none}});
  return means;
}

std::vector<OrientationMean> orientation_means(const std::vector<std::string> &files,
                                               const std::string &by, const std::string &panel_by)
{
  std::vector<OrientationBeds> kinds;
  SeenBeds seen;
  for (const std::string &file : files) {
    const CsvTable table(file);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const std::string group = field_or_empty(table, row, by);
      const std::string panel = field_or_empty(table, row, panel_by);
      OrientationBeds &kind = find_or_add(
          kinds,
          [&](const OrientationBeds &k) { return k.group == group && k.panel == panel; },
          OrientationBeds{panel, group, {}, {}});
      const double low = table.number(row, "elevation_low_deg");
      const double high = table.number(row, "elevation_high_deg");
      if (!(low >= 0.0 && low < high && high <= 90.0 + 1e-9))
        throw InputError(fmt::format("{}: a bin from {} to {} degrees, wanted within 0 to 90",
                                     table.place(row), low, high));
      const double isotropic = table.number(row, "isotropic_fraction");
      if (!(isotropic > 0.0))
        throw InputError(
            fmt::format("{}: isotropic_fraction is {}, wanted > 0", table.place(row), isotropic));
      const std::string seed = seed_of(table, row);
      seen.add(table, row, fmt::format("{}\n{}\n{}\n{}", panel, group, seed, low));
      kind.beds.insert(file + '\n' + seed);
      BinOfBeds &bin = find_or_add(
          kind.bins, [&](const BinOfBeds &b) { return b.low == low && b.high == high; },
          BinOfBeds{low, high, {}, 0.0, 0.0, 0.0});
      bin.densities.push_back(number_between(table, row, "density", 0.0, unbounded));
      bin.error = number_between(table, row, "density_error", 0.0, unbounded);
      bin.scatter =
          number_between(table, row, "isotropic_scatter", 0.0, unbounded) / isotropic;
      bin.isotropic = isotropic;
    }
  }

  std::vector<OrientationMean> means;
  for (const OrientationBeds &kind : kinds) {
    const BinOfBeds &first = kind.bins.front();
    // The part q of n isotropic rods scatters by sqrt(q (1 - q)/n), in units of q by s: n follows.
    const double rods_of_a_bed =
        (1.0 - first.isotropic) / (first.isotropic * first.scatter * first.scatter);
    OrientationMean mean{kind.panel,
                         kind.group,
                         kind.beds.size(),
                         rods_of_a_bed * static_cast<double>(kind.beds.size()),
                         {}};
    for (const BinOfBeds &bin : kind.bins) {
      if (bin.densities.size() != kind.beds.size())
        throw InputError(
            fmt::format("the bin from {:.4g} to {:.4g} degrees is in {} of {} beds, wanted the "
                        "same bins in all",
                        bin.low, bin.high, bin.densities.size(), kind.beds.size()));
      MeanWithError density = mean_of(bin.densities);
      if (kind.beds.size() == 1) density.error = bin.error;
      mean.bins.push_back({bin.low, bin.high, density,
                           bin.scatter / std::sqrt(static_cast<double>(kind.beds.size()))});
    }
    means.push_back(std::move(mean));
  }
  return means;
}

}  // namespace spherocylinder
