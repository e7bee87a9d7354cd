// SPDX-License-Identifier: GPL-2.0-or-later
// rod_contacts: where the rods of a bed touch, and what the contacts carry. docs/rod_contacts.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/beds.h"
#include "analysis/contact_forces.h"
#include "analysis/contact_statistics.h"
#include "analysis/input_error.h"
#include "analysis/orientation_statistics.h"
#include "analysis/result_table.h"

using namespace spherocylinder;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t position_bins = 10;
// Gap in diameters that the six digits of a usual dump do not tell from touching: they round a
// coordinate below 1 m by 5e-7 m, and the rods of a laboratory are some millimetres thick.
constexpr double doubtful_gap = 1e-4;
constexpr double largest_over_mean = 10.0;  // of the distributions of overlaps and forces

struct Options {
  BedFiles beds;
  VesselOptions vessel;
  double gap = 0.0;  // diameters of the thickest rod
  std::vector<std::string> local, wall_local;
  std::string local_keywords = default_local_keywords, wall_local_keywords = default_local_keywords;
  double strong = 1.0;
  std::size_t bins = 40;
  std::string csv, tables, contacts_csv;
};

struct Forces {
  std::vector<ContactForce> pairs, walls;
  std::vector<double> pair_sizes, wall_sizes;  // N
  Vec3 sum_on_walls;                           // that the walls exert on the rods (N)
  ForceChains chains;
  std::size_t pairs_apart;  // pairs with a force whose gap is not below the one asked for
};

struct Result {
  std::int64_t step;
  std::size_t rods;
  std::vector<ClosePair> pairs;
  std::size_t doubtful_pairs;  // whose gap is within doubtful_gap of the one asked for
  std::vector<WallContact> walls;
  std::vector<std::uint32_t> pair_numbers, all_numbers;  // contacts of each rod
  ContactKinds kinds, uncorrelated;
  MeanWithError side_position, sin_gamma;
  double sin_gamma_of_all;
  Spread overlap, wall_overlap;
  std::optional<Forces> pair_forces, wall_forces;
};

constexpr OverFiles same = OverFiles::same, sum = OverFiles::sum, mean = OverFiles::mean,
                    error = OverFiles::error, largest = OverFiles::largest;

const std::vector<Column> summary_columns{{"step", same},
                                          {"rods", sum},
                                          {"pair_contacts", sum},
                                          {"doubtful_pairs", sum},
                                          {"wall_contacts", sum},
                                          {"contacts_per_rod", mean},
                                          {"contacts_per_rod_error", error},
                                          {"contacts_per_rod_with_walls", mean},
                                          {"contacts_per_rod_with_walls_error", error},
                                          {"rods_without_contact_fraction", mean},
                                          {"rods_without_contact_fraction_error", error},
                                          {"side_side_fraction", mean},
                                          {"side_side_fraction_error", error},
                                          {"side_end_fraction", mean},
                                          {"side_end_fraction_error", error},
                                          {"end_end_fraction", mean},
                                          {"end_end_fraction_error", error},
                                          {"uncorrelated_side_side_fraction", mean},
                                          {"uncorrelated_side_end_fraction", mean},
                                          {"uncorrelated_end_end_fraction", mean},
                                          {"mean_side_position", mean},
                                          {"mean_side_position_error", error},
                                          {"contact_sin_gamma", mean},
                                          {"contact_sin_gamma_error", error},
                                          {"all_pairs_sin_gamma", mean},
                                          {"overlap_mean_diameters", mean},
                                          {"overlap_mean_error_diameters", error},
                                          {"overlap_rms_diameters", mean},
                                          {"overlap_max_diameters", largest},
                                          {"wall_overlap_mean_diameters", mean},
                                          {"wall_overlap_mean_error_diameters", error},
                                          {"wall_overlap_max_diameters", largest},
                                          {"pair_forces", sum},
                                          {"pair_force_mean_N", mean},
                                          {"pair_force_mean_error_N", error},
                                          {"pair_force_rms_N", mean},
                                          {"pair_force_max_N", largest},
                                          {"wall_forces", sum},
                                          {"wall_force_mean_N", mean},
                                          {"wall_force_mean_error_N", error},
                                          {"wall_force_max_N", largest},
                                          {"wall_force_sum_x_N", mean},
                                          {"wall_force_sum_y_N", mean},
                                          {"wall_force_sum_z_N", mean},
                                          {"strong_fraction", mean},
                                          {"strong_fraction_error", error},
                                          {"chains", mean},
                                          {"chains_error", error},
                                          {"largest_chain_rods", mean},
                                          {"largest_chain_rods_error", error},
                                          {"rods_in_chains_fraction", mean},
                                          {"rods_in_chains_fraction_error", error}};

