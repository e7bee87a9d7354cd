// SPDX-License-Identifier: GPL-2.0-or-later
#include "close_rod_pairs.h"

#include <algorithm>
#include <cmath>

#include "neigh_list.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Skin in diameters of the thickest rod at hand. A wider one is renewed less often and holds more
// pairs; in settled beds about 4.6 neighbours a rod are nearer than 0.3 diameters and 3 touch.
constexpr double kSkinInDiameters = 0.4;

// True if the segments are certainly farther apart than `reach`: the distance of the infinite
// lines, |between . n| / |n|, is a lower bound.
bool lines_are_apart(const Segment &i, const Segment &j, double reach)
{
  const Vec3 normal = cross(i.axis, j.axis);
  const double along = dot(j.centre - i.centre, normal);
  return along * along > reach * reach * norm_squared(normal);
}

}  // namespace

// Any surface point of a rod moves at most as far as its centre plus its axis's end; a spin about
// the axis moves no surface.
bool CloseRodPairs::mark_moved(const std::vector<Segment> &segments)
{
  bool any = false;
  const double half_skin = 0.5 * skin_;
  for (size_t i = 0; i < segments.size(); i++) {
    const double shift = norm(segments[i].centre - reference_[i].centre) +
                         segments[i].half_length * norm(segments[i].axis - reference_[i].axis);
    moved_[i] = shift > half_skin;
    if (!moved_[i]) continue;
    reference_[i] = segments[i];
    any = true;
  }
  return any;
}

bool CloseRodPairs::is_close(int i, int j, const std::vector<double> &radius) const
{
  const Segment &a = reference_[i], &b = reference_[j];
  const double reach = radius[i] + radius[j] + skin_;
  const double bound = reach + a.half_length + b.half_length;
  if (norm_squared(a.centre - b.centre) >= bound * bound) return false;
  if (lines_are_apart(a, b, reach)) return false;
  return closest_points(a, b).distance_squared < reach * reach;
}

void CloseRodPairs::update(const NeighList &list, int **contact_flags,
                           const std::vector<Segment> &segments,
                           const std::vector<double> &radius, bool rebuilt)
{
  if (rebuilt) {
    entries_.clear();
    reference_ = segments;
    moved_.assign(segments.size(), 1);
    skin_ = radius.empty()
                ? 0.0
                : kSkinInDiameters * 2.0 * *std::max_element(radius.begin(), radius.end());
  } else if (!mark_moved(segments)) {
    return;
  }

  // entries_ is in the order of LIGGGHTS's list: walk both at once.
  next_entries_.clear();
  size_t old = 0;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    const int *neighbours = list.firstneigh[i];
    const int count = list.numneigh[i];
    const bool moved_i = moved_[i];
    for (int index = 0; index < count; index++) {
      const int j = neighbours[index] & NEIGHMASK;
      const bool was_close =
          old < entries_.size() && entries_[old].i == i && entries_[old].index == index;
      old += was_close;
      bool close = was_close;
      if (moved_i || moved_[j])
        close = (contact_flags && contact_flags[i][index]) || is_close(i, j, radius);
      if (close) next_entries_.push_back({i, j, index});
    }
  }
  entries_.swap(next_entries_);
}
