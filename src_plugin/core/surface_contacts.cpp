// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/surface_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/closest_points.h"

namespace spherocylinder {

namespace {

// Where features meet, both are asked as far as this (over the rod's radius) beyond their own bounds, so
// that neither rounding nor the turn of flat facets leaves a gap: what both find is one contact.
constexpr double kSeam = kFlatTurn;
// Two seams to either side: places nearer to each other than this many of them are one.
constexpr double kOnePlace = 4.0;

// Coordinates in a triangle's plane.
struct Rectangle {
  Vec3 origin, across_edge, along_edge;

  Rectangle(const TriangleShape &shape, int edge)
      : origin(shape.corners[0]),
        across_edge(shape.inwards[edge]),
        along_edge(cross(shape.inwards[edge], shape.normal))
  {
  }
  double across(const Vec3 &point) const { return dot(point - origin, across_edge); }
  double along(const Vec3 &point) const { return dot(point - origin, along_edge); }
};

// An end at an edge or corner has a contact of its own where the axis is nearest there. Where the axis comes
// nearer farther in, as it does at the contact between the ends, the end's fades out with the sine of the
// angle at which it does: a rod that lies along a ridge has both ends on it in spite of small tilts.
constexpr double kComesNearer = 0.01;

class Finder {
 public:
  Finder(const Capsule &rod, const TriangleSurface &surface, const NearFeatures &near,
         const std::vector<RememberedSide> &remembered, std::vector<SurfaceContact> &contacts)
      : rod_(rod),
        axis_(rod.segment),
        surface_(surface),
        near_(near),
        remembered_(remembered),
        contacts_(contacts),
        seam_(std::max(kSeam * rod.radius, surface.one_node()))
  {
  }

