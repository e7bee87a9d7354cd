// SPDX-License-Identifier: GPL-2.0-or-later
// Closed meshes and STL files for the tests of the post-processors. Triangles face outwards.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "solid/clipped_volume.h"
#include "solid/prism_volume.h"

namespace spherocylinder {

using Triangles = std::vector<Triangle>;

inline void add_quadrangle(Triangles &mesh, const Vec3 &a, const Vec3 &b, const Vec3 &c,
                           const Vec3 &d)
{
  mesh.push_back({a, b, c});
  mesh.push_back({a, c, d});
}

inline Triangles box_mesh(const UprightBox &b)
{
  const auto at = [&](int i) {
    return Vec3{i & 1 ? b.x_high : b.x_low, i & 2 ? b.y_high : b.y_low, i & 4 ? b.z_high : b.z_low};
  };
  Triangles mesh;
  add_quadrangle(mesh, at(0), at(2), at(3), at(1));
  add_quadrangle(mesh, at(4), at(5), at(7), at(6));
  add_quadrangle(mesh, at(0), at(1), at(5), at(4));
  add_quadrangle(mesh, at(2), at(6), at(7), at(3));
  add_quadrangle(mesh, at(0), at(4), at(6), at(2));
  add_quadrangle(mesh, at(1), at(3), at(7), at(5));
  return mesh;
}

// A regular polygon of `facets` corners on circles of these radii at both ends, about the z axis.
inline Triangles cone_mesh(double low_radius, double high_radius, double z_low, double z_high,
                           int facets)
{
  const auto at = [&](int i, double radius, double z) {
    const double angle = 2.0 * std::acos(-1.0) * (i % facets) / facets;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  Triangles mesh;
  for (int i = 0; i < facets; i++) {
    add_quadrangle(mesh, at(i, low_radius, z_low), at(i + 1, low_radius, z_low),
                   at(i + 1, high_radius, z_high), at(i, high_radius, z_high));
    mesh.push_back({{0, 0, z_low}, at(i + 1, low_radius, z_low), at(i, low_radius, z_low)});
    mesh.push_back({{0, 0, z_high}, at(i, high_radius, z_high), at(i + 1, high_radius, z_high)});
  }
  return mesh;
}

inline Triangles turned_over(Triangles mesh)
{
  for (Triangle &t : mesh) std::swap(t.b, t.c);
  return mesh;
}

// Two surfaces as one: with the second turned over inside the first a body with a hollow.
inline Triangles both(Triangles a, const Triangles &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::string stl_text(const Triangles &mesh)
{
  std::string text = "solid test\n";
  for (const Triangle &t : mesh) {
    text += "facet normal 0 0 0\n outer loop\n";  // readers go by the order of the corners
    for (const Vec3 &p : {t.a, t.b, t.c})
      text += fmt::format("  vertex {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid test\n";
}

// Corners that are the same are shared.
inline vtkSmartPointer<vtkPolyData> poly_data_of(const Triangles &mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<Vec3> known;
  const auto id_of = [&](const Vec3 &p) {
    for (std::size_t i = 0; i < known.size(); i++)
      if (norm(known[i] - p) == 0.0) return static_cast<vtkIdType>(i);
    known.push_back(p);
    return points->InsertNextPoint(p.x, p.y, p.z);
  };
  vtkNew<vtkCellArray> cells;
  for (const Triangle &t : mesh) {
    cells->InsertNextCell(3);
    for (const Vec3 &p : {t.a, t.b, t.c}) cells->InsertCellPoint(id_of(p));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

}  // namespace spherocylinder
