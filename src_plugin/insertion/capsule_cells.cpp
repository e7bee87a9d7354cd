// SPDX-License-Identifier: GPL-2.0-or-later
#include "insertion/capsule_cells.h"

#include <algorithm>
#include <cmath>

#include "core/closest_points.h"
#include "domain.h"

using namespace LAMMPS_NS;
using spherocylinder::Capsule;
using spherocylinder::Vec3;

namespace {

constexpr int64_t kMostCells = 1 << 20;  // along a side: their numbers make one key

}  // namespace

CapsuleCells::CapsuleCells(const Domain &domain, double largest)
{
  const int periodic[3] = {domain.xperiodic, domain.yperiodic, domain.zperiodic};
  for (int d = 0; d < 3; d++) {
    lo_[d] = domain.boxlo[d];
    period_[d] = periodic[d] ? domain.prd[d] : 0.0;
    width_[d] = 2.001 * largest;
    cells_[d] = 0;
    if (!periodic[d]) continue;
    cells_[d] = std::min(std::max<int64_t>(1, int64_t(period_[d] / width_[d])), kMostCells);
    width_[d] = period_[d] / static_cast<double>(cells_[d]);
  }
}

CapsuleCells::Place CapsuleCells::place_of(const Vec3 &x) const
{
  const double at[3] = {x.x, x.y, x.z};
  Place place;
  for (int d = 0; d < 3; d++)
    place.cell[d] = static_cast<int64_t>(std::floor((at[d] - lo_[d]) / width_[d]));
  return place;
}

// Cells that share a key by chance only cost a look.
int64_t CapsuleCells::key_of(const Place &place) const
{
  int64_t key = 0;
  for (int d = 0; d < 3; d++) {
    int64_t cell = place.cell[d];
    if (cells_[d] > 0) cell = ((cell % cells_[d]) + cells_[d]) % cells_[d];
    key = key * (kMostCells + 7) + cell;
  }
  return key;
}

void CapsuleCells::add(const Capsule &capsule)
{
  in_cell_[key_of(place_of(capsule.segment.centre))].push_back(static_cast<int>(capsules_.size()));
  capsules_.push_back(capsule);
}

bool CapsuleCells::overlaps(const Capsule &capsule) const
{
  const Place place = place_of(capsule.segment.centre);
  // Of one or two cells in a period each is looked into once.
  int first[3], last[3];
  for (int d = 0; d < 3; d++) {
    first[d] = cells_[d] == 1 || cells_[d] == 2 ? 0 : -1;
    last[d] = cells_[d] == 1 ? 0 : 1;
  }
  for (int i = first[0]; i <= last[0]; i++)
    for (int j = first[1]; j <= last[1]; j++)
      for (int k = first[2]; k <= last[2]; k++) {
        const Place near = {{place.cell[0] + i, place.cell[1] + j, place.cell[2] + k}};
        const auto found = in_cell_.find(key_of(near));
        if (found == in_cell_.end()) continue;
        for (const int other : found->second)
          if (touch(capsule, capsules_[other], false)) return true;
      }
  return false;
}

bool CapsuleCells::overlap_own_images(const std::vector<Capsule> &body) const
{
  for (size_t i = 0; i < body.size(); i++)
    for (size_t j = i; j < body.size(); j++)
      if (touch(body[i], body[j], true)) return true;
  return false;
}

// All images of b whose bounding sphere reaches that of a. `images_only`: not b itself.
bool CapsuleCells::touch(const Capsule &a, const Capsule &b, bool images_only) const
{
  const double reach = 0.5 * (a.length() + b.length()), radii = a.radius + b.radius;
  const Vec3 apart = b.segment.centre - a.segment.centre;
  const double along[3] = {apart.x, apart.y, apart.z};
  int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
  for (int d = 0; d < 3; d++) {
    if (period_[d] > 0.0) {
      first[d] = static_cast<int>(std::ceil((-reach - along[d]) / period_[d]));
      last[d] = static_cast<int>(std::floor((reach - along[d]) / period_[d]));
    } else if (std::fabs(along[d]) > reach) {
      return false;
    }
  }
  for (int i = first[0]; i <= last[0]; i++)
    for (int j = first[1]; j <= last[1]; j++)
      for (int k = first[2]; k <= last[2]; k++) {
        if (images_only && i == 0 && j == 0 && k == 0) continue;
        spherocylinder::Segment image = b.segment;
        image.centre = image.centre + Vec3{i * period_[0], j * period_[1], k * period_[2]};
        if (closest_points(a.segment, image).distance_squared <= radii * radii) return true;
      }
  return false;
}
