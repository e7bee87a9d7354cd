// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper2D.h>

#include "core/closest_points.h"
#include "fibre_frames.h"
#include "io/input_error.h"
#include "io/vtk_errors.h"
#include "meshes.h"
#include "pictures/annotation.h"
#include "pictures/colour_map.h"
#include "pictures/fibre_surface.h"
#include "pictures/font.h"
#include "pictures/mesh_surface.h"
#include "pictures/picture_layout.h"
#include "pictures/rod_surface.h"
#include "pictures/shown_part.h"
#include "pictures/vessel_surface.h"
#include "scratch_folder.h"
#include "solid/capsule_measures.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

// Volume inside a closed mesh by the divergence theorem: sum of det(a, b, c)/6 over its triangles,
// positive if they face outwards.
double enclosed_volume(vtkPolyData *mesh)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); i++) {
    vtkPoints *corners = mesh->GetCell(i)->GetPoints();
    double p[3][3];
    for (vtkIdType j = 1; j + 1 < corners->GetNumberOfPoints(); j++) {
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
  for (std::size_t i = 0; i < geometry.rod_of_point.size(); i++) {
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
  for (const auto &mesh : {vessel_wall(vessel), vessel_floor(vessel), vessel_ring(vessel, 0.5),
                           dashed_vessel_ring(vessel, 0.5)})
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); i++) {
      const Vec3 p = load(mesh->GetPoint(i));
      EXPECT_NEAR(std::hypot(p.x - 1, p.y - 2), 3.0, 1e-6);
    }
}

