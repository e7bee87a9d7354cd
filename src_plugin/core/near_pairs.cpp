// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spherocylinder {

namespace {

// Buckets a cube on an axis: each is entered in some four cells of its own.
constexpr double kBucketsPerCube = 4.0;
// Cells in a dimension: so that their numbers are whole numbers, whatever the space between the rods.
constexpr double kMostCells = 1e6;
constexpr int kNone = -1, kGone = -1;
// Look-ups are numbered; in one search there are no more than half of these.
constexpr int kMostLookUps = 1 << 30;

Vec3 smaller(const Vec3 &a, const Vec3 &b)
{
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Vec3 larger(const Vec3 &a, const Vec3 &b)
{
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

// The rows of cells, of those in the grid, that a cube reaches in one dimension; none if last < first.
struct Rows {
  int first, last;

  Rows(int a, int b) : first(a), last(b) {}
  Rows(double place, double half, int cells)
      : first(row(place - half, cells)), last(place + half < 0.0 ? -1 : row(place + half, cells))
  {
    last = std::min(last, cells - 1);
  }
  bool has(int k) const { return first <= k && k <= last; }

 private:
  static int row(double place, int cells)
  {
    return place < 0.0 ? 0 : place < cells ? static_cast<int>(place) : cells;
  }
};

Vec3 absolute(const Vec3 &a) { return {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}; }

}  // namespace

int NearPairs::cubes_on(const Segment &segment) const
{
  return std::max(1, static_cast<int>(std::ceil(2.0 * segment.half_length / spacing_)));
}

// Of its tube, from the centre.
Vec3 NearPairs::extent_of(const Capsule &rod) const
{
  const double around = rod.radius + 0.5 * (gap_ + spacing_);
  return rod.segment.half_length * absolute(rod.segment.axis) + Vec3{around, around, around};
}

bool NearPairs::lies_in_grid(const Capsule &rod) const
{
  const Vec3 extent = extent_of(rod);
  const Vec3 low = rod.segment.centre - extent, high = rod.segment.centre + extent;
  return low_.x <= low.x && low_.y <= low.y && low_.z <= low.z && high.x <= high_.x &&
         high.y <= high_.y && high.z <= high_.z;
}

void NearPairs::lay_grid(const std::vector<Capsule> &rods)
{
  double mean_radius = 0.0;
  for (int i = 0; i < owned_; i++) mean_radius += rods[i].radius / owned_;
  const double reach = 2.0 * mean_radius + gap_;
  spacing_ = 0.5 * reach;

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low = {kInfinity, kInfinity, kInfinity}, high = -low;
  double cubes = 0.0;
  for (int i = 0; i < owned_; i++) {
    const Segment &segment = rods[i].segment;
    const Vec3 extent = extent_of(rods[i]);
    low = smaller(low, segment.centre - extent);
    high = larger(high, segment.centre + extent);
    cubes += cubes_on(segment);
  }
  make_buckets(cubes);

  if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return;  // no rod has a place
  double edge = reach + spacing_;
  const Vec3 space = {edge, edge, edge};
  low_ = low - space;
  high_ = high + space;
  const Vec3 size = high_ - low_;
  edge = std::max(edge, std::max({size.x, size.y, size.z}) / kMostCells);
  cells_a_metre_ = 1.0 / edge;
  const auto cells = [&](double length) { return static_cast<int>(length * cells_a_metre_) + 1; };
  nx_ = cells(size.x);
  ny_ = cells(size.y);
  nz_ = cells(size.z);
  // Odd, so that cells of one column come into different buckets.
  row_ = static_cast<uint32_t>(nx_) | 1u;
  plane_ = row_ * (static_cast<uint32_t>(ny_) | 1u);
}

void NearPairs::make_buckets(double cubes)
{
  uint32_t buckets = 64;
  while (buckets < kBucketsPerCube * cubes && buckets < (1u << 30)) buckets *= 2;
  bucket_bits_ = buckets - 1;
  last_of_bucket_.assign(buckets, kNone);
}

// The cells of a rod, each once. Along the axis the rows of cells that a cube reaches move one way in each
// dimension: a cell of a cube and of any before it is one of the cube just before it.
void NearPairs::enter(int i, const Capsule &rod)
{
  Entries &own = of_rods_[i];
  own.first = own.end = static_cast<int>(entries_.size());
  const Segment &segment = rod.segment;
  const int cubes = cubes_on(segment);
  const double step = 2.0 * segment.half_length / cubes;
  const double half = (rod.radius + 0.5 * (gap_ + step)) * cells_a_metre_;
  const Vec3 middle = cells_a_metre_ * (segment.centre - low_);
  const Vec3 along = cells_a_metre_ * segment.axis;

  // Cubes that may reach into the grid, a step more at either end for rounding; a sphere has one.
  double begin = -segment.half_length - step, end = -begin;
  const auto clip = [&](double centre, double slope, int cells) {
    const double low = -half - centre, high = cells + half - centre;
    if (std::fabs(slope) * segment.half_length < 1e-9 * half) {
      if (!(low <= half && high >= -half)) end = begin;
      return;
    }
    begin = std::max(begin, std::min(low / slope, high / slope) - step);
    end = std::min(end, std::max(low / slope, high / slope) + step);
  };
  int first = 0, last = 0;
  if (step > 0.0) {
    clip(middle.x, along.x, nx_);
    clip(middle.y, along.y, ny_);
    clip(middle.z, along.z, nz_);
    if (!(begin < end)) return;
    first = std::max(0, static_cast<int>((begin + segment.half_length) / step));
    last = std::min(cubes - 1, static_cast<int>((end + segment.half_length) / step));
  }

  Rows x_before{1, 0}, y_before{1, 0}, z_before{1, 0};
  for (int k = first; k <= last; k++) {
    const Vec3 place = middle + ((k + 0.5) * step - segment.half_length) * along;
    const Rows x(place.x, half, nx_), y(place.y, half, ny_), z(place.z, half, nz_);
    for (int iz = z.first; iz <= z.last; iz++)
      for (int iy = y.first; iy <= y.last; iy++) {
        const uint32_t first_of_row = iz * plane_ + iy * row_;
        const bool row_before = z_before.has(iz) && y_before.has(iy);
        for (int ix = x.first; ix <= x.last; ix++) {
          if (row_before && x_before.has(ix)) continue;
          int &last = last_of_bucket_[(first_of_row + ix) & bucket_bits_];
          entries_.push_back({i, last});
          last = own.end++;
        }
      }
    x_before = x;
    y_before = y;
    z_before = z;
  }
}

void NearPairs::LookUp::begin(size_t rods)
{
  if (last_seen.size() != rods || look_ups > kMostLookUps) {
    last_seen.assign(rods, 0);
    look_ups = 0;
  }
}

void NearPairs::LookUp::forget()
{
  partners.clear();
  found.clear();
  tried = 0;
}

// The rods that i shares cells with become candidates, of those entered before it.
void NearPairs::look_up(const std::vector<Capsule> &rods, int i, LookUp &own) const
{
  own.candidates.clear();
  int *last_seen = own.last_seen.data();
  const int now = ++own.look_ups;
  last_seen[i] = now;
  for (int k = of_rods_[i].first; k < of_rods_[i].end; k++)
    for (int m = entries_[k].before; m != kNone; m = entries_[m].before) {
      const int j = entries_[m].rod;
      if (j == kGone || last_seen[j] == now) continue;
      last_seen[j] = now;
      own.candidates.push_back(j);
    }
  own.tried += static_cast<int64_t>(own.candidates.size());
  keep_near(rods, i, own);
}

// Of the candidates, those near rod i.
void NearPairs::keep_near(const std::vector<Capsule> &rods, int i, LookUp &own) const
{
  SegmentPairs &batch = own.batch;
  const int n = static_cast<int>(own.candidates.size());
  for (int start = 0; start < n; start += kBatch) {
    const int count = std::min(kBatch, n - start);
    const int *js = &own.candidates[start];
    for (int k = 0; k < count; k++)
      batch.set(k, rods[i].segment, rods[js[k]].segment,
                rods[i].radius + rods[js[k]].radius + gap_);
    closest_points(batch);
    for (int k = 0; k < count; k++) {
      if (batch.uncertain[k] != 0.0) make_certain(batch, k, rods[i].segment, rods[js[k]].segment);
      if (batch.distance_squared[k] < batch.reach[k] * batch.reach[k])
        own.partners.push_back(js[k]);
    }
  }
}

// Calls look(n, own) for n of 0 ... number - 1, those of a piece in their order.
template <typename Look>
void NearPairs::look_up_all(const std::vector<Capsule> &rods, int number,
                            const SearchPieces &pieces, Look look)
{
  if (static_cast<int>(look_ups_.size()) < pieces.count) look_ups_.resize(pieces.count);
  for (LookUp &of_piece : look_ups_) of_piece.forget();
  const auto first_of = [&](int piece) {
    return static_cast<int>(static_cast<int64_t>(number) * piece / pieces.count);
  };
  pieces.run([&](int piece) {
    LookUp &own = look_ups_[piece];
    own.begin(rods.size());
    for (int n = first_of(piece); n < first_of(piece + 1); n++) look(n, own);
  });
  for (const LookUp &own : look_ups_) tried_ += own.tried;
}

// Entered from the last to the first: before a rod's entries are those of higher number.
void NearPairs::find(const std::vector<Capsule> &rods, int owned, double gap,
                     const SearchPieces &pieces)
{
  owned_ = owned;
  gap_ = gap;
  first_.assign(owned + 1, 0);
  partners_.clear();
  entries_.clear();
  of_rods_.assign(rods.size(), {0, 0});
  cells_ = tried_ = 0;
  nx_ = ny_ = nz_ = 0;
  if (owned == 0) return;
  lay_grid(rods);
  for (int i = static_cast<int>(rods.size()) - 1; i >= 0; i--) enter(i, rods[i]);
  cells_ = static_cast<int64_t>(entries_.size());
  most_entries_ = 2 * entries_.size();

  // Of each row its length, then where the next one begins.
  look_up_all(rods, owned, pieces, [&](int i, LookUp &own) {
    const size_t first = own.partners.size();
    look_up(rods, i, own);
    std::sort(own.partners.begin() + first, own.partners.end());
    first_[i + 1] = static_cast<int>(own.partners.size() - first);
  });
  for (int i = 0; i < owned; i++) first_[i + 1] += first_[i];
  for (const LookUp &own : look_ups_)
    partners_.insert(partners_.end(), own.partners.begin(), own.partners.end());
}

bool NearPairs::find_again(const std::vector<Capsule> &rods, const std::vector<int> &moved,
                           const SearchPieces &pieces)
{
  if (rods.size() != of_rods_.size() || entries_.size() > most_entries_) return false;
  for (const int i : moved)
    if (i < owned_ && !lies_in_grid(rods[i])) return false;

  cells_ = tried_ = 0;
  found_.clear();
  if (owned_ == 0) return true;
  for (const int i : moved)
    for (int k = of_rods_[i].first; k < of_rods_[i].end; k++) entries_[k].rod = kGone;
  for (const int i : moved) {
    enter(i, rods[i]);
    cells_ += of_rods_[i].end - of_rods_[i].first;
  }
  look_up_all(rods, static_cast<int>(moved.size()), pieces, [&](int n, LookUp &own) {
    const int i = moved[n];
    own.partners.clear();
    look_up(rods, i, own);
    for (const int j : own.partners)
      if (std::min(i, j) < owned_) own.found.push_back({std::min(i, j), std::max(i, j)});
  });
  for (const LookUp &own : look_ups_)
    found_.insert(found_.end(), own.found.begin(), own.found.end());
  return true;
}

}  // namespace spherocylinder
