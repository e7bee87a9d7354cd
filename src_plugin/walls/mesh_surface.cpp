// SPDX-License-Identifier: GPL-2.0-or-later
#include "walls/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "domain.h"
#include "fix_mesh_surface.h"
#include "host/private_members.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

double largest_step(const std::vector<Corners> &from, const std::vector<Corners> &to)
{
  double largest = 0.0;
  for (size_t t = 0; t < from.size(); t++)
    for (int k = 0; k < 3; k++) largest = std::max(largest, norm_squared(to[t][k] - from[t][k]));
  return std::sqrt(largest);
}

bool are_equal(const Vec3 &a, const Vec3 &b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool are_equal(const std::vector<Corners> &a, const std::vector<Corners> &b)
{
  for (size_t t = 0; t < a.size(); t++)
    for (int k = 0; k < 3; k++)
      if (!are_equal(a[t][k], b[t][k])) return false;
  return a.size() == b.size();
}

}  // namespace

void MeshSurface::read_corners(std::vector<Corners> &corners) const
{
  TriMesh &mesh = *fix_->triMesh();
  corners.resize(mesh.sizeLocal() + mesh.sizeGhost());
  for (size_t t = 0; t < corners.size(); t++)
    for (int k = 0; k < 3; k++) {
      double node[3];
      mesh.node(static_cast<int>(t), k, node);
      corners[t][k] = load(node);
    }
}

void MeshSurface::read()
{
  TriMesh &mesh = *fix_->triMesh();
  find_velocities();
  std::vector<int> ids(mesh.sizeLocal() + mesh.sizeGhost());
  for (size_t t = 0; t < ids.size(); t++) ids[t] = mesh.id(static_cast<int>(t));
  std::vector<Corners> corners;
  read_corners(corners);
  step_ = ids_.empty() ? 0.0 : step_of_same_triangles(ids, corners);
  if (ids == ids_ && are_equal(corners, corners_)) return;

  version_++;
  const bool are_the_same = ids == ids_;
  corners_ = std::move(corners);
  // A mesh that moved is the same surface elsewhere; one whose copies beyond a periodic boundary have
  // changed is not.
  if (are_the_same && mesh.isMoving()) {
    surface_.move_to(corners_);
  } else {
    topology_++;
    ids_ = std::move(ids);
    triangles_.clear();
    for (size_t t = 0; t < ids_.size(); t++) triangles_.emplace(ids_[t], static_cast<int>(t));
    surface_ = TriangleSurface(corners_, std::acos(std::min(1.0, cosine_of_curvature(mesh))));
  }
  make_trees(true);
  kept_ = corners_;
  shift_ = 0.0;
}

Vec3 MeshSurface::shortest_image(const Vec3 &way) const
{
  double shortest[3];
  store(way, shortest);
  domain_->minimum_image(shortest);
  return load(shortest);
}

// Triangles have other numbers on this rank now, or are copies beyond another face of the box: each is
// compared with the nearest of those that had its id, less the length of a periodic box.
double MeshSurface::step_of_same_triangles(const std::vector<int> &ids,
                                           const std::vector<Corners> &corners) const
{
  double largest = 0.0;
  for (size_t t = 0; t < ids.size(); t++) {
    double nearest = std::numeric_limits<double>::infinity();
    const auto range = triangles_.equal_range(ids[t]);
    for (auto then = range.first; then != range.second; ++then) {
      double farthest = 0.0;
      for (int k = 0; k < 3; k++) {
        const Vec3 way = corners[t][k] - corners_[then->second][k];
        farthest = std::max(farthest, norm_squared(shortest_image(way)));
      }
      nearest = std::min(nearest, farthest);
    }
    if (range.first != range.second) largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

// Once a step, not at each contact: a mover brings them when it begins to move.
void MeshSurface::find_velocities()
{
  velocities_ = fix_->triMesh()->prop().getElementProperty<MultiVectorContainer<double, 3, 3>>("v");
}

void MeshSurface::follow()
{
  find_velocities();
  if (!fix_->triMesh()->isMoving()) return;
  std::vector<Corners> corners;
  read_corners(corners);
  if (corners.size() != corners_.size()) {
    read();
    return;
  }
  step_ = largest_step(corners_, corners);
  corners_ = std::move(corners);
  surface_.move_to(corners_);
  shift_ = largest_step(kept_, corners_);
}

void MeshSurface::keep_place()
{
  if (shift_ == 0.0) return;
  version_++;
  kept_ = corners_;
  shift_ = 0.0;
  make_trees(false);
}

void MeshSurface::make_trees(bool are_new)
{
  std::vector<Box> triangles, edges, corners;
  for (const Corners &c : corners_)
    triangles.push_back(united(around(c[0], c[1]), around(c[2], c[2])));
  for (const SurfaceEdge &edge : surface_.edges())
    edges.push_back(around(surface_.node(edge.nodes[0]), surface_.node(edge.nodes[1])));
  for (const int corner : surface_.corner_nodes())
    corners.push_back(around(surface_.node(corner), surface_.node(corner)));
  const auto put = [are_new](BoxTree &tree, const std::vector<Box> &boxes) {
    if (are_new)
      tree = BoxTree(boxes);
    else
      tree.move_to(boxes);
  };
  put(triangle_boxes_, triangles);
  put(edge_boxes_, edges);
  put(corner_boxes_, corners);
}

int MeshSurface::triangle_of(int id, const Vec3 &point) const
{
  int nearest = -1;
  double nearest_distance = 0.0;
  const auto range = triangles_.equal_range(id);
  for (auto found = range.first; found != range.second; ++found) {
    const double distance = norm_squared(surface_.shape(found->second).centre() - point);
    if (nearest >= 0 && distance >= nearest_distance) continue;
    nearest = found->second;
    nearest_distance = distance;
  }
  return nearest;
}

Vec3 MeshSurface::velocity(int triangle, const Vec3 &point) const
{
  if (!velocities_) return kZero;
  double **of_corners = velocities_->begin()[triangle];
  const std::array<double, 3> weights = barycentric(surface_.shape(triangle), point);
  return weights[0] * load(of_corners[0]) + weights[1] * load(of_corners[1]) +
         weights[2] * load(of_corners[2]);
}
