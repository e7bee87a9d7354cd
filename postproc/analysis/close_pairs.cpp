// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/close_pairs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "analysis/input_error.h"
#include "analysis/parallel.h"
#include "analysis/progress.h"
#include "core/closest_points_batch.h"
#include "core/spread_contact.h"

namespace spherocylinder {
namespace {

// Length of a piece over the largest diameter: shorter ones make more of them, longer ones more
// pairs that are not near. The time is flat between 4 and 8.
constexpr double piece_in_diameters = 5.0;

// Relative room for the rounding of positions; far above it, far below a piece.
constexpr double slack = 1e-9;

// Cells a direction: three such numbers make a key of 60 bits.
constexpr std::int64_t most_cells = std::int64_t{1} << 20;

constexpr std::size_t no_cell = static_cast<std::size_t>(-1);

double component(const Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }

struct Piece {
  Vec3 middle;  // from the lower corner of the grid, inside the box where it is periodic (m)
  std::array<int, 3> wrap;  // sides of the box that were added to get it there
  std::uint32_t rod, number;
};

// Equal pieces of an axis.
struct Pieces {
  double half_length, length;
  std::uint32_t count;

  Pieces(const Segment &segment, double longest)
      : half_length(segment.half_length),
        length(0.0),
        count(static_cast<std::uint32_t>(
            std::max(1.0, std::ceil(2.0 * segment.half_length / longest))))
  {
    length = 2.0 * half_length / count;
  }

  double middle(std::uint32_t k) const { return (k + 0.5) * length - half_length; }
  std::uint32_t holding(double s) const
  {
    const double k = length > 0.0 ? std::floor((s + half_length) / length) : 0.0;
    return static_cast<std::uint32_t>(std::clamp(k, 0.0, count - 1.0));
  }
};

// The pieces of all rods in cells, cells in order of z, y, x. Only cells that hold something exist,
// so that a rod far away costs nothing.
class PieceGrid {
 public:
  PieceGrid(const std::vector<Rod> &rods, const Periodicity &box, double reach, double longest)
      : box_(box)
  {
    cut(rods, longest);
    shape(reach + longest);
    sort();
  }

  std::size_t cells() const { return keys_.size(); }
  const Piece *begin(std::size_t cell) const { return pieces_.data() + starts_[cell]; }
  const Piece *end(std::size_t cell) const { return pieces_.data() + starts_[cell + 1]; }

  // Half of a cell's 26 neighbours, so that each pair of cells comes once, and the number of sides
  // of the box to be added to their pieces.
  template <class Work>
  void for_half_of_neighbours(std::size_t cell, Work work) const
  {
    const std::array<std::int64_t, 3> at = unpack(keys_[cell]);
    for (int dz = 0; dz <= 1; ++dz)
      for (int dy = dz == 0 ? 0 : -1; dy <= 1; ++dy)
        for (int dx = dz == 0 && dy == 0 ? 1 : -1; dx <= 1; ++dx) {
          std::array<std::int64_t, 3> there{at[0] + dx, at[1] + dy, at[2] + dz};
          std::array<int, 3> sides{};
          bool outside = false;
          for (int d = 0; d < 3; ++d) {
            if (there[d] >= 0 && there[d] < count_[d]) continue;
            if (box_.side[d] > 0.0) {
              sides[d] = there[d] < 0 ? -1 : 1;
              there[d] = there[d] < 0 ? count_[d] - 1 : 0;
            } else {
              outside = true;
            }
          }
          if (outside) continue;
          const std::size_t found = find(pack(there), cell);
          if (found != no_cell) work(found, sides);
        }
  }

 private:
  using Key = std::uint64_t;

  static Key pack(const std::array<std::int64_t, 3> &at)
  {
    return static_cast<Key>((at[2] * most_cells + at[1]) * most_cells + at[0]);
  }

