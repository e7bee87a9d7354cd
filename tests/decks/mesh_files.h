// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles for mesh walls: flat and folded sheets, boxes, tubes; and STL files of them, exact to the
// last bit. Space frame, SI units.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace decks {

using spherocylinder::Vec3;
using MeshTriangle = std::array<Vec3, 3>;
using Mesh = std::vector<MeshTriangle>;

// Any sheet over two parameters is one of these, bent afterwards.
using Place = std::function<Vec3(double, double)>;

// A parallelogram from `corner` along a and b.
struct Sheet {
  Vec3 corner, a, b;
  Vec3 at(double s, double t) const { return corner + s * a + t * b; }
};

// na x nb cells, each of two triangles, all with the same diagonal; for a surface over the unit square.
Mesh tiled(const Place &place, int na, int nb);
Mesh tiled(const Sheet &sheet, int na, int nb);

// Cells of any size, each cut `cuts` times across its longer side at any place, so that corners lie in the
// middle of other triangles' edges; either diagonal.
Mesh randomly_tiled(const Sheet &sheet, int cuts, unsigned seed);

// The six faces of a box, n x n cells each.
Mesh box_mesh(const Vec3 &low, const Vec3 &high, int n);

// n plates inscribed in a cylinder about z, from z0 to z1 in m rings; with `first` the angle of the first
// corner (rad).
Mesh tube_mesh(double radius, double z0, double z1, int n, int m, double first = 0.0);

Mesh joined(const std::vector<Mesh> &parts);
Mesh transformed(const Mesh &mesh, const std::function<Vec3(const Vec3 &)> &map);

// An ASCII file with 17 digits: the program reads the very numbers.
std::string stl(const Mesh &mesh);

// fix mesh/surface of a file, and a wall of rods of such meshes. `keywords` of either.
std::string mesh_fix(const std::string &id, const std::string &file,
                     const std::string &keywords = "", const std::string &style = "mesh/surface");
std::string mesh_wall(const std::string &id, const std::string &models,
                      const std::vector<std::string> &meshes, const std::string &keywords = "");

}  // namespace decks