const std::vector<Column> number_columns{{"step", same},
                                         {"contacts", same},
                                         {"rods", sum},
                                         {"fraction", mean},
                                         {"fraction_error", error},
                                         {"rods_with_walls", sum},
                                         {"fraction_with_walls", mean},
                                         {"fraction_with_walls_error", error}};

const std::vector<Column> position_columns{{"step", same},      {"position_low", same},
                                           {"position_high", same}, {"count", sum},
                                           {"fraction", mean},  {"fraction_error", error},
                                           {"density", mean},   {"density_error", error}};

std::vector<Column> over_mean_columns(const std::string &what)
{
  return {{"step", same},
          {what + "_over_mean_low", same},
          {what + "_over_mean_high", same},
          {"pair_count", sum},
          {"pair_density", mean},
          {"pair_density_error", error},
          {"wall_count", sum},
          {"wall_density", mean},
          {"wall_density_error", error}};
}

const std::vector<Column> chain_columns{{"step", same},
                                        {"rods_low", same},
                                        {"rods_high", same},
                                        {"chains", mean},
                                        {"chains_error", error}};

const std::vector<Column> contact_columns{{"step", same},        {"id_i", same},
                                          {"id_j", same},        {"wall", same},
                                          {"position_i_m", same}, {"position_j_m", same},
                                          {"gap_m", same},       {"sin_gamma", same},
                                          {"force_N", same},     {"chain", same}};

// Of a part p of n.
double fraction_error(double p, std::size_t n)
{
  return n > 0 ? std::sqrt(p * (1.0 - p) / static_cast<double>(n)) : none;
}

double number(std::size_t count) { return static_cast<double>(count); }

std::pair<std::uint32_t, std::uint32_t> key_of(std::uint32_t i, std::uint32_t j)
{
  return std::minmax(i, j);
}

std::vector<double> sizes_of(const std::vector<ContactForce> &forces)
{
  std::vector<double> sizes;
  for (const ContactForce &contact : forces) sizes.push_back(norm(contact.force));
  return sizes;
}

// The dumps of forces beside each dump of rods.
class ForceFiles {
 public:
  explicit ForceFiles(const Options &options) : options_(options)
  {
    need_one_a_dump("--local", options.local.size());
    need_one_a_dump("--wall-local", options.wall_local.size());
  }

  std::optional<std::vector<ContactForce>> at(const Bed &bed, LocalKind kind)
  {
    const bool of_pairs = kind == LocalKind::pairs;
    const std::vector<std::string> &paths = of_pairs ? options_.local : options_.wall_local;
    if (paths.empty()) return std::nullopt;
    auto &[file, forces] = open_[of_pairs ? 0 : 1];
    if (!forces || file != bed.file) {
      file = bed.file;
      forces = std::make_unique<LocalForces>(
          paths[bed.file], kind, of_pairs ? options_.local_keywords : options_.wall_local_keywords,
          of_pairs ? "--local-keywords" : "--wall-local-keywords");
    }
    return forces->at_step(bed.frame, bed.rods);
  }