  static std::array<std::int64_t, 3> unpack(Key key)
  {
    const auto k = static_cast<std::int64_t>(key);
    return {k % most_cells, k / most_cells % most_cells, k / most_cells / most_cells};
  }

  // Of a key near that of the cell `hint`: by steps that double, then by halves.
  std::size_t find(Key key, std::size_t hint) const
  {
    std::size_t low = 0, high = keys_.size();
    if (keys_[hint] < key) {
      low = hint + 1;
      for (std::size_t step = 1; low + step < keys_.size(); step *= 2) {
        if (keys_[low + step] >= key) {
          high = low + step + 1;
          break;
        }
        low += step;
      }
    } else {
      high = hint + 1;
      for (std::size_t step = 1; step < high; step *= 2) {
        if (keys_[high - 1 - step] < key) {
          low = high - 1 - step;
          break;
        }
        high -= step;
      }
    }
    const auto found = std::lower_bound(keys_.begin() + low, keys_.begin() + high, key);
    return found != keys_.end() && *found == key ? found - keys_.begin() : no_cell;
  }

  void cut(const std::vector<Rod> &rods, double longest)
  {
    if (rods.size() > UINT32_MAX) throw InputError("more than 2^32 rods, wanted fewer");
    for (std::uint32_t i = 0; i < rods.size(); ++i) {
      const Segment &segment = rods[i].capsule.segment;
      const Pieces pieces(segment, longest);
      for (std::uint32_t k = 0; k < pieces.count; ++k)
        pieces_.push_back({segment.at(pieces.middle(k)), {0, 0, 0}, i, k});
    }
  }

  // Places the corner, wraps the pieces and chooses the number of cells.
  void shape(double smallest_cell)
  {
    for (int d = 0; d < 3; ++d) {
      double low = 0.0, high = 0.0;
      for (const Piece &piece : pieces_) {
        const double x = component(piece.middle, d);
        low = &piece == pieces_.data() ? x : std::min(low, x);
        high = &piece == pieces_.data() ? x : std::max(high, x);
      }
      const double side = box_.side[d];
      const double extent = side > 0.0 ? side : high - low;
      count_[d] = std::clamp<std::int64_t>(
          static_cast<std::int64_t>(
              std::min(static_cast<double>(most_cells), extent / (smallest_cell * (1.0 + slack)))),
          1, most_cells);
      cell_[d] = extent / static_cast<double>(count_[d]);
      for (Piece &piece : pieces_) {
        double *middle = d == 0 ? &piece.middle.x : d == 1 ? &piece.middle.y : &piece.middle.z;
        *middle -= low;
        if (side == 0.0) continue;
        piece.wrap[d] = -static_cast<int>(std::floor(*middle / side));
        *middle += piece.wrap[d] * side;
      }
    }
  }

  Key key_of(const Piece &piece) const
  {
    std::array<std::int64_t, 3> at;
    for (int d = 0; d < 3; ++d) {
      const double k = cell_[d] > 0.0 ? std::floor(component(piece.middle, d) / cell_[d]) : 0.0;
      at[d] = std::clamp<std::int64_t>(static_cast<std::int64_t>(k), 0, count_[d] - 1);
    }
    return pack(at);
  }

  void sort()
  {
    std::vector<std::pair<Key, std::uint32_t>> order(pieces_.size());
    for (std::uint32_t k = 0; k < pieces_.size(); ++k) order[k] = {key_of(pieces_[k]), k};
    std::sort(order.begin(), order.end());
    std::vector<Piece> sorted(pieces_.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      sorted[k] = pieces_[order[k].second];
      if (k > 0 && order[k].first == order[k - 1].first) continue;
      keys_.push_back(order[k].first);
      starts_.push_back(k);
    }
    starts_.push_back(order.size());
    pieces_ = std::move(sorted);
  }

