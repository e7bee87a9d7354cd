// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/rods_near_mesh.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "core/closest_points.h"
#include "lists/rod_shifts.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

constexpr double kSkinInDiameters = 0.5;  // of the thickest rod at hand
constexpr double kUsedOfSkin = 0.99;      // the rest is for rounding

AtomVecSpherocylinder &style_of(const Atom &atom)
{
  return static_cast<AtomVecSpherocylinder &>(*atom.avec);
}

// Whether both ends are above both of two faces that make a valley seen from there: the edge between them
// does not stand out towards the rod, and cannot before an end has gone through a face.
bool is_in_valley(const TriangleSurface &surface, const SurfaceEdge &edge, const Segment &axis)
{
  if (edge.beside.size() != 2) return false;
  const TriangleShape &one = surface.shape(edge.beside[0].triangle);
  const TriangleShape &other = surface.shape(edge.beside[1].triangle);
  const Vec3 ends[2] = {axis.at(-axis.half_length), axis.at(axis.half_length)};
  // Of a valley each face rises above the other, on the side where it is one.
  const double of_other = one.height(other.centre()), of_one = other.height(one.centre());
  for (const Vec3 &end : ends)
    if (!(one.height(end) * of_other > 0.0) || !(other.height(end) * of_one > 0.0)) return false;
  return true;
}

}  // namespace

bool RodsNearMesh::renew(MeshSurface &mesh, int groupbit, int last_known_id, const Touched &touched)
{
  RodShifts &shifts = style_of(*atom).attached<RodShifts>();
  if (known_ && version_ == shifts.version() && mesh_version_ == mesh.version()) {
    const double nearer = shifts.farthest(longest_) + mesh.shift();
    if (nearer <= kUsedOfSkin * skin_) return false;
  }
  shifts.keep_poses();
  mesh.keep_place();
  version_ = shifts.version();
  mesh_version_ = mesh.version();

  double thickest = 0.0;
  longest_ = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *shape = atom->shape[i];
    thickest = std::max(thickest, 2.0 * shape[0]);
    longest_ = std::max(longest_, shape[2] - shape[0]);
  }
  skin_ = kSkinInDiameters * thickest;
  count_ = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (near_.size() == count_) near_.emplace_back();
    touched_.clear();
    touched(i, touched_);
    const Capsule rod = style_of(*atom).capsule(i);
    NearFeatures &features = near_[count_].features;
    features.pierced.clear();
    if (atom->tag[i] > last_known_id && touched_.empty())
      find_pierced(mesh, rod.segment, features.pierced);
    if (!find(mesh, rod, features)) continue;
    near_[count_++].rod = i;
  }
  known_ = true;
  return true;
}

void RodsNearMesh::find_pierced(const MeshSurface &mesh, const Segment &axis,
                                std::vector<int> &pierced)
{
  found_.clear();
  mesh.triangle_boxes().find(around(axis.at(-axis.half_length), axis.at(axis.half_length)), found_);
  for (const int triangle : found_)
    if (goes_through(axis, mesh.surface().shape(triangle)))
      pierced.push_back(mesh.surface().facet(triangle));
}

// Of facets that the end is through by more than the reach: a rare case, for which all their triangles are
// looked at.
void RodsNearMesh::add_deep(const TriangleSurface &surface, const Vec3 &end, double reach,
                            const std::vector<int> &pierced, std::vector<int> &triangles) const
{
  std::vector<int> deep;
  const auto note = [&](int triangle) {
    if (std::fabs(surface.shape(triangle).height(end)) > reach)
      deep.push_back(surface.facet(triangle));
  };
  for (const int triangle : touched_) note(triangle);
  for (const int facet : pierced) note(facet);  // which has the number of one of its triangles
  std::sort(deep.begin(), deep.end());
  deep.erase(std::unique(deep.begin(), deep.end()), deep.end());
  for (const int facet : deep) {
    int triangle = facet;
    do {
      if (surface.shape(triangle).holds_foot(end, reach)) triangles.push_back(triangle);
      triangle = surface.next_of_facet(triangle);
    } while (triangle != facet);
  }
}

bool RodsNearMesh::find(const MeshSurface &mesh, const Capsule &rod, NearFeatures &features)
{
  const Segment &axis = rod.segment;
  const TriangleSurface &surface = mesh.surface();
  const double reach = rod.radius + skin_;
  const Vec3 ends[2] = {axis.at(-axis.half_length), axis.at(axis.half_length)};
  for (int k = 0; k < 2; k++) {
    features.triangles[k].clear();
    add_deep(surface, ends[k], reach, features.pierced, features.triangles[k]);
    found_.clear();
    mesh.triangle_boxes().find(widened(around(ends[k], ends[k]), reach), found_);
    for (const int triangle : found_) {
      const TriangleShape &shape = surface.shape(triangle);
      if (std::fabs(shape.height(ends[k])) <= reach && shape.holds_foot(ends[k], reach))
        features.triangles[k].push_back(triangle);
    }
  }
  group_facets(surface, features);

  const Box box = widened(around(ends[0], ends[1]), reach);
  features.edges.clear();
  found_.clear();
  mesh.edge_boxes().find(box, found_);
  for (const int edge : found_)
    if (closest_points(axis, surface.segment(edge)).distance_squared <= reach * reach &&
        !is_in_valley(surface, surface.edges()[edge], axis))
      features.edges.push_back(edge);
  std::sort(features.edges.begin(), features.edges.end());

  features.corners.clear();
  found_.clear();
  mesh.corner_boxes().find(box, found_);
  for (const int found : found_) {
    const int corner = surface.corner_nodes()[found];
    const std::vector<int> &edges = surface.edges_at(corner);
    if (std::all_of(edges.begin(), edges.end(),
                    [&](int edge) { return is_in_valley(surface, surface.edges()[edge], axis); }))
      continue;
    const Vec3 &at = surface.node(corner);
    if (norm_squared(axis.at(closest_position(axis, at)) - at) <= reach * reach)
      features.corners.push_back(corner);
  }
  std::sort(features.corners.begin(), features.corners.end());
  return !features.triangles[0].empty() || !features.triangles[1].empty() ||
         !features.edges.empty() || !features.corners.empty();
}
