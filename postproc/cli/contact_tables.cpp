// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/contact_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/numbers.h"

namespace spherocylinder {
namespace {

constexpr std::size_t kPositionBins = 10;
constexpr double kLargestOverMean = 10.0;  // of the distributions of overlaps and forces

constexpr OverFiles kSame = OverFiles::Same, kSum = OverFiles::Sum, kMean = OverFiles::Mean,
                    kError = OverFiles::Error, kLargest = OverFiles::Largest;

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

// Beds without fibres beside others have none of their numbers.
template <class Number>
auto of_shapes(Number number)
{
  return [number](const BedContacts &b) {
    return b.fibres ? static_cast<double>(number(*b.fibres)) : none;
  };
}

template <class Number>
auto of_contacts(Number number)
{
  return [number](const BedContacts &b) {
    return b.of_fibres ? static_cast<double>(number(*b.of_fibres)) : none;
  };
}

template <class Mean>
auto mean_of_contacts(Mean mean)
{
  return [mean](const BedContacts &b) {
    return b.of_fibres ? mean(*b.of_fibres) : MeanWithError{none, none};
  };
}

void add_fibre_fields(Fields<BedContacts> &fields)
{
  using S = FibreShapes;
  using C = FibreContacts;
  fields.add("fibres", kSum, of_shapes([](const S &s) { return s.fibres; }));
  fields.add("segments", kSum, of_shapes([](const S &s) { return s.segments; }));
  fields.add("rings", kSum, of_shapes([](const S &s) { return s.rings; }));
  fields.add("parts_of_fibres", kSum, of_shapes([](const S &s) { return s.parts; }));
  fields.add("contacts_on_shared_ends_left_out", kSum,
             [](const BedContacts &b) { return b.doubles; });
  fields.add("fibre_contacts", kSum, of_contacts([](const C &c) { return c.between; }));
  fields.add("self_contacts", kSum, of_contacts([](const C &c) { return c.with_itself; }));
  fields.add_mean("contacts_per_fibre", mean_of_contacts([](const C &c) { return c.per_fibre; }));
  fields.add_mean("contacts_per_fibre_with_walls",
                  mean_of_contacts([](const C &c) { return c.with_walls; }));
  fields.add_mean("fibres_touched_per_fibre",
                  mean_of_contacts([](const C &c) { return c.touched; }));
}

}  // namespace

Fields<BedContacts> contact_summary_fields(bool with_fibres)
{
  using B = BedContacts;
  Fields<B> fields;
  fields.add("step", kSame, [](const B &b) { return b.step; });
  fields.add("rods", kSum, [](const B &b) { return b.rods; });
  fields.add("pair_contacts", kSum, [](const B &b) { return b.pairs.size(); });
  fields.add("doubtful_pairs", kSum, [](const B &b) { return b.doubtful_pairs; });
  fields.add("wall_contacts", kSum, [](const B &b) { return b.walls.size(); });
  fields.add_mean("contacts_per_rod", [](const B &b) { return b.between_rods.per_rod; });
  fields.add_mean("contacts_per_rod_with_walls", [](const B &b) { return b.with_walls.per_rod; });
  fields.add_mean("rods_without_contact_fraction", [](const B &b) { return b.without_contact; });
  fields.add_mean("side_side_fraction", [](const B &b) { return b.kinds.side_side; });
  fields.add_mean("side_end_fraction", [](const B &b) { return b.kinds.side_end; });
  fields.add_mean("end_end_fraction", [](const B &b) { return b.kinds.end_end; });
  fields.add("uncorrelated_side_side_fraction", kMean,
             [](const B &b) { return b.uncorrelated.side_side; });
  fields.add("uncorrelated_side_end_fraction", kMean,
             [](const B &b) { return b.uncorrelated.side_end; });
  fields.add("uncorrelated_end_end_fraction", kMean,
             [](const B &b) { return b.uncorrelated.end_end; });
  fields.add_mean("mean_side_position", [](const B &b) { return b.side_position; });
  fields.add_mean("contact_sin_gamma", [](const B &b) { return b.sin_gamma; });
  fields.add("all_pairs_sin_gamma", kMean, [](const B &b) { return b.sin_gamma_of_all; });
  fields.add_mean(
      "overlap_mean", [](const B &b) { return b.overlap.mean; }, "_diameters");
  fields.add("overlap_rms_diameters", kMean, [](const B &b) { return b.overlap.root_mean_square; });
  fields.add("overlap_max_diameters", kLargest, [](const B &b) { return b.overlap.largest; });
  fields.add_mean(
      "wall_overlap_mean", [](const B &b) { return b.wall_overlap.mean; }, "_diameters");
  fields.add("wall_overlap_max_diameters", kLargest,
             [](const B &b) { return b.wall_overlap.largest; });
  fields.add("pair_forces", kSum, [](const B &b) { return number_of(b.pair_forces); });
  fields.add_mean(
      "pair_force_mean", [](const B &b) { return spread_of(b.pair_forces).mean; }, "_N");
  fields.add("pair_force_rms_N", kMean,
             [](const B &b) { return spread_of(b.pair_forces).root_mean_square; });
  fields.add("pair_force_max_N", kLargest,
             [](const B &b) { return spread_of(b.pair_forces).largest; });
  fields.add("wall_forces", kSum, [](const B &b) { return number_of(b.wall_forces); });
  fields.add_mean(
      "wall_force_mean", [](const B &b) { return spread_of(b.wall_forces).mean; }, "_N");
  fields.add("wall_force_max_N", kLargest,
             [](const B &b) { return spread_of(b.wall_forces).largest; });
  fields.add("wall_force_sum_x_N", kMean, [](const B &b) { return sum_of(b.wall_forces).x; });
  fields.add("wall_force_sum_y_N", kMean, [](const B &b) { return sum_of(b.wall_forces).y; });
  fields.add("wall_force_sum_z_N", kMean, [](const B &b) { return sum_of(b.wall_forces).z; });
  fields.add_mean("strong_fraction", [](const B &b) { return b.strong; });
  fields.add("chains", kMean, number_of_chains).add("chains_error", kError, no_error);
  fields.add("largest_chain_rods", kMean, largest_chain);
  fields.add("largest_chain_rods_error", kError, no_error);
  fields.add_mean("rods_in_chains_fraction", [](const B &b) { return b.in_chains; });
  if (with_fibres) add_fibre_fields(fields);
  return fields;
}

Fields<NumberRow> number_fields()
{
  using R = NumberRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("contacts", kSame, [](const R &r) { return r.contacts; });
  fields.add("rods", kSum, [](const R &r) { return r.between_rods; });
  fields.add_mean("fraction", [](const R &r) { return part_of(r.between_rods, r.rods); });
  fields.add("rods_with_walls", kSum, [](const R &r) { return r.with_walls; });
  fields.add_mean("fraction_with_walls", [](const R &r) { return part_of(r.with_walls, r.rods); });
  return fields;
}

std::vector<NumberRow> number_rows(const BedContacts &b)
{
  std::vector<NumberRow> rows;
  for (std::size_t k = 0; k < b.with_walls.rods_with.size(); k++)
    rows.push_back(
        {b.step, k, b.between_rods.rods_that_have(k), b.with_walls.rods_with[k], b.rods});
  return rows;
}

Fields<BinRow> position_fields()
{
  using R = BinRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("position_low", kSame, [](const R &r) { return r.pairs.low; });
  fields.add("position_high", kSame, [](const R &r) { return r.pairs.high; });
  fields.add("count", kSum, [](const R &r) { return r.pairs.count; });
  fields.add_mean("fraction", [](const R &r) { return r.pairs.part; });
  fields.add_mean("density", [](const R &r) { return r.pairs.density(); });
  return fields;
}

std::vector<BinRow> position_rows(const BedContacts &b, const std::vector<Rod> &rods)
{
  std::vector<BinRow> rows;
  for (const HistogramBin &bin : histogram(side_positions(rods, b.pairs), 1.0, kPositionBins))
    rows.push_back({b.step, bin, {}});
  return rows;
}

Fields<BinRow> over_mean_fields(const std::string &what)
{
  using R = BinRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add(what + "_over_mean_low", kSame, [](const R &r) { return r.pairs.low; });
  fields.add(what + "_over_mean_high", kSame, [](const R &r) { return r.pairs.high; });
  fields.add("pair_count", kSum, [](const R &r) { return r.pairs.count; });
  fields.add_mean("pair_density", [](const R &r) { return r.pairs.density(); });
  fields.add("wall_count", kSum, [](const R &r) { return r.walls.count; });
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
  const auto of_pairs = histogram(pairs, kLargestOverMean, bins);
  const auto of_walls = histogram(walls, kLargestOverMean, bins);
  std::vector<BinRow> rows;
  for (std::size_t k = 0; k < bins; k++) rows.push_back({step, of_pairs[k], of_walls[k]});
  return rows;
}

Fields<ChainRow> chain_fields()
{
  using R = ChainRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("rods_low", kSame, [](const R &r) { return r.rods_low; });
  fields.add("rods_high", kSame, [](const R &r) { return r.rods_high; });
  fields.add_mean("chains", [](const R &r) {
    const double count = static_cast<double>(r.chains);
    return MeanWithError{count, std::sqrt(count + 1.0)};  // none is not certain either
  });
  return fields;
}

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

Fields<ContactRow> contact_fields()
{
  using R = ContactRow;
  Fields<R> fields;
  fields.add("step", kSame, [](const R &r) { return r.step; });
  fields.add("id_i", kSame, [](const R &r) { return r.id_i; });
  fields.add("id_j", kSame, [](const R &r) { return r.id_j; });
  fields.add("wall", kSame, [](const R &r) { return r.wall; });
  fields.add("position_i_m", kSame, [](const R &r) { return r.position_i; });
  fields.add("position_j_m", kSame, [](const R &r) { return r.position_j; });
  fields.add("gap_m", kSame, [](const R &r) { return r.gap; });
  fields.add("sin_gamma", kSame, [](const R &r) { return r.sin_gamma; });
  fields.add("force_N", kSame, [](const R &r) { return r.force; });
  fields.add("chain", kSame, [](const R &r) { return r.chain; });
  return fields;
}

std::vector<ContactRow> contact_rows(const BedContacts &b, const std::vector<Rod> &rods)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> forces;
  if (b.pair_forces)
    for (std::size_t k = 0; k < b.pair_forces->contacts.size(); k++) {
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

}  // namespace spherocylinder
