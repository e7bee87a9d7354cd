// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "core/box_tree.h"
#include "core/triangle_surface.h"

namespace LAMMPS_NS {

class Domain;
class FixMeshSurface;
template <typename T, int NUM_VEC, int LEN_VEC>
class MultiVectorContainer;

// LIGGGHTS's mesh as rods meet it: the triangles that this rank owns and those near them (ghosts), as one
// surface, with their velocities.
class MeshSurface {
 public:
  MeshSurface(FixMeshSurface &fix, Domain &domain) : fix_(&fix), domain_(&domain) {}

  FixMeshSurface &fix() const { return *fix_; }

  // LIGGGHTS may have given this rank other triangles, or put them elsewhere.
  void read();
  // Once a step: to where a moving mesh is now.
  void follow();

  const spherocylinder::TriangleSurface &surface() const { return surface_; }
  const spherocylinder::BoxTree &triangle_boxes() const { return triangle_boxes_; }
  const spherocylinder::BoxTree &edge_boxes() const { return edge_boxes_; }
  const spherocylinder::BoxTree &corner_boxes() const { return corner_boxes_; }

  // LIGGGHTS's number, and the triangle of this rank that has it, -1 if none: across a periodic
  // boundary there may be several, of which the one nearest to `point`.
  int id(int triangle) const { return ids_[triangle]; }
  int triangle_of(int id, const spherocylinder::Vec3 &point) const;

  // Of a way between two points of a box the shortest one through its periodic faces.
  spherocylinder::Vec3 shortest_image(const spherocylinder::Vec3 &way) const;

  // Of the surface at a point of it (m/s).
  spherocylinder::Vec3 velocity(int triangle, const spherocylinder::Vec3 &point) const;

  // How far any corner has come since keep_place(), and another number each time that was called or the
  // triangles are others (m).
  double shift() const { return shift_; }
  int version() const { return version_; }
  // Another number each time that triangles have other places in surface().
  int topology() const { return topology_; }
  void keep_place();
  // How far any corner came in the last step (m): of triangles that this rank had before, if read().
  double step() const { return step_; }

 private:
  FixMeshSurface *fix_;
  Domain *domain_;
  std::vector<int> ids_;
  std::vector<spherocylinder::Corners> corners_, kept_;
  std::unordered_multimap<int, int> triangles_;  // by id
  spherocylinder::TriangleSurface surface_;
  spherocylinder::BoxTree triangle_boxes_, edge_boxes_, corner_boxes_;
  MultiVectorContainer<double, 3, 3> *velocities_ = nullptr;  // LIGGGHTS's; null of a mesh at rest
  double shift_ = 0.0, step_ = 0.0;
  int version_ = 0, topology_ = 0;

  void find_velocities();
  double step_of_same_triangles(const std::vector<int> &ids,
                                const std::vector<spherocylinder::Corners> &corners) const;
  void read_corners(std::vector<spherocylinder::Corners> &corners) const;
  // Of a surface that is the same elsewhere the trees stay as they are, or all are new.
  void make_trees(bool are_new);
};

}  // namespace LAMMPS_NS
