// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/close_pairs.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "core/near_pairs.h"
#include "core/parallel.h"
#include "core/spread_contact.h"
#include "io/input_error.h"
#include "io/progress.h"

namespace spherocylinder {
namespace {

// Rods a block, at most. With fewer, more of the partners are in other blocks; with more, the cells
// do not stay in the caches. The time is flat between 1000 and 4000.
constexpr std::ptrdiff_t kMostInABlock = 2048;

// And no more than so many diameters of length, unless it is one rod: what a search needs of memory
// goes with them.
constexpr double kMostLengthOfABlock = 1e6;

// Room for the rounding of positions, in radii of the thickest rod.
constexpr double kSlack = 1e-6;

double component(const Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }

// How far a rod reaches from its centre in direction d (m).
double half_extent(const Capsule &rod, int d)
{
  return rod.segment.half_length * std::abs(component(rod.segment.axis, d)) + rod.radius;
}

using Image = std::array<int, 3>;  // sides of the box to be added in x, y and z

// A rod, or an image of it, where the search has it.
struct PlacedRod {
  std::uint32_t rod;
  Image image;  // of the rod as the frame has it
  Vec3 centre;  // m
};

using Bounds = std::array<std::array<double, 2>, 3>;  // lower and upper in x, y and z (m)

bool meet(const Bounds &a, const Bounds &b)
{
  for (int d = 0; d < 3; d++)
    if (a[d][0] > b[d][1] || b[d][0] > a[d][1]) return false;
  return true;
}

// The rods, inside the box where it is periodic, in blocks of neighbours.
class BlockSearch {
 public:
  BlockSearch(const std::vector<Rod> &rods, const Periodicity &box, double largest_gap,
              double contact_gap, double room)
      : rods_(rods),
        box_(box),
        largest_gap_(largest_gap),
        contact_gap_(contact_gap),
        searched_gap_(std::max(0.0, largest_gap) + room)
  {
    placed_.reserve(rods.size());
    for (std::uint32_t i = 0; i < rods.size(); i++) {
      const Vec3 &centre = rods[i].capsule.segment.centre;
      Image image{};
      for (int d = 0; d < 3; d++)
        if (box.side[d] > 0.0) image[d] = -sides_away(rods[i], d);
      placed_.push_back(moved({i, {}, centre}, image));
    }
    cut(placed_.begin(), placed_.end());
  }

  std::size_t blocks() const { return blocks_.size(); }

  // The pairs of a block's rods with each other, with those of later blocks, and with the images of
  // all rods on one side, those that come after {0, 0, 0}: so each pair comes once.
  std::vector<ClosePair> pairs_of(std::size_t block) const
  {
    std::vector<PlacedRod> placed(blocks_[block].begin, blocks_[block].end);
    const int owned = static_cast<int>(placed.size());
    const auto most = [&](int d) { return box_.side[d] > 0.0 ? 1 : 0; };
    for (int x = 0; x <= most(0); x++)
      for (int y = -most(1); y <= most(1); y++)
        for (int z = -most(2); z <= most(2); z++)
          if (const Image image{x, y, z}; image >= Image{}) add_partners(block, image, placed);

    std::vector<Capsule> capsules;
    capsules.reserve(placed.size());
    for (const PlacedRod &p : placed) {
      capsules.push_back(rods_[p.rod].capsule);
      capsules.back().segment.centre = p.centre;
    }
    NearPairs near;
    near.find(capsules, owned, searched_gap_);
    std::vector<Candidate> candidates;
    for (int i = 0; i < owned; i++)
      for (int k = near.first(i); k < near.first(i + 1); k++) {
        const PlacedRod &a = placed[i], &b = placed[near.partners()[k]];
        if (a.rod != b.rod) candidates.push_back(a.rod < b.rod ? candidate(a, b) : candidate(b, a));
      }
    return near_ones(candidates);
  }

 private:
  using Iterator = std::vector<PlacedRod>::iterator;

  struct Block {
    Iterator begin, end;
    Bounds bounds;  // of its rods, thicker by half the gap
  };

  struct Candidate {
    std::uint32_t i, j;
    Segment image_of_j;  // that is near i where the frame has it
  };

