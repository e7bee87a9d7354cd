// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/multisphere_input.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/mass_properties.h"
#include "core/rotation.h"
#include "io/frame_columns.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr int kMostSpheres = 100000;

// Seeds of LIGGGHTS's random numbers. Nothing of a placed body depends on them, but the host wants
// primes, all different within a command.
constexpr int kTemplateSeed = 15485863, kDistributionSeed = 32452843, kInsertionSeed = 32452867;

// Points that the host tries for the share of each sphere in the body's volume, which only a
// coupled flow solver uses: the fewest it accepts.
constexpr int kVolumeTries = 1000;

// insert/pack knows no point: it gets a region so wide (of the box's largest coordinate) that the
// numbers in it are still different ones.
constexpr double kPointWidth = 1e-13;

// Of the deck's time step: the step of the insertion.
constexpr double kMoment = 1e-15;

double component(const Vec3 &a, int d) { return d == 0 ? a.x : d == 1 ? a.y : a.z; }

// The same place in a periodic box.
double wrapped(double x, const std::array<double, 2> &bounds)
{
  const double period = bounds[1] - bounds[0];
  const double inside = x - period * std::floor((x - bounds[0]) / period);
  return inside < bounds[1] ? inside : bounds[0];
}

MassProperties mass_of(const RodKind &kind)
{
  return mass_properties(2.0 * kind.radius, 2.0 * (kind.half_length + kind.radius), kind.density);
}

}  // namespace

int SphereCount::of(const Capsule &rod) const
{
  if (spheres) return *spheres;
  // Whole numbers of spacings that round-off has made a little longer are still whole.
  constexpr double kRoundOff = 1e-9;
  const double gaps = 2.0 * rod.segment.half_length / (spacing.value() * rod.radius);
  if (gaps > kMostSpheres) return kMostSpheres + 1;
  return 1 + std::max(1, static_cast<int>(std::ceil(gaps * (1.0 - kRoundOff))));
}

std::vector<double> sphere_places(double half_length, int n)
{
  std::vector<double> places;
  for (int k = 0; k < n; k++) places.push_back(half_length * (2.0 * k / (n - 1) - 1.0));
  return places;
}

std::vector<RodKind> rod_kinds(const DumpFrame &frame, const std::vector<Rod> &rods,
                               const SphereCount &count, std::optional<double> density)
{
  std::optional<std::size_t> column;
  if (!density) column = need_column(frame, "density", "--density");
  std::vector<RodKind> kinds;
  for (std::size_t row = 0; row < rods.size(); row++) {
    const Rod &rod = rods[row];
    const auto fail = [&](const std::string &what) {
      throw InputError(
          fmt::format("{}:{}: rod {}: {}", frame.path, frame.line_of(row), rod.id, what));
    };
    const double rho = density ? *density : frame.value(row, *column);
    if (!(rho > 0.0)) fail(fmt::format("density is {}, wanted a number > 0", rho));
    if (rod.is_sphere()) fail("it is a sphere, wanted rods longer than they are thick");
    const double radius = rod.capsule.radius, half_length = rod.capsule.segment.half_length;
    // Of one kind but for the dump's roundings.
    const auto is_near = [](double a, double b) { return std::abs(a - b) <= kLengthRounding * b; };
    auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const RodKind &k) {
      return k.type == rod.type && is_near(radius, k.radius) &&
             is_near(half_length + radius, k.half_length + k.radius) && is_near(rho, k.density);
    });
    if (kind == kinds.end()) {
      const int n = count.of(rod.capsule);
      if (n > kMostSpheres)
        fail(fmt::format("it would be of more than {} spheres, wanted a wider spacing",
                         kMostSpheres));
      kinds.push_back({rod.type, radius, half_length, rho, n, {}});
      kind = std::prev(kinds.end());
    }
    kind->rods.push_back(row);
  }
  return kinds;
}

BoxBounds multisphere_box(const DumpFrame &frame, const std::vector<Rod> &rods,
                          std::optional<double> margin)
{
  BoxBounds box = frame.box;
  for (int d = 0; d < 3; d++) {
    if (frame.periodic[d]) continue;
    double low = INFINITY, high = -INFINITY;
    for (const Rod &rod : rods) {
      const Segment &s = rod.capsule.segment;
      const double reach = std::abs(component(s.axis, d)) * s.half_length + rod.capsule.radius;
      low = std::min(low, component(s.centre, d) - reach);
      high = std::max(high, component(s.centre, d) + reach);
    }
    if (margin)
      box[d] = {low - *margin, high + *margin};
    else
      box[d] = {std::min(box[d][0], low), std::max(box[d][1], high)};
  }
  return box;
}

std::string box_commands(const BoxBounds &box, const std::array<bool, 3> &periodic,
                         const std::vector<RodKind> &kinds)
{
  int types = 1;
  for (const RodKind &kind : kinds) types = std::max(types, kind.type);
  std::string flags, bounds;
  for (int d = 0; d < 3; d++) {
    flags += periodic[d] ? " p" : " f";
    bounds += fmt::format(" {} {}", box[d][0], box[d][1]);
  }
  std::string text;
  if (kinds.size() == 1) text = fmt::format("variable rod_mass index {}\n", mass_of(kinds[0]).mass);
  return text + fmt::format("variable rod_types index {}\nvariable types index {}\nboundary{}\n"
                            "region box block{} units box\ncreate_box ${{types}} box\n",
                            types, types, flags, bounds);
}