 private:
  void need_one_a_dump(const char *option, std::size_t count) const
  {
    if (count > 0 && count != options_.beds.dumps.size())
      throw InputError(fmt::format("{}: wanted one for each of the {} DUMP files (got {})", option,
                                   options_.beds.dumps.size(), count));
  }

  const Options &options_;
  std::pair<std::size_t, std::unique_ptr<LocalForces>> open_[2];
};

Forces pair_forces_of(std::vector<ContactForce> forces, const Result &r, double strong)
{
  Forces found{};
  found.pairs = std::move(forces);
  found.pair_sizes = sizes_of(found.pairs);
  found.chains = force_chains(r.rods, found.pairs, strong);
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> touching;
  for (const ClosePair &pair : r.pairs) touching[key_of(pair.i, pair.j)] = true;
  for (const ContactForce &contact : found.pairs)
    if (!touching.count(key_of(contact.i, contact.j))) ++found.pairs_apart;
  return found;
}

Forces wall_forces_of(std::vector<ContactForce> forces)
{
  Forces found{};
  found.walls = std::move(forces);
  found.wall_sizes = sizes_of(found.walls);
  for (const ContactForce &contact : found.walls)
    found.sum_on_walls = found.sum_on_walls + contact.force;
  return found;
}

double mean_cylinder_over_diameter(const std::vector<Rod> &rods)
{
  return mean_of(rods, [](const Rod &rod) { return rod.capsule.aspect_ratio() - 1.0; }).mean;
}

Result measure(const Bed &bed, const std::optional<Vessel> &vessel, const Options &options,
               ForceFiles &force_files)
{
  Result r{};
  r.step = bed.frame.step;
  r.rods = bed.rods.size();
  double diameter = 0.0;
  for (const Rod &rod : bed.rods) diameter = std::max(diameter, 2.0 * rod.capsule.radius);
  const double gap = options.gap * diameter, doubt = doubtful_gap * diameter;
  r.pairs = close_pairs(bed.rods, periodicity_of(bed.frame), gap + doubt);
  r.doubtful_pairs = std::count_if(r.pairs.begin(), r.pairs.end(), [&](const ClosePair &pair) {
    return pair.gap > gap - doubt;
  });
  r.pairs.erase(std::remove_if(r.pairs.begin(), r.pairs.end(),
                               [&](const ClosePair &pair) { return !(pair.gap < gap); }),
                r.pairs.end());
  if (vessel) {
    need_rods_inside(bed, *vessel);
    r.walls = wall_contacts(bed.rods, *vessel, gap);
  }
  r.pair_numbers = r.all_numbers = pair_contact_numbers(r.rods, r.pairs);
  add_wall_contacts(r.all_numbers, r.walls);

  const std::vector<Vec3> axes = axes_of(bed.rods);
  r.sin_gamma_of_all = axes.size() < 2 ? none : mean_sin_gamma(axes);
  r.kinds = contact_kinds(bed.rods, r.pairs);
  r.uncorrelated = axes.size() < 2
                       ? ContactKinds{none, none, none}
                       : uncorrelated_contact_kinds(mean_cylinder_over_diameter(bed.rods),
                                                    r.sin_gamma_of_all);
  r.side_position = mean_of(side_positions(bed.rods, r.pairs));
  std::vector<double> sines;
  for (const ClosePair &pair : r.pairs)
    if (!bed.rods[pair.i].is_sphere() && !bed.rods[pair.j].is_sphere())
      sines.push_back(pair.sin_gamma);
  r.sin_gamma = mean_of(sines);
  r.overlap = spread_of(pair_overlaps(bed.rods, r.pairs));
  r.wall_overlap = spread_of(wall_overlaps(bed.rods, r.walls));

  if (auto forces = force_files.at(bed, LocalKind::pairs))
    r.pair_forces = pair_forces_of(std::move(*forces), r, options.strong);
  if (auto forces = force_files.at(bed, LocalKind::walls))
    r.wall_forces = wall_forces_of(std::move(*forces));
  return r;
}

