// SPDX-License-Identifier: GPL-2.0-or-later
// rod_contacts: where the rods of a bed touch, and what the contacts carry. docs/rod_contacts.md
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/bed_contacts.h"
#include "cli/beds.h"
#include "cli/contact_tables.h"
#include "io/input_error.h"
#include "io/text.h"

using namespace spherocylinder;

namespace {

struct Options {
  BedFiles beds;
  VesselOptions vessel;
  double gap = 0.0;  // diameters of the thickest rod
  std::vector<std::string> local, wall_local;
  std::string local_keywords = kDefaultLocalKeywords, wall_local_keywords = kDefaultLocalKeywords;
  double strong = 1.0;
  std::size_t bins = 40;
  std::string csv, tables, contacts_csv;
};

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
    const bool of_pairs = kind == LocalKind::Pairs;
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

// Mean, its error and the largest of so many values, if there are any.
void print_spread(const char *name, std::size_t count, const Spread &spread, const char *unit)
{
  fmt::print("  {:<22} {:8}", name, count);
  if (count > 0)
    fmt::print("             mean {:.4g} -+ {}{}, largest {:.4g}{}", spread.mean.mean,
               std::isnan(spread.mean.error) ? "-" : fmt::format("{:.2g}", spread.mean.error), unit,
               spread.largest, unit);
  fmt::print("\n");
}

void print_forces(const BedContacts &b, double strong)
{
  if (b.pair_forces) {
    print_spread("forces between rods", b.pair_forces->sizes.size(), b.pair_forces->spread, " N");
    if (b.forces_apart > 0)
      fmt::print("  {:<22} {:8}             of them between rods that the dump shows apart\n", "",
                 b.forces_apart);
    fmt::print(
        "  {:<22} {:8}             above {:.3g} of the mean; {} chains, the largest of {} rods\n",
        "strong contacts", b.chains.strong, strong, b.chains.sizes.size(),
        b.chains.sizes.empty() ? 0 : b.chains.sizes[0]);
  }
  if (b.wall_forces) {
    print_spread("forces of walls", b.wall_forces->sizes.size(), b.wall_forces->spread, " N");
    const Vec3 &total = b.wall_forces->sum;
    fmt::print("  {:<22} {:8}             ({:.6g}, {:.6g}, {:.6g}) N\n", "  together", "", total.x,
               total.y, total.z);
  }
}

void print_table(const BedContacts &b, double strong, bool with_walls)
{
  const auto measured = [](const char *name, const MeanWithError &value, auto... rest) {
    fmt::print("  {:<22} {} -+ {}   {}\n", name, cell(value.mean, 8, 4), cell(value.error, 6, 4),
               rest...);
  };
  fmt::print("step {}: {} rods\n", b.step, b.rods);
  if (b.fibres) fmt::print("  {}\n", fibre_count_line(*b.fibres));
  if (b.of_fibres) {
    measured("contacts a fibre", b.of_fibres->per_fibre,
             fmt::format("({} between fibres, {} of fibres with themselves)", b.of_fibres->between,
                         b.of_fibres->with_itself));
    if (with_walls) measured("  with walls", b.of_fibres->with_walls, "");
    measured("fibres touched", b.of_fibres->touched, "by a fibre");
  }
  measured("contacts a rod", b.between_rods.per_rod,
           fmt::format("({} between rods)", b.pairs.size()));
  if (b.doubtful_pairs > 0)
    fmt::print(
        "    doubtful             {:8}             pairs so near to touching that the dump's "
        "digits do not tell\n",
        b.doubtful_pairs);
  if (with_walls)
    measured("  with walls", b.with_walls.per_rod, fmt::format("({} at walls)", b.walls.size()));
  measured("rods without contact", b.without_contact, "of all rods");
  if (b.pairs.empty()) return print_forces(b, strong);
  const auto beside = [](double uncorrelated) { return cell(uncorrelated, 8, 4); };
  fmt::print("                         measured             uncorrelated\n");
  measured("side to side", b.kinds.side_side, beside(b.uncorrelated.side_side));
  measured("side to end", b.kinds.side_end, beside(b.uncorrelated.side_end));
  measured("end to end", b.kinds.end_end, beside(b.uncorrelated.end_end));
  measured("mean position on side", b.side_position, beside(0.5) + "   (0 centre, 1 end)");
  measured("<|sin gamma|>", b.sin_gamma,
           fmt::format("{:8.4f}   (long isotropic rods; of all pairs {} are measured)",
                       kIsotropicContactSinGamma, cell(b.sin_gamma_of_all, 0, 4)));
  print_spread("overlap / diameter", b.overlaps.size(), b.overlap, "");
  if (!b.walls.empty()) print_spread("  at walls", b.wall_overlaps.size(), b.wall_overlap, "");
  print_forces(b, strong);
}

// All CSV files of a run.
class Tables {
 public:
  explicit Tables(const Options &o)
      : several_(o.beds.several()),
        has_contacts_(!o.contacts_csv.empty()),
        bins_(o.bins),
        summary_csv_(o.csv),
        numbers_(path(o, "numbers"), number_fields(), several_, MissingRows::Zero),
        positions_(path(o, "positions"), position_fields(), several_),
        overlaps_(path(o, "overlaps"), over_mean_fields("overlap"), several_),
        forces_(o.local.empty() && o.wall_local.empty() ? "" : path(o, "forces"),
                over_mean_fields("force"), several_),
        chains_(o.local.empty() ? "" : path(o, "chains"), chain_fields(), several_,
                MissingRows::Zero),
        contacts_(o.contacts_csv, contact_fields(), false)
  {
    if (several_ && has_contacts_)
      throw InputError(fmt::format("--contacts-csv: wanted with one DUMP file only (got {})",
                                   o.beds.dumps.size()));
  }