std::string template_file(const RodKind &kind)
{
  std::string text;
  for (const double z : sphere_places(kind.half_length, kind.spheres))
    text += fmt::format("0 0 {} {}\n", z, kind.radius);
  return text;
}

std::string body_commands(const DumpFrame &frame, const std::vector<Rod> &rods,
                          const std::vector<RodKind> &kinds, const BoxBounds &box,
                          const std::vector<std::string> &template_paths)
{
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < kinds.size(); k++) {
    const RodKind &kind = kinds[k];
    const MassProperties p = mass_of(kind);
    fmt::format_to(out,
                   "fix rod_template{0} all particletemplate/multisphere {1} atom_type {2} density "
                   "constant {3} nspheres {4} ntry {5} spheres file {6} scale 1.0 mass {7} "
                   "inertia_tensor {8} 0 0 {8} 0 {9} use_density type {0}\n"
                   "fix rods{0} all particledistribution/discrete {10} 1 rod_template{0} 1.0\n",
                   k + 1, kTemplateSeed, kind.type, kind.density, kind.spheres, kVolumeTries,
                   template_paths[k], p.mass, p.inertia_transverse, p.inertia_axial,
                   kDistributionSeed);
  }

  double largest = 0.0;
  for (const auto &bounds : box)
    largest = std::max({largest, std::abs(bounds[0]), std::abs(bounds[1])});
  const double width = kPointWidth * largest;
  const VectorColumns velocity(frame, {"vx", "vy", "vz"});
  const VectorColumns omega(frame, {"omegax", "omegay", "omegaz"});
  std::array<std::size_t, 4> quaternion;  // rods_of has found them
  for (int i = 0; i < 4; i++) quaternion[i] = *frame.find_column(fmt::format("quat{}", i + 1));
  // The host numbers bodies as they come: rods numbered 1, 2, 3 ... keep their ids.
  std::vector<std::pair<std::size_t, std::size_t>> order;  // row, kind
  for (std::size_t k = 0; k < kinds.size(); k++)
    for (const std::size_t row : kinds[k].rods) order.emplace_back(row, k);
  std::sort(order.begin(), order.end(),
            [&](const auto &a, const auto &b) { return rods[a.first].id < rods[b.first].id; });
  for (const auto &[row, k] : order) {
    const Vec3 &centre = rods[row].capsule.segment.centre;
    std::string bounds;
    for (int d = 0; d < 3; d++) {
      double x = component(centre, d);
      if (frame.periodic[d]) x = wrapped(x, box[d]);
      // Half the width below, but not out of a box whose face it lies on.
      const double low = std::clamp(x - 0.5 * width, box[d][0], box[d][1] - width);
      bounds += fmt::format(" {} {}", low, low + width);
    }
    const Quaternion q =
        normalized({frame.value(row, quaternion[0]), frame.value(row, quaternion[1]),
                    frame.value(row, quaternion[2]), frame.value(row, quaternion[3])});
    const Vec3 v = velocity.of(row), w = omega.of(row);
    fmt::format_to(out,
                   "region rod{0} block{1} units box volume_limit 1e-300\n"
                   "fix rod{0} all insert/pack seed {2} distributiontemplate rods{3} insert_every "
                   "once verbose no overlapcheck no all_in no orientation constant {4} {5} {6} {7} "
                   "vel constant {8} {9} {10} omega constant {11} {12} {13} region rod{0} ntry_mc "
                   "1001 particles_in_region 1\n",
                   rods[row].id, bounds, kInsertionSeed, k + 1, q.w, q.x, q.y, q.z, v.x, v.y, v.z,
                   w.x, w.y, w.z);
  }
  // Insertion takes a step, so it is one in which nothing moves, and which is not counted. A
  // variable keeps its value through substitution, not as a formula.
  fmt::format_to(out,
                 "variable rods_dt equal dt\nvariable rods_dt equal ${{rods_dt}}\n"
                 "variable rods_now equal step\nvariable rods_now equal ${{rods_now}}\n"
                 "variable rods_moment equal {}*${{rods_dt}}\ntimestep ${{rods_moment}}\n"
                 "run 1 post no\ntimestep ${{rods_dt}}\nreset_timestep ${{rods_now}}\n",
                 kMoment);
  for (const auto &[row, k] : order)
    fmt::format_to(out, "unfix rod{0}\nregion rod{0} delete\n", rods[row].id);
  for (std::size_t k = 0; k < kinds.size(); k++)
    fmt::format_to(out, "unfix rods{0}\nunfix rod_template{0}\n", k + 1);
  fmt::format_to(
      out, "variable rods_dt delete\nvariable rods_now delete\nvariable rods_moment delete\n");
  return fmt::to_string(text);
}

}  // namespace spherocylinder