std::vector<double> summary_row(const Result &r)
{
  const auto as_number = [](std::uint32_t count) { return static_cast<double>(count); };
  const MeanWithError per_rod = mean_of(r.pair_numbers, as_number);
  const MeanWithError with_walls = mean_of(r.all_numbers, as_number);
  const double bare = number(std::count(r.all_numbers.begin(), r.all_numbers.end(), 0u)) /
                      number(r.rods);
  std::vector<double> row{number(r.step),
                          number(r.rods),
                          number(r.pairs.size()),
                          number(r.doubtful_pairs),
                          number(r.walls.size()),
                          per_rod.mean,
                          per_rod.error,
                          with_walls.mean,
                          with_walls.error,
                          bare,
                          fraction_error(bare, r.rods)};
  for (const double part : {r.kinds.side_side, r.kinds.side_end, r.kinds.end_end})
    row.insert(row.end(), {part, fraction_error(part, r.pairs.size())});
  row.insert(row.end(), {r.uncorrelated.side_side, r.uncorrelated.side_end, r.uncorrelated.end_end,
                         r.side_position.mean, r.side_position.error, r.sin_gamma.mean,
                         r.sin_gamma.error, r.sin_gamma_of_all, r.overlap.mean.mean,
                         r.overlap.mean.error, r.overlap.root_mean_square, r.overlap.largest,
                         r.wall_overlap.mean.mean, r.wall_overlap.mean.error,
                         r.wall_overlap.largest});
  const Spread pairs = r.pair_forces ? spread_of(r.pair_forces->pair_sizes) : spread_of({});
  const Spread walls = r.wall_forces ? spread_of(r.wall_forces->wall_sizes) : spread_of({});
  const Vec3 on_walls = r.wall_forces ? r.wall_forces->sum_on_walls : Vec3{none, none, none};
  row.insert(row.end(),
             {r.pair_forces ? number(r.pair_forces->pairs.size()) : none, pairs.mean.mean,
              pairs.mean.error, pairs.root_mean_square, pairs.largest,
              r.wall_forces ? number(r.wall_forces->walls.size()) : none, walls.mean.mean,
              walls.mean.error, walls.largest, on_walls.x, on_walls.y, on_walls.z});
  if (!r.pair_forces || r.pair_forces->pairs.empty()) {
    row.insert(row.end(), 8, none);
    return row;
  }
  const ForceChains &chains = r.pair_forces->chains;
  const double strong = number(chains.strong) / number(r.pair_forces->pairs.size());
  double in_chains = 0.0;
  for (const std::size_t size : chains.sizes) in_chains += number(size) / number(r.rods);
  row.insert(row.end(), {strong, fraction_error(strong, r.pair_forces->pairs.size()),
                         number(chains.sizes.size()), none,
                         chains.sizes.empty() ? 0.0 : number(chains.sizes[0]), none, in_chains,
                         fraction_error(in_chains, r.rods)});
  return row;
}

Rows number_rows(const Result &r)
{
  const std::uint32_t most = *std::max_element(r.all_numbers.begin(), r.all_numbers.end());
  const auto count = [](const std::vector<std::uint32_t> &numbers, std::uint32_t wanted) {
    return number(std::count(numbers.begin(), numbers.end(), wanted));
  };
  Rows rows;
  for (std::uint32_t k = 0; k <= most; ++k) {
    const double pairs = count(r.pair_numbers, k), all = count(r.all_numbers, k);
    const double n = number(r.rods);
    rows.push_back({number(r.step), number(k), pairs, pairs / n, fraction_error(pairs / n, r.rods),
                    all, all / n, fraction_error(all / n, r.rods)});
  }
  return rows;
}

