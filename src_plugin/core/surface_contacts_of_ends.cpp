// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/surface_finder.h"

namespace spherocylinder {

void EndFinder::find()
{
  find_of_end(OnRod::kEndMinus);
  if (axis_.half_length > 0.0) find_of_end(OnRod::kEndPlus);
}

void EndFinder::find_of_end(OnRod place)
{
  const size_t first = contacts_.size();
  const int which = place == OnRod::kEndMinus ? 0 : 1;
  const double along = which == 0 ? -axis_.half_length : axis_.half_length;
  const Vec3 end = axis_.at(along);
  for (const NearFacet &facet : near_.facets[which])
    if (const int triangle = holder_of_foot(facet, near_.triangles[which].data(), end);
        triangle >= 0)
      add_over_face(place, triangle, along, end);
  for (const int edge : near_.edges) add_at_edge(place, edge, along, end);
  for (const int corner : near_.corners) add_at_corner(place, corner, along, end);
  if (contacts_.size() - first < 2) return;
  drop_twins(first);
  drop_hidden(first, which);
  share_valley(first);
}

int EndFinder::holder_of_foot(const NearFacet &facet, const int *triangles, const Vec3 &end) const
{
  const Rectangle in(surface_.shape(triangles[facet.first]), facet.edge);
  const double x = in.across(end), y = in.along(end);
  if (x < facet.low[0] - seam_ || x > facet.high[0] + seam_ || y < facet.low[1] - seam_ ||
      y > facet.high[1] + seam_)
    return -1;
  if (surface_.shape(triangles[facet.last]).holds_foot(end, 0.0)) return triangles[facet.last];
  for (const double margin : {0.0, seam_})
    for (int k = facet.first; k < facet.first + facet.count; k++)
      if (surface_.shape(triangles[k]).holds_foot(end, margins(triangles[k], margin))) {
        facet.last = k;
        return triangles[k];
      }
  return -1;
}

std::array<double, 3> EndFinder::margins(int triangle, double margin) const
{
  const std::array<bool, 3> &flat = surface_.flat_edges(triangle);
  return {flat[0] ? margin : 0.0, flat[1] ? margin : 0.0, flat[2] ? margin : 0.0};
}

double EndFinder::side_of_memory(OnRod place, int triangle) const
{
  for (const RememberedSide &memory : remembered_) {
    if (memory.place != place) continue;
    const bool is_same = surface_.facet(memory.triangle) == surface_.facet(triangle);
    if (!is_same &&
        (surface_.patch(memory.triangle) != surface_.patch(triangle) ||
         !surface_.meet_smoothly(surface_.facet(memory.triangle), surface_.facet(triangle))))
      continue;
    const double along = dot(memory.normal, surface_.shape(memory.triangle).normal);
    if (along != 0.0)
      return (along < 0.0 ? -1.0 : 1.0) * surface_.orientation(memory.triangle) *
             surface_.orientation(triangle);
  }
  return 0.0;
}

bool EndFinder::is_pierced(int triangle) const
{
  const std::vector<int> &pierced = near_.pierced;
  return std::find(pierced.begin(), pierced.end(), surface_.facet(triangle)) != pierced.end();
}

void EndFinder::add_over_face(OnRod place, int triangle, double along, const Vec3 &end)
{
  const TriangleShape &shape = surface_.shape(triangle);
  const double height = shape.height(end);
  double side = side_of_memory(place, triangle);
  if (side == 0.0) {
    const double of_centre = is_pierced(triangle) ? shape.height(axis_.centre) : 0.0;
    side = (of_centre != 0.0 ? of_centre : height) < 0.0 ? -1.0 : 1.0;
  }
  if (side * height > rod_.radius) return;
  add(place, face(triangle), along, side * shape.normal, side * height);
}

void EndFinder::add_at_edge(OnRod place, int index, double along, const Vec3 &end)
{
  const Segment segment = surface_.segment(index);
  const double on_edge = dot(end - segment.centre, segment.axis);
  if (std::fabs(on_edge) > segment.half_length) return;
  const Vec3 way = end - segment.at(on_edge);
  if (norm_squared(way) > rod_.radius * rod_.radius) return;
  const Bearer bearer = edge(index, 0.5 + 0.5 * on_edge / segment.half_length);
  const bool passed = has_passed(place, bearer, way);
  if (!stands_out(surface_.edges()[index], passed ? -way : way)) return;
  add_by_way(place, bearer, along, way, passed);
}

void EndFinder::add_at_corner(OnRod place, int node, double along, const Vec3 &end)
{
  const Vec3 way = end - surface_.node(node);
  if (norm_squared(way) > rod_.radius * rod_.radius) return;
  const bool passed = has_passed(place, corner(node), way);
  if (!corner_stands_out(node, passed ? -way : way)) return;
  add_by_way(place, corner(node), along, way, passed);
}

void EndFinder::drop_hidden(size_t first, int which)
{
  for (size_t k = first; k < contacts_.size(); k++)
    if (contacts_[k].distance < 0.0) return;
  for (size_t k = first; k < contacts_.size(); k++)
    if (is_face(k) && is_hidden(contacts_[k], which)) contacts_[k].weight = 0.0;
}

bool EndFinder::is_hidden(const SurfaceContact &contact, int which) const
{
  const Vec3 from = axis_.at(contact.along), to = contact.on_surface(axis_);
  const std::vector<int> &triangles = near_.triangles[which];
  for (const NearFacet &facet : near_.facets[which]) {
    const TriangleShape &shape = surface_.shape(triangles[facet.first]);
    const double before = shape.height(from), behind = shape.height(to);
    if (before * behind >= 0.0 || std::fabs(behind) <= kOnePlace * seam_) continue;
    const Vec3 crossing = from + (before / (before - behind)) * (to - from);
    for (int k = facet.first; k < facet.first + facet.count; k++)
      if (surface_.shape(triangles[k]).holds_foot(crossing, seam_)) return true;
  }
  return false;
}

void EndFinder::share_valley(size_t first)
{
  const size_t count = contacts_.size() - first;
  // How far two facets go together: wholly those that meet, others as the way between them bears.
  std::vector<double> together(count * count, 0.0);
  bool any = false;
  for (size_t a = 0; a < count; a++)
    for (size_t b = 0; b < count; b++)
      if (a != b &&
          (make_a_valley(first + a, first + b) || are_of_one_bowl(first + a, first + b))) {
        together[a * count + b] = std::numeric_limits<double>::infinity();
        any = true;
      }
  if (!any) return;
  std::vector<double> parts(count, 0.0);
  for (size_t a = 0; a < count; a++) {
    parts[a] = overlap(first + a);
    for (size_t b = 0; b < count; b++)
      if (make_a_valley(first + a, first + b)) parts[a] *= part_beside(first + a, first + b);
  }
  for (size_t via = 0; via < count; via++)
    for (size_t a = 0; a < count; a++)
      for (size_t b = 0; b < count; b++) {
        if (a == b || a == via || b == via) continue;
        const double way =
            std::min({together[a * count + via], parts[via], together[via * count + b]});
        together[a * count + b] = std::max(together[a * count + b], way);
      }
  for (size_t a = 0; a < count; a++) {
    double sum = parts[a];
    for (size_t b = 0; b < count; b++) {
      const double way = together[a * count + b], least = std::min(parts[a], parts[b]);
      if (way > 0.0) sum += parts[b] * (way < least ? way / least : 1.0);
    }
    if (sum > parts[a]) contacts_[first + a].weight = parts[a] / sum;
  }
}

double EndFinder::part_beside(size_t a, size_t b) const
{
  const double own = from_valley(a, b), others = from_valley(b, a);
  const double part = own + others > 0.0 ? own / (own + others) : 0.5;
  return 1.0 - (1.0 - part) * (overlap(b) < overlap(a) ? overlap(b) / overlap(a) : 1.0);
}

double EndFinder::from_valley(size_t a, size_t b) const
{
  const SurfaceContact &one = contacts_[a], &other = contacts_[b];
  const double sine = norm(cross(one.normal, other.normal));
  const double over =
      dot(one.on_surface(axis_) - surface_.shape(other.triangle).corners[0], other.normal);
  return sine > 0.0 ? std::max(0.0, over / sine) : 0.0;
}

bool EndFinder::is_face(size_t k) const
{
  return contacts_[k].feature == OnSurface::kFace && contacts_[k].weight > 0.0;
}

bool EndFinder::are_of_one_bowl(size_t a, size_t b) const
{
  constexpr double kLeastCosine = 0.96;
  return is_face(a) && is_face(b) &&
         surface_.patch(contacts_[a].triangle) == surface_.patch(contacts_[b].triangle) &&
         dot(contacts_[a].normal, contacts_[b].normal) > kLeastCosine;
}

bool EndFinder::make_a_valley(size_t a, size_t b) const
{
  return is_face(a) && is_face(b) &&
         surface_.meet_smoothly(surface_.facet(contacts_[a].triangle),
                                surface_.facet(contacts_[b].triangle));
}

}  // namespace spherocylinder
