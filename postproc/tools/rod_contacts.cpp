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

#include "analysis/bed_contacts.h"
#include "analysis/beds.h"
#include "analysis/contact_forces.h"
#include "analysis/input_error.h"
#include "analysis/orientation_statistics.h"
#include "analysis/result_table.h"

using namespace spherocylinder;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t position_bins = 10;
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

constexpr OverFiles same = OverFiles::same, sum = OverFiles::sum, mean = OverFiles::mean,
                    error = OverFiles::error, largest = OverFiles::largest;

// What several beds alone give an error.
double no_error(const BedContacts &) { return none; }

Spread spread_of(const std::optional<MeasuredForces> &forces)
{
  return forces ? forces->spread : Spread{{none, none}, none, none};
}

double number_of(const std::optional<MeasuredForces> &forces)
{
  return forces ? static_cast<double>(forces->contacts.size()) : none;
}

Vec3 sum_of(const std::optional<MeasuredForces> &forces)
{
  return forces ? forces->sum : Vec3{none, none, none};
}

bool has_chains(const BedContacts &b) { return b.pair_forces && !b.pair_forces->contacts.empty(); }

double number_of_chains(const BedContacts &b)
{
  return has_chains(b) ? static_cast<double>(b.chains.sizes.size()) : none;
}

double largest_chain(const BedContacts &b)
{
  if (!has_chains(b)) return none;
  return b.chains.sizes.empty() ? 0.0 : static_cast<double>(b.chains.sizes[0]);
}

Fields<BedContacts> summary_fields()
{
  using B = BedContacts;
  Fields<B> fields;
  fields.add("step", same, [](const B &b) { return b.step; });
  fields.add("rods", sum, [](const B &b) { return b.rods; });
  fields.add("pair_contacts", sum, [](const B &b) { return b.pairs.size(); });
  fields.add("doubtful_pairs", sum, [](const B &b) { return b.doubtful_pairs; });
  fields.add("wall_contacts", sum, [](const B &b) { return b.walls.size(); });
  fields.add_mean("contacts_per_rod", [](const B &b) { return b.between_rods.per_rod; });
  fields.add_mean("contacts_per_rod_with_walls", [](const B &b) { return b.with_walls.per_rod; });
  fields.add_mean("rods_without_contact_fraction", [](const B &b) { return b.without_contact; });
  fields.add_mean("side_side_fraction", [](const B &b) { return b.kinds.side_side; });
  fields.add_mean("side_end_fraction", [](const B &b) { return b.kinds.side_end; });
  fields.add_mean("end_end_fraction", [](const B &b) { return b.kinds.end_end; });
  fields.add("uncorrelated_side_side_fraction", mean,
             [](const B &b) { return b.uncorrelated.side_side; });
  fields.add("uncorrelated_side_end_fraction", mean,
             [](const B &b) { return b.uncorrelated.side_end; });
  fields.add("uncorrelated_end_end_fraction", mean,
             [](const B &b) { return b.uncorrelated.end_end; });
  fields.add_mean("mean_side_position", [](const B &b) { return b.side_position; });
  fields.add_mean("contact_sin_gamma", [](const B &b) { return b.sin_gamma; });
  fields.add("all_pairs_sin_gamma", mean, [](const B &b) { return b.sin_gamma_of_all; });
  fields.add_mean("overlap_mean", [](const B &b) { return b.overlap.mean; }, "_diameters");
  fields.add("overlap_rms_diameters", mean, [](const B &b) { return b.overlap.root_mean_square; });
  fields.add("overlap_max_diameters", largest, [](const B &b) { return b.overlap.largest; });
  fields.add_mean("wall_overlap_mean", [](const B &b) { return b.wall_overlap.mean; },
                  "_diameters");
  fields.add("wall_overlap_max_diameters", largest,
             [](const B &b) { return b.wall_overlap.largest; });
  fields.add("pair_forces", sum, [](const B &b) { return number_of(b.pair_forces); });
  fields.add_mean("pair_force_mean", [](const B &b) { return spread_of(b.pair_forces).mean; },
                  "_N");
  fields.add("pair_force_rms_N", mean,
             [](const B &b) { return spread_of(b.pair_forces).root_mean_square; });
  fields.add("pair_force_max_N", largest,
             [](const B &b) { return spread_of(b.pair_forces).largest; });
  fields.add("wall_forces", sum, [](const B &b) { return number_of(b.wall_forces); });
  fields.add_mean("wall_force_mean", [](const B &b) { return spread_of(b.wall_forces).mean; },
                  "_N");
  fields.add("wall_force_max_N", largest,
             [](const B &b) { return spread_of(b.wall_forces).largest; });
  fields.add("wall_force_sum_x_N", mean, [](const B &b) { return sum_of(b.wall_forces).x; });
  fields.add("wall_force_sum_y_N", mean, [](const B &b) { return sum_of(b.wall_forces).y; });
  fields.add("wall_force_sum_z_N", mean, [](const B &b) { return sum_of(b.wall_forces).z; });
  fields.add_mean("strong_fraction", [](const B &b) { return b.strong; });
  fields.add("chains", mean, number_of_chains).add("chains_error", error, no_error);
  fields.add("largest_chain_rods", mean, largest_chain);
  fields.add("largest_chain_rods_error", error, no_error);
  fields.add_mean("rods_in_chains_fraction", [](const B &b) { return b.in_chains; });
  return fields;
}

