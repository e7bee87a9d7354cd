// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/contact_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"

namespace spherocylinder {

std::vector<WallContact> wall_contacts(const std::vector<Rod> &rods, const Vessel &vessel,
                                       double largest_gap)
{
  std::vector<WallContact> contacts;
  for (std::uint32_t k = 0; k < rods.size(); k++) {
    const Segment &segment = rods[k].capsule.segment;
    const double radius = rods[k].capsule.radius;
    for (const bool at_plus : {false, true}) {
      if (rods[k].is_sphere() && !at_plus) continue;
      const Vec3 end = segment.at(at_plus ? segment.half_length : -segment.half_length);
      const double above = end.z - radius - vessel.floor;
      const double inside = vessel.radius - radius - std::hypot(end.x - vessel.x, end.y - vessel.y);
      if (above < largest_gap) contacts.push_back({k, true, at_plus, above});
      if (inside < largest_gap) contacts.push_back({k, false, at_plus, inside});
    }
  }
  return contacts;
}

std::vector<std::uint32_t> pair_contact_numbers(std::size_t rods,
                                                const std::vector<ClosePair> &pairs)
{
  std::vector<std::uint32_t> numbers(rods, 0);
  for (const ClosePair &pair : pairs) {
    numbers[pair.i]++;
    numbers[pair.j]++;
  }
  return numbers;
}

void add_wall_contacts(std::vector<std::uint32_t> &numbers, const std::vector<WallContact> &walls)
{
  for (const WallContact &contact : walls) numbers[contact.rod]++;
}

// closest_points clamps to the half length itself, so that no tolerance is needed.
bool at_end(double position, double half_length) { return std::abs(position) >= half_length; }

CountedKinds contact_kinds(const std::vector<Rod> &rods, const std::vector<ClosePair> &pairs,
                           const Fibres &fibres)
{
  const auto is_end = [&](std::uint32_t rod, double position) {
    if (!at_end(position, rods[rod].capsule.segment.half_length)) return false;
    return !fibres.are_there() || fibres.joints_of_rod[rod][position > 0.0] == kNoJoint;
  };
  std::array<std::size_t, 3> counts{};  // by the number of ends
  for (const ClosePair &pair : pairs) counts[is_end(pair.i, pair.s) + is_end(pair.j, pair.t)]++;
  return {part_of(counts[0], pairs.size()), part_of(counts[1], pairs.size()),
          part_of(counts[2], pairs.size())};
}

ContactKinds uncorrelated_contact_kinds(double x, double mean_sin_gamma)
{
  const double sides = 2.0 * mean_sin_gamma * x * x, mixed = 4.0 * pi * x, ends = 4.0 * pi;
  const double all = sides + mixed + ends;
  return {sides / all, mixed / all, ends / all};
}

std::vector<double> side_positions(const std::vector<Rod> &rods,
                                   const std::vector<ClosePair> &pairs)
{
  std::vector<double> positions;
  const auto add = [&](double position, const Rod &rod) {
    const double half_length = rod.capsule.segment.half_length;
    if (!at_end(position, half_length)) positions.push_back(std::abs(position) / half_length);
  };
  for (const ClosePair &pair : pairs) {
    add(pair.s, rods[pair.i]);
    add(pair.t, rods[pair.j]);
  }
  return positions;
}

std::vector<double> pair_overlaps(const std::vector<Rod> &rods, const std::vector<ClosePair> &pairs)
{
  std::vector<double> overlaps;
  for (const ClosePair &pair : pairs)
    if (pair.gap < 0.0)
      overlaps.push_back(-pair.gap / (rods[pair.i].capsule.radius + rods[pair.j].capsule.radius));
  return overlaps;
}

std::vector<double> wall_overlaps(const std::vector<Rod> &rods,
                                  const std::vector<WallContact> &walls)
{
  std::vector<double> overlaps;
  for (const WallContact &contact : walls)
    if (contact.gap < 0.0)
      overlaps.push_back(-contact.gap / (2.0 * rods[contact.rod].capsule.radius));
  return overlaps;
}

Spread spread_of(const std::vector<double> &values)
{
  if (values.empty()) return {{none, none}, none, none};
  const MeanWithError squares = mean_of(values, [](double value) { return value * value; });
  return {mean_of(values), std::sqrt(squares.mean),
          *std::max_element(values.begin(), values.end())};
}

std::vector<HistogramBin> histogram(const std::vector<double> &values, double high,
                                    std::size_t bins)
{
  std::vector<HistogramBin> found(bins);
  const double width = high / static_cast<double>(bins);
  for (std::size_t k = 0; k < bins; k++)
    found[k] = {width * static_cast<double>(k), width * static_cast<double>(k + 1), 0, {}};
  for (const double value : values)
    if (value < high) found[std::min(bins - 1, static_cast<std::size_t>(value / width))].count++;
  for (HistogramBin &bin : found) bin.part = part_of(bin.count, values.size());
  return found;
}

}  // namespace spherocylinder
