// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/mass_properties.h"

#include "core/numbers.h"

namespace spherocylinder {

MassProperties mass_properties(double diameter, double length, double density, int shared_ends)
{
  const double r = 0.5 * diameter;
  const double h = length - diameter;
  const double cylinder = density * pi * r * r * h;
  const double counted = 1.0 - 0.5 * shared_ends;  // of the two hemispheres
  const double sphere = counted * density * (4.0 / 3.0) * pi * r * r * r;

  MassProperties properties;
  properties.mass = cylinder + sphere;
  properties.volume = pi * r * r * h + counted * (4.0 / 3.0) * pi * r * r * r;
  properties.area = 2.0 * pi * r * (length - shared_ends * r);
  properties.inertia_axial = 0.5 * cylinder * r * r + 0.4 * sphere * r * r;
  properties.inertia_transverse = cylinder * (h * h / 12.0 + 0.25 * r * r) +
                                  sphere * (0.4 * r * r + 0.25 * h * h + 0.375 * h * r);
  return properties;
}

}  // namespace spherocylinder
