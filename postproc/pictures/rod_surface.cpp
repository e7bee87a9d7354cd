// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/rod_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <vtkCapsuleSource.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include "core/numbers.h"
#include "pictures/fibre_surface.h"

namespace spherocylinder {
namespace {

// One capsule about the origin with its axis along y, as VTK makes it.
vtkSmartPointer<vtkPolyData> capsule_template(const Capsule &capsule, int resolution)
{
  vtkNew<vtkCapsuleSource> source;
  source->SetRadius(capsule.radius);
  source->SetCylinderLength(2.0 * capsule.segment.half_length);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

// Right-handed frame whose y axis is the rod's.
struct RodFrame {
  Vec3 x, y, z;

  explicit RodFrame(const Vec3 &axis) : y(axis)
  {
    const Vec3 aside = axis.z * axis.z < 0.5 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
    x = cross(axis, aside);
    x = (1.0 / norm(x)) * x;
    z = cross(x, y);
  }

  Vec3 turned(const double *p) const { return p[0] * x + p[1] * y + p[2] * z; }
};

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(int resolution) : resolution_(resolution)
  {
    normals_->SetName("Normals");
    normals_->SetNumberOfComponents(3);
    points_->SetDataTypeToFloat();
  }

  void add(const Capsule &capsule, vtkIdType index)
  {
    auto &shape = shapes_[{capsule.radius, capsule.segment.half_length}];
    if (!shape) shape = capsule_template(capsule, resolution_);
    const RodFrame frame(capsule.segment.axis);
    vtkDataArray *shape_normals = shape->GetPointData()->GetNormals();
    const vtkIdType first = points_->GetNumberOfPoints();
    for (vtkIdType i = 0; i < shape->GetNumberOfPoints(); i++) {
      const Vec3 p = capsule.segment.centre + frame.turned(shape->GetPoint(i));
      const Vec3 n = frame.turned(shape_normals->GetTuple3(i));
      points_->InsertNextPoint(p.x, p.y, p.z);
      normals_->InsertNextTuple3(n.x, n.y, n.z);
      geometry_.rod_of_point.push_back(index);
    }
    vtkIdType size;
    const vtkIdType *corners;
    vtkCellArray *triangles = shape->GetPolys();
    for (triangles->InitTraversal(); triangles->GetNextCell(size, corners);) {
      polygons_->InsertNextCell(static_cast<int>(size));
      for (vtkIdType i = 0; i < size; i++) polygons_->InsertCellPoint(first + corners[i]);
      geometry_.rod_of_cell.push_back(index);
    }
  }

  // Rings, joined by bands of triangles, and round ends.
  void add(const TubePart &part, double radius)
  {
    const int n = static_cast<int>(part.rings.size());
    if (part.begins) add_round_end(part.rings.front(), radius, part, true);
    vtkIdType before = -1;
    for (int k = 0; k < n; k++) {
      const double from_middle = (2.0 * k - (n - 1)) / (n - 1);  // -1 to 1
      const vtkIdType ring =
          add_circle(part.rings[k], radius, 0.0, part.rod,
                     from_middle < 0.0 ? part.before : part.after, 0.5 * std::abs(from_middle));
      if (k > 0) add_band(before, ring, part.rod);
      before = ring;
    }
    if (part.ends) add_round_end(part.rings.back(), radius, part, false);
  }

  // Has points for which no neighbour is said, too.
  void say_neighbours()
  {
    for (std::size_t k = geometry_.neighbour_of_point.size(); k < geometry_.rod_of_point.size();
         k++) {
      geometry_.neighbour_of_point.push_back(geometry_.rod_of_point[k]);
      geometry_.part_of_neighbour.push_back(0.0f);
    }
  }

  RodGeometry finish()
  {
    geometry_.mesh = vtkSmartPointer<vtkPolyData>::New();
    geometry_.mesh->SetPoints(points_);
    geometry_.mesh->SetPolys(polygons_);
    geometry_.mesh->GetPointData()->SetNormals(normals_);
    return std::move(geometry_);
  }

 private:
  // The circle of latitude of a ball about the ring's centre: 0 is the ring itself, above it towards
  // where the tube goes. Returns its first point.
  vtkIdType add_circle(const TubeRing &ring, double radius, double latitude, vtkIdType rod,
                       vtkIdType neighbour, double part)
  {
    const vtkIdType first = points_->GetNumberOfPoints();
    const Vec3 aside = cross(ring.along, ring.across);
    for (int k = 0; k < resolution_; k++) {
      const double angle = 2.0 * pi * k / resolution_;
      const Vec3 n =
          std::cos(latitude) * (std::cos(angle) * ring.across + std::sin(angle) * aside) +
          std::sin(latitude) * ring.along;
      const Vec3 p = ring.centre + radius * n;
      points_->InsertNextPoint(p.x, p.y, p.z);
      normals_->InsertNextTuple3(n.x, n.y, n.z);
      geometry_.rod_of_point.push_back(rod);
      geometry_.neighbour_of_point.push_back(neighbour);
      geometry_.part_of_neighbour.push_back(static_cast<float>(part));
    }
    return first;
  }

  // Between two circles, the second further along.
  void add_band(vtkIdType first, vtkIdType second, vtkIdType rod)
  {
    for (int k = 0; k < resolution_; k++) {
      const int next = (k + 1) % resolution_;
      add_triangle(first + k, first + next, second + next, rod);
      add_triangle(first + k, second + next, second + k, rod);
    }
  }

  void add_triangle(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType rod)
  {
    polygons_->InsertNextCell(3);
    for (const vtkIdType corner : {a, b, c}) polygons_->InsertCellPoint(corner);
    geometry_.rod_of_cell.push_back(rod);
  }

  void add_round_end(const TubeRing &ring, double radius, const TubePart &part, bool at_tail)
  {
    const int steps = std::max(2, resolution_ / 4);
    const vtkIdType neighbour = at_tail ? part.before : part.after;
    const double sense = at_tail ? -1.0 : 1.0;
    vtkIdType before = -1;
    for (int k = 0; k <= steps; k++) {
      const vtkIdType circle =
          add_circle(ring, radius, sense * 0.5 * pi * k / steps, part.rod, neighbour, 0.5);
      if (k > 0 && at_tail) add_band(circle, before, part.rod);
      if (k > 0 && !at_tail) add_band(before, circle, part.rod);
      before = circle;
    }
  }

  int resolution_;
  std::map<std::pair<double, double>, vtkSmartPointer<vtkPolyData>> shapes_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkCellArray> polygons_;
  RodGeometry geometry_;
};

}  // namespace

RodGeometry rod_surfaces(const std::vector<Rod> &rods, int resolution)
{
  SurfaceBuilder builder(resolution);
  for (std::size_t i = 0; i < rods.size(); i++)
    builder.add(rods[i].capsule, static_cast<vtkIdType>(i));
  return builder.finish();
}

RodGeometry rod_surfaces(const std::vector<Rod> &rods, const Fibres &fibres, int resolution)
{
  if (!fibres.are_there()) return rod_surfaces(rods, resolution);
  SurfaceBuilder builder(resolution);
  for (std::size_t i = 0; i < rods.size(); i++)
    if (fibres.of_rod[i] == kNoFibre) builder.add(rods[i].capsule, static_cast<vtkIdType>(i));
  builder.say_neighbours();
  for (const Fibre &fibre : fibres.all)
    for (const TubePart &part : tube_of(fibre, fibres, rods, resolution))
      builder.add(part, rods[part.rod].capsule.radius);
  return builder.finish();
}

RodGeometry rod_lines(const std::vector<Rod> &rods)
{
  // Poly data numbers all vertices before all lines, so spheres come first.
  RodGeometry geometry;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices, lines;
  points->SetDataTypeToFloat();
  for (const bool spheres : {true, false}) {
    for (std::size_t i = 0; i < rods.size(); i++) {
      if (rods[i].is_sphere() != spheres) continue;
      const Segment &segment = rods[i].capsule.segment;
      vtkCellArray *cells = spheres ? vertices : lines;
      cells->InsertNextCell(spheres ? 1 : 2);
      for (const double side :
           spheres ? std::vector<double>{0.0} : std::vector<double>{-1.0, 1.0}) {
        const Vec3 end = segment.at(side * segment.half_length);
        cells->InsertCellPoint(points->InsertNextPoint(end.x, end.y, end.z));
        geometry.rod_of_point.push_back(static_cast<vtkIdType>(i));
      }
      geometry.rod_of_cell.push_back(static_cast<vtkIdType>(i));
    }
  }
  geometry.mesh = vtkSmartPointer<vtkPolyData>::New();
  geometry.mesh->SetPoints(points);
  geometry.mesh->SetVerts(vertices);
  geometry.mesh->SetLines(lines);
  return geometry;
}

}  // namespace spherocylinder
