// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/closed_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkClipClosedSurface.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPoints.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>

#include "solid/half_spaces.h"

namespace spherocylinder {
namespace {

Vec3 vec(const double *p) { return {p[0], p[1], p[2]}; }

std::vector<Triangle> triangles_of(vtkPolyData *mesh)
{
  std::vector<Triangle> triangles;
  vtkNew<vtkIdList> ids;
  vtkCellArray *cells = mesh->GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(ids) != 0;) {
    double a[3], b[3], c[3];
    mesh->GetPoint(ids->GetId(0), a);
    mesh->GetPoint(ids->GetId(1), b);
    mesh->GetPoint(ids->GetId(2), c);
    triangles.push_back({vec(a), vec(b), vec(c)});
  }
  return triangles;
}

// Twice the area, along the normal.
Vec3 turn(const Triangle &t) { return cross(t.b - t.a, t.c - t.a); }

// By the divergence theorem, about a point of the surface, so that no digits are lost far away from
// the origin; < 0 if the triangles face inwards. (vtkMassProperties gives no sign.)
double enclosed_volume(const std::vector<Triangle> &triangles)
{
  double sum = 0.0;
  for (const Triangle &t : triangles) sum += dot(t.a - triangles[0].a, turn(t));
  return sum / 6.0;
}

// The vector areas of a closed surface add up to zero.
bool is_closed(const std::vector<Triangle> &triangles)
{
  constexpr double kRounding = 1e-6;
  Vec3 sum{0.0, 0.0, 0.0};
  double area = 0.0;
  for (const Triangle &t : triangles) {
    sum = sum + turn(t);
    area += norm(turn(t));
  }
  return norm(sum) <= kRounding * area;
}

vtkSmartPointer<vtkPolyData> edges_of(vtkPolyData *mesh, bool open)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->SetBoundaryEdges(open);
  edges->SetNonManifoldEdges(!open);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput();
}

std::string first_point(vtkPolyData *edges)
{
  const double *p = edges->GetPoint(0);
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]);
}

// Edges that two triangles go along in the same sense.
std::size_t count_turned_edges(vtkPolyData *mesh)
{
  std::set<std::pair<vtkIdType, vtkIdType>> seen;
  std::size_t twice = 0;
  vtkNew<vtkIdList> ids;
  vtkCellArray *cells = mesh->GetPolys();
  for (cells->InitTraversal(); cells->GetNextCell(ids) != 0;)
    for (vtkIdType i = 0; i < 3; i++)
      twice += !seen.insert({ids->GetId(i), ids->GetId((i + 1) % 3)}).second;
  return twice;
}

// Of polygons: triangles with their corners shared.
vtkSmartPointer<vtkPolyData> tidied(vtkPolyData *polygons)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(polygons);
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->SetTolerance(1e-9);
  clean->Update();
  vtkSmartPointer<vtkPolyData> found = clean->GetOutput();
  found->SetLines(nullptr);  // of triangles that were none
  found->SetVerts(nullptr);
  return found;
}

vtkSmartPointer<vtkPolyData> poly_data_of(const std::vector<Triangle> &triangles)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const Triangle &t : triangles) {
    cells->InsertNextCell(3);
    for (const Vec3 &p : {t.a, t.b, t.c})
      cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

// The planes of the triangles, each once. Corners have the seven digits of an STL file: the plane
// of a sliver is not known, and triangles are in one plane that are not further from it than that.
std::vector<HalfSpace> planes_of(const std::vector<Triangle> &triangles, double size)
{
  constexpr double kSliver = 3e-4, kRounding = 1e-6;
  std::vector<HalfSpace> planes;
  for (const Triangle &t : triangles) {
    const Vec3 n = turn(t);
    const double longest = std::max({norm(t.b - t.a), norm(t.c - t.b), norm(t.a - t.c)});
    if (norm(n) <= kSliver * size * longest) continue;
    const auto is_in = [&](const HalfSpace &plane) {
      const auto is_near = [&](const Vec3 &p) {
        return std::abs(dot(plane.normal, p) - plane.offset) <= kRounding * size;
      };
      return is_near(t.a) && is_near(t.b) && is_near(t.c) && dot(plane.normal, n) > 0.0;
    };
    if (std::any_of(planes.rbegin(), planes.rend(), is_in)) continue;
    const Vec3 normal = (1.0 / norm(n)) * n;
    planes.push_back({normal, dot(normal, t.a)});
  }
  return planes;
}

}  // namespace

std::optional<std::string> fault_of_surface(vtkPolyData *mesh)
{
  const auto open = edges_of(mesh, true);
  if (open->GetNumberOfCells() > 0)
    return fmt::format(
        "is not closed: {} edges belong to one triangle only, one of them at {}, wanted two "
        "triangles at each edge",
        open->GetNumberOfCells(), first_point(open));
  const auto crowded = edges_of(mesh, false);
  if (crowded->GetNumberOfCells() > 0)
    return fmt::format(
        "has {} edges that belong to more than two triangles, one of them at {}, wanted two triangles at "
        "each edge",
        crowded->GetNumberOfCells(), first_point(crowded));
  if (const std::size_t turned = count_turned_edges(mesh))
    return fmt::format(
        "has {} edges of which one triangle faces inwards and the other outwards, wanted all outwards",
        turned);
  const double volume = enclosed_volume(triangles_of(mesh));
  if (!(volume > 0.0))
    return fmt::format(
        "has triangles that face inwards: they enclose {:.6g} m^3, wanted > 0, all facing outwards",
        volume);
  return std::nullopt;
}