// How many rods have so many contacts.
struct NumberRow {
  std::int64_t step;
  std::size_t contacts, between_rods, with_walls, rods;
};

Fields<NumberRow> number_fields()
{
  using R = NumberRow;
  Fields<R> fields;
  fields.add("step", same, [](const R &r) { return r.step; });
  fields.add("contacts", same, [](const R &r) { return r.contacts; });
  fields.add("rods", sum, [](const R &r) { return r.between_rods; });
  fields.add_mean("fraction", [](const R &r) { return part_of(r.between_rods, r.rods); });
  fields.add("rods_with_walls", sum, [](const R &r) { return r.with_walls; });
  fields.add_mean("fraction_with_walls", [](const R &r) { return part_of(r.with_walls, r.rods); });
  return fields;
}

std::vector<NumberRow> number_rows(const BedContacts &b)
{
  std::vector<NumberRow> rows;
  for (std::size_t k = 0; k < b.with_walls.rods_with.size(); ++k)
    rows.push_back({b.step, k, b.between_rods.rods_that_have(k), b.with_walls.rods_with[k],
                    b.rods});
  return rows;
}

struct BinRow {
  std::int64_t step;
  HistogramBin pairs, walls;  // the same bin of both
};

Fields<BinRow> position_fields()
{
  using R = BinRow;
  Fields<R> fields;
  fields.add("step", same, [](const R &r) { return r.step; });
  fields.add("position_low", same, [](const R &r) { return r.pairs.low; });
  fields.add("position_high", same, [](const R &r) { return r.pairs.high; });
  fields.add("count", sum, [](const R &r) { return r.pairs.count; });
  fields.add_mean("fraction", [](const R &r) { return r.pairs.part; });
  fields.add_mean("density", [](const R &r) { return r.pairs.density(); });
  return fields;
}

std::vector<BinRow> position_rows(const BedContacts &b, const std::vector<Rod> &rods)
{
  std::vector<BinRow> rows;
  for (const HistogramBin &bin : histogram(side_positions(rods, b.pairs), 1.0, position_bins))
    rows.push_back({b.step, bin, {}});
  return rows;
}

