// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include <vtkCell.h>
#include <vtkPointData.h>

#include "core/closest_points.h"
#include "pictures/annotation.h"
#include "pictures/colour_map.h"
#include "pictures/rod_surface.h"
#include "pictures/vessel_surface.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

// Volume inside a closed mesh by the divergence theorem: sum of det(a, b, c)/6 over its triangles,
// positive if they face outwards.
double enclosed_volume(vtkPolyData *mesh)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i) {
    vtkPoints *corners = mesh->GetCell(i)->GetPoints();
    double p[3][3];
    for (vtkIdType j = 1; j + 1 < corners->GetNumberOfPoints(); ++j) {
      corners->GetPoint(0, p[0]);
      corners->GetPoint(j, p[1]);
      corners->GetPoint(j + 1, p[2]);
      sum += dot(load(p[0]), cross(load(p[1]), load(p[2]))) / 6.0;
    }
  }
  return sum;
}

TEST(RodSurface, PointsLieOnTheRods)
{
  std::vector<Rod> rods;
  for (const Vec3 &u : even_directions(12)) {
    const double i = static_cast<double>(rods.size());
    rods.push_back(
        {1, 1, {{{0.3 * i, 0.1, -0.2}, u, 0.05 * i}, 0.1 + 0.01 * i}});  // first a sphere
  }
  const RodGeometry geometry = rod_surfaces(rods, 16);
  ASSERT_EQ(geometry.rod_of_point.size(),
            static_cast<std::size_t>(geometry.mesh->GetNumberOfPoints()));
  ASSERT_EQ(geometry.rod_of_cell.size(),
            static_cast<std::size_t>(geometry.mesh->GetNumberOfCells()));
  for (std::size_t i = 0; i < geometry.rod_of_point.size(); ++i) {
    const Capsule &capsule = rods[geometry.rod_of_point[i]].capsule;
    const auto index = static_cast<vtkIdType>(i);
    const Vec3 point = load(geometry.mesh->GetPoint(index));
    const Vec3 from_axis = point - capsule.segment.at(closest_position(capsule.segment, point));
    EXPECT_NEAR(norm(from_axis), capsule.radius, 1e-6);  // single precision
    const Vec3 normal = load(geometry.mesh->GetPointData()->GetNormals()->GetTuple3(index));
    EXPECT_GT(dot(normal, from_axis), 0.99 * capsule.radius);
  }
}

// A mesh of many corners encloses nearly the rod's volume, from within.
TEST(RodSurface, MeshIsClosedAndFacesOutwards)
{
  const Rod rod{1, 1, {{{1, 2, 3}, {0.48, 0.6, 0.64}, 0.5}, 0.1}};
  const double enclosed = enclosed_volume(rod_surfaces({rod}, 64).mesh);
  EXPECT_LT(enclosed, volume(rod.capsule));
  EXPECT_GT(enclosed, 0.99 * volume(rod.capsule));
}

TEST(RodSurface, LinesEndWhereTheCylinderPartEnds)
{
  const Rod rod{7, 1, {{{1, 2, 3}, {0, 0, 1}, 0.5}, 0.1}};
  const Rod sphere{8, 1, {{{0, 0, 0}, {0, 0, 1}, 0.0}, 0.1}};
  const RodGeometry geometry = rod_lines({rod, sphere});
  EXPECT_EQ(geometry.mesh->GetNumberOfVerts(), 1);
  EXPECT_EQ(geometry.mesh->GetNumberOfLines(), 1);
  EXPECT_EQ(geometry.rod_of_cell, (std::vector<vtkIdType>{1, 0}));  // vertices come first
  EXPECT_NEAR(geometry.mesh->GetCell(1)->GetPoints()->GetPoint(0)[2], 2.5, 1e-6);
  EXPECT_NEAR(geometry.mesh->GetCell(1)->GetPoints()->GetPoint(1)[2], 3.5, 1e-6);
}

TEST(VesselSurface, LiesOnTheCylinder)
{
  const UprightCylinder vessel{1, 2, 3, -1, 1};
  for (const auto &mesh : {vessel_wall(vessel), vessel_floor(vessel), vessel_ring(vessel, 0.5)})
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i) {
      const Vec3 p = load(mesh->GetPoint(i));
      EXPECT_NEAR(std::hypot(p.x - 1, p.y - 2), 3.0, 1e-6);
    }
}

TEST(Annotation, RoundNumbers)
{
  EXPECT_NEAR(round_length(0.073), 0.05, 1e-12);
  EXPECT_NEAR(round_length(0.2), 0.2, 1e-12);
  EXPECT_NEAR(round_length(1.9), 1.0, 1e-12);
  EXPECT_EQ(length_label(0.05), "50 mm");
  EXPECT_EQ(length_label(2.0), "2 m");
  EXPECT_EQ(length_label(5e-5), "50 um");
  const RoundRange range = round_range(0.013, 0.085);  // quarters of 0.018: steps of 0.01
  EXPECT_NEAR(range.low, 0.01, 1e-12);
  EXPECT_NEAR(range.high, 0.09, 1e-12);
  EXPECT_EQ(range.labels, 9);
  EXPECT_LT(round_range(3, 3).low, 3.0);
  EXPECT_GT(round_range(3, 3).high, 3.0);
  EXPECT_EQ(round_range(0, 90).labels, 7);
}

// The ends of viridis as published: #440154 and #fde725.
TEST(ColourMap, EndsOfViridis)
{
  double rgb[3];
  viridis(2, 5)->GetColor(2, rgb);
  EXPECT_NEAR(rgb[0] * 255, 0x44, 0.6);
  EXPECT_NEAR(rgb[2] * 255, 0x54, 0.6);
  viridis(2, 5)->GetColor(5, rgb);
  EXPECT_NEAR(rgb[0] * 255, 0xfd, 0.6);
  EXPECT_NEAR(rgb[1] * 255, 0xe7, 0.6);
}

}  // namespace
}  // namespace spherocylinder
