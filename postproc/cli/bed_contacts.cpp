// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/bed_contacts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/numbers.h"
#include "measures/orientation_statistics.h"

namespace spherocylinder {
namespace {

// Pairs in doubt are looked for up to this gap, in diameters of the thickest rod, beyond the one
// asked for: where the digits leave more open, as of a rod far away, they tell nothing at all.
constexpr double kMostDoubt = 0.1;

ContactNumbers contact_numbers(const std::vector<std::uint32_t> &of_rods)
{
  ContactNumbers numbers{mean_of(of_rods, [](std::uint32_t k) { return static_cast<double>(k); }),
                         {}};
  numbers.rods_with.resize(*std::max_element(of_rods.begin(), of_rods.end()) + 1);
  for (const std::uint32_t k : of_rods) numbers.rods_with[k]++;
  return numbers;
}

// What lies on an end that two segments share counts once; then the contacts of whole fibres.
void count_once(const Bed &bed, BedContacts &found)
{
  const std::size_t before = found.pairs.size() + found.walls.size();
  leave_out_doubles(bed.rods, bed.fibres, found.pairs);
  leave_out_doubles(bed.fibres, found.walls);
  found.doubles = before - found.pairs.size() - found.walls.size();
  found.fibres = fibre_shapes(bed.rods, bed.fibres);
  found.of_fibres =
      fibre_contacts(bodies_of_rods(bed.fibres), bed.stretched.size(), found.pairs, found.walls);
}

void count_contacts(BedContacts &found)
{
  std::vector<std::uint32_t> of_rods = pair_contact_numbers(found.rods, found.pairs);
  found.between_rods = contact_numbers(of_rods);
  add_wall_contacts(of_rods, found.walls);
  found.with_walls = contact_numbers(of_rods);
  found.without_contact = part_of(found.with_walls.rods_with[0], found.rods);
}

void compare_with_uncorrelated(const Bed &bed, BedContacts &found)
{
  const std::vector<Rod> &rods = bed.rods;
  found.kinds = contact_kinds(rods, found.pairs, bed.fibres);
  found.uncorrelated = {none, none, none};
  found.sin_gamma_of_all = none;
  const std::vector<Vec3> axes = axes_of(rods);
  if (axes.size() < 2) return;
  const auto cylinder_over_diameter = [](const Rod &rod) {
    return rod.capsule.aspect_ratio() - 1.0;
  };
  found.sin_gamma_of_all = mean_sin_gamma(axes);
  found.uncorrelated = uncorrelated_contact_kinds(
      mean_of(bed.bodies(), cylinder_over_diameter).mean, found.sin_gamma_of_all);
}

MeasuredForces measured(std::vector<ContactForce> contacts)
{
  MeasuredForces forces{};
  forces.contacts = std::move(contacts);
  for (const ContactForce &contact : forces.contacts) {
    forces.sizes.push_back(norm(contact.force));
    forces.sum = forces.sum + contact.force;
  }
  forces.spread = spread_of(forces.sizes);
  return forces;
}

using RodPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

void find_chains(double strong, const RodPairs &touching, BedContacts &found)
{
  const std::vector<ContactForce> &forces = found.pair_forces->contacts;
  found.forces_apart =
      std::count_if(forces.begin(), forces.end(), [&](const ContactForce &contact) {
        return touching.count(std::minmax(contact.i, contact.j)) == 0;
      });
  found.chains = force_chains(found.rods, forces, strong);
  if (forces.empty()) return;
  std::size_t in_chains = 0;
  for (const std::size_t size : found.chains.sizes) in_chains += size;
  found.strong = part_of(found.chains.strong, forces.size());
  found.in_chains = part_of(in_chains, found.rods);
}

}  // namespace

BedContacts measure_contacts(const Bed &bed, const std::optional<Vessel> &vessel, double gap,
                             std::optional<std::vector<ContactForce>> pair_forces,
                             std::optional<std::vector<ContactForce>> wall_forces, double strong)
{
  const std::vector<Rod> &rods = bed.rods;
  BedContacts found{};
  found.step = bed.frame.step;
  found.rods = rods.size();
  const double largest_gap = gap * largest_diameter(rods);
  const std::vector<double> roundings = place_roundings(bed.frame, rods);
  const double doubt = std::min(2.0 * *std::max_element(roundings.begin(), roundings.end()),
                                kMostDoubt * largest_diameter(rods));
  std::vector<ClosePair> &pairs = found.pairs;
  pairs = close_pairs(rods, periodicity_of(bed.frame), largest_gap + doubt, largest_gap);
  const bool has_fibres = bed.fibres.are_there();
  if (has_fibres) leave_out_joints(rods, bed.fibres, pairs);
  found.doubtful_pairs = std::count_if(pairs.begin(), pairs.end(), [&](const ClosePair &pair) {
    return std::abs(pair.gap - largest_gap) < roundings[pair.i] + roundings[pair.j];
  });
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const ClosePair &pair) { return !(pair.gap < largest_gap); }),
              pairs.end());
  RodPairs touching;
  if (pair_forces)
    for (const ClosePair &pair : pairs) touching.insert({pair.i, pair.j});
  if (vessel) {
    need_rods_inside(bed, *vessel);
    found.walls = wall_contacts(rods, *vessel, largest_gap);
  }
  if (has_fibres) count_once(bed, found);
  count_contacts(found);
  compare_with_uncorrelated(bed, found);

  found.side_position = mean_of(side_positions(rods, pairs));
  std::vector<double> sines;
  for (const ClosePair &pair : pairs)
    if (!rods[pair.i].is_sphere() && !rods[pair.j].is_sphere()) sines.push_back(pair.sin_gamma);
  found.sin_gamma = mean_of(sines);
  found.overlaps = pair_overlaps(rods, pairs);
  found.wall_overlaps = wall_overlaps(rods, found.walls);
  found.overlap = spread_of(found.overlaps);
  found.wall_overlap = spread_of(found.wall_overlaps);

  found.strong = found.in_chains = {none, none};
  if (pair_forces) {
    found.pair_forces = measured(std::move(*pair_forces));
    find_chains(strong, touching, found);
  }
  if (wall_forces) found.wall_forces = measured(std::move(*wall_forces));
  return found;
}

}  // namespace spherocylinder