// Of overlaps or forces, over the mean of their kind.
Fields<BinRow> over_mean_fields(const std::string &what)
{
  using R = BinRow;
  Fields<R> fields;
  fields.add("step", same, [](const R &r) { return r.step; });
  fields.add(what + "_over_mean_low", same, [](const R &r) { return r.pairs.low; });
  fields.add(what + "_over_mean_high", same, [](const R &r) { return r.pairs.high; });
  fields.add("pair_count", sum, [](const R &r) { return r.pairs.count; });
  fields.add_mean("pair_density", [](const R &r) { return r.pairs.density(); });
  fields.add("wall_count", sum, [](const R &r) { return r.walls.count; });
  fields.add_mean("wall_density", [](const R &r) { return r.walls.density(); });
  return fields;
}

std::vector<BinRow> over_mean_rows(std::int64_t step, std::vector<double> pairs,
                                   std::vector<double> walls, std::size_t bins)
{
  for (std::vector<double> *values : {&pairs, &walls}) {
    const double scale = mean_of(*values).mean;
    for (double &value : *values) value /= scale;
  }
  const auto of_pairs = histogram(pairs, largest_over_mean, bins);
  const auto of_walls = histogram(walls, largest_over_mean, bins);
  std::vector<BinRow> rows;
  for (std::size_t k = 0; k < bins; ++k) rows.push_back({step, of_pairs[k], of_walls[k]});
  return rows;
}

struct ChainRow {
  std::int64_t step;
  std::size_t rods_low, rods_high, chains;
};

Fields<ChainRow> chain_fields()
{
  using R = ChainRow;
  Fields<R> fields;
  fields.add("step", same, [](const R &r) { return r.step; });
  fields.add("rods_low", same, [](const R &r) { return r.rods_low; });
  fields.add("rods_high", same, [](const R &r) { return r.rods_high; });
  fields.add_mean("chains", [](const R &r) {
    const double count = static_cast<double>(r.chains);
    return MeanWithError{count, std::sqrt(count)};
  });
  return fields;
}

// Chains of 2, 3-4, 5-8 ... rods.
std::vector<ChainRow> chain_rows(const BedContacts &b)
{
  std::vector<ChainRow> rows;
  const std::vector<std::size_t> &sizes = b.chains.sizes;
  for (std::size_t low = 2, high = 2; low == 2 || low <= sizes.front(); low = high + 1, high *= 2) {
    const auto in_row = [&](std::size_t size) { return size >= low && size <= high; };
    const auto count = std::count_if(sizes.begin(), sizes.end(), in_row);
    rows.push_back({b.step, low, high, static_cast<std::size_t>(count)});
    if (sizes.empty()) break;
  }
  return rows;
}

// A contact between rods, or of a rod at a wall. NaN where there is nothing to say.
struct ContactRow {
  std::int64_t step, id_i;
  double id_j, wall;              // 1 floor, 2 cylinder
  double position_i, position_j;  // signed distance from the centre along the axis (m)
  double gap, sin_gamma;          // m
  double force, chain;            // N; number of the force chain
};

Fields<ContactRow> contact_fields()
{
  using R = ContactRow;
  Fields<R> fields;
  fields.add("step", same, [](const R &r) { return r.step; });
  fields.add("id_i", same, [](const R &r) { return r.id_i; });
  fields.add("id_j", same, [](const R &r) { return r.id_j; });
  fields.add("wall", same, [](const R &r) { return r.wall; });
  fields.add("position_i_m", same, [](const R &r) { return r.position_i; });
  fields.add("position_j_m", same, [](const R &r) { return r.position_j; });
  fields.add("gap_m", same, [](const R &r) { return r.gap; });
  fields.add("sin_gamma", same, [](const R &r) { return r.sin_gamma; });
  fields.add("force_N", same, [](const R &r) { return r.force; });
  fields.add("chain", same, [](const R &r) { return r.chain; });
  return fields;
}

