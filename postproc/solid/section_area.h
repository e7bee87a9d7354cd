// SPDX-License-Identifier: GPL-2.0-or-later
// Areas in a plane, in closed form: what a plane section of a rod has in common with a
// polygon or a rectangle.
#pragma once

#include <vector>

namespace spherocylinder {

struct Point2 {
  double t, z;  // t horizontal, z up
};

// A convex polygon, corners counter-clockwise.
using Polygon = std::vector<Point2>;

struct Rectangle {
  double t_low, t_high, z_low, z_high;
};

// All points nearer than `radius` to a segment through the origin: a rod cut by a plane parallel
// to its axis. A segment of zero length gives a disc.
struct Stadium {
  Point2 axis;  // unit vector
  double half_length;
  double radius;
};

double area(const Polygon &polygon);
double area(const Stadium &stadium);

// The part of the polygon where dot(normal, point) <= offset.
Polygon clip(const Polygon &polygon, const Point2 &normal, double offset);

// Area common to the polygon and the disc of this radius about `centre`.
double intersection_area(const Polygon &polygon, const Point2 &centre, double radius);

double intersection_area(const Stadium &stadium, const Polygon &polygon);
double intersection_area(const Stadium &stadium, const Rectangle &rectangle);

// `b_centre`: where the middle of b's segment lies; that of a is the origin.
double intersection_area(const Stadium &a, const Stadium &b, const Point2 &b_centre);

}  // namespace spherocylinder
