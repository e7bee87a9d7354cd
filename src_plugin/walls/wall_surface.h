// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/capsule.h"
#include "core/closest_points.h"
#include "core/spread_contact.h"

namespace LAMMPS_NS {

class PrimitiveWall;

// An end sphere of a rod against a wall.
struct EndContact {
  double distance;              // of the end from the surface, negative once it is through (m)
  spherocylinder::Vec3 normal;  // unit, from the wall to the rod's side of it
  spherocylinder::Vec3 radial;  // cylinders: from the cylinder's axis to the end (m)
};

// The two ends of a rod, or the one of a sphere.
struct RodEnds {
  int count;                     // 0: no side of the wall can be told to be the rod's
  spherocylinder::Vec3 arms[2];  // from the rod's centre: at -u and at +u (m)
  EndContact contacts[2];

  bool touch(double radius) const
  {
    return (count > 0 && contacts[0].distance <= radius) ||
           (count > 1 && contacts[1].distance <= radius);
  }
};

// A wall in numbers: a plane at right angles to a coordinate axis, or a cylinder along one. A plane and the
// inside of a cylinder are touched with a rod's ends, the outside of a cylinder anywhere along the rod.
struct WallSurface {
  bool is_cylinder;
  spherocylinder::Vec3 direction;  // unit: of the plane's normal, or of the cylinder's axis
  spherocylinder::Vec3 point;      // on the plane, or on the cylinder's axis (m)
  double radius;                   // of the cylinder (m)

  // From the cylinder's axis to a point (m).
  SPHEROCYLINDER_INLINE spherocylinder::Vec3 radial(const spherocylinder::Vec3 &at) const
  {
    return {(1.0 - direction.x) * (at.x - point.x), (1.0 - direction.y) * (at.y - point.y),
            (1.0 - direction.z) * (at.z - point.z)};
  }
  // Of a point from the plane, signed, along the coordinate axis (m).
  SPHEROCYLINDER_INLINE double height(const spherocylinder::Vec3 &at) const
  {
    return dot(at - point, direction);
  }
  // Of a rod's centre: the rod is outside of the cylinder then.
  SPHEROCYLINDER_INLINE bool is_outside(const spherocylinder::Vec3 &centre) const
  {
    return is_cylinder && norm_squared(radial(centre)) > radius * radius;
  }
  // Of a bounding sphere from the surface, negative if they cut (m).
  double gap_of_sphere(const spherocylinder::Vec3 &centre, double bounding_radius) const
  {
    const double distance = is_cylinder ? norm(radial(centre)) - radius : height(centre);
    return std::fabs(distance) - bounding_radius;
  }

  // An end that is through the wall while the rod's centre is not belongs to the centre's side; a
  // centre in the plane has none.
  SPHEROCYLINDER_INLINE RodEnds ends_of(const spherocylinder::Capsule &rod) const
  {
    const spherocylinder::Segment &segment = rod.segment;
    RodEnds ends;
    ends.count = segment.half_length > 0.0 ? 2 : 1;
    ends.arms[0] = -segment.half_length * segment.axis;
    ends.arms[1] = segment.half_length * segment.axis;
    if (is_cylinder) {
      for (int k = 0; k < 2; k++) ends.contacts[k] = inside(segment.centre + ends.arms[k]);
      return ends;
    }
    const double height_of_centre = height(segment.centre);
    const spherocylinder::Vec3 normal = (height_of_centre > 0.0 ? 1.0 : -1.0) * direction;
    if (height_of_centre == 0.0) ends.count = 0;
    for (int k = 0; k < 2; k++)
      ends.contacts[k] = {std::fabs(height_of_centre) + dot(ends.arms[k], normal), normal,
                          spherocylinder::Vec3{0.0, 0.0, 0.0}};
    return ends;
  }

  // Of the axis of a rod outside of the cylinder and the cylinder's own.
  spherocylinder::ClosestPoints closest_at_outside(const spherocylinder::Segment &rod) const
  {
    return closest_points(rod, axis_beside(rod));
  }
  // Of a rod outside that touches: as with a straight rod of the cylinder's radius, without ends.
  // `spread`: see spherocylinder::spread_contact.
  spherocylinder::RodContact contact_at_outside(const spherocylinder::Capsule &rod,
                                                const spherocylinder::ClosestPoints &closest,
                                                bool spread) const
  {
    const double reach = rod.radius + radius;
    if (spread) return spread_contact(rod.segment, axis_beside(rod.segment), reach, closest);
    return {closest, reach - std::sqrt(closest.distance_squared)};
  }

  // As much of the cylinder's axis as the rod can be beside.
  spherocylinder::Segment axis_beside(const spherocylinder::Segment &rod) const
  {
    return {rod.centre - radial(rod.centre), direction, 2.0 * rod.half_length + radius};
  }

 private:
  // An end on the cylinder's axis touches nothing.
  SPHEROCYLINDER_INLINE EndContact inside(const spherocylinder::Vec3 &end) const
  {
    const spherocylinder::Vec3 from_axis = radial(end);
    const double distance = norm(from_axis);
    const double inwards = distance > 0.0 ? -1.0 / distance : 0.0;
    return {radius - distance, inwards * from_axis, from_axis};
  }
};

// What LIGGGHTS's own wall is, found by asking it about two points: it does not tell its
// parameters.
WallSurface surface_of(PrimitiveWall &wall);

}  // namespace LAMMPS_NS
