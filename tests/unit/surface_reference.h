// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces of triangles, rods near them, and slow methods for what is nearest; no formula of the
// core.
#pragma once

#include <vector>

#include "core/triangle_surface.h"
#include "test_support.h"

using Mesh = std::vector<spherocylinder::Corners>;

// ---- slow methods -------------------------------------------------------------------------------

struct Nearest {
  spherocylinder::Vec3 point;  // of the triangle or surface
  double distance;
};

// The normal equations of |a + u (b - a) + v (c - a) - point|^2 if their solution is in the
// triangle, else the best of the three sides. In long double.
Nearest nearest_on_triangle(const spherocylinder::Corners &corners,
                            const spherocylinder::Vec3 &point);

// The distance of an axis and a surface, at most `reach`: of a point that runs along the axis to
// each triangle, which is convex, by golden section.
double distance_of_axis(const spherocylinder::Segment &axis, const Mesh &mesh, double reach);

// The places where the surface is nearest to a point, no farther than `reach`: the nearest point of
// a triangle if no triangle within `margin` of it has a nearer one (a triangle being convex, it has
// one minimum). With a margin, minima that hardly are ones are left out.
std::vector<Nearest> minima_of_distance(const Mesh &mesh, const spherocylinder::Vec3 &point,
                                        double reach, double margin);

// Whether the mesh is between two points; not clear where the way passes within `margin` of a side
// of a triangle, or ends within it of one's plane.
enum class Sight { kFree, kHidden, kUnclear };
Sight sight_of(const Mesh &mesh, const spherocylinder::Vec3 &from, const spherocylinder::Vec3 &to,
               double margin);

// ---- surfaces of about the size 1 ---------------------------------------------------------------

Mesh box_mesh(const spherocylinder::Vec3 &half);                  // about the origin
Mesh hull_mesh(RandomRods &random, int points);                   // of points on the unit sphere
Mesh step_mesh();                                                 // a floor, a wall up, a floor
Mesh triangle_mesh(RandomRods &random);                           // one
Mesh spike_mesh();                                                // a slender tetrahedron
Mesh tube_mesh(int facets, double half_length, double phase);     // radius 1, about z, no lids
Mesh waves_mesh(RandomRods &random, int squares, double height);  // over |x|, |y| <= 1

Mesh four_for_one(const Mesh &mesh);

// A rod that comes near a random point of the mesh, up to 1.3 radii, from any side; its axis goes
// through nothing and stays 1e-3 radii away.
spherocylinder::Capsule rod_near(RandomRods &random, const Mesh &mesh, double radius,
                                 double aspect_ratio);