std::vector<ContactRow> contact_rows(const BedContacts &b, const std::vector<Rod> &rods)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> forces;
  if (b.pair_forces)
    for (std::size_t k = 0; k < b.pair_forces->contacts.size(); ++k) {
      const ContactForce &contact = b.pair_forces->contacts[k];
      forces[std::minmax(contact.i, contact.j)] = b.pair_forces->sizes[k];
    }
  std::vector<ContactRow> rows;
  for (const ClosePair &pair : b.pairs) {
    const auto found = forces.find({pair.i, pair.j});
    const double force = found == forces.end() ? none : found->second;
    const bool strong = force > b.chains.threshold;  // not if there is no force
    rows.push_back({b.step, rods[pair.i].id, static_cast<double>(rods[pair.j].id), none, pair.s,
                    pair.t, pair.gap, pair.sin_gamma, force,
                    strong ? b.chains.chain_of_rod[pair.i] : none});
  }
  for (const WallContact &contact : b.walls) {
    const double half_length = rods[contact.rod].capsule.segment.half_length;
    rows.push_back({b.step, rods[contact.rod].id, none, contact.at_floor ? 1.0 : 2.0,
                    contact.at_plus ? half_length : -half_length, none, contact.gap, none, none,
                    none});
  }
  return rows;
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

void print_forces(const BedContacts &b, double strong)
{
  if (b.pair_forces) {
    const Spread &spread = b.pair_forces->spread;
    fmt::print("  forces between rods   {:9}       mean {:.4g} -+ {:.2g} N, largest {:.4g} N\n",
               b.pair_forces->contacts.size(), spread.mean.mean, spread.mean.error,
               spread.largest);
    if (b.forces_apart > 0)
      fmt::print(
          "                        {:9}       of them between rods that the dump of rods shows "
          "apart\n",
          b.forces_apart);
    fmt::print(
        "  strong contacts       {:9}       above {:.3g} of the mean; {} chains, the largest of "
        "{} rods\n",
        b.chains.strong, strong, b.chains.sizes.size(),
        b.chains.sizes.empty() ? 0 : b.chains.sizes[0]);
  }
  if (b.wall_forces) {
    const Spread &spread = b.wall_forces->spread;
    const Vec3 &total = b.wall_forces->sum;
    fmt::print("  forces of walls       {:9}       mean {:.4g} -+ {:.2g} N, largest {:.4g} N\n",
               b.wall_forces->contacts.size(), spread.mean.mean, spread.mean.error,
               spread.largest);
    fmt::print("                                        together ({:.6g}, {:.6g}, {:.6g}) N\n",
               total.x, total.y, total.z);
  }
}

void print_table(const BedContacts &b, double strong, bool with_walls)
{
  const auto measured = [](const char *name, const MeanWithError &value, auto... rest) {
    fmt::print("  {:<22} {:8.4f} -+ {:.4f}   {}\n", name, value.mean, value.error, rest...);
  };
  fmt::print("step {}: {} rods\n", b.step, b.rods);
  measured("contacts a rod", b.between_rods.per_rod,
           fmt::format("({} between rods)", b.pairs.size()));
  if (b.doubtful_pairs > 0)
    fmt::print(
        "    doubtful             {:8}             pairs within {:g} diameters of touching, which "
        "six digits do not tell\n",
        b.doubtful_pairs, doubtful_gap);
  if (with_walls)
    measured("  with walls", b.with_walls.per_rod, fmt::format("({} at walls)", b.walls.size()));
  measured("rods without contact", b.without_contact, "of all rods");
  if (b.pairs.empty()) return print_forces(b, strong);
  const auto beside = [](double uncorrelated) { return fmt::format("{:8.4f}", uncorrelated); };
  fmt::print("                         measured             uncorrelated\n");
  measured("side to side", b.kinds.side_side, beside(b.uncorrelated.side_side));
  measured("side to end", b.kinds.side_end, beside(b.uncorrelated.side_end));
  measured("end to end", b.kinds.end_end, beside(b.uncorrelated.end_end));
  measured("mean position on side", b.side_position, beside(0.5) + "   (0 centre, 1 end)");
  measured("<|sin gamma|>", b.sin_gamma,
           fmt::format("{:8.4f}   (long isotropic rods; of all pairs {:.4f} are measured)",
                       isotropic_contact_sin_gamma, b.sin_gamma_of_all));
  fmt::print("  overlap / diameter     {:8.2e} -+ {:.1e}   largest {:.2e}\n", b.overlap.mean.mean,
             b.overlap.mean.error, b.overlap.largest);
  if (!b.walls.empty())
    fmt::print("    at walls             {:8.2e} -+ {:.1e}   largest {:.2e}\n",
               b.wall_overlap.mean.mean, b.wall_overlap.mean.error, b.wall_overlap.largest);
  print_forces(b, strong);
}