  void find()
  {
    contacts_.clear();
    find_of_end(OnRod::kEndMinus);
    if (axis_.half_length > 0.0) {
      find_of_end(OnRod::kEndPlus);
      const size_t ends = contacts_.size();
      for (const int edge : near_.edges) add_between_at_edge(edge);
      for (const int corner : near_.corners) add_between_at_corner(corner);
      if (contacts_.size() > ends) {
        drop_twins(ends);
        fade_ends(ends);
        share_between(ends);
      }
    }
    const auto is_nothing = [](const SurfaceContact &contact) { return !(contact.weight > 0.0); };
    contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), is_nothing),
                    contacts_.end());
  }

 private:
  const Capsule &rod_;
  const Segment &axis_;
  const TriangleSurface &surface_;
  const NearFeatures &near_;
  const std::vector<RememberedSide> &remembered_;
  std::vector<SurfaceContact> &contacts_;
  const double seam_;                // m
  std::vector<int> nearest_within_;  // edges that the axis is nearest to between both's ends

  // What bears a contact: of an edge or a corner one of its triangles.
  struct Bearer {
    OnSurface feature;
    int index, triangle, part;
  };
  static Bearer face(int triangle) { return {OnSurface::kFace, triangle, triangle, 0}; }
  Bearer corner(int node) const
  {
    return {OnSurface::kCorner, node, surface_.triangle_at(node), 4 + surface_.own_corner_at(node)};
  }
  // `place`: over the edge's length; `nth`: of the facets beside it.
  Bearer edge(int index, double place, int nth = 0) const
  {
    const auto &pieces = surface_.edges()[index].pieces;
    size_t k = 0;
    while (k + 1 < pieces.size() && place > pieces[k].end) k++;
    const TrianglePart &part = pieces[k].beside[nth];
    return {OnSurface::kEdge, index, part.triangle, 1 + part.number};
  }

  void add(OnRod place, const Bearer &bearer, double along, const Vec3 &normal, double distance,
           double weight = 1.0)
  {
    contacts_.push_back({place, bearer.feature, bearer.index, bearer.triangle, bearer.part, along,
                         normal, distance, weight});
  }

  // Adds a contact whose surface point is `way` away from the rod's, on the remembered side.
  void add_by_way(OnRod place, const Bearer &bearer, double along, const Vec3 &way, bool passed)
  {
    const double distance = norm(way);
    if (distance == 0.0) return;
    const double sign = passed ? -1.0 : 1.0;
    add(place, bearer, along, (sign / distance) * way, sign * distance);
  }

  // Of an end's contact with this normal, where the axis comes nearer farther in.
  double kept_of_end(const Vec3 &normal, double along) const
  {
    const double outwards = dot(normal, axis_.axis) * (along < 0.0 ? -1.0 : 1.0);
    return std::min(1.0, std::max(0.0, 1.0 - outwards / kComesNearer));
  }

  // Whether the rod's point has gone through the edge or corner that it touched in the last step.
  bool has_passed(OnRod place, const Bearer &bearer, const Vec3 &way) const
  {
    for (const RememberedSide &memory : remembered_)
      if (memory.place == place && memory.triangle == bearer.triangle && memory.part == bearer.part)
        return dot(memory.normal, way) < 0.0;
    return false;
  }

  // Whether from here the surface falls away on all sides of an edge's point: `way` leads from it.
  bool stands_out(const SurfaceEdge &edge, const Vec3 &way) const
  {
    for (const TrianglePart &side : edge.beside)
      if (dot(way, inwards_of(side)) > seam_) return false;
    return true;
  }
  bool corner_stands_out(int corner, const Vec3 &way) const
  {
    const Vec3 &at = surface_.node(corner);
    for (const int other : surface_.nodes_around(corner)) {
      const Vec3 along = surface_.node(other) - at;
      if (dot(way, along) > seam_ * norm(along)) return false;
    }
    for (const TrianglePart &side : surface_.triangles_through(corner))
      if (dot(way, inwards_of(side)) > seam_) return false;
    return true;
  }
  const Vec3 &inwards_of(const TrianglePart &side) const
  {
    return surface_.shape(side.triangle).inwards[side.number];
  }

  // ---- ends -------------------------------------------------------------------------------------

  void find_of_end(OnRod place)
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

  // The facet's triangle over which the end is, -1 if none.
  int holder_of_foot(const NearFacet &facet, const int *triangles, const Vec3 &end) const
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
  // Only within a facet there may be a gap: edges are asked as far as the seam themselves.
  std::array<double, 3> margins(int triangle, double margin) const
  {
    const std::array<bool, 3> &flat = surface_.flat_edges(triangle);
    return {flat[0] ? margin : 0.0, flat[1] ? margin : 0.0, flat[2] ? margin : 0.0};
  }

  // 1 or -1 along the face's normal, 0 if nothing is known.
  double side_of_memory(OnRod place, int triangle) const
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
  bool is_pierced(int triangle) const
  {
    const std::vector<int> &pierced = near_.pierced;
    return std::find(pierced.begin(), pierced.end(), surface_.facet(triangle)) != pierced.end();
  }

  void add_over_face(OnRod place, int triangle, double along, const Vec3 &end)
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

  void add_at_edge(OnRod place, int index, double along, const Vec3 &end)
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

  void add_at_corner(OnRod place, int node, double along, const Vec3 &end)
  {
    const Vec3 way = end - surface_.node(node);
    if (norm_squared(way) > rod_.radius * rod_.radius) return;
    const bool passed = has_passed(place, corner(node), way);
    if (!corner_stands_out(node, passed ? -way : way)) return;
    add_by_way(place, corner(node), along, way, passed);
  }

  // Of contacts at one point of the surface that with the largest weight stays, of equal ones the nearest, of
  // equal ones the first.
  void drop_twins(size_t first)
  {
    for (size_t a = first; a < contacts_.size(); a++)
      for (size_t b = a + 1; b < contacts_.size(); b++) {
        SurfaceContact &one = contacts_[a], &other = contacts_[b];
        if (!(one.weight > 0.0) || !(other.weight > 0.0)) continue;
        const Vec3 between = one.on_surface(axis_) - other.on_surface(axis_);
        if (norm(between) > kOnePlace * seam_ ||
            std::fabs(one.along - other.along) > kOnePlace * seam_)
          continue;
        const bool other_stays =
            other.weight != one.weight ? other.weight > one.weight : other.distance < one.distance;
        (other_stays ? one : other).weight = 0.0;
      }
  }

  // A face that another one hides from the end, as the far side of a thin plate, does not touch it. Once
  // the end is through one, nothing is told of what it sees.
  void drop_hidden(size_t first, int which)
  {
    for (size_t k = first; k < contacts_.size(); k++)
      if (contacts_[k].distance < 0.0) return;
    for (size_t k = first; k < contacts_.size(); k++)
      if (is_face(k) && is_hidden(contacts_[k], which)) contacts_[k].weight = 0.0;
  }
  bool is_hidden(const SurfaceContact &contact, int which) const
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

  // Facets in a valley share one load: as their overlaps, and as how far each one's foot is from where it
  // meets the next. One that hardly touches changes nothing for the others.
  void share_valley(size_t first)
  {
    const size_t count = contacts_.size() - first;
    // How far two facets go together: wholly those that meet, others as the way between them bears.
    std::vector<double> together(count * count, 0.0);
    bool any = false;
    for (size_t a = 0; a < count; a++)
      for (size_t b = 0; b < count; b++)
        if (a != b && make_a_valley(first + a, first + b)) {
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
  double overlap(size_t k) const { return rod_.radius - contacts_[k].distance; }
  // 0 where this one's foot is where it meets the other, 1 if the other does not touch.
  double part_beside(size_t a, size_t b) const
  {
    const double own = from_valley(a, b), others = from_valley(b, a);
    const double part = own + others > 0.0 ? own / (own + others) : 0.5;
    return 1.0 - (1.0 - part) * (overlap(b) < overlap(a) ? overlap(b) / overlap(a) : 1.0);
  }
  // A foot's height over the other facet over the sine of the turn.
  double from_valley(size_t a, size_t b) const
  {
    const SurfaceContact &one = contacts_[a], &other = contacts_[b];
    const double sine = norm(cross(one.normal, other.normal));
    const double over =
        dot(one.on_surface(axis_) - surface_.shape(other.triangle).corners[0], other.normal);
    return sine > 0.0 ? std::max(0.0, over / sine) : 0.0;
  }
  bool is_face(size_t k) const
  {
    return contacts_[k].feature == OnSurface::kFace && contacts_[k].weight > 0.0;
  }
  bool make_a_valley(size_t a, size_t b) const
  {
    return is_face(a) && is_face(b) &&
           surface_.meet_smoothly(surface_.facet(contacts_[a].triangle),
                                  surface_.facet(contacts_[b].triangle));
  }

  // ---- between the ends -------------------------------------------------------------------------

  bool is_between(double along) const { return std::fabs(along) < axis_.half_length; }

  void add_between_at_edge(int index)
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

  // The axis comes from beyond the edge and goes down over this facet: its load at the rim.
  void add_over_rim(int index, int nth, const Segment &segment)
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
      add(OnRod::kBetween, bearer, along, normal, (passed ? -1.0 : 1.0) * std::fabs(height),
          weight);
  }

  void add_between_at_corner(int node)
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

  // An end at an edge or corner that the axis is nearest to, and one over a facet beside it: there it has what it
  // had at the edge, a radius from the edge its whole load.
  void fade_ends(size_t ends)
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
        end.weight *= 1.0 - beside * (1.0 - kept) * (1.0 - way_from(contacts_[k], end));
      }
    }
  }
  // Of an end's foot from the edge, over the radius: 0 at it, 1 from a radius on or anywhere else.
  double way_from(const SurfaceContact &between, const SurfaceContact &end) const
  {
    if (are_at_one_edge(between, end)) return 0.0;
    if (between.feature != OnSurface::kEdge || end.feature != OnSurface::kFace) return 1.0;
    const SurfaceEdge &edge = surface_.edges()[between.index];
    for (const TrianglePart &side : edge.beside)
      if (surface_.facet(side.triangle) == surface_.facet(end.triangle))
        return std::clamp(
            dot(end.on_surface(axis_) - surface_.node(edge.nodes[0]), inwards_of(side)) /
                rod_.radius,
            0.0, 1.0);
    return 1.0;
  }

  // How far two contacts are one, 0 to 1: by their distance along the axis, and by their normals.
  double nearness(const SurfaceContact &a, const SurfaceContact &b) const
  {
    const double apart = std::fabs(a.along - b.along);
    if (apart >= rod_.radius) return 0.0;
    return (1.0 - apart / rod_.radius) * std::max(0.0, dot(a.normal, b.normal));
  }

  // Of contacts of one kind, nearest or over a rim, each has its part; those over rims have what the nearest
  // leave.
  void share_between(size_t ends)
  {
    const size_t count = contacts_.size();
    std::vector<double> shares(count, 0.0);
    for (size_t k = ends; k < count; k++) {
      const SurfaceContact &contact = contacts_[k];
      if (!(contact.weight > 0.0)) continue;
      double all = contact.weight, left = 1.0;
      for (size_t other = ends; other < count; other++) {
        if (other == k) continue;
        const double near = contacts_[other].weight * nearness(contact, contacts_[other]);
        if (is_nearest(other) == is_nearest(k))
          all += near;
        else if (is_nearest(other))
          left = std::min(left, 1.0 - near);
      }
      shares[k] = left * contact.weight / std::max(1.0, all) * left_by_ends(contact, ends);
    }
    for (size_t k = ends; k < count; k++) contacts_[k].weight = shares[k];
  }
  // Over a rim a contact has less than its whole weight from the start, until share_between().
  bool is_nearest(size_t k) const { return contacts_[k].weight == 1.0; }

  // Of the load of a contact between the ends: what those of the ends do not bear already.
  double left_by_ends(const SurfaceContact &contact, size_t ends) const
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
  bool are_at_one_edge(const SurfaceContact &a, const SurfaceContact &b) const
  {
    if (a.feature == OnSurface::kFace || b.feature == OnSurface::kFace) return false;
    if (a.feature == b.feature) return a.index == b.index;
    const SurfaceContact &edge = a.feature == OnSurface::kEdge ? a : b;
    const SurfaceContact &corner = a.feature == OnSurface::kEdge ? b : a;
    const auto &nodes = surface_.edges()[edge.index].nodes;
    return nodes[0] == corner.index || nodes[1] == corner.index;
  }
};