Rows position_rows(const Result &r, const std::vector<Rod> &rods)
{
  Rows rows;
  for (const HistogramBin &bin : histogram(side_positions(rods, r.pairs), 1.0, position_bins))
    rows.push_back({number(r.step), bin.low, bin.high, number(bin.count), bin.fraction,
                    bin.fraction_error, bin.density(), bin.density_error()});
  return rows;
}

// Each value over the mean of its own kind.
Rows over_mean_rows(const Result &r, std::vector<double> pairs, std::vector<double> walls,
                    std::size_t bins)
{
  for (std::vector<double> *values : {&pairs, &walls}) {
    const double scale = mean_of(*values).mean;
    for (double &value : *values) value /= scale;
  }
  const auto of_pairs = histogram(pairs, largest_over_mean, bins);
  const auto of_walls = histogram(walls, largest_over_mean, bins);
  Rows rows;
  for (std::size_t k = 0; k < bins; ++k)
    rows.push_back({number(r.step), of_pairs[k].low, of_pairs[k].high, number(of_pairs[k].count),
                    of_pairs[k].density(), of_pairs[k].density_error(), number(of_walls[k].count),
                    of_walls[k].density(), of_walls[k].density_error()});
  return rows;
}

// Chains of 2, 3-4, 5-8 ... rods.
Rows chain_rows(const Result &r)
{
  Rows rows;
  const std::vector<std::size_t> &sizes = r.pair_forces->chains.sizes;
  for (std::size_t low = 2, high = 2; low == 2 || low <= sizes.front(); low = high + 1, high *= 2) {
    const double count = number(std::count_if(sizes.begin(), sizes.end(), [&](std::size_t size) {
      return size >= low && size <= high;
    }));
    rows.push_back({number(r.step), number(low), number(high), count, std::sqrt(count)});
    if (sizes.empty()) break;
  }
  return rows;
}

Rows contact_rows(const Result &r, const std::vector<Rod> &rods)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> forces;
  if (r.pair_forces)
    for (const ContactForce &contact : r.pair_forces->pairs)
      forces[key_of(contact.i, contact.j)] = contact.force;
  Rows rows;
  for (const ClosePair &pair : r.pairs) {
    const auto force = forces.find(key_of(pair.i, pair.j));
    const double size = force == forces.end() ? none : norm(force->second);
    const bool strong = r.pair_forces && size > r.pair_forces->chains.threshold;
    rows.push_back({number(r.step), number(rods[pair.i].id), number(rods[pair.j].id), none, pair.s,
                    pair.t, pair.gap, pair.sin_gamma, size,
                    strong ? number(r.pair_forces->chains.chain_of_rod[pair.i]) : none});
  }
  for (const WallContact &contact : r.walls) {
    const double half_length = rods[contact.rod].capsule.segment.half_length;
    rows.push_back({number(r.step), number(rods[contact.rod].id), none,
                    contact.at_floor ? 1.0 : 2.0, contact.at_plus ? half_length : -half_length,
                    none, contact.gap, none, none, none});
  }
  return rows;
}

void print_forces(const Result &r, double strong)
{
  if (r.pair_forces) {
    const Forces &forces = *r.pair_forces;
    const Spread spread = spread_of(forces.pair_sizes);
    fmt::print("  forces between rods   {:9}       mean {:.4g} -+ {:.2g} N, largest {:.4g} N\n",
               forces.pairs.size(), spread.mean.mean, spread.mean.error, spread.largest);
    if (forces.pairs_apart > 0)
      fmt::print(
          "                        {:9}       of them between rods that the dump of rods shows "
          "apart\n",
          forces.pairs_apart);
    fmt::print(
        "  strong contacts       {:9}       above {:.3g} of the mean; {} chains, the largest of "
        "{} rods\n",
        forces.chains.strong, strong, forces.chains.sizes.size(),
        forces.chains.sizes.empty() ? 0 : forces.chains.sizes[0]);
  }
  if (r.wall_forces) {
    const Forces &forces = *r.wall_forces;
    const Spread spread = spread_of(forces.wall_sizes);
    const Vec3 &total = forces.sum_on_walls;
    fmt::print("  forces of walls       {:9}       mean {:.4g} -+ {:.2g} N, largest {:.4g} N\n",
               forces.walls.size(), spread.mean.mean, spread.mean.error, spread.largest);
    fmt::print("                                        together ({:.6g}, {:.6g}, {:.6g}) N\n",
               total.x, total.y, total.z);
  }
}

