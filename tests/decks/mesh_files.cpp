// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_files.h"

#include <cmath>
#include <random>

#include <fmt/format.h>

namespace decks {

namespace {

void add_cell(Mesh &mesh, const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d,
              bool other_diagonal = false)
{
  if (other_diagonal) {
    mesh.push_back({a, b, d});
    mesh.push_back({b, c, d});
  } else {
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
  }
}

struct Cell {
  double s0, s1, t0, t1;
};

}  // namespace

Mesh tiled(const Place &place, int na, int nb)
{
  Mesh mesh;
  for (int i = 0; i < na; i++)
    for (int j = 0; j < nb; j++) {
      const double s0 = static_cast<double>(i) / na, s1 = (i + 1.0) / na;
      const double t0 = static_cast<double>(j) / nb, t1 = (j + 1.0) / nb;
      add_cell(mesh, place(s0, t0), place(s1, t0), place(s1, t1), place(s0, t1));
    }
  return mesh;
}

Mesh tiled(const Sheet &sheet, int na, int nb)
{
  return tiled([&](double s, double t) { return sheet.at(s, t); }, na, nb);
}

Mesh randomly_tiled(const Sheet &sheet, int cuts, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.35, 0.65);
  std::vector<Cell> cells = {{0.0, 1.0, 0.0, 1.0}};
  for (int cut = 0; cut < cuts; cut++) {
    const size_t count = cells.size();
    for (size_t k = 0; k < count; k++) {
      Cell other = cells[k];
      const double p = part(random);
      const double along_a = (other.s1 - other.s0) * norm(sheet.a);
      const double along_b = (other.t1 - other.t0) * norm(sheet.b);
      if (along_a > along_b) {
        other.s0 = cells[k].s1 = cells[k].s0 + p * (cells[k].s1 - cells[k].s0);
      } else {
        other.t0 = cells[k].t1 = cells[k].t0 + p * (cells[k].t1 - cells[k].t0);
      }
      cells.push_back(other);
    }
  }
  Mesh mesh;
  for (const Cell &c : cells)
    add_cell(mesh, sheet.at(c.s0, c.t0), sheet.at(c.s1, c.t0), sheet.at(c.s1, c.t1),
             sheet.at(c.s0, c.t1), random() % 2);
  return mesh;
}

Mesh box_mesh(const Vec3 &low, const Vec3 &high, int n)
{
  const Vec3 x = {high.x - low.x, 0.0, 0.0}, y = {0.0, high.y - low.y, 0.0},
             z = {0.0, 0.0, high.z - low.z};
  return joined({tiled({low, x, y}, n, n), tiled({low, y, z}, n, n), tiled({low, z, x}, n, n),
                 tiled({low + z, x, y}, n, n), tiled({low + x, y, z}, n, n),
                 tiled({low + y, z, x}, n, n)});
}

Mesh tube_mesh(double radius, double z0, double z1, int n, int m, double first)
{
  const double pi = std::acos(-1.0);
  const auto place = [&](double s, double t) {
    // The last corner is the first, to the last bit.
    const double turn = s < 1.0 ? first + 2.0 * pi * s : first;
    return Vec3{radius * std::cos(turn), radius * std::sin(turn), z0 + t * (z1 - z0)};
  };
  return tiled(place, n, m);
}

Mesh joined(const std::vector<Mesh> &parts)
{
  Mesh all;
  for (const Mesh &part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Mesh transformed(const Mesh &mesh, const std::function<Vec3(const Vec3 &)> &map)
{
  Mesh moved = mesh;
  for (MeshTriangle &triangle : moved)
    for (Vec3 &corner : triangle) corner = map(corner);
  return moved;
}

std::string stl(const Mesh &mesh)
{
  std::string text = "solid mesh\n";
  for (const MeshTriangle &triangle : mesh) {
    const Vec3 n = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double length = norm(n);
    text += fmt::format("facet normal {:.17g} {:.17g} {:.17g}\nouter loop\n", n.x / length,
                        n.y / length, n.z / length);
    for (const Vec3 &corner : triangle)
      text += fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", corner.x, corner.y, corner.z);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid mesh\n";
}

std::string mesh_fix(const std::string &id, const std::string &file, const std::string &keywords,
                     const std::string &style)
{
  return fmt::format("fix {} all {} file {} type 1 {}\n", id, style, file, keywords);
}

std::string mesh_wall(const std::string &id, const std::string &models,
                      const std::vector<std::string> &meshes, const std::string &keywords)
{
  std::string names;
  for (const std::string &mesh : meshes) names += " " + mesh;
  return fmt::format(
      "fix {} all wall/gran model {} surface spherocylinder mesh n_meshes {} meshes{} {}\n", id,
      models, meshes.size(), names, keywords);
}

}  // namespace decks
