// SPDX-License-Identifier: GPL-2.0-or-later
#include "measures/fibre_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numbers.h"
#include "core/parallel.h"
#include "solid/capsule_measures.h"
#include "solid/shared_end.h"

namespace spherocylinder {
namespace {

// Axes further apart are not correlated: the work grows with the length of a fibre.
constexpr std::size_t kMostPlaces = 1000;

// The axis of an upright rod stands for none.
constexpr Vec3 kUpright{0.0, 0.0, 1.0};

double cylinder_length(const Rod &rod) { return 2.0 * rod.capsule.segment.half_length; }

Vec3 middle_of(const Fibre &fibre, const std::vector<Rod> &rods)
{
  Vec3 sum{0.0, 0.0, 0.0};
  double length = 0.0;
  for (std::size_t k = 0; k < fibre.segments.size(); k++) {
    const Rod &rod = rods[fibre.segments[k]];
    // Spheres alone are as good as each other.
    const double weight = cylinder_length(rod) + std::numeric_limits<double>::min();
    sum = sum + weight * (rod.capsule.segment.centre + fibre.shifts[k]);
    length += weight;
  }
  return (1.0 / length) * sum;
}

double distance_of(const FibreJoint &joint, const std::vector<Rod> &rods)
{
  return 0.5 * (cylinder_length(rods[joint.i]) + cylinder_length(rods[joint.j]));
}

// Of a fibre the cosines of all pairs that are so many places apart, summed.
struct CosineSums {
  std::vector<double> cosines, distances;
  std::vector<std::size_t> pairs;
};

// A ring is read as the open chain it is numbered as.
CosineSums cosine_sums(const Fibre &fibre, const std::vector<Rod> &rods)
{
  const std::size_t n = fibre.segments.size(), most = std::min(n, kMostPlaces);
  CosineSums sums{std::vector<double>(most), std::vector<double>(most),
                  std::vector<std::size_t>(most)};
  std::vector<double> along(n);
  for (std::size_t k = 1; k < n; k++)
    along[k] = along[k - 1] + 0.5 * (cylinder_length(rods[fibre.segments[k - 1]]) +
                                     cylinder_length(rods[fibre.segments[k]]));
  for (std::size_t i = 0; i < n; i++)
    for (std::size_t j = i; j < std::min(n, i + most); j++) {
      sums.cosines[j - i] += dot(rods[fibre.segments[i]].capsule.segment.axis,
                                 rods[fibre.segments[j]].capsule.segment.axis);
      sums.distances[j - i] += along[j] - along[i];
      sums.pairs[j - i]++;
    }
  return sums;
}

std::vector<TangentCorrelation> correlation_of(const std::vector<Rod> &rods, const Fibres &fibres)
{
  std::size_t longest = 0;
  for (const Fibre &fibre : fibres.all)
    longest = std::max(longest, std::min(fibre.segments.size(), kMostPlaces));
  std::vector<std::vector<double>> means(longest);
  std::vector<TangentCorrelation> found(longest);
  for (const Fibre &fibre : fibres.all) {
    const CosineSums sums = cosine_sums(fibre, rods);
    for (std::size_t k = 0; k < sums.pairs.size(); k++) {
      means[k].push_back(sums.cosines[k] / static_cast<double>(sums.pairs[k]));
      found[k].distance += sums.distances[k];
      found[k].pairs += sums.pairs[k];
    }
  }
  for (std::size_t k = 0; k < longest; k++) {
    found[k].places = k;
    found[k].distance /= static_cast<double>(found[k].pairs);
    found[k].cosine = mean_of(means[k]);
  }
  return found;
}

double persistence_of(const std::vector<Rod> &rods, const Fibres &fibres)
{
  if (fibres.joints.empty()) return none;
  const MeanWithError cosine = mean_of(fibres.joints, [&](const FibreJoint &joint) {
    return std::cos(
        bend_angle(rods[joint.i].capsule.segment.axis, rods[joint.j].capsule.segment.axis));
  });
  const MeanWithError length =
      mean_of(fibres.joints, [&](const FibreJoint &joint) { return distance_of(joint, rods); });
  if (!(cosine.mean > 0.0)) return none;
  return cosine.mean < 1.0 ? -length.mean / std::log(cosine.mean)
                           : std::numeric_limits<double>::infinity();
}

}  // namespace

Vec3 end_to_end(const Fibre &fibre, const std::vector<Rod> &rods)
{
  if (fibre.is_ring) return {0.0, 0.0, 0.0};
  const Segment &first = rods[fibre.segments.front()].capsule.segment;
  const Segment &last = rods[fibre.segments.back()].capsule.segment;
  return head_of(last) + fibre.shifts.back() - tail_of(first) - fibre.shifts.front();
}

double contour_length(const Fibre &fibre, const std::vector<Rod> &rods)
{
  double length = 0.0;
  for (const std::uint32_t rod : fibre.segments) length += cylinder_length(rods[rod]);
  return length;
}

std::vector<double> fibre_ids(const Fibres &fibres)
{
  std::vector<double> ids;
  for (const std::uint32_t fibre : fibres.of_rod)
    ids.push_back(fibre == kNoFibre ? 0.0 : static_cast<double>(fibres.all[fibre].id));
  return ids;
}

std::vector<double> fibre_places(const Fibres &fibres)
{
  std::vector<double> places;
  for (std::size_t i = 0; i < fibres.of_rod.size(); i++)
    places.push_back(fibres.of_rod[i] == kNoFibre ? 0.0 : fibres.place_of_rod[i] + 1.0);
  return places;
}

std::vector<Rod> fibre_bodies(const std::vector<Rod> &rods, const Fibres &fibres, Rings rings)
{
  std::vector<Rod> bodies;
  for (const Fibre &fibre : fibres.all) {
    const Rod &first = rods[fibre.segments[0]];
    const Vec3 ends = end_to_end(fibre, rods);
    const double distance = norm(ends), contour = contour_length(fibre, rods);
    const bool has_axis = distance > 0.0 || contour == 0.0;
    if (!has_axis && rings == Rings::LeftOut) continue;
    const double r = first.capsule.radius;
    const double half = fibre.is_ring ? std::max(0.5 * contour - r, 0.0) : 0.5 * contour;
    const Vec3 axis = distance > 0.0 ? (1.0 / distance) * ends : kUpright;
    bodies.push_back({fibre.id, first.type, {{middle_of(fibre, rods), axis, half}, r}});
  }
  for (std::size_t i = 0; i < rods.size(); i++)
    if (!fibres.are_there() || fibres.of_rod[i] == kNoFibre) bodies.push_back(rods[i]);
  return bodies;
}

std::vector<double> joint_curvatures(const std::vector<Rod> &rods, const Fibres &fibres)
{
  std::vector<double> found;
  for (const FibreJoint &joint : fibres.joints) {
    const double bend =
        bend_angle(rods[joint.i].capsule.segment.axis, rods[joint.j].capsule.segment.axis);
    const double length = distance_of(joint, rods);
    found.push_back(length > 0.0 ? bend / length : 0.0);
  }
  return found;
}

std::vector<double> rod_curvatures(const std::vector<Rod> &rods, const Fibres &fibres)
{
  const std::vector<double> of_joints = joint_curvatures(rods, fibres);
  std::vector<double> found(rods.size(), 0.0);
  for (std::size_t i = 0; i < fibres.joints_of_rod.size(); i++) {
    int joints = 0;
    for (const std::int32_t joint : fibres.joints_of_rod[i])
      if (joint != kNoJoint) {
        found[i] += of_joints[joint];
        joints++;
      }
    if (joints > 0) found[i] /= joints;
  }
  return found;
}

FibreShapes fibre_shapes(const std::vector<Rod> &rods, const Fibres &fibres)
{
  FibreShapes shapes{};
  shapes.fibres = fibres.all.size();
  shapes.parts = fibres.parts;
  const std::vector<double> of_joints = joint_curvatures(rods, fibres);
  std::vector<double> stretches, curvatures;
  for (const Fibre &fibre : fibres.all) {
    shapes.segments += fibre.segments.size();
    if (fibre.is_ring) shapes.rings++;
    const double contour = contour_length(fibre, rods);
    if (!fibre.is_ring && contour > 0.0)
      stretches.push_back(norm(end_to_end(fibre, rods)) / contour);
    double sum = 0.0;
    std::size_t joints = 0;
    for (const std::uint32_t rod : fibre.segments)
      if (const std::int32_t joint = fibres.joints_of_rod[rod][1]; joint != kNoJoint) {
        sum += of_joints[joint];
        joints++;
      }
    if (joints > 0) curvatures.push_back(sum / static_cast<double>(joints));
  }
  shapes.segments_a_fibre = mean_of(
      fibres.all, [](const Fibre &fibre) { return static_cast<double>(fibre.segments.size()); });
  shapes.contour =
      mean_of(fibres.all, [&](const Fibre &fibre) { return contour_length(fibre, rods); });
  shapes.stretch = mean_of(stretches);
  shapes.curvature = mean_of(curvatures);
  shapes.persistence = persistence_of(rods, fibres);
  shapes.correlation = correlation_of(rods, fibres);
  return shapes;
}

std::vector<SharedEnd> shared_ends(const std::vector<Rod> &rods, const Fibres &fibres)
{
  constexpr std::size_t kJointsAPiece = 128;
  std::vector<SharedEnd> ends(fibres.joints.size());
  for_each_piece(ends.size(), kJointsAPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; k++) {
      const FibreJoint &joint = fibres.joints[k];
      const Capsule &a = rods[joint.i].capsule;
      Capsule b = rods[joint.j].capsule;
      b.segment.centre = b.segment.centre + joint.shift;
      const Rod ball{rods[joint.i].id, 1, {{joint.place, kUpright, 0.0}, a.radius}};
      BoundedVolume beyond = shared_end_volume(a, b);
      beyond.value -= volume(ball.capsule);
      const double half_cosine = std::cos(0.5 * bend_angle(a.segment.axis, b.segment.axis));
      const double furthest =
          2.0 * std::min(a.segment.half_length, b.segment.half_length) + a.radius;
      ends[k] = {ball, beyond,
                 std::min(a.radius / std::max(half_cosine, 1e-3), furthest) +
                     norm(tail_of(b.segment) - joint.place)};
    }
  });
  return ends;
}

}  // namespace spherocylinder
