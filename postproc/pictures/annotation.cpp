// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/annotation.h"

#include <cmath>

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

#include "pictures/font.h"

namespace spherocylinder {

double round_length(double most)
{
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

RoundRange round_range(double low, double high)
{
  if (low == high) {
    const double room = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    low -= room;
    high += room;
  }
  if (low == 0.0 && high == 90.0) return {low, high, 7};  // an angle is better cut into fifteens
  // The part of a step that round-off may add is not worth another step.
  constexpr double kRoundOff = 1e-9;
  const double step = round_length((high - low) / 4.0);
  const double first = std::floor(low / step + kRoundOff);
  const double last = std::ceil(high / step - kRoundOff);
  return {first * step, last * step, static_cast<int>(last - first) + 1};
}

std::string length_label(double metres)
{
  if (metres >= 1.0) return fmt::format("{:.3g} m", metres);
  if (metres >= 1e-3) return fmt::format("{:.3g} mm", 1e3 * metres);
  return fmt::format("{:.3g} um", 1e6 * metres);
}

Ink ink_for(const double background[3], int font_size)
{
  const double light = 0.3 * background[0] + 0.59 * background[1] + 0.11 * background[2];
  const double shade = light > 0.5 ? 0.1 : 0.95;
  return {shade, shade, shade, font_size};
}

vtkSmartPointer<vtkTextActor> text(const std::string &words, double x, double y, const Ink &ink,
                                   TextAt height)
{
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(words.c_str());
  set_font(actor->GetTextProperty(), ink.font_size);
  actor->GetTextProperty()->SetColor(ink.red, ink.green, ink.blue);
  if (height == TextAt::Middle) actor->GetTextProperty()->SetVerticalJustificationToCentered();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  return actor;
}

vtkSmartPointer<vtkActor2D> bar(double x, double y, double width, double thickness, const Ink &ink)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, y, 0.0);
  points->InsertNextPoint(x + width, y, 0.0);
  points->InsertNextPoint(x + width, y + thickness, 0.0);
  points->InsertNextPoint(x, y + thickness, 0.0);
  vtkNew<vtkCellArray> quad;
  const vtkIdType corners[4] = {0, 1, 2, 3};
  quad->InsertNextCell(4, corners);
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetPolys(quad);

  vtkNew<vtkCoordinate> parts;
  parts->SetCoordinateSystemToNormalizedViewport();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  mapper->SetTransformCoordinate(parts);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(ink.red, ink.green, ink.blue);
  return actor;
}

vtkSmartPointer<vtkActor2D> colour_bar(vtkLookupTable *colours, double x, double y, double width,
                                       double height)
{
  auto actor = vtkSmartPointer<vtkScalarBarActor>::New();
  actor->SetLookupTable(colours);
  actor->SetTitle("");
  actor->DrawTickLabelsOff();
  actor->SetBarRatio(1.0);
  actor->SetMaximumNumberOfColors(static_cast<int>(colours->GetNumberOfTableValues()));
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  actor->SetWidth(width);
  actor->SetHeight(height);
  return actor;
}

}  // namespace spherocylinder
