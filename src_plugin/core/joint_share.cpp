// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/joint_share.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spherocylinder {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Of the deepest overlap, what is given up at the ends of a patch of crossed axes.
constexpr double kGivenUp = 1.0 / 16.0;

// Positions along the line, empty if low > high.
struct Span {
  double low = kInfinite, high = -kInfinite;
};

// Where a s^2 - 2 b s + c <= 0, a >= 0.
Span below_zero(double a, double b, double c)
{
  const double discriminant = b * b - a * c;
  if (!(a > 0.0)) return c <= 0.0 ? Span{-kInfinite, kInfinite} : Span{};
  if (!(discriminant >= 0.0)) return {};
  const double root = std::sqrt(discriminant);
  return {(b - root) / a, (b + root) / a};
}

Span in_both(const Span &a, const Span &b)
{
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

// Of two spans that meet; an empty one is left out.
Span over_both(const Span &a, const Span &b)
{
  if (!(a.low <= a.high)) return b;
  if (!(b.low <= b.high)) return a;
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

double smooth_step(double y)
{
  y = std::clamp(y, 0.0, 1.0);
  return y * y * (3.0 - 2.0 * y);
}

// How much of the patch is before the joint, over the length that counts.
double before_joint(const LinePatch &patch, double longest)
{
  const double length = 2.0 * std::min(patch.half, longest);
  const double before = patch.half - patch.centre;
  if (length > 0.0) return before / length;
  return before > 0.0 ? 1.0 : before < 0.0 ? 0.0 : 0.5;
}

// As seen from the first rod; from the second it is the same turned round, to the last bit.
LinePatch mean_of(const LinePatch &own, const LinePatch &next)
{
  return {0.5 * (own.centre - next.centre), 0.5 * (own.half + next.half)};
}

}  // namespace

LinePatch patch_on_line(const EndLine &line, const Segment &other, double reach)
{
  // With w from the end to a point of the other axis, across the line: w + t v nearest at t*.
  const Vec3 &u = line.outward, &v = other.axis;
  const Vec3 w = other.centre - line.from;
  const double along_w = dot(w, u), cosine = dot(v, u);
  const Vec3 across_w = w - along_w * u, across_v = v - cosine * u;
  const double squared_sine = norm_squared(across_v);
  const double h = other.half_length;
  const double t =
      squared_sine > 0.0 ? std::clamp(-dot(across_w, across_v) / squared_sine, -h, h) : 0.0;
  const double distance = norm(across_w + t * across_v);
  const double nearest = along_w + t * cosine;
  if (!(distance < reach)) return {nearest, 0.0};

  // Parallel axes touch along all of the other one's length, if it has one.
  const double overlap = reach - distance;
  const double cosine_4 = cosine * cosine * cosine * cosine;
  const double lengthwise = cosine_4 * cosine_4 * (h * h / (h * h + 2.0 * reach * overlap));
  const double given_up = kGivenUp + (1.0 - kGivenUp) * lengthwise;
  const double within = distance + given_up * overlap;
  // Within that of the axis, beside it, and of its ends.
  Span span;
  for (const double end : {-h, h}) {
    const Vec3 way = across_w + end * across_v;
    const double middle = along_w + end * cosine;
    const Span ball = below_zero(1.0, 0.0, norm_squared(way) - within * within);
    span = over_both(span, {middle + ball.low, middle + ball.high});
  }
  // |w - s u|^2 - (v.(w - s u))^2 <= within^2 and |v.(w - s u)| <= h.
  const double along_v = dot(w, v);
  const Span side = below_zero(squared_sine, along_w - along_v * cosine,
                               norm_squared(w) - along_v * along_v - within * within);
  const double one = (along_v - h) / cosine, other_one = (along_v + h) / cosine;
  const Span slab = cosine == 0.0 ? (std::fabs(along_v) <= h ? Span{-kInfinite, kInfinite} : Span{})
                                  : Span{std::min(one, other_one), std::max(one, other_one)};
  const Span beside = in_both(side, slab);
  if (std::isfinite(beside.low) && std::isfinite(beside.high)) span = over_both(span, beside);
  if (!(span.low <= span.high)) return {nearest, 0.0};
  return {0.5 * (span.low + span.high), 0.5 * (span.high - span.low)};
}

bool is_all_before_joint(const LinePatch &own, double longest)
{
  return before_joint(own, longest) >= 1.0;
}

double share_at_joint(const LinePatch &own, const LinePatch &next, double longest)
{
  return smooth_step(
      std::max(before_joint(own, longest), before_joint(mean_of(own, next), longest)));
}

ShareSlope slope_of_share(const LinePatch &own, const LinePatch &next, double longest)
{
  constexpr double kWhollyOwn = 0.2;
  const LinePatch mean = mean_of(own, next);
  const double of_own = before_joint(own, longest), of_mean = before_joint(mean, longest);
  const bool goes_by_own = of_own > of_mean;
  const double y = std::clamp(goes_by_own ? of_own : of_mean, 0.0, 1.0);
  const double length = 2.0 * std::min(goes_by_own ? own.half : mean.half, longest);
  if (!(length > 0.0)) return {0.0, 0.0};
  // More than one together: the inside of a bent joint.
  const double more = of_own + before_joint(next, longest) - 1.0;
  return {6.0 * y * (1.0 - y) / length, smooth_step(more / kWhollyOwn)};
}

Vec3 advance_on_line(const Vec3 &line, const Segment &other, const LinePatch &patch, bool at_end)
{
  const double cosine = dot(line, other.axis), squared_sine = 1.0 - cosine * cosine;
  const double along_other = patch.half * std::fabs(cosine);
  if (at_end || !(squared_sine > 0.0) || along_other >= other.half_length) return line;
  const double crossed = std::min(1.0, 2.0 - 2.0 * along_other / other.half_length);
  return (1.0 - crossed) * line + (crossed / squared_sine) * (line - cosine * other.axis);
}

double reach_beyond_joint(const LinePatch &own, const LinePatch &next, double longest,
                          double within, double bend_sine, double overlap)
{
  constexpr double kMostBeside = 1.0 / 16.0;
  const double half = mean_of(own, next).half;
  const double reach = std::min(within, half) * std::clamp(2.0 - 2.0 * half / longest, 0.0, 1.0);
  const double most_beside = kMostBeside * std::max(0.0, overlap);
  return bend_sine * reach > most_beside ? most_beside / bend_sine : reach;
}

}  // namespace spherocylinder
