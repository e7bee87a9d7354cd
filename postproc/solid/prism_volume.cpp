// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid/prism_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solid/capsule_measures.h"
#include "solid/plane_volume.h"
#include "solid/section_area.h"

namespace spherocylinder {
namespace {

// As for bodies that are round or square, see clipped_volume.cpp.
constexpr double kSliver = 1e-3;
constexpr double kNoArea = 1e-13;

// In the rod's own frame: its axis is t, its centre the origin.
struct RodFrame {
  explicit RodFrame(const Segment &segment) : centre(segment.centre), along(segment.axis)
  {
    const Vec3 side = std::abs(along.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
    const Vec3 e = cross(side, along);
    across = (1.0 / norm(e)) * e;
    aside = cross(along, across);
  }

  // x across, y aside, z along.
  Vec3 place(const Vec3 &point) const
  {
    const Vec3 d = point - centre;
    return {dot(d, across), dot(d, aside), dot(d, along)};
  }

  Vec3 centre, along, across, aside;
};

// The points behind a triangle, which ends them towards larger z.
class Prism {
 public:
  Prism(const Vec3 &a, const Vec3 &b, const Vec3 &c) : corners_{a, b, c} {}

  double low(double Vec3::*k) const
  {
    return std::min({corners_[0].*k, corners_[1].*k, corners_[2].*k});
  }
  double high(double Vec3::*k) const
  {
    return std::max({corners_[0].*k, corners_[1].*k, corners_[2].*k});
  }

  // Unit, its z >= 0.
  Vec3 normal() const
  {
    const Vec3 n = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    return ((n.z < 0.0 ? -1.0 : 1.0) / norm(n)) * n;
  }
  const Vec3 &corner() const { return corners_[0]; }

  // Twice the area of the triangle's shadow, > 0 if it faces along z.
  double shadow() const
  {
    const Vec3 p = corners_[1] - corners_[0], q = corners_[2] - corners_[0];
    return p.x * q.y - p.y * q.x;
  }

  // Whether the shadow holds the disc of this radius about the axis.
  bool shades_disc(double radius) const
  {
    const double turn = shadow() > 0.0 ? 1.0 : -1.0;
    for (int i = 0; i < 3; i++) {
      const Vec3 &p = corners_[i], &q = corners_[(i + 1) % 3];
      if (turn * (p.x * q.y - p.y * q.x) < radius * std::hypot(q.x - p.x, q.y - p.y)) return false;
    }
    return true;
  }

  // The triangle's points at x, from lower to higher y: an empty one has low.y > high.y.
  struct Chord {
    Vec3 low, high;
  };

  Chord chord(double x) const
  {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    Chord found{{x, kFar, 0.0}, {x, -kFar, 0.0}};
    const auto add = [&](const Vec3 &p) {
      if (p.y < found.low.y) found.low = p;
      if (p.y > found.high.y) found.high = p;
    };
    for (int i = 0; i < 3; i++) {
      const Vec3 &p = corners_[i], &q = corners_[(i + 1) % 3];
      if (p.x == x) add(p);
      if ((p.x < x && q.x > x) || (p.x > x && q.x < x))
        add(p + ((x - p.x) / (q.x - p.x)) * (q - p));
    }
    return found;
  }

 private:
  Vec3 corners_[3];
};

// The common body of a rod and a prism, cut by planes of constant x.
class Sections {
 public:
  Sections(const Prism &prism, double half_length, double radius)
      : prism_(prism), half_length_(half_length), radius_(radius)
  {
    using V = Vec3;
    low_ = std::max(-radius, prism.low(&V::x));
    high_ = std::min(radius, prism.high(&V::x));
    base_ = std::min(prism.low(&V::z), -half_length) - 2.0 * radius;
  }

  // Finds a section with an area, and the ends of the body; false if there is none.
  bool find_ends()
  {
    if (!(low_ < high_)) return false;
    const double deepest = deepest_section();
    if (!(depth(deepest) > 0.0)) return false;
    low_ = end_between(low_, deepest);
    high_ = end_between(high_, deepest);
    inner_ = 0.5 * (low_ + high_);
    return common_area(inner_) > 0.0;
  }

  double lowest() const { return low_; }
  double inner() const { return inner_; }
  double highest() const { return high_; }

  double common_area(double x) const
  {
    const Prism::Chord c = prism_.chord(x);
    if (!(c.low.y < c.high.y)) return 0.0;
    const Polygon behind{{base_, c.low.y},
                         {c.low.z, c.low.y},
                         {c.high.z, c.high.y},
                         {base_, c.high.y}};
    const double shared = intersection_area(stadium(x), behind);
    return shared > kNoArea * radius_ * radius_ ? shared : 0.0;
  }

  double largest_area(double a, double b) const
  {
    return area(stadium(a > 0.0 ? a : b < 0.0 ? b : 0.0));
  }

