// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/vessel_surface.h"

#include <cmath>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

namespace spherocylinder {
namespace {

constexpr int kFacets = 180;  // of a whole turn; a chord leaves the circle by 1.5e-4 of its radius

vtkIdType add_point(vtkPoints *points, const UprightCylinder &vessel, double angle, double z)
{
  return points->InsertNextPoint(vessel.x + vessel.radius * std::cos(angle),
                                 vessel.y + vessel.radius * std::sin(angle), z);
}

double angle_of(double i, const WallArc &arc) { return arc.begin + arc.span * i / kFacets; }

vtkSmartPointer<vtkPolyData> poly_data(vtkPoints *points)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

}  // namespace

vtkSmartPointer<vtkPolyData> vessel_wall(const UprightCylinder &vessel, const WallArc &arc)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> quads;
  for (int i = 0; i <= kFacets; i++) {
    add_point(points, vessel, angle_of(i, arc), vessel.z_low);
    add_point(points, vessel, angle_of(i, arc), vessel.z_high);
  }
  for (vtkIdType i = 0; i < kFacets; i++) {
    const vtkIdType corners[4] = {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1};
    quads->InsertNextCell(4, corners);
  }
  auto data = poly_data(points);
  data->SetPolys(quads);
  return data;
}

vtkSmartPointer<vtkPolyData> vessel_floor(const UprightCylinder &vessel)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> disc;
  disc->InsertNextCell(kFacets);
  for (int i = 0; i < kFacets; i++)
    disc->InsertCellPoint(add_point(points, vessel, angle_of(i, {}), vessel.z_low));
  auto data = poly_data(points);
  data->SetPolys(disc);
  return data;
}

vtkSmartPointer<vtkPolyData> vessel_ring(const UprightCylinder &vessel, double z)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(kFacets + 1);
  for (int i = 0; i <= kFacets; i++)
    line->InsertCellPoint(add_point(points, vessel, angle_of(i, {}), z));
  auto data = poly_data(points);
  data->SetLines(line);
  return data;
}

vtkSmartPointer<vtkPolyData> dashed_vessel_ring(const UprightCylinder &vessel, double z)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dashes;
  // Dashes lie evenly about the x and y axes, so that from the side the front covers the back.
  for (int i = 0; i < kFacets; i += 2) {
    dashes->InsertNextCell(2);
    for (const double end : {i - 0.5, i + 0.5})
      dashes->InsertCellPoint(add_point(points, vessel, angle_of(end, {}), z));
  }
  auto data = poly_data(points);
  data->SetLines(dashes);
  return data;
}

Vec3 to_vessel(const Vec3 &space, int axis)
{
  const double p[] = {space.x, space.y, space.z};
  return {p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]};
}

Vec3 to_space(const Vec3 &vessel, int axis)
{
  double p[3];
  p[(axis + 1) % 3] = vessel.x;
  p[(axis + 2) % 3] = vessel.y;
  p[axis] = vessel.z;
  return {p[0], p[1], p[2]};
}

void turn_to_space(vtkPolyData *mesh, int axis)
{
  vtkPoints *points = mesh->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); i++) {
    const double *p = points->GetPoint(i);
    const Vec3 turned = to_space({p[0], p[1], p[2]}, axis);
    points->SetPoint(i, turned.x, turned.y, turned.z);
  }
}

}  // namespace spherocylinder