  Periodicity box_;
  std::vector<Piece> pieces_;
  std::vector<Key> keys_;            // of the cells that hold something, rising
  std::vector<std::size_t> starts_;  // first piece of each, and the end
  std::array<std::int64_t, 3> count_{};
  std::array<double, 3> cell_{};  // m
};

// Pairs of pieces whose middles are near, worked out a batch at a time.
class PairFinder {
 public:
  PairFinder(const std::vector<Rod> &rods, const Periodicity &box, double reach, double longest,
             double largest_gap)
      : rods_(rods),
        box_(box),
        longest_(longest),
        largest_gap_(largest_gap),
        near_squared_((reach + longest) * (reach + longest) * (1.0 + slack))
  {
  }

  // `sides` of the box are to be added to q.
  void consider(const Piece &p, const Piece &q, const std::array<int, 3> &sides)
  {
    // First what needs no look at the rods, which lie scattered in memory.
    if (norm_squared(q.middle + times_side(sides) - p.middle) > near_squared_) return;
    if (p.rod == q.rod) return;
    // The rod that comes first in the frame is i, so that a pair of rods gives the same bits
    // wherever its pieces meet.
    const bool in_order = p.rod < q.rod;
    const Piece &a = in_order ? p : q, &b = in_order ? q : p;
    const Capsule &i = rods_[a.rod].capsule, &j = rods_[b.rod].capsule;
    std::array<int, 3> image;  // of j beside i as the frame has them
    for (int d = 0; d < 3; ++d)
      image[d] = (in_order ? sides[d] : -sides[d]) + b.wrap[d] - a.wrap[d];
    Segment moved = j.segment;
    moved.centre = moved.centre + times_side(image);
    pairs_.set(waiting_, i.segment, moved, i.radius + j.radius + largest_gap_);
    candidates_[waiting_] = {a.rod, b.rod, a.number, b.number, moved.centre};
    if (++waiting_ == kBatch) finish();
  }

  void finish()
  {
    if (waiting_ == 0) return;
    closest_points(pairs_);
    for (int k = 0; k < waiting_; ++k) keep(k);
    waiting_ = 0;
  }

  std::vector<ClosePair> found;

 private:
  struct Candidate {
    std::uint32_t i, j, piece_i, piece_j;
    Vec3 centre_j;  // of the image of j
  };

  Vec3 times_side(const std::array<int, 3> &sides) const
  {
    return {sides[0] * box_.side[0], sides[1] * box_.side[1], sides[2] * box_.side[2]};
  }

  void keep(int k)
  {
    const Candidate &c = candidates_[k];
    const Capsule &i = rods_[c.i].capsule, &j = rods_[c.j].capsule;
    const Segment image_of_j{c.centre_j, j.segment.axis, j.segment.half_length};
    const ClosestPoints points = pairs_.uncertain[k] != 0.0 ? closest_points(i.segment, image_of_j)
                                                            : pairs_.get(k);
    const double distance = std::sqrt(points.distance_squared);
    const double gap = distance - (i.radius + j.radius);
    if (!(gap < largest_gap_)) return;
    if (Pieces(i.segment, longest_).holding(points.s) != c.piece_i ||
        Pieces(j.segment, longest_).holding(points.t) != c.piece_j)
      return;
    const Vec3 normal = distance > 0.0 ? (1.0 / distance) * points.delta : Vec3{0.0, 0.0, 0.0};
    // spread_contact itself decides whether the rods are parallel enough.
    const ClosestPoints touching =
        pairs_.nearly_parallel[k] != 0.0 || pairs_.uncertain[k] != 0.0
            ? spread_contact(i.segment, image_of_j, i.radius + j.radius + largest_gap_, points)
                  .points
            : points;
    found.push_back({c.i, c.j, touching.s, touching.t, gap, normal,
                     norm(cross(i.segment.axis, j.segment.axis))});
  }

