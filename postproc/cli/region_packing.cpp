// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/region_packing.h"

#include <cmath>
#include <utility>

#include "core/numbers.h"
#include "core/parallel.h"
#include "measures/close_pairs.h"
#include "measures/fibre_contacts.h"
#include "solid/overlap_volume.h"

namespace spherocylinder {
namespace {

constexpr std::size_t kPairsAPiece = 128;

// A pair's volume is asked for to this part: overlaps are some percent of the solid, so that the
// solid's error is a hundred times smaller.
constexpr double kOverlapTolerance = 1e-2;

// The rods that reach into the region, and their images over periodic boundaries that do.
std::vector<Rod> rods_reaching(const DumpFrame &frame, const std::vector<Rod> &rods,
                               const UprightBox &region)
{
  struct Images {
    int first, last;
    double side;
  };
  const auto images = [&](const Rod &rod, int d, double centre, double axis, double low,
                          double high) -> Images {
    if (!frame.periodic[d]) return {0, 0, 0.0};
    const double side = frame.box[d][1] - frame.box[d][0];
    const double reach = rod.capsule.segment.half_length * std::abs(axis) + rod.capsule.radius;
    return {static_cast<int>(std::ceil((low - reach - centre) / side)),
            static_cast<int>(std::floor((high + reach - centre) / side)), side};
  };
  std::vector<Rod> found;
  for (const Rod &rod : rods) {
    const auto &[c, u, half_length] = rod.capsule.segment;
    const Images x = images(rod, 0, c.x, u.x, region.x_low, region.x_high);
    const Images y = images(rod, 1, c.y, u.y, region.y_low, region.y_high);
    const Images z = images(rod, 2, c.z, u.z, region.z_low, region.z_high);
    for (int i = x.first; i <= x.last; i++)
      for (int j = y.first; j <= y.last; j++)
        for (int k = z.first; k <= z.last; k++) {
          Rod image = rod;
          image.capsule.segment.centre = c + Vec3{i * x.side, j * y.side, k * z.side};
          if (!misses(region, image.capsule)) found.push_back(image);
        }
  }
  return found;
}

// The place, in a periodic box its first image from the region's lower sides on.
Vec3 image_from(const UprightBox &region, const Vec3 &place, const DumpFrame &frame)
{
  const auto moved = [&](double at, int d, double low) {
    if (!frame.periodic[d]) return at;
    const double side = frame.box[d][1] - frame.box[d][0];
    return at + side * std::ceil((low - at) / side);
  };
  return {moved(place.x, 0, region.x_low), moved(place.y, 1, region.y_low),
          moved(place.z, 2, region.z_low)};
}

bool holds_place(const UprightBox &region, const Vec3 &place)
{
  return place.x >= region.x_low && place.x <= region.x_high && place.y >= region.y_low &&
         place.y <= region.y_high && place.z >= region.z_low && place.z <= region.z_high;
}

// The ends and their images that reach into the region.
std::vector<SharedEnd> images_of_ends(const DumpFrame &frame, const std::vector<SharedEnd> &ends,
                                      const UprightBox &region)
{
  std::vector<SharedEnd> found;
  for (const SharedEnd &end : ends) {
    Rod whole = end.ball;
    whole.capsule.radius = end.reach;
    for (const Rod &image : rods_reaching(frame, {whole}, region)) {
      found.push_back(end);
      found.back().ball.capsule.segment.centre = image.capsule.segment.centre;
    }
  }
  return found;
}

void take_off(const BoundedVolume &part, BoundedVolume &from)
{
  from.value -= part.value;
  from.error += part.error;
}

RegionPacking packing_of(const UprightBox &bounds, double space, const BoundedVolume &solid,
                         double twice)
{
  return {none,
          bounds.z_low,
          bounds.z_high,
          space,
          solid.value / space,
          solid.error / space,
          (solid.value - twice) / space};
}

}  // namespace

std::vector<Overlap> overlaps_of(const Bed &bed)
{
  auto pairs = close_pairs(bed.rods, periodicity_of(bed.frame), 0.0);
  if (bed.fibres.are_there()) leave_out_joints(bed.rods, bed.fibres, pairs);
  std::vector<Overlap> overlaps(pairs.size());
  for_each_piece(pairs.size(), kPairsAPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; k++) {
      const ClosePair &pair = pairs[k];
      const Capsule &i = bed.rods[pair.i].capsule;
      Capsule j = bed.rods[pair.j].capsule;
      const Vec3 p = i.segment.at(pair.s);
      const Vec3 q = p - (pair.gap + i.radius + j.radius) * pair.normal;
      j.segment.centre = q - pair.t * j.segment.axis;  // of the image that is near
      overlaps[k] = {0.5 * (p + q), overlap_volume(i, j, kOverlapTolerance)};
    }
  });
  return overlaps;
}

