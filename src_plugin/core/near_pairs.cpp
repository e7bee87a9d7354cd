// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spherocylinder {

namespace {

// Cells a cube on an axis: more of them are a waste of memory where rods are few and far between.
constexpr double kCellsPerCube = 8.0;

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

void NearPairs::lay_grid(const std::vector<Capsule> &rods, int owned, double gap)
{
  double mean_radius = 0.0;
  for (int i = 0; i < owned; i++) mean_radius += rods[i].radius / owned;
  const double reach = 2.0 * mean_radius + gap;
  spacing_ = 0.5 * reach;

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low = {kInfinity, kInfinity, kInfinity}, high = -low;
  double cubes = 0.0;
  for (int i = 0; i < owned; i++) {
    const Segment &segment = rods[i].segment;
    const double around = rods[i].radius + 0.5 * (gap + spacing_);
    const Vec3 extent = segment.half_length * absolute(segment.axis) + Vec3{around, around, around};
    low = smaller(low, segment.centre - extent);
    high = larger(high, segment.centre + extent);
    cubes += cubes_on(segment);
  }

  nx_ = ny_ = nz_ = 0;
  if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return;  // no rod has a place
  const Vec3 size = high - low;
  double edge = reach + spacing_;
  const double most = kCellsPerCube * cubes + 1000.0;
  const auto cells = [](double length, double cell) { return std::floor(length / cell) + 1.0; };
  while (cells(size.x, edge) * cells(size.y, edge) * cells(size.z, edge) > most) edge *= 1.25;
  low_ = low;
  cells_a_metre_ = 1.0 / edge;
  nx_ = static_cast<int>(cells(size.x, edge));
  ny_ = static_cast<int>(cells(size.y, edge));
  nz_ = static_cast<int>(cells(size.z, edge));
}

// The cells of a rod, each once. Along the axis the rows of cells that a cube reaches move one way in each
// dimension: a cell of a cube and of any before it is one of the cube just before it.
void NearPairs::enter_rod(const Capsule &rod, double gap)
{
  const Segment &segment = rod.segment;
  const int cubes = cubes_on(segment);
  const double step = 2.0 * segment.half_length / cubes;
  const double half = (rod.radius + 0.5 * (gap + step)) * cells_a_metre_;
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
        const bool row_before = z_before.has(iz) && y_before.has(iy);
        for (int ix = x.first; ix <= x.last; ix++) {
          if (row_before && x_before.has(ix)) continue;
          const int cell = (iz * ny_ + iy) * nx_ + ix;
          first_of_cell_[cell]++;
          cells_of_rods_.push_back(cell);
        }
      }
    x_before = x;
    y_before = y;
    z_before = z;
  }
}

// The cells of each rod, then the rods of each cell.
void NearPairs::enter_rods(const std::vector<Capsule> &rods, double gap)
{
  const int n = static_cast<int>(rods.size());
  const int n_cells = nx_ * ny_ * nz_;
  first_of_cell_.assign(n_cells + 1, 0);
  first_of_rod_.resize(n + 1);
  cells_of_rods_.clear();
  for (int i = 0; i < n; i++) {
    first_of_rod_[i] = static_cast<int>(cells_of_rods_.size());
    enter_rod(rods[i], gap);
  }
  first_of_rod_[n] = static_cast<int>(cells_of_rods_.size());

  // first_of_cell_ holds counts; turned into ends, then, filling from the back, into beginnings.
  for (int cell = 0, end = 0; cell <= n_cells; cell++)
    first_of_cell_[cell] = end += first_of_cell_[cell];
  rods_in_cells_.resize(cells_of_rods_.size());
  for (int i = n - 1; i >= 0; i--)
    for (int k = first_of_rod_[i]; k < first_of_rod_[i + 1]; k++)
      rods_in_cells_[--first_of_cell_[cells_of_rods_[k]]] = i;
}

// Of the candidates, those near rod i.
void NearPairs::keep_near(const std::vector<Capsule> &rods, int i, double gap)
{
  const int n = static_cast<int>(candidates_.size());
  for (int start = 0; start < n; start += kBatch) {
    const int count = std::min(kBatch, n - start);
    const int *js = &candidates_[start];
    for (int k = 0; k < count; k++)
      batch_.set(k, rods[i].segment, rods[js[k]].segment,
                 rods[i].radius + rods[js[k]].radius + gap);
    closest_points(batch_);
    for (int k = 0; k < count; k++) {
      if (batch_.uncertain[k] != 0.0) make_certain(batch_, k, rods[i].segment, rods[js[k]].segment);
      if (batch_.distance_squared[k] < batch_.reach[k] * batch_.reach[k])
        partners_.push_back(js[k]);
    }
  }
}

void NearPairs::find(const std::vector<Capsule> &rods, int owned, double gap)
{
  first_.assign(owned + 1, 0);
  partners_.clear();
  cells_of_rods_.clear();
  tried_ = 0;
  if (owned == 0) return;
  lay_grid(rods, owned, gap);
  enter_rods(rods, gap);

  last_seen_.assign(rods.size(), -1);
  for (int i = 0; i < owned; i++) {
    first_[i] = static_cast<int>(partners_.size());
    candidates_.clear();
    for (int k = first_of_rod_[i]; k < first_of_rod_[i + 1]; k++) {
      const int cell = cells_of_rods_[k];
      for (int m = first_of_cell_[cell + 1] - 1; rods_in_cells_[m] > i; m--) {
        const int j = rods_in_cells_[m];
        if (last_seen_[j] == i) continue;
        last_seen_[j] = i;
        candidates_.push_back(j);
      }
    }
    tried_ += static_cast<int64_t>(candidates_.size());
    std::sort(candidates_.begin(), candidates_.end());
    keep_near(rods, i, gap);
  }
  first_[owned] = static_cast<int>(partners_.size());
}

}  // namespace spherocylinder