  const std::vector<Rod> &rods_;
  const Periodicity &box_;
  double longest_, largest_gap_, near_squared_;
  SegmentPairs pairs_{};
  Candidate candidates_[kBatch];
  int waiting_ = 0;
};

void search(const PieceGrid &grid, std::size_t first, std::size_t last, PairFinder &finder)
{
  constexpr std::array<int, 3> here{};
  for (std::size_t cell = first; cell < last; ++cell) {
    const Piece *end = grid.end(cell);
    for (const Piece *p = grid.begin(cell); p != end; ++p)
      for (const Piece *q = p + 1; q != end; ++q) finder.consider(*p, *q, here);
    grid.for_half_of_neighbours(cell, [&](std::size_t other, const std::array<int, 3> &sides) {
      for (const Piece *p = grid.begin(cell); p != end; ++p)
        for (const Piece *q = grid.begin(other); q != grid.end(other); ++q)
          finder.consider(*p, *q, sides);
    });
  }
  finder.finish();
}

// Of a single rod in one direction (m).
double largest_extent(const std::vector<Rod> &rods, int d)
{
  double largest = 0.0;
  for (const Rod &rod : rods) {
    const Segment &segment = rod.capsule.segment;
    const double half = segment.half_length * std::abs(component(segment.axis, d));
    largest = std::max(largest, 2.0 * (half + rod.capsule.radius));
  }
  return largest;
}

}  // namespace

Periodicity periodicity_of(const DumpFrame &frame)
{
  Periodicity box;
  for (int d = 0; d < 3; ++d) {
    if (!frame.periodic[d]) continue;
    if (frame.box_is_tilted)
      throw InputError(fmt::format("{}: step {}: the periodic box is tilted, wanted an upright one",
                                   frame.path, frame.step));
    box.side[d] = frame.box[d][1] - frame.box[d][0];
    if (!(box.side[d] > 0.0))
      throw InputError(fmt::format("{}: step {}: the periodic box is {} m wide in {}, wanted > 0",
                                   frame.path, frame.step, box.side[d], "xyz"[d]));
  }
  return box;
}

std::vector<ClosePair> close_pairs(const std::vector<Rod> &rods, const Periodicity &box,
                                   double largest_gap)
{
  if (rods.empty()) return {};
  double largest_radius = 0.0;
  for (const Rod &rod : rods) largest_radius = std::max(largest_radius, rod.capsule.radius);
  const double reach = 2.0 * largest_radius + largest_gap;
  const double longest = piece_in_diameters * 2.0 * largest_radius;
  // A piece and the reach are then shorter than the box together, so that a single cell across it,
  // its own neighbour on both sides, will do: the shifts tell the images apart.
  for (int d = 0; d < 3; ++d) {
    const double side = box.side[d];
    const double least = largest_extent(rods, d) + largest_gap;
    if (side > 0.0 && side < least)
      throw InputError(
          fmt::format("the periodic box is {:.6g} m wide in {}, wanted at least {:.6g} m "
                      "for these rods",
                      side, "xyz"[d], least));
  }

  const PieceGrid grid(rods, box, reach, longest);
  // Parts of so many cells, whose results follow each other in order.
  constexpr std::size_t grain = 4096;
  std::vector<std::vector<ClosePair>> found((grid.cells() + grain - 1) / grain);
  std::atomic<std::size_t> cells_done{0};
  Progress progress("finding contacts");
  std::mutex screen;
  for_each_piece(grid.cells(), grain, [&](std::size_t first, std::size_t last) {
    PairFinder finder(rods, box, reach, longest, largest_gap);
    search(grid, first, last, finder);
    found[first / grain] = std::move(finder.found);
    cells_done += last - first;
    const std::lock_guard lock(screen);
    progress.show(static_cast<double>(cells_done) / static_cast<double>(grid.cells()));
  });

  std::vector<ClosePair> pairs;
  for (std::vector<ClosePair> &part : found) {
    pairs.insert(pairs.end(), part.begin(), part.end());
    part = {};
  }
  return pairs;
}

}  // namespace spherocylinder