  void add(const Bed &bed, const BedContacts &b)
  {
    const auto sizes = [](const std::optional<MeasuredForces> &forces) {
      return forces ? forces->sizes : std::vector<double>{};
    };
    if (!summary_)
      summary_.emplace(summary_csv_, contact_summary_fields(b.fibres.has_value()), several_);
    summary_->add(b);
    numbers_.add_all(number_rows(b));
    positions_.add_all(position_rows(b, bed.rods));
    overlaps_.add_all(over_mean_rows(b.step, b.overlaps, b.wall_overlaps, bins_));
    if (b.pair_forces || b.wall_forces)
      forces_.add_all(over_mean_rows(b.step, sizes(b.pair_forces), sizes(b.wall_forces), bins_));
    if (b.pair_forces) chains_.add_all(chain_rows(b));
    if (has_contacts_) contacts_.add_all(contact_rows(b, bed.rods));  // many: only if asked for
  }

  void finish()
  {
    if (several_) {
      fmt::print("means of the files\n");
      summary_->print_means();
    }
    summary_->finish();
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

  bool several_, has_contacts_;
  std::size_t bins_;
  std::string summary_csv_;
  std::optional<ResultTable<BedContacts>> summary_;  // once it is known whether there are fibres
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
    const BedContacts contacts =
        measure_contacts(bed, vessel, options.gap, force_files.at(bed, LocalKind::Pairs),
                         force_files.at(bed, LocalKind::Walls), options.strong);
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
      "Example: rod_contacts bed.dump --vessel-radius 0.305 --csv contacts.csv --tables contacts\n"
      "         rod_contacts heap.dump --local heap.pairs --local-keywords \"id force\" --strong "
      "2\n"
      "         rod_contacts seed1.dump.gz seed2.dump.gz --vessel-radius 0.305 --csv means.csv");
  add_bed_options(app, options.beds);
  add_vessel_options(app, options.vessel);
  app.add_option("--gap", options.gap,
                 "gap of the surfaces below which rods touch, in diameters of the thickest rod")
      ->check(number_between(0.0, 10.0))
      ->capture_default_str();
  CLI::Option *local =
      app.add_option("--local", options.local,
                     "'dump local' file of compute pair/gran/local, one for each DUMP")
          ->allow_extra_args(false);
  app.add_option("--local-keywords", options.local_keywords, "keywords of that compute")
      ->needs(local)
      ->capture_default_str();
  CLI::Option *wall_local =
      app.add_option("--wall-local", options.wall_local,
                     "'dump local' file of compute wall/gran/local, one for each DUMP")
          ->allow_extra_args(false);
  app.add_option("--wall-local-keywords", options.wall_local_keywords, "keywords of that compute")
      ->needs(wall_local)
      ->capture_default_str();
  app.add_option("--strong", options.strong,
                 "a contact is part of a force chain above so many times the mean force")
      ->needs(local)
      ->check(positive_number())
      ->capture_default_str();
  CLI::Option *tables =
      app.add_option("--tables", options.tables,
                     "write the distributions to PREFIX_numbers.csv, PREFIX_positions.csv ...");
  app.add_option("--bins", options.bins, "bins of the distributions of overlaps and forces")
      ->needs(tables)
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--csv", options.csv, "write the numbers to this CSV file");
  app.add_option("--contacts-csv", options.contacts_csv, "write each contact to this CSV file");
  return run_tool(app, argc, argv, [&] { run(options); });
}
