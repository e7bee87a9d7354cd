// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/solid_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "core/batch.h"
#include "core/numbers.h"
#include "core/parallel.h"
#include "io/input_error.h"
#include "solid/capsule_measures.h"
#include "solid/closed_mesh.h"
#include "solid/plane_volume.h"

namespace spherocylinder {
namespace {

constexpr double kGoldenAngle = 2.39996322972865332;
constexpr std::size_t kPieces = 64, kFewestRodsAPiece = 16, kMostRodsAPiece = 2048;
constexpr double kMostBins = 100000.0;

// Sum over rods of a list of numbers, piece by piece, so that it does not depend on the threads.
template <class Add>
std::vector<double> sum_over_rods(std::size_t rods, std::size_t numbers, Add add)
{
  const std::size_t grain = std::clamp(rods / kPieces, kFewestRodsAPiece, kMostRodsAPiece);
  const std::size_t pieces = (rods + grain - 1) / grain;
  std::vector<std::vector<double>> parts(pieces);
  for_each_piece(rods, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<double> &sums = parts[begin / grain];
    sums.assign(numbers, 0.0);
    for (std::size_t i = begin; i < end; i++) add(i, sums);
  });
  std::vector<double> sums(numbers, 0.0);
  for (const auto &part : parts)
    for (std::size_t k = 0; k < numbers; k++) sums[k] += part[k];
  return sums;
}

// Nodes in (0, 1) and weights, for an integral of f(v) dv; by Newton's method on the Legendre
// polynomial.
struct GaussLegendre {
  explicit GaussLegendre(int n)
  {
    for (int i = 0; i < n; i++) {
      double x = std::cos(pi * (i + 0.75) / (n + 0.5));
      double slope = 1.0;
      for (int step = 0; step < 20; step++) {
        double before = 1.0, value = x;
        for (int k = 2; k <= n; k++) {
          const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
          before = value;
          value = next;
        }
        slope = n * (x * value - before) / (x * x - 1.0);
        x -= value / slope;
      }
      nodes.push_back(0.5 * (1.0 + x));
      weights.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
  }
  std::vector<double> nodes, weights;
};

// Chords parallel to the axis of a rod of radius 1, at `across` and `aside` from it. With
// rho^2 = 1 - v^2 a chord is 2 (h + v) long and the round section is rho d(rho) = v dv.
struct Chord {
  double across, aside;
  double v;
  double weight;  // area of the round section that it stands for
};

std::vector<Chord> chord_rule(int level)
{
  const double growth = std::pow(1.6, level);
  const GaussLegendre rule(static_cast<int>(std::round(2.0 * growth)));
  const int around = static_cast<int>(std::round(3.0 * growth));
  std::vector<Chord> chords;
  for (std::size_t i = 0; i < rule.nodes.size(); i++) {
    const double v = rule.nodes[i];
    const double rho = std::sqrt(1.0 - v * v);
    for (int k = 0; k < around; k++) {
      const double angle = 2.0 * pi * k / around;
      chords.push_back({rho * std::cos(angle), rho * std::sin(angle), v,
                        rule.weights[i] * v * 2.0 * pi / around});
    }
  }
  return chords;
}

// Concentric cylinders as arrays, from the axis.
struct NestedCylinders {
  explicit NestedCylinders(const std::vector<UprightCylinder> &cylinders)
      : x(cylinders[0].x), y(cylinders[0].y)
  {
    for (const UprightCylinder &c : cylinders) {
      radius_squared.push_back(c.radius * c.radius);
      z_low.push_back(c.z_low);
      z_high.push_back(c.z_high);
    }
  }