BedSolid::BedSolid(const Bed &bed_, std::vector<Overlap> overlaps_)
    : bed(bed_), overlaps(std::move(overlaps_)), shared(shared_ends(bed_.rods, bed_.fibres))
{
  for (const SharedEnd &end : shared) balls.push_back(end.ball);
}

double BedSolid::volume() const
{
  double sum = total_volume(bed.rods) - total_volume(balls);
  for (const SharedEnd &end : shared) sum -= end.beyond.value;
  return sum;
}

BoundedVolume solid_within(const BedSolid &solid, const UprightCylinder &region, double tolerance)
{
  BoundedVolume found = solid_within(solid.bed.rods, region, tolerance);
  if (solid.shared.empty()) return found;
  take_off(solid_within(solid.balls, region, tolerance), found);
  take_off_beyond(
      solid.shared,
      [&](const Vec3 &p) {
        return p.z >= region.z_low && p.z < region.z_high &&
               std::hypot(p.x - region.x, p.y - region.y) < region.radius;
      },
      [&](const Capsule &ball) { return !misses(region, ball) && !holds(region, ball); }, found);
  return found;
}

RegionPacking pack_box(const BedSolid &solid, const UprightBox &box, double tolerance)
{
  const DumpFrame &frame = solid.bed.frame;
  double twice = 0.0;
  for (const Overlap &overlap : solid.overlaps)
    if (holds_place(box, image_from(box, overlap.place, frame))) twice += overlap.volume.value;
  BoundedVolume found = solid_within(rods_reaching(frame, solid.bed.rods, box), box, tolerance);
  if (!solid.shared.empty()) {
    take_off(solid_within(rods_reaching(frame, solid.balls, box), box, tolerance), found);
    take_off_beyond(
        images_of_ends(frame, solid.shared, box),
        [&](const Vec3 &p) { return holds_place(box, p); },
        [&](const Capsule &ball) { return !misses(box, ball) && !holds(box, ball); }, found);
  }
  return packing_of(box, volume(box), found, twice);
}

RegionPacking pack_mesh(const BedSolid &solid, const ClosedMesh &mesh, double tolerance)
{
  const DumpFrame &frame = solid.bed.frame;
  const UprightBox bounds = mesh.bounds();
  double twice = 0.0;
  for (const Overlap &overlap : solid.overlaps) {
    const Vec3 place = image_from(bounds, overlap.place, frame);
    if (holds_place(bounds, place) && mesh.distance(place) <= 0.0) twice += overlap.volume.value;
  }
  BoundedVolume found = solid_within(rods_reaching(frame, solid.bed.rods, bounds), mesh, tolerance);
  if (!solid.shared.empty()) {
    take_off(solid_within(rods_reaching(frame, solid.balls, bounds), mesh, tolerance), found);
    take_off_beyond(
        images_of_ends(frame, solid.shared, bounds),
        [&](const Vec3 &p) { return holds_place(bounds, p) && mesh.distance(p) <= 0.0; },
        [&](const Capsule &ball) { return mesh.place_of(ball) == ClosedMesh::Place::Cut; }, found);
  }
  return packing_of(bounds, mesh.volume(), found, twice);
}

}  // namespace spherocylinder