// Of the rectangles along the first triangle's edges the smallest.
NearFacet narrowest(const TriangleSurface &surface, const int *triangles, NearFacet facet)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int edge = 0; edge < 3; edge++) {
    const Rectangle in(surface.shape(triangles[facet.first]), edge);
    double low[2] = {0.0, 0.0}, high[2] = {0.0, 0.0};
    for (int k = facet.first; k < facet.first + facet.count; k++)
      for (const Vec3 &corner : surface.shape(triangles[k]).corners) {
        const double at[2] = {in.across(corner), in.along(corner)};
        for (int d = 0; d < 2; d++) {
          low[d] = std::min(low[d], at[d]);
          high[d] = std::max(high[d], at[d]);
        }
      }
    const double area = (high[0] - low[0]) * (high[1] - low[1]);
    if (area >= smallest) continue;
    smallest = area;
    facet.edge = edge;
    std::copy_n(low, 2, facet.low);
    std::copy_n(high, 2, facet.high);
  }
  return facet;
}

}  // namespace

void group_facets(const TriangleSurface &surface, NearFeatures &near)
{
  for (int end = 0; end < 2; end++) {
    std::vector<int> &triangles = near.triangles[end];
    std::sort(triangles.begin(), triangles.end(), [&](int a, int b) {
      return std::pair(surface.facet(a), a) < std::pair(surface.facet(b), b);
    });
    near.facets[end].clear();
    const int count = static_cast<int>(triangles.size());
    for (int first = 0, next = 0; first < count; first = next) {
      while (next < count && surface.facet(triangles[next]) == surface.facet(triangles[first]))
        next++;
      near.facets[end].push_back(
          narrowest(surface, triangles.data(), {first, next - first, 0, {}, {}, first}));
    }
  }
}

void find_contacts(const Capsule &rod, const TriangleSurface &surface, const NearFeatures &near,
                   const std::vector<RememberedSide> &remembered,
                   std::vector<SurfaceContact> &contacts)
{
  Finder(rod, surface, near, remembered, contacts).find();
}

bool goes_through(const Segment &axis, const TriangleShape &triangle)
{
  const double from = triangle.height(axis.at(-axis.half_length));
  const double to = triangle.height(axis.at(axis.half_length));
  if ((from < 0.0) == (to < 0.0) || from == to) return false;
  const double part = from / (from - to);
  return triangle.holds_foot(axis.at((2.0 * part - 1.0) * axis.half_length), 0.0);
}

}  // namespace spherocylinder
