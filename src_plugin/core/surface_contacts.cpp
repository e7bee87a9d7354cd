// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/closest_points.h"

namespace spherocylinder {

namespace {

// Where features meet, both are asked as far as this (over the rod's radius) beyond their own bounds, so
// that neither rounding nor the turn of flat facets leaves a gap: what both find is one contact.
constexpr double kSeam = kFlatTurn;

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
        seam_(kSeam * rod.radius)
  {
  }

  void find()
  {
    contacts_.clear();
    if (axis_.half_length == 0.0) {
      find_of_end(OnRod::kEndMinus);
    } else {
      find_of_end(OnRod::kEndMinus);
      find_of_end(OnRod::kEndPlus);
      const size_t ends = contacts_.size();
      for (const int edge : near_.edges) add_between_at_edge(edge);
      for (const int corner : near_.corners) add_between_at_corner(corner);
      give_way_to_ends(ends);
      share_facets(ends);
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
  const double seam_;

  // Which side of a face an end is on that touched its smooth surface in the last step: 1 or -1 along the
  // face's normal, 0 if nothing is known.
  double side_of_memory(OnRod place, int triangle) const
  {
    for (const RememberedSide &memory : remembered_) {
      if (memory.place != place || surface_.patch(memory.triangle) != surface_.patch(triangle))
        continue;
      const double along = dot(memory.normal, surface_.shape(memory.triangle).normal);
      if (along != 0.0)
        return (along < 0.0 ? -1.0 : 1.0) * surface_.orientation(memory.triangle) *
               surface_.orientation(triangle);
    }
    return 0.0;
  }

  // What bears a contact: of an edge or a corner one of its triangles.
  struct Bearer {
    OnSurface feature;
    int index, triangle, part;
  };
  static Bearer face(int triangle) { return {OnSurface::kFace, triangle, triangle, 0}; }
  Bearer edge(int index, int nth_triangle = 0) const
  {
    const SurfaceEdge &edge = surface_.edges()[index];
    return {OnSurface::kEdge, index, edge.triangles[nth_triangle],
            1 + edge.own_edges[nth_triangle]};
  }
  Bearer corner(int node) const
  {
    return {OnSurface::kCorner, node, surface_.triangle_at(node),
            4 + surface_.own_corner_at(node)};
  }

  void add(OnRod place, const Bearer &bearer, double along, const Vec3 &normal, double distance,
           double weight = 1.0)
  {
    contacts_.push_back({place, bearer.feature, bearer.index, bearer.triangle, bearer.part, along,
                         normal, distance, weight});
  }

  // Whether from here the surface falls away on all sides of an edge's point: `way` leads from it.
  bool stands_out(const SurfaceEdge &edge, const Vec3 &way) const
  {
    for (const int triangle : edge.triangles)
      if (dot(way, inwards_of(edge, triangle)) > seam_) return false;
    return true;
  }
  bool corner_stands_out(int corner, const Vec3 &way) const
  {
    const Vec3 &at = surface_.node(corner);
    for (const int other : surface_.nodes_around(corner)) {
      const Vec3 along = surface_.node(other) - at;
      if (dot(way, along) > seam_ * norm(along)) return false;
    }
    return true;
  }

  // In the triangle's plane, at right angles to an edge that may be a part of its own.
  Vec3 inwards_of(const SurfaceEdge &edge, int triangle) const
  {
    const Vec3 along = surface_.node(edge.nodes[1]) - surface_.node(edge.nodes[0]);
    const TriangleShape &shape = surface_.shape(triangle);
    const Vec3 across = cross(shape.normal, along);
    const Vec3 middle =
        (1.0 / 3.0) * (shape.corners[0] + shape.corners[1] + shape.corners[2]);
    const double sign = dot(middle - surface_.node(edge.nodes[0]), across) < 0.0 ? -1.0 : 1.0;
    return (sign / norm(across)) * across;
  }

  // Adds a contact whose surface point is `way` away from the rod's, on the remembered side.
  void add_by_way(OnRod place, const Bearer &bearer, double along, const Vec3 &way, bool passed)
  {
    const double distance = norm(way);
    if (distance == 0.0) return;
    const double sign = passed ? -1.0 : 1.0;
    add(place, bearer, along, (sign / distance) * way, sign * distance);
  }

  // Whether the rod's point has gone through the edge or corner that it touched in the last step.
  bool has_passed(OnRod place, const Bearer &bearer, const Vec3 &way) const
  {
    for (const RememberedSide &memory : remembered_)
      if (memory.place == place && memory.triangle == bearer.triangle &&
          memory.part == bearer.part)
        return dot(memory.normal, way) < 0.0;
    return false;
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
    drop_twins(first);
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
        if (surface_.shape(triangles[k]).holds_foot(end, margin)) {
          facet.last = k;
          return triangles[k];
        }
    return -1;
  }

  void add_over_face(OnRod place, int triangle, double along, const Vec3 &end)
  {
    const TriangleShape &shape = surface_.shape(triangle);
    const double height = shape.height(end);
    if (remembered_.empty() && std::fabs(height) > rod_.radius && !goes_through(axis_, shape))
      return;
    double side = side_of_memory(place, triangle);
    if (side == 0.0) {
      const bool goes = goes_through(axis_, shape);
      if (!goes && std::fabs(height) > rod_.radius) return;
      const double of_centre = shape.height(axis_.centre);
      side = (goes && of_centre != 0.0 ? of_centre : height) < 0.0 ? -1.0 : 1.0;
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
    const bool passed = has_passed(place, edge(index), way);
    if (!stands_out(surface_.edges()[index], passed ? -way : way)) return;
    add_by_way(place, edge(index), along, way, passed);
  }

  void add_at_corner(OnRod place, int node, double along, const Vec3 &end)
  {
    const Vec3 way = end - surface_.node(node);
    if (norm_squared(way) > rod_.radius * rod_.radius) return;
    const bool passed = has_passed(place, corner(node), way);
    if (!corner_stands_out(node, passed ? -way : way)) return;
    add_by_way(place, corner(node), along, way, passed);
  }

  // Of contacts at one point of the surface the nearest stays, of equal ones the first.
  void drop_twins(size_t first)
  {
    for (size_t a = first; a < contacts_.size(); a++)
      for (size_t b = first; b < contacts_.size(); b++) {
        if (a == b || !(contacts_[a].weight > 0.0) || !(contacts_[b].weight > 0.0)) continue;
        const Vec3 between = contacts_[a].on_surface(axis_) - contacts_[b].on_surface(axis_);
        if (norm(between) > 4.0 * seam_) continue;
        const double a_less_b = contacts_[a].distance - contacts_[b].distance;
        if (a_less_b > 0.0 || (a_less_b == 0.0 && a > b)) contacts_[a].weight = 0.0;
      }
  }

  // The share of a facet in a valley: how far its foot is from the line where it meets the next, which is
  // its height over that over the sine of the turn.
  void share_valley(size_t first)
  {
    const size_t count = contacts_.size();
    if (count - first < 2) return;
    std::vector<double> from_valley(count, -1.0);
    for (size_t a = first; a < count; a++)
      for (size_t b = first; b < count; b++) {
        if (a == b || !is_face(a) || !is_face(b)) continue;
        const SurfaceContact &one = contacts_[a], &other = contacts_[b];
        if (surface_.patch(one.triangle) != surface_.patch(other.triangle)) continue;
        const double sine = norm(cross(one.normal, other.normal));
        const Vec3 foot = one.on_surface(axis_);
        const double over =
            dot(foot - surface_.shape(other.triangle).corners[0], other.normal);
        const double way = std::max(0.0, sine > 0.0 ? over / sine : 0.0);
        from_valley[a] = from_valley[a] < 0.0 ? way : std::min(from_valley[a], way);
      }
    for (size_t a = first; a < count; a++) {
      if (from_valley[a] < 0.0) continue;
      double sum = 0.0;
      int members = 0;
      for (size_t b = first; b < count; b++) {
        if (from_valley[b] < 0.0 ||
            surface_.patch(contacts_[a].triangle) != surface_.patch(contacts_[b].triangle))
          continue;
        sum += from_valley[b];
        members++;
      }
      contacts_[a].weight = sum > 0.0 ? from_valley[a] / sum : 1.0 / members;
    }
  }
  bool is_face(size_t k) const
  {
    return contacts_[k].feature == OnSurface::kFace && contacts_[k].weight > 0.0;
  }

  // ---- between the ends -------------------------------------------------------------------------

  bool is_between(double along) const { return std::fabs(along) < axis_.half_length; }

  void add_between_at_edge(int index)
  {
    const Segment segment = surface_.segment(index);
    const ClosestPoints nearest = closest_points(axis_, segment);
    if (nearest.distance_squared > rod_.radius * rod_.radius) return;
    if (is_between(nearest.s) && std::fabs(nearest.t) < segment.half_length) {
      const bool passed = has_passed(OnRod::kBetween, edge(index), nearest.delta);
      if (stands_out(surface_.edges()[index], passed ? -nearest.delta : nearest.delta)) {
        add_by_way(OnRod::kBetween, edge(index), nearest.s, nearest.delta, passed);
        return;
      }
    }
    const int beside = static_cast<int>(surface_.edges()[index].triangles.size());
    for (int nth = 0; nth < beside; nth++) add_over_rim(index, nth, segment);
  }

  // The axis comes from beyond the edge and goes down over this triangle: its load at the rim.
  void add_over_rim(int index, int nth_triangle, const Segment &segment)
  {
    const SurfaceEdge &rim = surface_.edges()[index];
    const int triangle = rim.triangles[nth_triangle];
    const Vec3 inwards = inwards_of(rim, triangle);
    const double crossing = dot(axis_.axis, inwards);
    if (crossing == 0.0) return;
    const double along = dot(segment.centre - axis_.centre, inwards) / crossing;
    if (!is_between(along)) return;
    const Vec3 on_axis = axis_.at(along);
    const double on_edge = dot(on_axis - segment.centre, segment.axis);
    if (std::fabs(on_edge) > segment.half_length) return;

    const double height = dot(on_axis - segment.at(on_edge), surface_.shape(triangle).normal);
    if (std::fabs(height) > rod_.radius || height == 0.0) return;
    Vec3 normal = (height < 0.0 ? -1.0 : 1.0) * surface_.shape(triangle).normal;
    const bool passed = has_passed(OnRod::kBetween, edge(index, nth_triangle), normal);
    if (passed) normal = -normal;
    for (const int other : rim.triangles)
      if (other != triangle && dot(inwards_of(rim, other), normal) >= 0.0) return;  // a valley

    // Of the axis as it goes inwards, in the plane across the edge.
    const double down = -dot(axis_.axis, normal) * (crossing > 0.0 ? 1.0 : -1.0);
    const double tilt = std::atan2(down, std::fabs(crossing));
    if (tilt < 0.0) return;  // nearest at the edge itself, or beyond
    const double weight = 1.0 - tilt / (0.5 * rim.turn);
    if (weight > 0.0)
      add(OnRod::kBetween, edge(index, nth_triangle), along, normal,
          (passed ? -1.0 : 1.0) * std::fabs(height), weight);
  }

  void add_between_at_corner(int node)
  {
    const Vec3 &at = surface_.node(node);
    const double along = closest_position(axis_, at);
    if (!is_between(along)) return;
    const Vec3 way = axis_.at(along) - at;
    if (norm_squared(way) > rod_.radius * rod_.radius) return;
    const bool passed = has_passed(OnRod::kBetween, corner(node), way);
    if (!corner_stands_out(node, passed ? -way : way)) return;
    add_by_way(OnRod::kBetween, corner(node), along, way, passed);
  }

  // An end at the same edge or corner bears its part of the load itself.
  void give_way_to_ends(size_t ends)
  {
    for (size_t k = ends; k < contacts_.size(); k++) {
      const double overlap = rod_.radius - contacts_[k].distance;
      double of_ends = 0.0;
      for (size_t end = 0; end < ends; end++)
        if (contacts_[end].weight > 0.0 && are_at_one_edge(contacts_[end], contacts_[k]))
          of_ends += rod_.radius - contacts_[end].distance;
      if (of_ends > 0.0) contacts_[k].weight *= std::max(0.0, 1.0 - of_ends / overlap);
    }
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

  // Smooth edges of one facet share one load.
  void share_facets(size_t ends)
  {
    const size_t count = contacts_.size();
    if (count - ends < 2) return;
    std::vector<double> sums(count, 0.0);
    for (size_t a = ends; a < count; a++)
      for (size_t b = ends; b < count; b++)
        if (a == b || share_a_facet(contacts_[a], contacts_[b])) sums[a] += contacts_[b].weight;
    for (size_t a = ends; a < count; a++)
      if (sums[a] > 1.0) contacts_[a].weight /= sums[a];
  }
  bool share_a_facet(const SurfaceContact &a, const SurfaceContact &b) const
  {
    if (a.feature != OnSurface::kEdge || b.feature != OnSurface::kEdge) return false;
    const SurfaceEdge &one = surface_.edges()[a.index], &other = surface_.edges()[b.index];
    if (!one.is_smooth || !other.is_smooth) return false;
    for (const int t : one.triangles)
      for (const int u : other.triangles)
        if (surface_.facet(t) == surface_.facet(u)) return true;
    return false;
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
