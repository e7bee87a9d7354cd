// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkCubeSource.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyDataSilhouette.h>

namespace spherocylinder {

vtkSmartPointer<vtkPolyData> walls_behind(vtkPolyData *mesh, const Vec3 &towards)
{
  constexpr double kInPlane = 1e-3;  // of the mesh's size: the middle lies in the triangle's plane
  constexpr double kEdgeOn = 1e-6;   // seen from its edge
  const Vec3 middle = load(mesh->GetCenter());
  const double size = mesh->GetLength();
  vtkNew<vtkCellArray> behind;
  vtkNew<vtkIdList> ids;
  vtkCellArray *cells = mesh->GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(ids) != 0;) {
    double a[3], b[3], c[3];
    mesh->GetPoint(ids->GetId(0), a);
    mesh->GetPoint(ids->GetId(1), b);
    mesh->GetPoint(ids->GetId(2), c);
    const Vec3 n = cross(load(b) - load(a), load(c) - load(a));
    const double length = norm(n);
    if (length == 0.0) continue;
    const double from_middle = dot(n, load(a) - middle) / length;
    const double outwards = from_middle > 0.0 ? 1.0 : -1.0;
    if (std::abs(from_middle) > kInPlane * size && outwards * dot(n, towards) > kEdgeOn * length)
      continue;
    behind->InsertNextCell(ids);
  }
  auto walls = vtkSmartPointer<vtkPolyData>::New();
  walls->SetPoints(mesh->GetPoints());
  walls->SetPolys(behind);
  return walls;
}

vtkSmartPointer<vtkPolyData> outline_of(vtkPolyData *mesh, const Vec3 &towards)
{
  vtkNew<vtkPolyDataSilhouette> filter;
  filter->SetInputData(mesh);
  filter->SetDirectionToSpecifiedVector();
  filter->SetVector(towards.x, towards.y, towards.z);
  filter->SetEnableFeatureAngle(1);
  filter->SetFeatureAngle(30.0);
  filter->SetBorderEdges(1);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> mesh_within(vtkPolyData *mesh, const UprightBox &box)
{
  const std::pair<Vec3, double> sides[] = {{{1, 0, 0}, box.x_low}, {{-1, 0, 0}, box.x_high},
                                           {{0, 1, 0}, box.y_low}, {{0, -1, 0}, box.y_high},
                                           {{0, 0, 1}, box.z_low}, {{0, 0, -1}, box.z_high}};
  vtkSmartPointer<vtkPolyData> part = mesh;
  for (const auto &[normal, at] : sides) {
    if (!std::isfinite(at)) continue;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(at, at, at);
    plane->SetNormal(normal.x, normal.y, normal.z);
    vtkNew<vtkClipPolyData> clip;
    clip->SetInputData(part);
    clip->SetClipFunction(plane);
    clip->Update();
    part = clip->GetOutput();
  }
  return part;
}

vtkSmartPointer<vtkPolyData> level_plane(const UprightBox &box, double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(box.x_low, box.y_low, z);
  plane->SetPoint1(box.x_high, box.y_low, z);
  plane->SetPoint2(box.x_low, box.y_high, z);
  plane->Update();
  return plane->GetOutput();
}

vtkSmartPointer<vtkPolyData> box_faces(const UprightBox &box)
{
  vtkNew<vtkCubeSource> faces;
  faces->SetBounds(box.x_low, box.x_high, box.y_low, box.y_high, box.z_low, box.z_high);
  faces->Update();
  return faces->GetOutput();
}

}  // namespace spherocylinder