void print_table(const Result &r, const std::vector<double> &row, const Options &options,
                 bool with_walls)
{
  const auto value = [&](const char *name) {
    for (std::size_t k = 0; k < summary_columns.size(); ++k)
      if (summary_columns[k].name == name) return row[k];
    throw std::logic_error(name);
  };
  fmt::print("step {}: {} rods\n", r.step, r.rods);
  fmt::print("  contacts a rod         {:8.4f} -+ {:.4f}   ({} between rods)\n",
             value("contacts_per_rod"), value("contacts_per_rod_error"), r.pairs.size());
  if (r.doubtful_pairs > 0)
    fmt::print(
        "    doubtful             {:8}             pairs within {:g} diameters of touching, which "
        "six digits do not tell\n",
        r.doubtful_pairs, doubtful_gap);
  if (with_walls)
    fmt::print("    with walls           {:8.4f} -+ {:.4f}   ({} at walls)\n",
               value("contacts_per_rod_with_walls"), value("contacts_per_rod_with_walls_error"),
               r.walls.size());
  fmt::print("  rods without contact   {:8.4f} -+ {:.4f}   of all rods\n",
             value("rods_without_contact_fraction"), value("rods_without_contact_fraction_error"));
  if (r.pairs.empty()) return print_forces(r, options.strong);
  fmt::print("                         measured             uncorrelated\n");
  fmt::print("  side to side           {:8.4f} -+ {:.4f}   {:8.4f}\n", r.kinds.side_side,
             value("side_side_fraction_error"), r.uncorrelated.side_side);
  fmt::print("  side to end            {:8.4f} -+ {:.4f}   {:8.4f}\n", r.kinds.side_end,
             value("side_end_fraction_error"), r.uncorrelated.side_end);
  fmt::print("  end to end             {:8.4f} -+ {:.4f}   {:8.4f}\n", r.kinds.end_end,
             value("end_end_fraction_error"), r.uncorrelated.end_end);
  fmt::print("  mean position on side  {:8.4f} -+ {:.4f}   {:8.4f}   (0 centre, 1 end)\n",
             r.side_position.mean, r.side_position.error, 0.5);
  fmt::print("  <|sin gamma|>          {:8.4f} -+ {:.4f}   {:8.4f}   (long isotropic rods; of all "
             "pairs {:.4f} are measured)\n",
             r.sin_gamma.mean, r.sin_gamma.error, isotropic_contact_sin_gamma, r.sin_gamma_of_all);
  fmt::print("  overlap / diameter     {:8.2e} -+ {:.1e}   largest {:.2e}\n", r.overlap.mean.mean,
             r.overlap.mean.error, r.overlap.largest);
  if (!r.walls.empty())
    fmt::print("    at walls             {:8.2e} -+ {:.1e}   largest {:.2e}\n",
               r.wall_overlap.mean.mean, r.wall_overlap.mean.error, r.wall_overlap.largest);
  print_forces(r, options.strong);
}

// All CSV files of a run.
class Tables {
 public:
  explicit Tables(const Options &o)
      : several_(o.beds.several()),
        bins_(o.bins),
        summary_(o.csv, summary_columns, several_),
        numbers_(path(o, "numbers"), number_columns, several_),
        positions_(path(o, "positions"), position_columns, several_),
        overlaps_(path(o, "overlaps"), over_mean_columns("overlap"), several_),
        forces_(o.local.empty() && o.wall_local.empty() ? "" : path(o, "forces"),
                over_mean_columns("force"), several_),
        chains_(o.local.empty() ? "" : path(o, "chains"), chain_columns, several_),
        contacts_(o.contacts_csv, contact_columns, false)
  {
    if (several_ && !o.contacts_csv.empty())
      throw InputError(fmt::format("--contacts-csv: wanted with one DUMP file only (got {})",
                                   o.beds.dumps.size()));
  }