// All CSV files of a run.
class Tables {
 public:
  explicit Tables(const Options &o)
      : several_(o.beds.several()),
        bins_(o.bins),
        summary_(o.csv, summary_fields(), several_),
        numbers_(path(o, "numbers"), number_fields(), several_),
        positions_(path(o, "positions"), position_fields(), several_),
        overlaps_(path(o, "overlaps"), over_mean_fields("overlap"), several_),
        forces_(o.local.empty() && o.wall_local.empty() ? "" : path(o, "forces"),
                over_mean_fields("force"), several_),
        chains_(o.local.empty() ? "" : path(o, "chains"), chain_fields(), several_),
        contacts_(o.contacts_csv, contact_fields(), false)
  {
    if (several_ && !o.contacts_csv.empty())
      throw InputError(fmt::format("--contacts-csv: wanted with one DUMP file only (got {})",
                                   o.beds.dumps.size()));
  }

  void add(const Bed &bed, const BedContacts &b)
  {
    const auto sizes = [](const std::optional<MeasuredForces> &forces) {
      return forces ? forces->sizes : std::vector<double>{};
    };
    summary_.add(b);
    numbers_.add_all(number_rows(b));
    positions_.add_all(position_rows(b, bed.rods));
    overlaps_.add_all(over_mean_rows(b.step, b.overlaps, b.wall_overlaps, bins_));
    if (b.pair_forces || b.wall_forces)
      forces_.add_all(over_mean_rows(b.step, sizes(b.pair_forces), sizes(b.wall_forces), bins_));
    if (b.pair_forces) chains_.add_all(chain_rows(b));
    if (!several_) contacts_.add_all(contact_rows(b, bed.rods));
  }

  void finish()
  {
    if (several_) {
      fmt::print("means of the files\n");
      summary_.print_means();
    }
    summary_.finish();
    numbers_.finish();
    positions_.finish();
    overlaps_.finish();
    forces_.finish();
    chains_.finish();
    contacts_.finish();
  }

 private:
  static std::string path(const Options &options, const char *name)
  {
    return options.tables.empty() ? "" : fmt::format("{}_{}.csv", options.tables, name);
  }

  bool several_;
  std::size_t bins_;
  ResultTable<BedContacts> summary_;
  ResultTable<NumberRow> numbers_;
  ResultTable<BinRow> positions_, overlaps_, forces_;
  ResultTable<ChainRow> chains_;
  ResultTable<ContactRow> contacts_;
};

void run(const Options &options)
{
  const std::optional<Vessel> vessel = options.vessel.vessel();
  ForceFiles force_files(options);
  Tables tables(options);
  for_each_bed(options.beds, [&](const Bed &bed) {
    const BedContacts contacts = measure_contacts(
        bed, vessel, options.gap, force_files.at(bed, LocalKind::pairs),
        force_files.at(bed, LocalKind::walls), options.strong);
    tables.add(bed, contacts);
    if (options.beds.several()) fmt::print("{}: ", bed.frame.path);
    print_table(contacts, options.strong, vessel.has_value());
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
