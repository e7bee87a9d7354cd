// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/fibre_contacts.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>
#include <utility>

namespace spherocylinder {
namespace {

class Doubles {
 public:
  Doubles(const std::vector<Rod> &rods, const Fibres &fibres, const std::vector<ClosePair> &pairs)
      : rods_(rods), fibres_(fibres), pairs_(pairs)
  {
    for (std::size_t k = 0; k < pairs.size(); k++) of_rods_.emplace(key(pairs[k].i, pairs[k].j), k);
  }

  bool is_one(std::size_t pair) const
  {
    const ClosePair &p = pairs_[pair];
    return is_one(pair, p.i, p.s, p.j) || is_one(pair, p.j, p.t, p.i);
  }

 private:
  static constexpr int kNoEnd = -1;

  static std::uint64_t key(std::uint32_t a, std::uint32_t b)
  {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  // 0 tail, 1 head; a sphere's ends are one.
  int end_of(std::uint32_t rod, double position) const
  {
    if (rods_[rod].is_sphere() || !at_end(position, rods_[rod].capsule.segment.half_length))
      return kNoEnd;
    return position > 0.0 ? 1 : 0;
  }

  // Seen from the rod's side of the pair, where it touches at `position`.
  bool is_one(std::size_t pair, std::uint32_t rod, double position, std::uint32_t other) const
  {
    const int end = end_of(rod, position);
    if (end == kNoEnd) return false;
    const std::int32_t joint = fibres_.joints_of_rod[rod][end];
    if (joint == kNoJoint) return false;
    const std::uint32_t neighbour = end == 1 ? fibres_.joints[joint].j : fibres_.joints[joint].i;
    const auto [begin, last] = of_rods_.equal_range(key(neighbour, other));
    return std::any_of(begin, last, [&](const auto &found) {
      const ClosePair &there = pairs_[found.second];
      const int its_end = end_of(neighbour, there.i == neighbour ? there.s : there.t);
      return its_end != 1 - end || found.second < pair;
    });
  }

  const std::vector<Rod> &rods_;
  const Fibres &fibres_;
  const std::vector<ClosePair> &pairs_;
  std::unordered_multimap<std::uint64_t, std::size_t> of_rods_;
};

}  // namespace

void leave_out_joints(const std::vector<Rod> &rods, const Fibres &fibres,
                      std::vector<ClosePair> &pairs)
{
  pairs.erase(std::remove_if(
                  pairs.begin(), pairs.end(),
                  [&](const ClosePair &pair) { return fibres.never_touch(pair.i, pair.j, rods); }),
              pairs.end());
}

void leave_out_doubles(const std::vector<Rod> &rods, const Fibres &fibres,
                       std::vector<ClosePair> &pairs)
{
  const Doubles doubles(rods, fibres, pairs);
  std::vector<ClosePair> kept;
  for (std::size_t k = 0; k < pairs.size(); k++)
    if (!doubles.is_one(k)) kept.push_back(pairs[k]);
  pairs = std::move(kept);
}

void leave_out_doubles(const Fibres &fibres, std::vector<WallContact> &walls)
{
  std::set<std::pair<std::uint32_t, bool>> tails;  // and whether at the floor
  for (const WallContact &wall : walls)
    if (!wall.at_plus) tails.insert({wall.rod, wall.at_floor});
  const auto is_double = [&](const WallContact &wall) {
    const std::int32_t joint = fibres.joints_of_rod[wall.rod][1];
    return wall.at_plus && joint != kNoJoint &&
           tails.count({fibres.joints[joint].j, wall.at_floor}) > 0;
  };
  walls.erase(std::remove_if(walls.begin(), walls.end(), is_double), walls.end());
}

FibreContacts fibre_contacts(const std::vector<std::uint32_t> &body, std::size_t bodies,
                             const std::vector<ClosePair> &pairs,
                             const std::vector<WallContact> &walls)
{
  FibreContacts found{};
  std::vector<std::size_t> numbers(bodies, 0), touched(bodies, 0);
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
  for (const ClosePair &pair : pairs) {
    const std::uint32_t a = body[pair.i], b = body[pair.j];
    if (a == b) {
      found.with_itself++;
      continue;
    }
    found.between++;
    numbers[a]++;
    numbers[b]++;
    if (!touching.insert(std::minmax(a, b)).second) continue;
    touched[a]++;
    touched[b]++;
  }
  const auto as_number = [](std::size_t n) { return static_cast<double>(n); };
  found.per_fibre = mean_of(numbers, as_number);
  found.touched = mean_of(touched, as_number);
  for (const WallContact &wall : walls) numbers[body[wall.rod]]++;
  found.with_walls = mean_of(numbers, as_number);
  return found;
}

}  // namespace spherocylinder