  int sides_away(const Rod &rod, int d) const
  {
    constexpr double kFurthest = 1e9;
    const double sides = std::floor(component(rod.capsule.segment.centre, d) / box_.side[d]);
    if (!(std::abs(sides) < kFurthest))
      throw InputError(fmt::format(
          "{}rod {} is {:g} sides of the periodic box away in {}, wanted less than {:g}",
          box_.where, rod.id, sides, "xyz"[d], kFurthest));
    return static_cast<int>(sides);
  }

  PlacedRod moved(const PlacedRod &p, const Image &by) const
  {
    const Vec3 shift{by[0] * box_.side[0], by[1] * box_.side[1], by[2] * box_.side[2]};
    return {p.rod, {p.image[0] + by[0], p.image[1] + by[1], p.image[2] + by[2]}, p.centre + shift};
  }

  // Of a rod that is thicker by half the gap.
  Bounds bounds_of(const PlacedRod &p) const
  {
    Bounds bounds;
    for (int d = 0; d < 3; d++) {
      const double half = half_extent(rods_[p.rod].capsule, d) + 0.5 * searched_gap_;
      bounds[d] = {component(p.centre, d) - half, component(p.centre, d) + half};
    }
    return bounds;
  }

  double length(Iterator begin, Iterator end) const
  {
    double sum = 0.0;
    for (auto p = begin; p != end; p++) sum += rods_[p->rod].capsule.aspect_ratio();
    return sum;
  }

  // Halves the space around the centres across its longest side until the halves are blocks. So a
  // rod far away ends up in a block of its own.
  void cut(Iterator begin, Iterator end)
  {
    const bool too_long = end - begin > 1 && length(begin, end) > kMostLengthOfABlock;
    if (end - begin > kMostInABlock || too_long) {
      int across = 0;
      double longest = 0.0, middle = 0.0;
      for (int d = 0; d < 3; d++) {
        const auto [low, high] = std::minmax_element(begin, end, [&](const auto &a, const auto &b) {
          return component(a.centre, d) < component(b.centre, d);
        });
        const double from = component(low->centre, d), to = component(high->centre, d);
        if (!(to - from > longest)) continue;
        across = d;
        longest = to - from;
        middle = from + 0.5 * longest;
      }
      const auto half = std::partition(
          begin, end, [&](const PlacedRod &p) { return component(p.centre, across) < middle; });
      if (half != begin && half != end) {  // else all centres are in one place
        cut(begin, half);
        cut(half, end);
        return;
      }
    }
    Block block{begin, end, bounds_of(*begin)};
    for (auto p = begin; p != end; p++) {
      const Bounds of_rod = bounds_of(*p);
      for (int d = 0; d < 3; d++) {
        block.bounds[d][0] = std::min(block.bounds[d][0], of_rod[d][0]);
        block.bounds[d][1] = std::max(block.bounds[d][1], of_rod[d][1]);
      }
    }
    blocks_.push_back(block);
  }

  // The rods of later blocks, of an image all rods, that may be near those of a block.
  void add_partners(std::size_t block, const Image &image, std::vector<PlacedRod> &placed) const
  {
    Bounds reached = blocks_[block].bounds;  // as seen from the image
    for (int d = 0; d < 3; d++)
      for (double &bound : reached[d]) bound -= image[d] * box_.side[d];
    for (std::size_t other = image == Image{} ? block + 1 : 0; other < blocks_.size(); other++)
      if (meet(reached, blocks_[other].bounds))
        for (auto p = blocks_[other].begin; p != blocks_[other].end; p++)
          if (meet(reached, bounds_of(*p))) placed.push_back(moved(*p, image));
  }

  // i comes first in the frame, so that a pair gives the same bits wherever it is found.
  Candidate candidate(const PlacedRod &i, const PlacedRod &j) const
  {
    Image between;
    for (int d = 0; d < 3; d++) between[d] = j.image[d] - i.image[d];
    Segment image = rods_[j.rod].capsule.segment;
    image.centre = moved({j.rod, {}, image.centre}, between).centre;
    return {i.rod, j.rod, image};
  }