// A vessel along y about x = 1, z = 2, from y = 3 to 4; turned there and back nothing is lost.
TEST(VesselSurface, LiesAlongAnAxis)
{
  for (int axis = 0; axis < 3; axis++) {
    const Vec3 p = to_vessel(to_space({1, 2, 3}, axis), axis);
    EXPECT_EQ(p.x, 1);
    EXPECT_EQ(p.y, 2);
    EXPECT_EQ(p.z, 3);
  }
  VesselOptions options;
  options.radius = 0.5;
  options.centre = {1.0, 2.0};
  options.floor = 3.0;
  const auto wall = vessel_wall(vessel_up_to(*vessel_about(1, options), 4.0));
  turn_to_space(wall, 1);
  double low = 9.0, high = -9.0;
  for (vtkIdType i = 0; i < wall->GetNumberOfPoints(); i++) {
    const Vec3 p = load(wall->GetPoint(i));
    EXPECT_NEAR(std::hypot(p.x - 1, p.z - 2), 0.5, 1e-6);
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  EXPECT_EQ(low, 3.0);
  EXPECT_EQ(high, 4.0);
}

// A rod of total length 2 (h + 0.1) along x.
Rod rod_along_x(const Vec3 &centre, double h) { return {1, 1, {{centre, {1, 0, 0}, h}, 0.1}}; }

// The pictures of a film see what the rods of all frames reach: from the side x from -0.5 to 3.5
// and z from -0.1 to 2.1; the half in front of y = 1 is cut off, which lies between y = 0 and 2.
TEST(ShownPart, OfAFilmIsWhatAllRodsReach)
{
  DumpFrame frame;
  const std::vector<Rod> first{rod_along_x({0, 0, 0}, 0.4)};
  const std::vector<Rod> second{rod_along_x({3, 2, 2}, 0.4), rod_along_x({1, 0.9, 1}, 0.4)};
  PartOptions options;
  options.cut = true;
  ShownPart part(options, View::Side, true);
  EXPECT_FALSE(part.may_be_empty());
  part.look_at(frame, first);
  part.look_at(frame, second);
  EXPECT_TRUE(part.may_be_empty());
  EXPECT_TRUE(part.rods_shown(first).empty());
  EXPECT_EQ(part.rods_shown(second), std::vector<std::size_t>{0});
  PictureOptions picture;
  part.set(picture, frame);
  EXPECT_FALSE(picture.aim_at_rods);
  EXPECT_FALSE(picture.box);
  EXPECT_FALSE(picture.vessel);
  EXPECT_NEAR(picture.seen->size(0), 4.0, 1e-12);
  EXPECT_NEAR(picture.seen->middle(0), 1.5, 1e-12);
  EXPECT_NEAR(picture.seen->size(1), 2.2, 1e-12);
  EXPECT_NEAR(picture.seen->middle(1), 1.0, 1e-12);
  EXPECT_NEAR(picture.seen->size(2), 2.2, 1e-12);
}

// A box that is periodic in x and becomes longer: its edges are those of the frame at hand in x, of
// all rods in y and z; all pictures have room for the longest.
TEST(ShownPart, OfAFilmHoldsAllPeriodicBoxes)
{
  DumpFrame shorter, longer;
  shorter.periodic = longer.periodic = {true, false, false};
  shorter.box = {{{-1, 1}, {-9, 9}, {-9, 9}}};
  longer.box = {{{-2, 2}, {-9, 9}, {-9, 9}}};
  const std::vector<Rod> rods{rod_along_x({0, 3, 0}, 0.4)}, later{rod_along_x({0, 5, 0}, 0.4)};
  ShownPart part({}, View::Top, true);
  part.look_at(longer, rods);
  part.look_at(shorter, later);
  PictureOptions picture;
  part.set(picture, shorter);
  EXPECT_EQ((*picture.box)[0], (std::array{-1.0, 1.0}));
  EXPECT_NEAR((*picture.box)[1][0], 2.9, 1e-12);
  EXPECT_NEAR((*picture.box)[1][1], 5.1, 1e-12);
  EXPECT_NEAR(picture.seen->size(0), 4.0, 1e-12);
  EXPECT_NEAR(picture.seen->size(1), 2.2, 1e-12);
}

// --box and --top leave rods out by their centre and by their highest point; a cut goes through the
// box's middle, y = 0.5, wherever the rods are.
TEST(ShownPart, BoxAndTopLeaveRodsOut)
{
  PartOptions options;
  options.box = {-1, 1, -1, 2, 0, 1};
  options.top = 0.9;
  options.cut = true;
  ShownPart part(options, View::Oblique, false);
  const std::vector<Rod> rods{rod_along_x({0.9, 1.9, 0.5}, 0.4), rod_along_x({1.1, 1.9, 0.5}, 0.4),
                              rod_along_x({0, 0.4, 0.5}, 0.4), rod_along_x({0, 0.6, 0.85}, 0.4),
                              rod_along_x({0, 0.6, 0.75}, 0.4)};
  DumpFrame frame;
  part.look_at(frame, rods);
  EXPECT_EQ(part.rods_shown(rods), (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(part.left_out_by(), "--box, --top, --cut");
  PictureOptions picture;
  part.set(picture, frame);
  EXPECT_EQ(*picture.box, (Box{{{-1, 1}, {-1, 2}, {0, 1}}}));
  EXPECT_TRUE(picture.aim_at_rods);
}

// A drum along y about x = 1, z = -1: open where rods or a periodic box end, or between the ends
// that are given, and cut through its middle, y = 0, 2 or 1.
TEST(ShownPart, OfADrum)
{
  PartOptions options;
  options.vessel.radius = 2.0;
  options.vessel.centre = {1.0, -1.0};
  options.vessel_axis = "y";
  options.cut = true;
  const std::vector<Rod> rods{rod_along_x({1, -3, 0.9}, 0.4), rod_along_x({2.9, 0.5, -1}, 0.4),
                              rod_along_x({1, 3, -1}, 0.4)};
  DumpFrame frame;
  ShownPart part(options, View::Side, false);
  part.look_at(frame, rods);
  EXPECT_EQ(part.rods_shown(rods), (std::vector<std::size_t>{1, 2}));
  PictureOptions picture;
  part.set(picture, frame);
  EXPECT_EQ(picture.vessel->axis, 1);
  EXPECT_TRUE(picture.vessel->goes_on_below && picture.vessel->goes_on_above);
  EXPECT_NEAR(picture.vessel->cylinder.z_low, -3.1, 1e-12);
  EXPECT_NEAR(picture.vessel->cylinder.z_high, 3.1, 1e-12);

  DumpFrame periodic;
  periodic.periodic = {false, true, false};
  periodic.box = {{{-9, 9}, {-4, 8}, {-9, 9}}};
  ShownPart long_drum(options, View::Side, false);
  long_drum.look_at(periodic, rods);
  EXPECT_EQ(long_drum.rods_shown(rods), (std::vector<std::size_t>{2}));  // behind y = 2
  long_drum.set(picture, periodic);
  EXPECT_FALSE(picture.box);
  EXPECT_EQ(picture.vessel->cylinder.z_low, -4.0);
  EXPECT_EQ(picture.vessel->cylinder.z_high, 8.0);

  options.vessel.floor = -3.0;
  options.vessel_height = 8.0;
  ShownPart closed(options, View::Side, false);
  closed.look_at(frame, rods);
  EXPECT_EQ(closed.rods_shown(rods), (std::vector<std::size_t>{2}));
  closed.set(picture, frame);
  EXPECT_FALSE(picture.vessel->goes_on_below || picture.vessel->goes_on_above);
  EXPECT_EQ(picture.vessel->cylinder.z_high, 5.0);

  options.vessel_height = 5.9;
  EXPECT_THROW(ShownPart(options, View::Side, false).look_at(frame, rods), InputError);
  options.vessel_height = 8.0;
  options.vessel.centre = {-1.0, 1.0};
  EXPECT_THROW(ShownPart(options, View::Side, false).look_at(frame, rods), InputError);
}

// An upright vessel in a film: as high as the bed becomes and a tenth more.
TEST(ShownPart, OfAFilmOfAVessel)
{
  PartOptions options;
  options.vessel.radius = 2.0;
  ShownPart part(options, View::Side, true);
  DumpFrame frame;
  part.look_at(frame, {rod_along_x({0, 0, 3.9}, 0.4)});
  part.look_at(frame, {rod_along_x({0, 0, 0.1}, 0.4)});
  PictureOptions picture;
  part.set(picture, frame);
  EXPECT_NEAR(picture.vessel->cylinder.z_high, 4.4, 1e-12);
  EXPECT_TRUE(picture.vessel->goes_on_above);
  EXPECT_FALSE(picture.aim_at_rods);
}

// Of a box the faces that look away from the viewer or are seen from their edge, of a cylinder the
// half of the wall behind the axis and the floor, of a plate all; whichever way triangles are turned.
TEST(MeshSurface, WallsBehind)
{
  const Triangles box = box_mesh({1, 2, 1, 3, 1, 4});
  for (const Triangles &mesh : {box, turned_over(box)}) {
    const auto data = poly_data_of(mesh);
    EXPECT_EQ(walls_behind(data, frame_of(View::Side).towards)->GetNumberOfPolys(), 10);
    EXPECT_EQ(walls_behind(data, frame_of(View::Top).towards)->GetNumberOfPolys(), 10);
    EXPECT_EQ(walls_behind(data, frame_of(View::Oblique).towards)->GetNumberOfPolys(), 6);
  }
  const int n = 90;
  const auto wall = poly_data_of(cone_mesh(1, 1, 0, 2, n));
  EXPECT_EQ(walls_behind(wall, frame_of(View::Oblique).towards)->GetNumberOfPolys(), n + n);
  const auto plate = poly_data_of({{{0, 0, 0}, {1, 0, 0.5}, {0, 1, 0}}});
  EXPECT_EQ(walls_behind(plate, {0, 0, 1})->GetNumberOfPolys(), 1);
  EXPECT_EQ(walls_behind(plate, {0, 0, -1})->GetNumberOfPolys(), 1);
}

// A box's twelve edges; of a cylinder from the side the two ends' circles and two lines.
TEST(MeshSurface, Outline)
{
  EXPECT_EQ(
      outline_of(poly_data_of(box_mesh({1, 2, 1, 3, 1, 4})), {0.3, -0.9, 0.4})->GetNumberOfLines(),
      12);
  EXPECT_EQ(outline_of(poly_data_of(cone_mesh(1, 1, 0, 2, 90)), {0.1, -1, 0})->GetNumberOfLines(),
            90 + 90 + 2);
}

TEST(MeshSurface, PartInABox)
{
  const auto part = mesh_within(poly_data_of(box_mesh({1, 2, 1, 3, 1, 4})), {0, 1.5, 0, 9, 0, 3});
  double b[6];
  part->GetBounds(b);
  const double wanted[] = {1, 1.5, 1, 3, 1, 3};
  for (int i = 0; i < 6; i++) EXPECT_NEAR(b[i], wanted[i], 1e-6);
}

class ShownMeshes : public ScratchFolder {};

// The pictures of a film see a mesh at all its places: from x = -4 to 6; and what --top leaves of it.
TEST_F(ShownMeshes, OfAFilmAreAllInIt)
{
  write("m_0.stl", stl_text(box_mesh({-4, -3, 0, 1, 0, 1})));
  write("m_0050.stl", stl_text(box_mesh({5, 6, 0, 1, 0, 1})));
  PartOptions options;
  options.bodies = {path("m_*.stl")};
  options.top = 0.5;
  ShownPart part(options, View::Side, true);
  DumpFrame first, second;
  second.step = 50;
  part.look_at(first, {rod_along_x({0, 0, 0}, 0.4)});
  part.look_at(second, {rod_along_x({0, 0, 0}, 0.4)});
  PictureOptions picture;
  part.set(picture, second);
  EXPECT_NEAR(picture.seen->size(0), 10.0, 1e-6);
  EXPECT_NEAR(picture.seen->size(1), 0.6, 1e-6);
  ASSERT_EQ(picture.meshes.size(), 1u);
  EXPECT_NEAR(picture.meshes[0].surface->GetBounds()[0], 5.0, 1e-6);
  EXPECT_EQ(picture.meshes[0].kind, DrawnMesh::Kind::Body);
}

// The floor of a heap reaches a tenth further than its rods, in a box to its sides.
TEST(ShownPart, FloorOfAHeap)
{
  PartOptions options;
  options.vessel.floor = -0.1;
  DumpFrame frame;
  const std::vector<Rod> rods{rod_along_x({0, 0, 0}, 0.4), rod_along_x({0, 1, 0}, 0.4)};
  ShownPart part(options, View::Side, false);
  part.look_at(frame, rods);
  PictureOptions picture;
  part.set(picture, frame);
  ASSERT_EQ(picture.meshes.size(), 1u);
  EXPECT_EQ(picture.meshes[0].kind, DrawnMesh::Kind::Floor);
  const double wanted[] = {-0.6, 0.6, -0.22, 1.22, -0.1, -0.1};
  for (int i = 0; i < 6; i++)
    EXPECT_NEAR(picture.meshes[0].surface->GetBounds()[i], wanted[i], 1e-6);

  options.box = {-2, 2, -3, 3, -1, 1};
  ShownPart boxed(options, View::Side, false);
  boxed.look_at(frame, rods);
  boxed.set(picture, frame);
  EXPECT_NEAR(picture.meshes[0].surface->GetBounds()[3], 3.0, 1e-6);
  options.vessel.floor = 0.5;
  EXPECT_THROW(ShownPart(options, View::Side, false).look_at(frame, rods), InputError);
}

// Front and back dashes cover each other from the side and from the front, and half is gaps.
TEST(VesselSurface, DashesLieBehindEachOther)
{
  const auto ring = dashed_vessel_ring({0, 0, 3, -1, 1}, 0.5);
  std::vector<Vec3> middles;
  double drawn = 0.0;
  for (vtkIdType i = 0; i < ring->GetNumberOfCells(); i++) {
    vtkPoints *ends = ring->GetCell(i)->GetPoints();
    const Vec3 a = load(ends->GetPoint(0)), b = load(ends->GetPoint(1));
    middles.push_back(0.5 * (a + b));
    drawn += norm(b - a);
  }
  const auto is_there = [&](double x, double y) {
    return std::any_of(middles.begin(), middles.end(), [&](const Vec3 &m) {
      return std::hypot(m.x - x, m.y - y) < 1e-5;  // single precision
    });
  };
  for (const Vec3 &m : middles) EXPECT_TRUE(is_there(m.x, -m.y) && is_there(-m.x, m.y));
  EXPECT_NEAR(drawn, 3.0 * std::acos(-1.0), 1e-3);
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

TEST(Annotation, LinesAreBrokenAtBlanks)
{
  EXPECT_EQ(broken_into_lines("elevation (deg)"), "elevation\n(deg)");
  EXPECT_EQ(broken_into_lines("angular velocity (rad/s)"), "angular\nvelocity\n(rad/s)");
  EXPECT_EQ(broken_into_lines("one two three"), "one two\nthree");  // 7 letters, 13 with the third
  EXPECT_EQ(broken_into_lines("c_temperature_of_rod"), "c_temperature_of_rod");
}

// Twice as large letters are twice as wide, to the rounding of each letter to pixels; two lines are
// higher than one.
TEST(Font, SizeOfText)
{
  need_font();
  const TextSize small = size_of_text("λ = 30", 20), large = size_of_text("λ = 30", 40);
  EXPECT_GT(small.width, 3 * 20);  // six letters, none below half as wide as high on the average
  EXPECT_NEAR(large.width, 2 * small.width, 6);
  EXPECT_GT(size_of_text("a\nb", 20).height, size_of_text("b", 20).height + 15);
}

const PictureWords kWords{"λ = 30,  700 rods,  step 500000",
                          "elevation\n(deg)",
                          {"0", "15", "30", "45", "60", "75", "90"},
                          false,
                          false};

// Letters keep to the picture and to themselves, whatever its shape: nothing beyond the edges, the
// colour bar's column beside the room for the rods, caption, scale bar and room above each other.
TEST(PictureLayout, NothingLiesOverAnother)
{
  const int sizes[][2] = {{1200, 900}, {400, 600},  {300, 600},
                          {600, 1800}, {4000, 300}, {300, 300}};
  for (const auto &[width, height] : sizes) {
    const PictureLayout at = lay_out(width, height, 0, kWords);
    const double letter = at.font_size;
    EXPECT_GE(at.right - at.left, 0.5 * width) << width << 'x' << height;
    EXPECT_GE(at.top - at.bottom, 0.5 * height) << width << 'x' << height;
    EXPECT_GT(at.bar_left, at.right);
    EXPECT_LE(at.bar_left + size_of_text(kWords.title, at.font_size).width, width);
    EXPECT_LE(at.bar_left + at.bar_width + at.label_gap + at.labels_width, width);
    EXPECT_LE(at.title_y + size_of_text(kWords.title, at.font_size).height, height);
    EXPECT_GT(at.title_y, at.bar_bottom + at.bar_height + 0.5 * letter);  // half the last label
    EXPECT_GE(at.bar_height, 7.0 * letter);
    EXPECT_LE(at.left + size_of_text(kWords.caption, at.font_size).width, width);
    EXPECT_GE(at.scale_y, at.caption_y + letter);
    EXPECT_GE(at.scale_label_y, at.scale_y + at.scale_thickness);
    EXPECT_GE(at.bottom, at.scale_label_y + letter);
  }
  EXPECT_EQ(lay_out(1200, 900, 0, kWords).font_size, 900 / 45);
}

// Values beyond an end of the colours are said, and nothing moves for it: the pictures of a film match.
TEST(PictureLayout, ValuesBeyondTheEnds)
{
  PictureWords beyond = kWords;
  EXPECT_EQ(beyond.label(0), "0");
  beyond.below = beyond.above = true;
  EXPECT_EQ(beyond.label(0), "≤ 0");
  EXPECT_EQ(beyond.label(1), "15");
  EXPECT_EQ(beyond.label(6), "≥ 90");
  beyond.title = "x";  // narrower than the labels
  PictureWords within = beyond;
  within.below = within.above = false;
  const PictureLayout at = lay_out(600, 400, 0, beyond);
  EXPECT_EQ(at.right, lay_out(600, 400, 0, within).right);
  EXPECT_LE(at.bar_left + at.bar_width + at.label_gap +
                size_of_text(beyond.label(6), at.font_size).width,
            600);
}

// Words shorter than the longest caption of a film leave the letters as they are.
TEST(PictureLayout, PicturesOfAFilmHaveLettersOfOneSize)
{
  PictureWords other = kWords;
  other.caption = "λ = 30,  7 rods,  step 5";
  for (const int width : {300, 400, 1200})
    EXPECT_EQ(lay_out(width, 600, 0, other).font_size, lay_out(width, 600, 0, kWords).font_size);
}

TEST(PictureLayout, WhatDoesNotFitIsRefused)
{
  const auto refusal = [](int width, int height, int font_size, const PictureWords &w) {
    try {
      lay_out(width, height, font_size, w);
    } catch (const InputError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(1200, 900, 32, kWords), "");
  const std::string too_large = refusal(1200, 900, 400, kWords);
  EXPECT_EQ(too_large.find("--font-size: must be at most "), 0u) << too_large;
  const int most = std::stoi(too_large.substr(29));
  EXPECT_EQ(lay_out(1200, 900, most, kWords).font_size, most);
  EXPECT_NE(refusal(1200, 900, most + 1, kWords), "");
  PictureWords wide = kWords;
  wide.title = std::string(60, 'm');
  EXPECT_EQ(refusal(300, 300, 0, wide).find("--size: letters"), 0u);
}

// A complaint of VTK's becomes a sentence, and is caught only while asked for.
TEST(VtkErrors, AreSaid)
{
  vtkNew<vtkPolyDataMapper2D> mapper;
  {
    const VtkErrors errors;
    EXPECT_NO_THROW(errors.expect_none("no picture"));
    vtkWarningWithObjectMacro(mapper, "only a warning");
    EXPECT_NO_THROW(errors.expect_none("no picture"));
    vtkErrorWithObjectMacro(mapper, "the texture is too large");
    try {
      errors.expect_none("no picture");
      ADD_FAILURE() << "not said";
    } catch (const InputError &error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find("no picture (VTK: vtk"), 0u) << what;
      EXPECT_NE(what.find("the texture is too large)"), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
  EXPECT_STRNE(vtkOutputWindow::GetInstance()->GetClassName(), "vtkStringOutputWindow");
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

// A fibre's tube is closed where it ends and has no gap at a joint; its points are about a radius from
// the segments' axes, off by an eighth of bend times length, and normals point away from them.
TEST(FibreSurface, IsASmoothTube)
{
  const double r = 0.005, h = 0.04, bend = 0.3;
  FibreBed bed;
  bed.add_chain(1, points_on_arc({0, 0, 0}, h, 6, bend), r);
  const Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  const RodGeometry geometry = rod_surfaces(bed.rods, fibres, 16);
  vtkPoints *points = geometry.mesh->GetPoints();
  vtkDataArray *normals = geometry.mesh->GetPointData()->GetNormals();
  ASSERT_EQ(geometry.rod_of_point.size(), static_cast<std::size_t>(points->GetNumberOfPoints()));
  ASSERT_EQ(geometry.neighbour_of_point.size(), geometry.rod_of_point.size());
  ASSERT_EQ(geometry.rod_of_cell.size(),
            static_cast<std::size_t>(geometry.mesh->GetNumberOfCells()));
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); k++) {
    const double *at = points->GetPoint(k);
    const Vec3 p{at[0], at[1], at[2]};
    const Segment &s = bed.rods[geometry.rod_of_point[k]].capsule.segment;
    const double along = std::clamp(dot(p - s.centre, s.axis), -s.half_length, s.half_length);
    EXPECT_NEAR(norm(p - s.at(along)), r, h * bend / 8.0 + 0.05 * r);
    const double *n = normals->GetTuple3(k);
    EXPECT_GT(dot({n[0], n[1], n[2]}, p - s.at(along)), 0.9 * r - h * bend / 8.0);
    EXPECT_LE(std::abs(geometry.rod_of_point[k] - geometry.neighbour_of_point[k]), 1);
  }
  // Points that lie on each other are one: each edge then has two triangles but for the poles'.
  std::map<std::array<int, 3>, int> number;
  const auto point = [&](vtkIdType k) {
    const double *at = points->GetPoint(k);
    const auto cell = [](double x) { return static_cast<int>(std::lround(x * 1e7)); };
    return number
        .emplace(std::array{cell(at[0]), cell(at[1]), cell(at[2])}, static_cast<int>(number.size()))
        .first->second;
  };
  std::map<std::pair<int, int>, int> edges;
  for (vtkIdType k = 0; k < geometry.mesh->GetNumberOfCells(); k++) {
    vtkCell *cell = geometry.mesh->GetCell(k);
    for (int e = 0; e < 3; e++) {
      const int a = point(cell->GetPointId(e)), b = point(cell->GetPointId((e + 1) % 3));
      if (a != b) edges[{a, b}]++;
    }
  }
  for (const auto &[edge, count] : edges)
    EXPECT_EQ(count,
              (edges.count({edge.second, edge.first}) ? edges.at({edge.second, edge.first}) : 0));
}

// Over a periodic boundary the tube ends on either side, where its segments are.
TEST(FibreSurface, EndsAtAPeriodicBoundary)
{
  FibreBed bed;
  bed.add_chain(1, points_in_line({0.05, 0, 0}, {1, 0, 0}, 0.04, 4), 0.005);
  for (Rod &rod : bed.rods)
    if (rod.capsule.segment.centre.x > 0.15) rod.capsule.segment.centre.x -= 0.2;
  const Fibres fibres =
      fibres_of(bed.frame({true, false, false}, {{{-0.05, 0.15}, {-1, 1}, {-1, 1}}}), bed.rods, {});
  ASSERT_EQ(fibres.joints.size(), 3u);
  const auto tube = tube_of(fibres.all[0], fibres, bed.rods, 12);
  ASSERT_EQ(tube.size(), 4u);
  for (std::size_t k = 0; k < 4; k++) {
    EXPECT_EQ(tube[k].begins, k == 0 || k == 3) << k;
    EXPECT_EQ(tube[k].ends, k == 2 || k == 3) << k;
    EXPECT_NEAR(tube[k].rings.front().centre.x, bed.rods[k].capsule.segment.centre.x - 0.02, 1e-12);
    EXPECT_NEAR(tube[k].rings.back().centre.x, bed.rods[k].capsule.segment.centre.x + 0.02, 1e-12);
  }
}

// A ring's tube comes back to itself, corner on corner.
TEST(FibreSurface, RingCloses)
{
  std::vector<Vec3> points;
  for (int k = 0; k <= 9; k++) {
    const double angle = 2.0 * M_PI * (k % 9) / 9;
    points.push_back(
        {0.06 * std::cos(angle), 0.05 * std::sin(angle), 0.01 * std::sin(2 * angle + 0.5)});
  }
  FibreBed bed;
  bed.add_chain(1, points, 0.005);
  const Fibres fibres = fibres_of(bed.frame(), bed.rods, {});
  ASSERT_TRUE(fibres.all[0].is_ring);
  const int corners = 12;
  const auto tube = tube_of(fibres.all[0], fibres, bed.rods, corners);
  const TubeRing &first = tube.front().rings.front(), &last = tube.back().rings.back();
  EXPECT_NEAR(norm(first.centre - last.centre), 0.0, 1e-12);
  EXPECT_NEAR(norm(first.along - last.along), 0.0, 1e-12);
  const double turn = std::acos(std::clamp(dot(first.across, last.across), -1.0, 1.0));
  EXPECT_NEAR(std::remainder(turn, 2.0 * M_PI / corners), 0.0, 1e-6);
}

}  // namespace
}  // namespace spherocylinder
