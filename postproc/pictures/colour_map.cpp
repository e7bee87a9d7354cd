// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/colour_map.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

namespace spherocylinder {

vtkSmartPointer<vtkLookupTable> viridis(double low, double high)
{
  constexpr int kControls[][3] = {{68, 1, 84},    {72, 36, 117},  {65, 68, 135},  {53, 95, 141},
                                  {42, 120, 142}, {33, 145, 140}, {34, 168, 132}, {68, 191, 112},
                                  {122, 209, 81}, {189, 223, 38}, {253, 231, 37}};
  constexpr int kColours = 256;
  vtkNew<vtkColorTransferFunction> curve;
  curve->SetColorSpaceToLab();
  double at = 0.0;
  for (const auto &[red, green, blue] : kControls) {
    curve->AddRGBPoint(at, red / 255.0, green / 255.0, blue / 255.0);
    at += 0.1;
  }

  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kColours);
  for (int i = 0; i < kColours; i++) {
    double rgb[3];
    curve->GetColor(static_cast<double>(i) / (kColours - 1), rgb);
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2]);
  }
  table->SetTableRange(low, high);
  return table;
}

}  // namespace spherocylinder
