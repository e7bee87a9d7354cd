// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/rod_surface.h"

#include <map>
#include <utility>

#include <vtkCapsuleSource.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

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

  RodGeometry finish()
  {
    geometry_.mesh = vtkSmartPointer<vtkPolyData>::New();
    geometry_.mesh->SetPoints(points_);
    geometry_.mesh->SetPolys(polygons_);
    geometry_.mesh->GetPointData()->SetNormals(normals_);
    return std::move(geometry_);
  }

 private:
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
