// SPDX-License-Identifier: GPL-2.0-or-later
#include "walls/wall_surface.h"

#include <utility>

#include "container.h"
#include "primitive_wall.h"

using namespace LAMMPS_NS;
using spherocylinder::load;
using spherocylinder::norm;
using spherocylinder::Vec3;

namespace {

Vec3 along(int axis)
{
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

Vec3 way_to_wall(PrimitiveWall &wall, double x, double y, double z)
{
  double at[3] = {x, y, z}, way[3] = {0.0, 0.0, 0.0};
  wall.resolveContact(at, 0.0, way);
  return load(way);
}

WallSurface plane(PrimitiveWall &wall)
{
  // Of two different points one is off the plane, and from there the way has one component.
  double base = 0.0;
  Vec3 way = way_to_wall(wall, base, base, base);
  if (norm(way) == 0.0) {
    base = 1.0;
    way = way_to_wall(wall, base, base, base);
  }
  const int axis = way.x != 0.0 ? 0 : way.y != 0.0 ? 1 : 2;
  return {false, along(axis), Vec3{base, base, base} + way, 0.0};
}

WallSurface cylinder(PrimitiveWall &wall)
{
  double origin[3] = {0.0, 0.0, 0.0}, radial[3];
  wall.calcRadialDistance(origin, radial);
  // LIGGGHTS gives x and z of a ycylinder in each other's place.
  if (wall.axis() == 1) std::swap(radial[0], radial[2]);
  WallSurface surface{true, along(wall.axis()), -load(radial), 0.0};

  // From a point off the axis the way to the wall is along the radius, outwards or inwards.
  const Vec3 off_axis = surface.point + Vec3{1.0, 1.0, 1.0};
  surface.radius =
      norm(surface.radial(off_axis) + way_to_wall(wall, off_axis.x, off_axis.y, off_axis.z));
  return surface;
}

}  // namespace

WallSurface LAMMPS_NS::surface_of(PrimitiveWall &wall)
{
  return wall.axis() >= 0 ? cylinder(wall) : plane(wall);
}