  // Those of the candidates that are near, worked out a batch at a time.
  std::vector<ClosePair> near_ones(const std::vector<Candidate> &candidates) const
  {
    std::vector<ClosePair> found;
    SegmentPairs batch{};
    for (std::size_t start = 0; start < candidates.size(); start += kBatch) {
      const Candidate *of_batch = &candidates[start];
      const int count = static_cast<int>(std::min<std::size_t>(kBatch, candidates.size() - start));
      for (int k = 0; k < count; k++) {
        const auto &[i, j, image] = of_batch[k];
        const double reach = rods_[i].capsule.radius + rods_[j].capsule.radius + contact_gap_;
        batch.set(k, rods_[i].capsule.segment, image, reach);
      }
      closest_points(batch);
      for (int k = 0; k < count; k++) {
        const auto &[i, j, image] = of_batch[k];
        const Capsule &rod_i = rods_[i].capsule, &rod_j = rods_[j].capsule;
        if (batch.uncertain[k] != 0.0) make_certain(batch, k, rod_i.segment, image);
        ClosestPoints points = batch.get(k);
        const double distance = std::sqrt(points.distance_squared);
        const double gap = distance - (rod_i.radius + rod_j.radius);
        if (!(gap < largest_gap_)) continue;
        const Vec3 normal = distance > 0.0 ? (1.0 / distance) * points.delta : Vec3{0.0, 0.0, 0.0};
        // spread_contact itself decides whether the rods are parallel enough.
        if (batch.nearly_parallel[k] != 0.0 || batch.uncertain[k] != 0.0)
          points = spread_contact(rod_i.segment, image, batch.reach[k], points).points;
        found.push_back(
            {i, j, points.s, points.t, gap, normal, norm(cross(rod_i.segment.axis, image.axis))});
      }
    }
    return found;
  }

  const std::vector<Rod> &rods_;
  const Periodicity &box_;
  double largest_gap_, contact_gap_, searched_gap_;  // m
  std::vector<PlacedRod> placed_;                    // block after block
  std::vector<Block> blocks_;
};

}  // namespace

Periodicity periodicity_of(const DumpFrame &frame)
{
  Periodicity box;
  box.where = fmt::format("{}: step {}: ", frame.path, frame.step);
  for (int d = 0; d < 3; d++) {
    if (!frame.periodic[d]) continue;
    if (frame.box_is_tilted)
      throw InputError(
          fmt::format("{}the periodic box is tilted, wanted an upright one", box.where));
    box.side[d] = frame.box[d][1] - frame.box[d][0];
    if (!(box.side[d] > 0.0))
      throw InputError(fmt::format("{}the periodic box is {} m wide in {}, wanted > 0", box.where,
                                   box.side[d], "xyz"[d]));
  }
  return box;
}

std::vector<ClosePair> close_pairs(const std::vector<Rod> &rods, const Periodicity &box,
                                   double largest_gap, std::optional<double> contact_gap)
{
  if (rods.empty()) return {};
  if (rods.size() > UINT32_MAX) throw InputError("more than 2^32 rods, wanted fewer");
  double largest_radius = 0.0;
  std::array<double, 3> least{};
  for (const Rod &rod : rods) {
    largest_radius = std::max(largest_radius, rod.capsule.radius);
    for (int d = 0; d < 3; d++)
      least[d] = std::max(least[d], 2.0 * half_extent(rod.capsule, d) + largest_gap);
  }
  for (int d = 0; d < 3; d++)
    if (box.side[d] > 0.0 && box.side[d] < least[d])
      throw InputError(
          fmt::format("{}the periodic box is {:.6g} m wide in {}, wanted at least {:.6g} m "
                      "for these rods",
                      box.where, box.side[d], "xyz"[d], least[d]));

  const BlockSearch search(rods, box, largest_gap, contact_gap.value_or(largest_gap),
                           kSlack * largest_radius);
  std::vector<std::vector<ClosePair>> found(search.blocks());
  Progress progress("finding contacts");
  std::mutex screen;
  std::size_t done = 0;
  for_each_piece(search.blocks(), 1, [&](std::size_t block, std::size_t) {
    found[block] = search.pairs_of(block);
    const std::lock_guard lock(screen);
    progress.show(static_cast<double>(++done) / static_cast<double>(search.blocks()));
  });

  std::vector<ClosePair> pairs;
  for (std::vector<ClosePair> &part : found) {
    pairs.insert(pairs.end(), part.begin(), part.end());
    part = {};
  }
  return pairs;
}

}  // namespace spherocylinder
