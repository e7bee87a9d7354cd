// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/bed_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "core/numbers.h"
#include "io/vtk_errors.h"
#include "pictures/annotation.h"
#include "pictures/colour_map.h"
#include "pictures/mesh_surface.h"
#include "pictures/picture_layout.h"
#include "pictures/png_file.h"
#include "pictures/rod_surface.h"
#include "pictures/vessel_surface.h"

namespace spherocylinder {
namespace {

// The picture is drawn this many times larger each way, steps along edges are blurred (FXAA), and
// it is averaged down: ambient occlusion does not go with the driver's own smoothing.
constexpr int kOversampling = 2;

Extent extent_of(const std::vector<Rod> &rods, const PictureOptions &options)
{
  Extent extent(options.view);
  if (options.aim_at_rods) extent.include(rods);
  if (options.seen) extent.include(*options.seen);
  if (options.box)
    for (const Vec3 &corner : corners_of(*options.box)) extent.include(corner);
  for (const DrawnMesh &mesh : options.meshes) extent.include(mesh.surface);
  if (!options.vessel) return extent;
  const UprightCylinder &vessel = options.vessel->cylinder;
  for (const double z : {vessel.z_low, vessel.z_high}) {
    const auto ring = vessel_ring(vessel, z);
    turn_to_space(ring, options.vessel->axis);
    for (vtkIdType i = 0; i < ring->GetNumberOfPoints(); i++)
      extent.include(load(ring->GetPoint(i)));
  }
  return extent;
}

vtkSmartPointer<vtkActor> add_surface(vtkRenderer *renderer, vtkPolyData *mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

// Of a point, those of two segments of a fibre blended.
double value_at(const RodGeometry &geometry, std::size_t point, const std::vector<double> &values,
                bool blend)
{
  const double own = values[geometry.rod_of_point[point]];
  if (!blend || geometry.neighbour_of_point.empty()) return own;
  const double part = geometry.part_of_neighbour[point];
  return own + part * (values[geometry.neighbour_of_point[point]] - own);
}

void add_rods(vtkRenderer *renderer, const std::vector<Rod> &rods, const Fibres &fibres,
              const RodQuantity &colour, vtkLookupTable *colours, const PictureOptions &options)
{
  const RodGeometry geometry = rod_surfaces(rods, fibres, options.resolution);
  vtkNew<vtkFloatArray> numbers;
  numbers->SetNumberOfValues(static_cast<vtkIdType>(geometry.rod_of_point.size()));
  for (std::size_t i = 0; i < geometry.rod_of_point.size(); i++)
    numbers->SetValue(static_cast<vtkIdType>(i),
                      static_cast<float>(value_at(geometry, i, colour.values, options.blend)));
  geometry.mesh->GetPointData()->SetScalars(numbers);

  const auto actor = add_surface(renderer, geometry.mesh);
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetLookupTable(colours);
  actor->GetMapper()->UseLookupTableScalarRangeOn();
  actor->GetProperty()->SetInterpolationToPhong();
  actor->GetProperty()->SetAmbient(0.3);
  actor->GetProperty()->SetDiffuse(0.9);
  actor->GetProperty()->SetSpecular(0.35);
  actor->GetProperty()->SetSpecularPower(40.0);
}

// As thick as the strokes of small letters, at least a pixel and a little more.
void add_line(vtkRenderer *renderer, vtkPolyData *line, const Ink &ink)
{
  const double width = std::max(1.2 * kOversampling, ink.font_size / 16.0);
  const auto actor = add_surface(renderer, line);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(ink.red, ink.green, ink.blue);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
}

void add_box(vtkRenderer *renderer, const Box &box, const Ink &ink)
{
  vtkNew<vtkOutlineSource> edges;
  edges->SetBounds(box[0][0], box[0][1], box[1][0], box[1][1], box[2][0], box[2][1]);
  edges->Update();
  add_line(renderer, edges->GetOutput(), ink);
}

// To be looked through.
void add_pane(vtkRenderer *renderer, vtkPolyData *mesh, double opacity)
{
  const auto actor = add_surface(renderer, mesh);
  actor->GetProperty()->SetColor(0.55, 0.63, 0.72);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetOpacity(opacity);
}

constexpr double kWallOpacity = 0.18, kFloorOpacity = 0.35;

void add_mesh(vtkRenderer *renderer, const DrawnMesh &mesh, const ViewFrame &frame, const Ink &ink)
{
  if (mesh.kind == DrawnMesh::Kind::Body) {
    const auto actor = add_surface(renderer, mesh.surface);
    actor->GetProperty()->SetColor(0.62, 0.65, 0.68);
    actor->GetProperty()->SetInterpolationToFlat();
    return;
  }
  if (mesh.kind == DrawnMesh::Kind::Floor)
    add_pane(renderer, mesh.surface, kFloorOpacity);
  else
    add_pane(renderer, walls_behind(mesh.surface, frame.towards), kWallOpacity);
  add_line(renderer, outline_of(mesh.surface, frame.towards), ink);
}

// The half of the wall behind the rods, the end away from the viewer, the two rings (dashed where
// the vessel goes on beyond them) and the outline's two lines along the axis.
void add_vessel(vtkRenderer *renderer, const DrawnVessel &drawn, const ViewFrame &frame,
                const Ink &ink)
{
  const UprightCylinder &vessel = drawn.cylinder;
  const Vec3 towards = to_vessel(frame.towards, drawn.axis);
  const double across = std::hypot(towards.x, towards.y);
  const bool end_on = across < 1e-9;
  WallArc back;
  if (!end_on) {
    back.begin = std::atan2(towards.y, towards.x) + 0.5 * pi;
    back.span = pi;
  }
  const auto add_turned = [&](vtkPolyData *mesh, double opacity) {
    turn_to_space(mesh, drawn.axis);
    add_pane(renderer, mesh, opacity);
  };
  const auto add_edge = [&](vtkPolyData *line) {
    turn_to_space(line, drawn.axis);
    add_line(renderer, line, ink);
  };
  add_turned(vessel_wall(vessel, back), kWallOpacity);
  const bool low_is_far = towards.z >= 0.0;
  if (!(low_is_far ? drawn.goes_on_below : drawn.goes_on_above)) {
    UprightCylinder far_end = vessel;
    if (!low_is_far) far_end.z_low = vessel.z_high;
    add_turned(vessel_floor(far_end), kFloorOpacity);
  }
  for (const auto &[z, goes_on] : {std::pair{vessel.z_low, drawn.goes_on_below},
                                   std::pair{vessel.z_high, drawn.goes_on_above}})
    add_edge(goes_on ? dashed_vessel_ring(vessel, z) : vessel_ring(vessel, z));
  if (end_on) return;
  for (const double side : {-vessel.radius, vessel.radius}) {
    const double x = vessel.x - side * towards.y / across;
    const double y = vessel.y + side * towards.x / across;
    vtkNew<vtkLineSource> line;
    line->SetPoint1(x, y, vessel.z_low);
    line->SetPoint2(x, y, vessel.z_high);
    line->Update();
    add_edge(line->GetOutput());
  }
}

// A key light from the upper left and a weak one from the right, fixed to the camera.
void add_lights(vtkRenderer *renderer)
{
  struct Lamp {
    double x, y, z, intensity;
  };
  renderer->RemoveAllLights();
  renderer->AutomaticLightCreationOff();
  for (const Lamp &lamp : {Lamp{-0.6, 0.9, 1.0, 0.85}, Lamp{1.0, 0.2, 0.6, 0.3}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(lamp.x, lamp.y, lamp.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(lamp.intensity);
    renderer->AddLight(light);
  }
}

// Points the camera so that the extent fills its part of the picture; returns the width of the
// whole picture in metres.
double aim_camera(vtkRenderer *renderer, const ViewFrame &frame, const Extent &extent,
                  const PictureLayout &layout, const PictureOptions &options)
{
  const double pixel = std::max(extent.size(0) / (layout.right - layout.left),
                                extent.size(1) / (layout.top - layout.bottom));  // metres
  const double picture_width = pixel * options.width, picture_height = pixel * options.height;
  const double x = extent.middle(0) - 0.5 * (layout.left + layout.right - options.width) * pixel;
  const double y = extent.middle(1) - 0.5 * (layout.bottom + layout.top - options.height) * pixel;
  const Vec3 focus = x * frame.right + y * frame.up + extent.middle(2) * frame.towards;
  const Vec3 eye = focus + (extent.size(2) + picture_width) * frame.towards;

  vtkCamera *camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus.x, focus.y, focus.z);
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetViewUp(frame.up.x, frame.up.y, frame.up.z);
  camera->SetParallelScale(0.5 * picture_height);
  renderer->ResetCameraClippingRange();
  return picture_width;
}

// What stands beside the colours.
PictureWords words_of(const PictureOptions &options, const RodQuantity &colour,
                      const RoundRange &range)
{
  PictureWords words{options.caption, broken_into_lines(colour.title), {}, false, false};
  for (int i = 0; options.colour_bar && i < range.labels; i++)
    words.labels.push_back(
        fmt::format("{:.3g}", range.low + i * (range.high - range.low) / (range.labels - 1)));
  const double crumb = 1e-9 * (range.high - range.low);
  for (const double value : colour.values) {
    words.below = words.below || value < range.low - crumb;
    words.above = words.above || value > range.high + crumb;
  }
  return words;
}

void add_annotation(vtkRenderer *renderer, const PictureOptions &options, const PictureLayout &at,
                    const PictureWords &words, vtkLookupTable *colours, double picture_width,
                    const Ink &ink)
{
  const double width = options.width, height = options.height;
  const auto add_text = [&](const std::string &text_, double x, double y, TextAt foot) {
    renderer->AddActor2D(text(text_, x / width, y / height, ink, foot));
  };
  const double length = round_length(0.25 * picture_width);
  renderer->AddActor2D(bar(at.left / width, at.scale_y / height, length / picture_width,
                           at.scale_thickness / height, ink));
  add_text(length_label(length), at.left, at.scale_label_y, TextAt::Foot);
  add_text(words.caption, at.left, at.caption_y, TextAt::Foot);
  if (words.labels.empty()) return;
  renderer->AddActor2D(colour_bar(colours, at.bar_left / width, at.bar_bottom / height,
                                  at.bar_width / width, at.bar_height / height));
  add_text(words.title, at.bar_left, at.title_y, TextAt::Foot);
  const double step = at.bar_height / static_cast<double>(words.labels.size() - 1);
  for (std::size_t i = 0; i < words.labels.size(); i++)
    add_text(words.label(i), at.bar_left + at.bar_width + at.label_gap,
             at.bar_bottom + static_cast<double>(i) * step, TextAt::Middle);
}

}  // namespace

std::array<Vec3, 8> corners_of(const Box &box)
{
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; i++) corners[i] = {box[0][i & 1], box[1][(i >> 1) & 1], box[2][i >> 2]};
  return corners;
}

void write_bed_picture(const std::string &path, const std::vector<Rod> &rods, const Fibres &fibres,
                       const RodQuantity &colour, const PictureOptions &options)
{
  const RoundRange range = round_range(colour.low, colour.high);
  const PictureWords words = words_of(options, colour, range);
  const PictureLayout layout = lay_out(options.width, options.height, options.font_size, words);
  const ViewFrame frame = frame_of(options.view);
  const Extent extent = extent_of(rods, options);
  const Ink ink = ink_for(options.background, kOversampling * layout.font_size);
  const auto colours = viridis(range.low, range.high);

  const VtkErrors errors;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(options.background[0], options.background[1], options.background[2]);
  add_rods(renderer, rods, fibres, colour, colours, options);
  if (options.vessel) add_vessel(renderer, *options.vessel, frame, ink);
  if (options.box) add_box(renderer, *options.box, ink);
  for (const DrawnMesh &mesh : options.meshes) add_mesh(renderer, mesh, frame, ink);
  add_lights(renderer);

  // Ambient occlusion darkens the gaps between rods, which tells near from far in a bed.
  const double thickness = rods.empty() ? 0.0 : 2.0 * rods.front().capsule.radius;
  renderer->SetUseSSAO(!rods.empty());
  renderer->SetSSAORadius(5.0 * thickness);
  renderer->SetSSAOBias(0.05 * thickness);
  renderer->SetSSAOKernelSize(32);
  renderer->SSAOBlurOn();

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  renderer->UseFXAAOn();  // before letters and bars are drawn
  window->SetSize(kOversampling * options.width, kOversampling * options.height);
  window->AddRenderer(renderer);
  const double picture_width = aim_camera(renderer, frame, extent, layout, options);
  add_annotation(renderer, options, layout, words, colours, picture_width, ink);
  window->Render();
  write_png(window, path, kOversampling);
  errors.expect_none(
      fmt::format("the picture of {}x{} pixels cannot be drawn", options.width, options.height));
}

}  // namespace spherocylinder