  double x, y;
  std::vector<double> radius_squared, z_low, z_high;
};

// A chord in place: the points p + s u with |s| <= reach. The wall of a cylinder of radius R about
// the z axis leaves -b/a -+ sqrt(off_axis + a R^2)/a of its line, with a = u_x^2 + u_y^2,
// b = u_x p_x + u_y p_y and off_axis = b^2 - a (p_x^2 + p_y^2).
struct PlacedChord {
  double reach, area, z, b, off_axis, a, over_a, over_z;
};

// Adds what each of `count` cylinders leaves of the chord, times its area, to the sums. No
// branches: a cylinder that the line misses leaves an interval of length 0 or less.
SPHEROCYLINDER_VECTOR void add_chord(const PlacedChord &c, const double *radius_squared,
                                     const double *z_low, const double *z_high, std::size_t count,
                                     double *sums)
{
  const auto smaller = [](double p, double q) { return p < q ? p : q; };
  const auto larger = [](double p, double q) { return p > q ? p : q; };
  for (std::size_t k = 0; k < count; k++) {
    const double root = std::sqrt(larger(c.off_axis + c.a * radius_squared[k], 0.0));
    const double to_floor = (z_low[k] - c.z) * c.over_z, to_top = (z_high[k] - c.z) * c.over_z;
    const double low =
        larger(larger(-c.reach, (-c.b - root) * c.over_a), smaller(to_floor, to_top));
    const double high =
        smaller(smaller(c.reach, (-c.b + root) * c.over_a), larger(to_floor, to_top));
    sums[k] += c.area * larger(high - low, 0.0);
  }
}

// What is left of one rod's chords in concentric cylinders.
class ChordedRod {
 public:
  ChordedRod(const Capsule &rod, double turn) : rod_(rod), u_(rod.segment.axis)
  {
    const Vec3 side = std::abs(u_.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
    const Vec3 e = cross(u_, side);
    const Vec3 e1 = (1.0 / norm(e)) * e, e2 = cross(u_, e1);
    across_ = std::cos(turn) * e1 + std::sin(turn) * e2;
    aside_ = cross(u_, across_);
  }

  // Adds the volume within cylinders[first .. last) to sums.
  void add(const std::vector<Chord> &rule, const NestedCylinders &cylinders, std::size_t first,
           std::size_t last, double *sums) const
  {
    if (first == last) return;
    const double r = rod_.radius;
    const double a = u_.x * u_.x + u_.y * u_.y;
    constexpr double kLevel = 1e200;  // a level rod's chord is far from any plane it is not in
    const double over_a = 1.0 / a, over_z = u_.z == 0.0 ? kLevel : 1.0 / u_.z;
    const Vec3 centre = rod_.segment.centre - Vec3{cylinders.x, cylinders.y, 0.0};
    for (const Chord &chord : rule) {
      const Vec3 p = centre + (r * chord.across) * across_ + (r * chord.aside) * aside_;
      const double b = u_.x * p.x + u_.y * p.y;
      const double off_axis = b * b - a * (p.x * p.x + p.y * p.y);
      add_chord({rod_.segment.half_length + r * chord.v, r * r * chord.weight, p.z, b, off_axis, a,
                 over_a, over_z},
                &cylinders.radius_squared[first], &cylinders.z_low[first], &cylinders.z_high[first],
                last - first, sums + first);
    }
  }

 private:
  const Capsule &rod_;
  Vec3 u_, across_, aside_;
};

// Chords show little of a rod that stands upright, whose chords are all cut at once or not at all,
// nor of a cylinder that is no wider than the rod.
bool needs_sections(const UprightCylinder &c, const Capsule &rod)
{
  constexpr double kUprightExtent = 0.25;
  const Vec3 &u = rod.segment.axis;
  return c.radius < 2.0 * rod.radius ||
         rod.segment.half_length * std::hypot(u.x, u.y) < kUprightExtent * rod.radius;
}

// Solid within each of these cylinders by the finer of two rules. The error: each rod is turned by
// another angle, which makes the rods' errors independent, so that their squares add up; the
// differences from the coarser rule stand for them.
std::vector<BoundedVolume> sums_by_rules(const std::vector<Rod> &rods,
                                         const std::vector<UprightCylinder> &cylinders, int level,
                                         double tolerance)
{
  const std::vector<Chord> coarse = chord_rule(level - 1), fine = chord_rule(level);
  const std::size_t count = cylinders.size();
  const NestedCylinders nested(cylinders);
  const auto sums = sum_over_rods(rods.size(), 4 * count, [&](std::size_t i, auto &part) {
    double *const solid = part.data(), *const difference = solid + count;
    double *const squares = difference + count, *const bounds = squares + count;
    const Capsule &rod = rods[i].capsule;
    // The cylinders are nested: those that miss the rod come first, those that hold it last.
    const auto begin = cylinders.begin(), end = cylinders.end();
    const auto meets =
        std::partition_point(begin, end, [&](const auto &c) { return misses(c, rod); });
    const auto inside =
        std::partition_point(meets, end, [&](const auto &c) { return !holds(c, rod); });
    const auto by_chords =
        std::partition_point(meets, inside, [&](const auto &c) { return needs_sections(c, rod); });
    for (auto c = meets; c != by_chords; c++) {
      const BoundedVolume found = clipped_volume(rod, *c, tolerance);
      solid[c - begin] += found.value;
      bounds[c - begin] += found.error;
    }
    const std::size_t first = by_chords - begin, last = inside - begin;
    static thread_local std::vector<double> by_coarse, by_fine;
    by_coarse.assign(count, 0.0);
    by_fine.assign(count, 0.0);
    const ChordedRod chorded(rod, kGoldenAngle * static_cast<double>(i));
    chorded.add(coarse, nested, first, last, by_coarse.data());
    chorded.add(fine, nested, first, last, by_fine.data());
    for (std::size_t k = first; k < last; k++) {
      const double d = by_fine[k] - by_coarse[k];
      solid[k] += by_fine[k];
      difference[k] += d;
      squares[k] += d * d;
    }
    const double whole = volume(rod);
    for (std::size_t k = last; k < count; k++) solid[k] += whole;
  });
  std::vector<BoundedVolume> found(count);
  for (std::size_t k = 0; k < count; k++)
    found[k] = {sums[k], std::max(std::abs(sums[count + k]), 2.0 * std::sqrt(sums[2 * count + k])) +
                             sums[3 * count + k]};
  return found;
}

// What lies between each of the nested cylinders and the one before; the edges are left open.
std::vector<ProfileBin> shells(const std::vector<Rod> &rods,
                               const std::vector<UprightCylinder> &cylinders, double tolerance)
{
  const auto within = volumes_within(rods, cylinders, tolerance);
  std::vector<ProfileBin> bins;
  BoundedVolume inner{0.0, 0.0};
  double inner_region = 0.0;
  for (std::size_t k = 0; k < cylinders.size(); k++) {
    const double region = volume(cylinders[k]);
    bins.push_back({0.0, 0.0, region - inner_region, within[k].value - inner.value,
                    within[k].error + inner.error});
    inner = within[k];
    inner_region = region;
  }
  return bins;
}

void set_edges(std::vector<ProfileBin> &bins, const std::vector<double> &edges)
{
  for (std::size_t k = 0; k < bins.size(); k++) {
    bins[k].low = edges[k];
    bins[k].high = edges[k + 1];
  }
}

}  // namespace

std::vector<double> volumes_below(const std::vector<Rod> &rods, const std::vector<double> &heights)
{
  // Rods wholly below a height are counted where they first are, and added up afterwards.
  const std::size_t count = heights.size();
  const auto sums = sum_over_rods(rods.size(), 2 * count, [&](std::size_t i, auto &part) {
    const Capsule &rod = rods[i].capsule;
    const double up = rod.segment.half_length * std::abs(rod.segment.axis.z) + rod.radius;
    const double z = rod.segment.centre.z;
    const auto first = std::upper_bound(heights.begin(), heights.end(), z - up);
    std::size_t k = first - heights.begin();
    for (; k < count && heights[k] < z + up; k++) part[k] += volume_below(rod, heights[k]);
    if (k < count) part[count + k] += volume(rod);
  });
  std::vector<double> volumes(count);
  double whole = 0.0;
  for (std::size_t k = 0; k < count; k++) {
    whole += sums[count + k];
    volumes[k] = whole + sums[k];
  }
  return volumes;
}

std::vector<BoundedVolume> volumes_within(const std::vector<Rod> &rods,
                                          const std::vector<UprightCylinder> &cylinders,
                                          double tolerance)
{
  constexpr int kLastLevel = 8;
  std::vector<BoundedVolume> found(cylinders.size());
  std::vector<std::size_t> open(cylinders.size());
  for (std::size_t k = 0; k < open.size(); k++) open[k] = k;
  for (int level = 1; level <= kLastLevel && !open.empty(); level++) {
    std::vector<UprightCylinder> asked;
    for (const std::size_t k : open) asked.push_back(cylinders[k]);
    const auto sums = sums_by_rules(rods, asked, level, 0.1 * tolerance);
    for (std::size_t i = 0; i < open.size(); i++) found[open[i]] = sums[i];
    const auto close_enough = [&](std::size_t k) {
      const double inner = k == 0 ? 0.0 : found[k - 1].value;
      double least = found[k].value - inner;
      if (k + 1 < found.size()) least = std::min(least, found[k + 1].value - found[k].value);
      return found[k].error <= 0.5 * tolerance * std::max(least, 0.0);
    };
    open.erase(std::remove_if(open.begin(), open.end(), close_enough), open.end());
  }
  return found;
}

std::vector<double> bin_edges(double low, double high, double width)
{
  constexpr double kCrumb = 1e-6;
  if (!((high - low) / width < kMostBins))
    throw InputError(fmt::format("--bin: {:.6g} m makes more than {:.0f} bins between {:.6g} and "
                                 "{:.6g} m, wanted wider ones",
                                 width, kMostBins, low, high));
  std::vector<double> edges;
  for (std::size_t k = 0; low + k * width < high - kCrumb * width; k++)
    edges.push_back(low + static_cast<double>(k) * width);
  edges.push_back(high);
  return edges;
}

std::vector<ProfileBin> height_profile(const std::vector<Rod> &rods, double section, double floor,
                                       const std::vector<double> &edges)
{
  std::vector<double> heights = edges;
  for (double &height : heights) height += floor;
  const std::vector<double> below = volumes_below(rods, heights);
  std::vector<ProfileBin> bins;
  for (std::size_t k = 1; k < edges.size(); k++)
    bins.push_back({edges[k - 1], edges[k], section * (edges[k] - edges[k - 1]),
                    below[k] - below[k - 1], 0.0});
  return bins;
}

std::vector<ProfileBin> height_profile(const std::vector<Rod> &rods, const ClosedMesh &vessel,
                                       const std::vector<double> &edges)
{
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double floor = vessel.bounds().z_low;
  std::vector<ProfileBin> bins = height_profile(rods, 1.0, floor, edges);
  double below = 0.0;
  for (ProfileBin &bin : bins) {
    const auto part = vessel.part_within({-kFar, kFar, -kFar, kFar, -kFar, floor + bin.high});
    const double up_to = part ? part->volume() : 0.0;
    bin.region = up_to - below;
    below = up_to;
  }
  return bins;
}

std::vector<ProfileBin> radius_profile(const std::vector<Rod> &rods, const UprightCylinder &vessel,
                                       const std::vector<double> &edges, double tolerance)
{
  std::vector<UprightCylinder> cylinders;
  for (std::size_t k = 1; k < edges.size(); k++)
    cylinders.push_back({vessel.x, vessel.y, edges[k], vessel.z_low, vessel.z_high});
  std::vector<ProfileBin> bins = shells(rods, cylinders, tolerance);
  set_edges(bins, edges);
  return bins;
}

std::vector<ProfileBin> wall_profile(const std::vector<Rod> &rods, const UprightCylinder &vessel,
                                     const std::vector<double> &edges, double tolerance)
{
  // From the innermost out, as volumes_within wants them.
  std::vector<UprightCylinder> cylinders;
  for (std::size_t k = edges.size() - 1; k-- > 0;)
    cylinders.push_back(
        {vessel.x, vessel.y, vessel.radius - edges[k], vessel.z_low + edges[k], vessel.z_high});
  std::vector<ProfileBin> bins = shells(rods, cylinders, tolerance);
  std::reverse(bins.begin(), bins.end());
  set_edges(bins, edges);
  return bins;
}

}  // namespace spherocylinder
