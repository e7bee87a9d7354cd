// SPDX-License-Identifier: GPL-2.0-or-later
#include "surface_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace spherocylinder;

namespace {

using Long = long double;

struct LongVec {
  Long x, y, z;
};

LongVec operator-(const LongVec &a, const LongVec &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
LongVec operator+(const LongVec &a, const LongVec &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
LongVec operator*(Long s, const LongVec &a) { return {s * a.x, s * a.y, s * a.z}; }
Long dot(const LongVec &a, const LongVec &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LongVec cross(const LongVec &a, const LongVec &b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LongVec longer(const Vec3 &a) { return {a.x, a.y, a.z}; }
Vec3 rounded(const LongVec &a)
{
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

double triangle_distance(const Corners &corners, const Vec3 &point)
{
  return nearest_on_triangle(corners, point).distance;
}

double side_distance(const Vec3 &from, const Vec3 &to, const Vec3 &point)
{
  const double part = dot(point - from, to - from) / norm_squared(to - from);
  return norm(point - from - std::min(1.0, std::max(0.0, part)) * (to - from));
}

// Certainly: by a sphere around the first corner.
bool is_farther(const Corners &corners, const Vec3 &point, double reach)
{
  const double size =
      std::max(norm_squared(corners[1] - corners[0]), norm_squared(corners[2] - corners[0]));
  return norm(point - corners[0]) > 1.000001 * (reach + std::sqrt(size));
}

}  // namespace

Nearest nearest_on_triangle(const Corners &corners, const Vec3 &point)
{
  const LongVec corner[] = {longer(corners[0]), longer(corners[1]), longer(corners[2])};
  const LongVec p = longer(point);
  const LongVec b = corner[1] - corner[0], c = corner[2] - corner[0], w = p - corner[0];
  const Long bb = dot(b, b), bc = dot(b, c), cc = dot(c, c), wb = dot(w, b), wc = dot(w, c);
  const Long determinant = bb * cc - bc * bc;
  const Long u = (cc * wb - bc * wc) / determinant, v = (bb * wc - bc * wb) / determinant;
  LongVec best = corner[0] + u * b + v * c;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) {
    Long least = std::numeric_limits<Long>::max();
    for (int k = 0; k < 3; k++) {
      const LongVec side = corner[(k + 1) % 3] - corner[k];
      const Long part = dot(p - corner[k], side) / dot(side, side);
      const LongVec at = corner[k] + std::min(Long(1), std::max(Long(0), part)) * side;
      const Long squared = dot(p - at, p - at);
      if (squared >= least) continue;
      least = squared;
      best = at;
    }
  }
  return {rounded(best), static_cast<double>(std::sqrt(dot(p - best, p - best)))};
}

double distance_of_axis(const Segment &axis, const Mesh &mesh, double reach)
{
  constexpr double kGolden = 0.61803398874989485;
  double least = reach;
  for (const Corners &corners : mesh) {
    double low = -axis.half_length, high = axis.half_length;
    if (is_farther(corners, axis.centre, axis.half_length + least)) continue;
    if (triangle_distance(corners, axis.centre) - axis.half_length > least) continue;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double at_a = triangle_distance(corners, axis.at(a)),
           at_b = triangle_distance(corners, axis.at(b));
    // Nowhere is it nearer than this by more than the interval; 0.618^60 = 3e-13.
    for (int k = 0; k < 60 && std::min(at_a, at_b) - (high - low) < least; k++) {
      if (at_a < at_b) {
        high = b;
        b = a;
        at_b = at_a;
        a = high - kGolden * (high - low);
        at_a = triangle_distance(corners, axis.at(a));
      } else {
        low = a;
        a = b;
        at_a = at_b;
        b = low + kGolden * (high - low);
        at_b = triangle_distance(corners, axis.at(b));
      }
    }
    least = std::min({least, at_a, at_b, triangle_distance(corners, axis.at(-axis.half_length)),
                      triangle_distance(corners, axis.at(axis.half_length))});
  }
  return least;
}

std::vector<Nearest> minima_of_distance(const Mesh &mesh, const Vec3 &point, double reach,
                                        double margin)
{
  std::vector<Nearest> near;
  std::vector<const Corners *> triangles;
  for (const Corners &corners : mesh) {
    if (is_farther(corners, point, reach)) continue;
    near.push_back(nearest_on_triangle(corners, point));
    triangles.push_back(&corners);
  }
  std::vector<Nearest> minima;
  for (const Nearest &one : near) {
    if (one.distance > reach) continue;
    bool is_one = true;
    for (size_t k = 0; k < near.size() && is_one; k++)
      is_one = near[k].distance >= one.distance - 1e-12 * reach ||
               nearest_on_triangle(*triangles[k], one.point).distance > margin;
    for (const Nearest &minimum : minima)
      is_one = is_one && norm(minimum.point - one.point) > margin;
    if (is_one) minima.push_back(one);
  }
  return minima;
}

Sight sight_of(const Mesh &mesh, const Vec3 &from, const Vec3 &to, double margin)
{
  Sight sight = Sight::kFree;
  for (const Corners &corners : mesh) {
    const LongVec a = longer(corners[0]), b = longer(corners[1]), c = longer(corners[2]);
    const LongVec normal = cross(b - a, c - a);
    const Long scale = std::sqrt(dot(normal, normal));
    const Long high = dot(longer(from) - a, normal) / scale;
    const Long low = dot(longer(to) - a, normal) / scale;
    if ((high < -margin && low < -margin) || (high > margin && low > margin)) continue;
    // Near its own triangle, or a neighbour in whose plane it is, the target is in sight.
    if (std::fabs(low) <= margin) {
      if (std::fabs(low) > 1e-9L * margin) sight = Sight::kUnclear;
      continue;
    }
    if (std::fabs(high) <= margin) {
      sight = Sight::kUnclear;
      continue;
    }
    const Long part = high / (high - low);
    const Vec3 crossing = rounded(longer(from) + part * (longer(to) - longer(from)));
    if (triangle_distance(corners, crossing) > margin) continue;
    double to_sides = margin;
    for (int k = 0; k < 3; k++)
      to_sides = std::min(to_sides, side_distance(corners[k], corners[(k + 1) % 3], crossing));
    if (to_sides >= margin) return Sight::kHidden;
    sight = Sight::kUnclear;
  }
  return sight;
}

// ---- surfaces -----------------------------------------------------------------------------------

namespace {

// A flat one with corners in turn.
void add_quad(Mesh &mesh, const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  mesh.push_back({a, b, c});
  mesh.push_back({a, c, d});
}

}  // namespace

Mesh box_mesh(const Vec3 &half)
{
  const auto corner = [&](int x, int y, int z) -> Vec3 {
    return {x * half.x, y * half.y, z * half.z};
  };
  Mesh mesh;
  for (const int side : {-1, 1}) {
    add_quad(mesh, corner(side, -1, -1), corner(side, 1, -1), corner(side, 1, 1),
             corner(side, -1, 1));
    add_quad(mesh, corner(-1, side, -1), corner(1, side, -1), corner(1, side, 1),
             corner(-1, side, 1));
    add_quad(mesh, corner(-1, -1, side), corner(1, -1, side), corner(1, 1, side),
             corner(-1, 1, side));
  }
  return mesh;
}

Mesh hull_mesh(RandomRods &random, int points)
{
  std::vector<Vec3> all;
  for (int k = 0; k < points; k++) all.push_back(random.direction());
  Mesh mesh;
  for (int a = 0; a < points; a++)
    for (int b = a + 1; b < points; b++)
      for (int c = b + 1; c < points; c++) {
        const Vec3 normal = cross(all[b] - all[a], all[c] - all[a]);
        int above = 0, below = 0;
        for (int k = 0; k < points; k++)
          if (k != a && k != b && k != c) (dot(all[k] - all[a], normal) > 0.0 ? above : below)++;
        if (above == 0) mesh.push_back({all[a], all[b], all[c]});
        if (below == 0) mesh.push_back({all[a], all[c], all[b]});
      }
  return mesh;
}

Mesh step_mesh()
{
  Mesh mesh;
  add_quad(mesh, {-1.0, -1.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}, {-1.0, 1.0, 0.0});
  add_quad(mesh, {0.0, -1.0, 0.0}, {0.0, -1.0, 0.5}, {0.0, 1.0, 0.5}, {0.0, 1.0, 0.0});
  add_quad(mesh, {0.0, -1.0, 0.5}, {1.0, -1.0, 0.5}, {1.0, 1.0, 0.5}, {0.0, 1.0, 0.5});
  return mesh;
}

Mesh triangle_mesh(RandomRods &random)
{
  return {{random.direction(), random.direction(), random.direction()}};
}

Mesh spike_mesh()
{
  const Vec3 tip = {0.05, 0.02, 1.0}, a = {0.1, 0.0, -1.0}, b = {-0.1, 0.1, -1.0},
             c = {-0.05, -0.15, -1.0};
  return {{a, b, tip}, {b, c, tip}, {c, a, tip}, {a, c, b}};
}

Mesh tube_mesh(int facets, double half_length, double phase)
{
  const auto corner = [&](int k, double z) -> Vec3 {
    const double angle = phase + 2.0 * kPi * (k % facets) / facets;
    return {std::cos(angle), std::sin(angle), z};
  };
  Mesh mesh;
  for (int k = 0; k < facets; k++)
    add_quad(mesh, corner(k, -half_length), corner(k + 1, -half_length), corner(k + 1, half_length),
             corner(k, half_length));
  return mesh;
}

Mesh waves_mesh(RandomRods &random, int squares, double height)
{
  std::vector<std::vector<Vec3>> nodes(squares + 1);
  for (int i = 0; i <= squares; i++)
    for (int j = 0; j <= squares; j++)
      nodes[i].push_back(
          {2.0 * i / squares - 1.0, 2.0 * j / squares - 1.0, height * random.uniform(-1.0, 1.0)});
  Mesh mesh;
  for (int i = 0; i < squares; i++)
    for (int j = 0; j < squares; j++) {
      mesh.push_back({nodes[i][j], nodes[i + 1][j], nodes[i + 1][j + 1]});
      mesh.push_back({nodes[i][j], nodes[i + 1][j + 1], nodes[i][j + 1]});
    }
  return mesh;
}

Mesh four_for_one(const Mesh &mesh)
{
  Mesh finer;
  for (const Corners &corners : mesh) {
    const auto &[a, b, c] = corners;
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    for (const Corners &part :
         {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
      finer.push_back(part);
  }
  return finer;
}

Capsule rod_near(RandomRods &random, const Mesh &mesh, double radius, double aspect_ratio)
{
  for (;;) {
    const Corners &corners = mesh[random.below(static_cast<int>(mesh.size()))];
    double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vec3 at = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
    const double half = radius * (aspect_ratio - 1.0);
    const Vec3 axis = random.direction();
    const double along = half * std::min(1.0, std::max(-1.0, random.uniform(-1.5, 1.5)));
    const Vec3 on_axis = at + random.uniform(0.0, 1.3) * radius * random.direction();
    const Capsule rod = {{on_axis - along * axis, axis, half}, radius};
    if (distance_of_axis(rod.segment, mesh, 1.1e-3 * radius) > 1e-3 * radius) return rod;
  }
}
