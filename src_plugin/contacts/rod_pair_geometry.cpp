// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/rod_pair_geometry.h"

#include <cmath>

#include "core/joint_share.h"
#include "core/spread_contact.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;
using Touch = TouchingRodPairs::Touch;

namespace {

// In the order of the rods' ids, so that all ranks that see a pair get the same bits.
RodContact spread_over(const Touch &touch, const std::vector<Capsule> &rods, const int *tag,
                       double reach)
{
  const Segment i = extended(rods[touch.i].segment, touch.beyond_i),
                j = extended(rods[touch.j].segment, touch.beyond_j);
  const double on_i = 0.5 * touch.beyond_i, on_j = 0.5 * touch.beyond_j;
  const ClosestPoints points = moved(RodContact{touch.points, 0.0}, -on_i, -on_j).points;
  if (tag[touch.i] < tag[touch.j]) return moved(spread_contact(i, j, reach, points), on_i, on_j);
  return moved(swapped(spread_contact(j, i, reach, swapped(RodContact{points, 0.0}).points)), on_i,
               on_j);
}

Vec3 common_perpendicular(const Vec3 &u, const Vec3 &v)
{
  Vec3 normal = cross(u, v);
  if (norm_squared(normal) == 0.0)
    normal = std::fabs(u.x) < 0.5 ? cross(u, Vec3{1.0, 0.0, 0.0}) : cross(u, Vec3{0.0, 1.0, 0.0});
  return (1.0 / norm(normal)) * normal;
}

}  // namespace

RodPairGeometry LAMMPS_NS::geometry_of(const Touch &touch, const std::vector<Capsule> &rods,
                                       const int *tag, const double *side, bool spread)
{
  const Capsule &rod_i = rods[touch.i], &rod_j = rods[touch.j];
  const double reach = rod_i.radius + rod_j.radius;
  const bool was_touching = side && (side[0] != 0.0 || side[1] != 0.0 || side[2] != 0.0);
  const bool passed = was_touching && dot(touch.points.delta, load(side)) < 0.0;

  RodContact contact{touch.points, passed ? reach + touch.distance : reach - touch.distance};
  double distance = passed ? -touch.distance : touch.distance;
  if (spread && touch.nearly_parallel && !passed) {
    contact = spread_over(touch, rods, tag, reach);
    distance = std::sqrt(contact.points.distance_squared);
  }

  const Vec3 normal = distance != 0.0 ? (1.0 / distance) * contact.points.delta
                      : was_touching  ? (1.0 / norm(load(side))) * load(side)
                                     : common_perpendicular(rod_i.segment.axis, rod_j.segment.axis);
  return {contact.points.s, contact.points.t, normal,           distance,        contact.overlap,
          contact.share,    contact.sideways, contact.couple_i, contact.couple_j};
}