  void add(const Bed &bed, const Result &r, const std::vector<double> &summary)
  {
    summary_.add({summary});
    numbers_.add(number_rows(r));
    positions_.add(position_rows(r, bed.rods));
    overlaps_.add(over_mean_rows(r, pair_overlaps(bed.rods, r.pairs),
                                 wall_overlaps(bed.rods, r.walls), bins_));
    if (r.pair_forces || r.wall_forces)
      forces_.add(
          over_mean_rows(r, r.pair_forces ? r.pair_forces->pair_sizes : std::vector<double>{},
                         r.wall_forces ? r.wall_forces->wall_sizes : std::vector<double>{}, bins_));
    if (r.pair_forces) chains_.add(chain_rows(r));
    if (!several_) contacts_.add(contact_rows(r, bed.rods));
  }

  void finish()
  {
    if (several_) {
      fmt::print("means of the files\n");
      print_means(summary_columns, summary_.combined()[0]);
    }
    for (ResultTable *table :
         {&summary_, &numbers_, &positions_, &overlaps_, &forces_, &chains_, &contacts_})
      table->finish();
  }

 private:
  static std::string path(const Options &options, const char *name)
  {
    return options.tables.empty() ? "" : fmt::format("{}_{}.csv", options.tables, name);
  }

  bool several_;
  std::size_t bins_;
  ResultTable summary_, numbers_, positions_, overlaps_, forces_, chains_, contacts_;
};

void run(const Options &options)
{
  const std::optional<Vessel> vessel = options.vessel.vessel();
  ForceFiles force_files(options);
  Tables tables(options);
  for_each_bed(options.beds, [&](const Bed &bed) {
    const Result result = measure(bed, vessel, options, force_files);
    const std::vector<double> summary = summary_row(result);
    tables.add(bed, result, summary);
    if (options.beds.several()) fmt::print("{}: ", bed.frame.path);
    print_table(result, summary, options, vessel.has_value());
  });
  tables.finish();
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app(
      "Where the rods of a bed touch each other and the walls, and what the contacts carry.",
      "rod_contacts");
  app.footer(
      "Example: rod_contacts bed.dump --vessel-radius 0.305 --csv contacts.csv --tables contacts");
  add_bed_options(app, options.beds);
  add_vessel_options(app, options.vessel);
  app.add_option("--gap", options.gap,
                 "gap of the surfaces below which rods touch, in diameters of the thickest rod")
      ->check(number_between(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--local", options.local,
                 "'dump local' file of compute pair/gran/local, one for each DUMP")
      ->allow_extra_args(false);
  app.add_option("--local-keywords", options.local_keywords, "keywords of that compute")
      ->capture_default_str();
  app.add_option("--wall-local", options.wall_local,
                 "'dump local' file of compute wall/gran/local, one for each DUMP")
      ->allow_extra_args(false);
  app.add_option("--wall-local-keywords", options.wall_local_keywords, "keywords of that compute")
      ->capture_default_str();
  app.add_option("--strong", options.strong,
                 "a contact is part of a force chain above so many times the mean force")
      ->check(positive_number())
      ->capture_default_str();
  app.add_option("--bins", options.bins, "bins of the distributions of overlaps and forces")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the numbers to this CSV file");
  app.add_option("--tables", options.tables,
                 "write the distributions to PREFIX_numbers.csv, PREFIX_positions.csv ...");
  app.add_option("--contacts-csv", options.contacts_csv, "write each contact to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