 private:
  double half_width(double x) const
  {
    return std::sqrt(std::max((radius_ - x) * (radius_ + x), 0.0));
  }

  Stadium stadium(double x) const { return {{1.0, 0.0}, half_length_, half_width(x)}; }

  // How far the triangle is above the rod's lower end in this section, where it is furthest:
  // the largest of z(y) + h + sqrt(w^2 - y^2), which is concave in x too. Below 0: nowhere.
  double depth(double x) const
  {
    constexpr double kNone = -std::numeric_limits<double>::max();
    const Prism::Chord c = prism_.chord(x);
    const double w = half_width(x);
    const double y_low = std::max(c.low.y, -w), y_high = std::min(c.high.y, w);
    if (!(y_low <= y_high)) return kNone;
    const double width = c.high.y - c.low.y;
    const double slope = width > 0.0 ? (c.high.z - c.low.z) / width : 0.0;
    const double y = std::clamp(w * slope / std::hypot(1.0, slope), y_low, y_high);
    return c.low.z + slope * (y - c.low.y) + half_length_ +
           std::sqrt(std::max((w - y) * (w + y), 0.0));
  }

  // By the golden section. Where the chord misses the rod the way back is towards the axis's
  // nearest point in the shadow; there the depth is told by how far it misses.
  double deepest_section() const
  {
    constexpr double kGolden = 0.6180339887498949;
    constexpr int kSteps = 60;
    const auto value = [&](double x) {
      const double found = depth(x);
      if (found > -std::numeric_limits<double>::max()) return found;
      const Prism::Chord c = prism_.chord(x);
      const double gap = std::max(c.low.y, -c.high.y) - half_width(x);
      return kMissed * (1.0 + gap / radius_);
    };
    double low = low_, high = high_;
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = value(left), at_right = value(right);
    for (int i = 0; i < kSteps && std::max(at_left, at_right) <= 0.0; i++) {
      if (at_left >= at_right) {
        high = right;
        right = left;
        at_right = at_left;
        left = high - kGolden * (high - low);
        at_left = value(left);
      } else {
        low = left;
        left = right;
        at_left = at_right;
        right = low + kGolden * (high - low);
        at_right = value(right);
      }
    }
    return at_left >= at_right ? left : right;
  }

  // The end of the body between a section outside, or at its edge, and one inside.
  double end_between(double outside, double inside) const
  {
    constexpr int kHalvings = 50;
    if (depth(outside) > 0.0) return outside;
    for (int i = 0; i < kHalvings; i++) {
      const double middle = 0.5 * (outside + inside);
      (depth(middle) > 0.0 ? inside : outside) = middle;
    }
    return outside;
  }

  // Below any depth that there is. A chord's distance from the rod's section is a convex function of x.
  static constexpr double kMissed = -1e100;

  const Prism &prism_;
  double half_length_, radius_, low_, high_, base_, inner_ = 0.0;
};

// The rod's volume behind the triangle.
BoundedVolume volume_behind(const Prism &prism, const Capsule &capsule, double tolerance)
{
  const double h = capsule.segment.half_length, r = capsule.radius;
  if (prism.shades_disc(r)) {
    const Vec3 n = prism.normal();
    const Vec3 tilted{std::hypot(n.x, n.y), 0.0, n.z};
    return {volume_below({{{0.0, 0.0, 0.0}, tilted, h}, r}, dot(n, prism.corner())), 0.0};
  }
  Sections sections(prism, h, r);
  if (!sections.find_ends()) return {0.0, 0.0};
  return convex_volume({[&](double x) { return sections.common_area(x); },
                        [&](double a, double b) { return sections.largest_area(a, b); },
                        sections.lowest(), sections.inner(), sections.highest()},
                       tolerance, kSliver * volume(capsule));
}

}  // namespace

BoundedVolume volume_inside(const std::vector<Triangle> &surface, const Capsule &capsule,
                            double tolerance)
{
  using V = Vec3;
  const RodFrame frame(capsule.segment);
  const double r = capsule.radius, end = capsule.segment.half_length + r;
  BoundedVolume sum{0.0, 0.0};
  for (const Triangle &triangle : surface) {
    const Prism prism(frame.place(triangle.a), frame.place(triangle.b), frame.place(triangle.c));
    if (prism.low(&V::x) >= r || prism.high(&V::x) <= -r || prism.low(&V::y) >= r ||
        prism.high(&V::y) <= -r || prism.high(&V::z) <= -end || prism.shadow() == 0.0)
      continue;
    const BoundedVolume part = volume_behind(prism, capsule, tolerance);
    sum.value += prism.shadow() > 0.0 ? part.value : -part.value;
    sum.error += part.error;
  }
  return sum;
}

}  // namespace spherocylinder
