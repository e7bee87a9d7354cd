// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkPolyData.h>

namespace spherocylinder {

ViewFrame frame_of(View view)
{
  if (view == View::Side) return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  if (view == View::Top) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double turn = 0.44, lift = 0.44;  // rad, 25 degrees
  const Vec3 right{std::cos(turn), std::sin(turn), 0.0};
  const Vec3 front{std::sin(turn), -std::cos(turn), 0.0};
  const Vec3 towards = std::cos(lift) * front + std::sin(lift) * Vec3{0, 0, 1};
  return {right, cross(towards, right), towards};
}

Extent::Extent(View view) : frame_(frame_of(view))
{
  std::fill(low_, low_ + 3, std::numeric_limits<double>::infinity());
  std::fill(high_, high_ + 3, -std::numeric_limits<double>::infinity());
}

void Extent::include(const Vec3 &point, double radius)
{
  const double along[3] = {dot(point, frame_.right), dot(point, frame_.up),
                           dot(point, frame_.towards)};
  for (int i = 0; i < 3; i++) {
    low_[i] = std::min(low_[i], along[i] - radius);
    high_[i] = std::max(high_[i], along[i] + radius);
  }
}

void Extent::include(const std::vector<Rod> &rods)
{
  for (const Rod &rod : rods)
    for (const double side : {-1.0, 1.0})
      include(rod.capsule.segment.at(side * rod.capsule.segment.half_length), rod.capsule.radius);
}

void Extent::include(vtkPolyData *mesh)
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); i++) include(load(mesh->GetPoint(i)));
}

void Extent::include(const Extent &other)
{
  for (int i = 0; i < 3; i++) {
    low_[i] = std::min(low_[i], other.low_[i]);
    high_[i] = std::max(high_[i], other.high_[i]);
  }
}

}  // namespace spherocylinder
