// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of a rod with a mesh, and what they add up to.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "core/surface_contacts.h"
#include "surface_reference.h"

using Contacts = std::vector<spherocylinder::SurfaceContact>;
using Memory = std::vector<spherocylinder::RememberedSide>;

// What nothing is remembered of and the axis goes through.
inline void add_pierced(const spherocylinder::Capsule &rod,
                        const spherocylinder::TriangleSurface &surface,
                        spherocylinder::NearFeatures &near)
{
  for (int t = 0; t < surface.count(); t++)
    if (goes_through(rod.segment, surface.shape(t))) near.pierced.push_back(surface.facet(t));
}

// All features of a surface, near or not.
inline spherocylinder::NearFeatures everything(const spherocylinder::TriangleSurface &surface)
{
  spherocylinder::NearFeatures near;
  for (int t = 0; t < surface.count(); t++)
    for (auto &triangles : near.triangles) triangles.push_back(t);
  group_facets(surface, near);
  for (size_t e = 0; e < surface.edges().size(); e++) near.edges.push_back(static_cast<int>(e));
  near.corners = surface.corner_nodes();
  return near;
}

inline Contacts contacts_of(const spherocylinder::Capsule &rod,
                            const spherocylinder::TriangleSurface &surface,
                            const Memory &memory = {})
{
  spherocylinder::NearFeatures near = everything(surface);
  if (memory.empty()) add_pierced(rod, surface, near);
  Contacts contacts;
  find_contacts(rod, surface, near, memory, contacts);
  return contacts;
}

// With no other features than those that the axis is nearer to than the radius.
inline Contacts near_contacts_of(const spherocylinder::Capsule &rod,
                                 const spherocylinder::TriangleSurface &surface, const Mesh &mesh,
                                 const Memory &memory = {})
{
  using namespace spherocylinder;
  const double r = rod.radius, reach = r * (1.0 + 1e-9), h = rod.segment.half_length;
  NearFeatures near;
  std::vector<bool> is_near(mesh.size());
  for (int t = 0; t < surface.count(); t++) {
    is_near[t] = distance_of_axis(rod.segment, {mesh[t]}, 2.0 * r) <= reach;
    if (!is_near[t]) continue;
    for (auto &triangles : near.triangles) triangles.push_back(t);
  }
  group_facets(surface, near);
  if (memory.empty()) add_pierced(rod, surface, near);
  for (size_t e = 0; e < surface.edges().size(); e++) {
    bool any = false;
    for (const SurfaceEdge::Piece &piece : surface.edges()[e].pieces)
      for (const TrianglePart &side : piece.beside) any = any || is_near[side.triangle];
    if (any) near.edges.push_back(static_cast<int>(e));
  }
  for (const int n : surface.corner_nodes()) {
    const double along = dot(surface.node(n) - rod.segment.centre, rod.segment.axis);
    const double held = along > h ? h : along < -h ? -h : along;
    if (norm(rod.segment.at(held) - surface.node(n)) <= reach) near.corners.push_back(n);
  }
  Contacts contacts;
  find_contacts(rod, surface, near, memory, contacts);
  return contacts;
}

inline Memory memory_of(const Contacts &contacts)
{
  Memory memory;
  for (const auto &contact : contacts)
    memory.push_back({contact.place, contact.triangle, contact.part, contact.normal});
  return memory;
}

// Of a force that grows with the overlap, and its moment about the rod's centre, over radii.
struct Load {
  spherocylinder::Vec3 force, moment;
};
inline Load load_of(const Contacts &contacts, const spherocylinder::Capsule &rod)
{
  using namespace spherocylinder;
  Load load{kZero, kZero};
  const double r = rod.radius;
  for (const SurfaceContact &contact : contacts) {
    const Vec3 force = (contact.weight * (r - contact.distance) / r) * contact.normal;
    load.force = load.force + force;
    load.moment = load.moment + cross((contact.along / r) * rod.segment.axis, force);
  }
  return load;
}
inline double difference(const Load &a, const Load &b, const spherocylinder::Capsule &rod)
{
  return norm(a.force - b.force) +
         norm(a.moment - b.moment) * rod.radius / (rod.segment.half_length + rod.radius);
}

// A pose and its contacts in C++, for messages.
inline std::string text_of(const spherocylinder::Capsule &rod)
{
  const auto &[centre, axis, half] = rod.segment;
  char text[400];
  std::snprintf(text, sizeof text,
                "Capsule{{{%.17g, %.17g, %.17g}, {%.17g, %.17g, %.17g}, %.17g}, %.17g}", centre.x,
                centre.y, centre.z, axis.x, axis.y, axis.z, half, rod.radius);
  return text;
}
inline std::string text_of(const Contacts &contacts)
{
  std::string all;
  for (const auto &c : contacts) {
    char text[300];
    std::snprintf(text, sizeof text,
                  "\n  %s at %s %d (triangle %d, part %d): along %.9g, normal (%.6g, %.6g, %.6g), "
                  "distance %.9g, weight %.9g",
                  c.place == spherocylinder::OnRod::kEndMinus  ? "end -"
                  : c.place == spherocylinder::OnRod::kEndPlus ? "end +"
                                                               : "between",
                  c.feature == spherocylinder::OnSurface::kFace   ? "face"
                  : c.feature == spherocylinder::OnSurface::kEdge ? "edge"
                                                                  : "corner",
                  c.index, c.triangle, c.part, c.along, c.normal.x, c.normal.y, c.normal.z,
                  c.distance, c.weight);
    all += text;
  }
  return all;
}

// How many poses of how many failed, and the first of them.
class Failures {
 public:
  void add(bool failed, const std::string &what)
  {
    poses_++;
    if (failed && count_++ == 0) first_ = what;
  }
  // A text that is made only of the first failure.
  template <class Text>
  auto add(bool failed, const Text &what) -> decltype(what(), void())
  {
    poses_++;
    if (failed && count_++ == 0) first_ = what();
  }
  int count() const { return count_; }
  std::string text() const
  {
    return std::to_string(count_) + " of " + std::to_string(poses_) + " poses, first " + first_;
  }

 private:
  int poses_ = 0, count_ = 0;
  std::string first_;
};
