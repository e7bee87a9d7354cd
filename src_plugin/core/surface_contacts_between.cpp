// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>

#include "core/closest_points.h"
#include "core/numbers.h"
#include "core/surface_finder.h"

namespace spherocylinder {

namespace {

// An end at an edge or corner has a contact of its own where the axis is nearest there. Where the axis comes
// nearer farther in, as it does at the contact between the ends, the end's fades out with the sine of the
// angle at which it does: a rod that lies along a ridge has both ends on it in spite of small tilts.
constexpr double kComesNearer = 0.01;

}  // namespace

void BetweenFinder::find()
{
  const size_t ends = contacts_.size();
  for (const int edge : near_.edges) add_between_at_edge(edge);
  for (const int corner : near_.corners) add_between_at_corner(corner);
  if (contacts_.size() == ends) return;
  drop_twins(ends);
  join_neighbours(ends);
  bears_.clear();
  for (size_t k = ends; k < contacts_.size(); k++)
    bears_.push_back(1.0 - gentleness(contacts_[k]) * (1.0 - standing_out(k, ends)));
  fade_ends(ends);
  share_between(ends);
}

double BetweenFinder::kept_of_end(const Vec3 &normal, double along) const
{
  const double outwards = dot(normal, axis_.axis) * (along < 0.0 ? -1.0 : 1.0);
  return std::min(1.0, std::max(0.0, 1.0 - outwards / kComesNearer));
}

void BetweenFinder::add_between_at_edge(int index)
{
  const Segment segment = surface_.segment(index);
  const ClosestPoints nearest = closest_points(axis_, segment);
  if (nearest.distance_squared > rod_.radius * rod_.radius) return;
  if (is_between(nearest.s) && std::fabs(nearest.t) < segment.half_length) {
    const Bearer bearer = edge(index, 0.5 + 0.5 * nearest.t / segment.half_length);
    const bool passed = has_passed(OnRod::kBetween, bearer, nearest.delta);
    if (stands_out(surface_.edges()[index], passed ? -nearest.delta : nearest.delta)) {
      add_by_way(OnRod::kBetween, bearer, nearest.s, nearest.delta, passed);
      nearest_within_.push_back(index);
      return;
    }
  }
  const int facets = static_cast<int>(surface_.edges()[index].beside.size());
  for (int nth = 0; nth < facets; nth++) add_over_rim(index, nth, segment);
}

void BetweenFinder::add_over_rim(int index, int nth, const Segment &segment)
{
  const SurfaceEdge &rim = surface_.edges()[index];
  const TriangleShape &shape = surface_.shape(rim.beside[nth].triangle);
  const Vec3 &inwards = inwards_of(rim.beside[nth]);
  const double crossing = dot(axis_.axis, inwards);
  if (crossing == 0.0) return;
  const double along = dot(segment.centre - axis_.centre, inwards) / crossing;
  if (!is_between(along)) return;
  const Vec3 on_axis = axis_.at(along);
  const double on_edge = dot(on_axis - segment.centre, segment.axis);
  if (std::fabs(on_edge) > segment.half_length) return;

  const double height = dot(on_axis - segment.at(on_edge), shape.normal);
  if (std::fabs(height) > rod_.radius || height == 0.0) return;
  const Bearer bearer = edge(index, 0.5 + 0.5 * on_edge / segment.half_length, nth);
  Vec3 normal = (height < 0.0 ? -1.0 : 1.0) * shape.normal;
  const bool passed = has_passed(OnRod::kBetween, bearer, normal);
  if (passed) normal = -normal;
  for (size_t other = 0; other < rim.beside.size(); other++)
    if (static_cast<int>(other) != nth && dot(inwards_of(rim.beside[other]), normal) >= 0.0)
      return;  // a valley

  // Of the axis as it goes inwards, in the plane across the edge.
  const double down = -dot(axis_.axis, normal) * (crossing > 0.0 ? 1.0 : -1.0);
  const double tilt = std::atan2(down, std::fabs(crossing));
  if (tilt < 0.0) return;  // nearest at the edge itself, or beyond
  const double weight = 1.0 - tilt / (0.5 * rim.turn);
  if (weight > 0.0)
    add(OnRod::kBetween, bearer, along, normal, (passed ? -1.0 : 1.0) * std::fabs(height), weight);
}

void BetweenFinder::add_between_at_corner(int node)
{
  // Of a convex pair, axis and edge, there is one nearest place: not its end if it is within the edge.
  for (const int edge : surface_.edges_at(node))
    if (std::find(nearest_within_.begin(), nearest_within_.end(), edge) != nearest_within_.end())
      return;
  const Vec3 &at = surface_.node(node);
  const double along = closest_position(axis_, at);
  if (!is_between(along)) return;
  const Vec3 way = axis_.at(along) - at;
  if (norm_squared(way) > rod_.radius * rod_.radius) return;
  const bool passed = has_passed(OnRod::kBetween, corner(node), way);
  if (!corner_stands_out(node, passed ? -way : way)) return;
  add_by_way(OnRod::kBetween, corner(node), along, way, passed);
}

void BetweenFinder::fade_ends(size_t ends)
{
  for (size_t k = ends; k < contacts_.size(); k++) {
    if (!is_nearest(k)) continue;
    for (size_t n = 0; n < ends; n++) {
      SurfaceContact &end = contacts_[n];
      if (end.distance < 0.0 || !(end.weight > 0.0)) continue;
      const double kept = kept_of_end(end.normal, end.along);
      // Wholly within half a radius along the axis, not from a radius on.
      const double apart = std::fabs(contacts_[k].along - end.along) / rod_.radius;
      const double beside = std::clamp(2.0 - 2.0 * apart, 0.0, 1.0);
      end.weight *=
          1.0 - bears_[k - ends] * beside * (1.0 - kept) * (1.0 - way_from(contacts_[k], end));
    }
  }
}

double BetweenFinder::way_from(const SurfaceContact &between, const SurfaceContact &end) const
{
  if (are_at_one_edge(between, end)) return 0.0;
  if (between.feature != OnSurface::kEdge || end.feature != OnSurface::kFace) return 1.0;
  const SurfaceEdge &edge = surface_.edges()[between.index];
  for (const TrianglePart &side : edge.beside)
    if (surface_.facet(side.triangle) == surface_.facet(end.triangle))
      return std::clamp(
          dot(end.on_surface(axis_) - surface_.node(edge.nodes[0]), inwards_of(side)) / rod_.radius,
          0.0, 1.0);
  return 1.0;
}

double BetweenFinder::gentleness(const SurfaceContact &contact) const
{
  constexpr double kGentle = 0.35, kSteep = 0.5;  // rad
  if (!is_smooth(contact)) return 0.0;
  double turn = 0.0;
  for_each_edge_of(contact, [&](const SurfaceEdge &edge) { turn = std::max(turn, edge.turn); });
  return std::clamp((kSteep - turn) / (kSteep - kGentle), 0.0, 1.0);
}

bool BetweenFinder::is_smooth(const SurfaceContact &contact) const
{
  bool all = true;
  for_each_edge_of(contact, [&](const SurfaceEdge &edge) { all &= edge.is_smooth; });
  return all;
}

// Of a contact at an edge, that; at a corner those that meet there.
template <typename See>
void BetweenFinder::for_each_edge_of(const SurfaceContact &contact, See see) const
{
  if (contact.feature == OnSurface::kEdge)
    see(surface_.edges()[contact.index]);
  else
    for (const int edge : surface_.edges_at(contact.index)) see(surface_.edges()[edge]);
}

void BetweenFinder::join_neighbours(size_t ends)
{
  const size_t count = contacts_.size();
  ends_ = ends;
  is_nearest_.clear();
  overlaps_.clear();
  for (size_t k = ends; k < count; k++) {
    is_nearest_.push_back(contacts_[k].weight == 1.0);
    overlaps_.push_back(rod_.radius - contacts_[k].distance);
  }
  joined_to_.assign(count - ends, -1);
  joined_.assign(count - ends, 0.0);
  for (size_t k = ends; k < count; k++)
    for (size_t n = k + 1; n < count; n++)
      if (contacts_[k].weight > 0.0 && contacts_[n].weight > 0.0 && is_smooth(contacts_[k]) &&
          is_smooth(contacts_[n])) {
        const bool k_is_deeper = overlap(k) >= overlap(n);
        join(k_is_deeper ? k : n, k_is_deeper ? n : k);
      }
}

// Of the axis in the facet beside both, across their edges: the sine of its angle with them; 0 if there is none.
double BetweenFinder::inclination_of_common_facet(const SurfaceContact &a,
                                                  const SurfaceContact &b) const
{
  double found = 0.0;
  for_each_edge_of(a, [&](const SurfaceEdge &one) {
    for (const TrianglePart &side : one.beside)
      for_each_edge_of(b, [&](const SurfaceEdge &other) {
        for (const TrianglePart &of_other : other.beside)
          if (surface_.facet(side.triangle) == surface_.facet(of_other.triangle))
            found = std::max({found, std::fabs(dot(axis_.axis, inwards_of(side))),
                              std::fabs(dot(axis_.axis, inwards_of(of_other)))});
      });
  });
  return found;
}

void BetweenFinder::join(size_t nearest, size_t rim)
{
  SurfaceContact &one = contacts_[nearest], &other = contacts_[rim];
  const double crossing = inclination_of_common_facet(one, other);
  if (crossing == 0.0 || !(dot(one.normal, other.normal) > 0.0)) return;
  double turn = pi;
  for (const SurfaceContact *contact : {&one, &other})
    for_each_edge_of(*contact, [&](const SurfaceEdge &edge) { turn = std::min(turn, edge.turn); });
  const double width = 0.5 * crossing * turn * std::fabs(one.along - other.along);
  const double difference = overlap(nearest) - overlap(rim);
  // Facets that turn by more than the rod is pressed into them are a polygon, whose edges bear for themselves.
  const double joined = std::clamp(2.0 - width / overlap(nearest), 0.0, 1.0);
  if (!(overlap(rim) > 0.0) || joined == 0.0) return;
  // The deeper one may have a neighbour on either side, the other has this one.
  const double part = difference < width ? 0.5 - 0.5 * difference / width : 0.0;
  const double more = joined * (width * part * (1.0 - part) - part * difference);
  other.weight = joined * part + (1.0 - joined) * other.weight;
  other.distance -= joined * difference + more;
  one.weight = std::max(0.0, one.weight - joined * part);
  one.distance -= more;
  for (const size_t k : {nearest, rim}) {
    joined_to_[k - ends_] = static_cast<int>(k == rim ? nearest : rim);
    joined_[k - ends_] = std::max(joined_[k - ends_], joined);
  }
}

// Along the contact's normal, by the end's own contact with the patch; 0 of one that has none (m).
double BetweenFinder::overlap_at_end(const SurfaceContact &contact, OnRod end, size_t ends) const
{
  double deepest = 0.0;
  for (size_t k = 0; k < ends; k++) {
    const SurfaceContact &own = contacts_[k];
    if (own.place != end || !(own.weight > 0.0) ||
        surface_.patch(own.triangle) != surface_.patch(contact.triangle))
      continue;
    deepest = std::max(deepest, (rod_.radius - own.distance) * nearness_of_normals(own, contact));
  }
  return deepest;
}

double BetweenFinder::standing_out(size_t k, size_t ends) const
{
  const SurfaceContact &contact = contacts_[k];
  const double own = overlap(k);
  if (!(own > 0.0)) return 1.0;
  const double part = 0.5 + 0.5 * contact.along / axis_.half_length;
  const double between_ends = (1.0 - part) * overlap_at_end(contact, OnRod::kEndMinus, ends) +
                              part * overlap_at_end(contact, OnRod::kEndPlus, ends);
  return std::clamp((own - between_ends) / own, 0.0, 1.0);
}

double BetweenFinder::nearness(const SurfaceContact &a, const SurfaceContact &b) const
{
  const double apart = std::fabs(a.along - b.along);
  if (apart >= rod_.radius) return 0.0;
  return (1.0 - apart / rod_.radius) * nearness_of_normals(a, b);
}

void BetweenFinder::share_between(size_t ends)
{
  const size_t count = contacts_.size();
  std::vector<double> shares(count, 0.0);
  for (size_t k = ends; k < count; k++) {
    const SurfaceContact &contact = contacts_[k];
    if (!(contact.weight > 0.0)) continue;
    double all = std::max(contact.weight, joined_[k - ends]), left = 1.0;
    for (size_t other = ends; other < count; other++) {
      if (other == k) continue;
      const bool are_joined = joined_to_[k - ends] == static_cast<int>(other) ||
                              joined_to_[other - ends] == static_cast<int>(k);
      const double apart =
          are_joined ? 1.0 - std::min(joined_[k - ends], joined_[other - ends]) : 1.0;
      const double near = apart * contacts_[other].weight * nearness(contact, contacts_[other]);
      if (is_nearest(other) == is_nearest(k))
        all += near;
      else if (is_nearest(other))
        left = std::min(left, 1.0 - near);
    }
    const double gentle = gentleness(contact);
    shares[k] = left * contact.weight / std::max(1.0, all) *
                (bears_[k - ends] - (1.0 - gentle) * (1.0 - left_by_ends(contact, ends)));
  }
  for (size_t k = ends; k < count; k++) contacts_[k].weight = shares[k];
}

double BetweenFinder::left_by_ends(const SurfaceContact &contact, size_t ends) const
{
  const double overlap = rod_.radius - contact.distance;
  if (!(overlap > 0.0)) return 1.0;
  double left = 1.0, at_edge = 0.0;
  for (size_t k = 0; k < ends; k++) {
    const SurfaceContact &end = contacts_[k];
    if (!(end.weight > 0.0)) continue;
    const double of_end = rod_.radius - end.distance;
    left *= 1.0 - std::min(1.0, of_end / overlap) * end.weight * nearness(contact, end);
    if (are_at_one_edge(contact, end)) at_edge += end.weight * of_end / overlap;
  }
  return std::min(left, std::max(0.0, 1.0 - at_edge));
}

bool BetweenFinder::are_at_one_edge(const SurfaceContact &a, const SurfaceContact &b) const
{
  if (a.feature == OnSurface::kFace || b.feature == OnSurface::kFace) return false;
  if (a.feature == b.feature) return a.index == b.index;
  const SurfaceContact &edge = a.feature == OnSurface::kEdge ? a : b;
  const SurfaceContact &corner = a.feature == OnSurface::kEdge ? b : a;
  const auto &nodes = surface_.edges()[edge.index].nodes;
  return nodes[0] == corner.index || nodes[1] == corner.index;
}

}  // namespace spherocylinder