ClosedMesh::ClosedMesh(vtkPolyData *mesh)
    : mesh_(mesh),
      triangles_(triangles_of(mesh)),
      volume_(enclosed_volume(triangles_)),
      distance_(vtkSmartPointer<vtkImplicitPolyDataDistance>::New())
{
  distance_->SetInput(mesh_);
}

ClosedMesh::ClosedMesh(ClosedMesh &&) noexcept = default;
ClosedMesh::~ClosedMesh() = default;

UprightBox ClosedMesh::bounds() const
{
  double b[6];
  mesh_->GetBounds(b);
  return {b[0], b[1], b[2], b[3], b[4], b[5]};
}

double ClosedMesh::distance(const Vec3 &point) const
{
  return distance_->EvaluateFunction(point.x, point.y, point.z);
}

// A piece of the axis is clear of the surface if its middle is further away than its ends and the
// rod's radius; else its halves may be.
ClosedMesh::Place ClosedMesh::place_of(const Capsule &rod) const
{
  constexpr double kShortest = 0.5;  // radii; what is not clear then is left to the integral
  if (misses(bounds(), rod)) return Place::Outside;
  const Segment &segment = rod.segment;
  std::vector<std::pair<double, double>> open{{0.0, segment.half_length}};  // middle, half length
  bool inside = false;
  while (!open.empty()) {
    const auto [middle, half] = open.back();
    open.pop_back();
    const double away = distance(segment.at(middle));
    inside = away < 0.0;
    if (std::abs(away) > half + rod.radius) continue;
    if (std::abs(away) <= rod.radius || half <= kShortest * rod.radius) return Place::Cut;
    open.emplace_back(middle - 0.5 * half, 0.5 * half);
    open.emplace_back(middle + 0.5 * half, 0.5 * half);
  }
  return inside ? Place::Inside : Place::Outside;
}

std::optional<ClosedMesh> ClosedMesh::part_within(const UprightBox &window) const
{
  constexpr double kThinnest = 1e-6;
  const UprightBox all = bounds();
  const double size =
      std::max({all.x_high - all.x_low, all.y_high - all.y_low, all.z_high - all.z_low});
  const double crumb = kThinnest * size;
  vtkNew<vtkPlaneCollection> planes;
  const auto cut = [&](double at, double low, double high, double x, double y, double z) {
    if (at < low + crumb || at > high - crumb) return;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(at, at, at);
    plane->SetNormal(x, y, z);
    planes->AddItem(plane);
  };
  const auto apart = [&](double low, double high, double mesh_low, double mesh_high) {
    return low >= mesh_high - crumb || high <= mesh_low + crumb;
  };
  if (apart(window.x_low, window.x_high, all.x_low, all.x_high) ||
      apart(window.y_low, window.y_high, all.y_low, all.y_high) ||
      apart(window.z_low, window.z_high, all.z_low, all.z_high))
    return std::nullopt;
  cut(window.x_low, all.x_low, all.x_high, 1, 0, 0);
  cut(window.x_high, all.x_low, all.x_high, -1, 0, 0);
  cut(window.y_low, all.y_low, all.y_high, 0, 1, 0);
  cut(window.y_high, all.y_low, all.y_high, 0, -1, 0);
  cut(window.z_low, all.z_low, all.z_high, 0, 0, 1);
  cut(window.z_high, all.z_low, all.z_high, 0, 0, -1);
  vtkNew<vtkClipClosedSurface> clip;
  clip->SetInputData(mesh_);
  clip->SetClippingPlanes(planes);
  clip->Update();
  const auto part = tidied(clip->GetOutput());
  if (part->GetNumberOfPolys() == 0) return std::nullopt;
  ClosedMesh found(part);
  if (!is_closed(found.triangles_))
    throw std::runtime_error(fmt::format(
        "VTK leaves a hole where it cuts a mesh at the window {} {} {} {} {} {}", window.x_low,
        window.x_high, window.y_low, window.y_high, window.z_low, window.z_high));
  return found;
}

bool ClosedMesh::is_convex() const
{
  constexpr double kRounding = 1e-4;
  const auto hull = inset(0.0);
  return hull && std::abs(hull->volume() - volume_) <= kRounding * volume_;
}

std::optional<ClosedMesh> ClosedMesh::inset(double margin) const
{
  std::vector<HalfSpace> planes = planes_of(triangles_, mesh_->GetLength());
  for (HalfSpace &plane : planes) plane.offset -= margin;
  const auto surface = common_body(planes, vec(mesh_->GetCenter()), mesh_->GetLength());
  if (surface.size() < 4 || !(enclosed_volume(surface) > 0.0)) return std::nullopt;
  return ClosedMesh(tidied(poly_data_of(surface)));
}

ClosedMesh ClosedMesh::scaled(double factor) const
{
  double middle[3];
  mesh_->GetCenter(middle);
  vtkNew<vtkTransform> transform;
  transform->Translate(middle);
  transform->Scale(factor, factor, factor);
  transform->Translate(-middle[0], -middle[1], -middle[2]);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(mesh_);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return ClosedMesh(filter->GetOutput());
}

}  // namespace spherocylinder
