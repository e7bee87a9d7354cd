// SPDX-License-Identifier: GPL-2.0-or-later
// Rods placed one by one, or templates and an insertion command.
#include <algorithm>

#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

std::string templates(Draft &draft)
{
  std::string text, names;
  for (size_t k = 0; k < draft.kinds.size(); k++) {
    const Kind &kind = draft.kinds[k];
    text += fmt::format(
        "fix template{} all particletemplate/spherocylinder {} atom_type {} density constant {} "
        "radius constant {:.17g} length constant {:.17g}\n",
        k, draft.random.seed(), kind.type, kind.density, kind.radius, kind.length);
    names += fmt::format(" template{} {:.17g}", k, 1.0 / static_cast<double>(draft.kinds.size()));
  }
  return text + fmt::format("fix mixture all particledistribution/discrete {} {}{}\n",
                            draft.random.seed(), draft.kinds.size(), names);
}

std::string feed_region(const Draft &draft)
{
  std::string bounds;
  for (int d = 0; d < 3; d++) {
    const double middle = 0.5 * (draft.inside_lo[d] + draft.inside_hi[d]);
    double half = 0.5 * (draft.inside_hi[d] - draft.inside_lo[d]) - 0.55 * draft.longest();
    for (const Wall &wall : draft.plan.walls)  // a square in the circle
      if (wall.cylinder && wall.dim != d) half *= 0.6;
    half = std::max(half, 0.02 * draft.box.period(d));
    bounds += fmt::format(" {:.17g} {:.17g}", middle - half, middle + half);
  }
  return "region feed block" + bounds + " units box\n";
}

// A square across the middle of the box, for insert/stream: normal along z.
std::string face(const Draft &draft)
{
  double lo[2], hi[2];
  for (int d = 0; d < 2; d++) {
    const double half = 0.2 * (draft.inside_hi[d] - draft.inside_lo[d]);
    lo[d] = 0.5 * (draft.inside_lo[d] + draft.inside_hi[d]) - half;
    hi[d] = lo[d] + 2.0 * half;
  }
  const double z = 0.5 * (draft.inside_lo[2] + draft.inside_hi[2]) - 0.5 * draft.longest();
  const auto facet = [&](double x, double y) {
    return fmt::format(
        "facet normal 0 0 1\n outer loop\n  vertex {0} {1} {4}\n  vertex {2} {1} {4}\n"
        "  vertex {2} {3} {4}\n endloop\nendfacet\n"
        "facet normal 0 0 1\n outer loop\n  vertex {0} {1} {4}\n  vertex {2} {3} {4}\n"
        "  vertex {0} {3} {4}\n endloop\nendfacet\n",
        lo[0], lo[1], x, y, z);
  };
  return "solid face\n" + facet(hi[0], hi[1]) + "endsolid face\n";
}

void choose_insertion(Draft &draft)
{
  Random &random = draft.random;
  draft.plan.most_rods = std::min(draft.plan.most_rods, 30);
  const int rods = draft.plan.most_rods;
  std::string text = templates(draft) + feed_region(draft);
  const std::string orientation =
      random.chance(0.8) ? "orientation random "
                         : random.pick({"orientation constant 0.70710678 0.70710678 0 0 ",
                                        "orientation constant 0.7071 0.7071 0 0 "});
  std::string common = fmt::format(
      "seed {} distributiontemplate mixture maxattempt 400 overlapcheck yes all_in no {}"
      "vel constant {:.3g} 0.0 {:.3g}",
      random.seed(), orientation, random.uniform(-1.0, 1.0), random.uniform(-1.0, -0.2));
  if (random.chance(0.3)) common += " omega constant 10.0 -5.0 0.0";
  const long every = draft.unit * random.integer(1, 3);
  draft.plan.fewest_rods = 0;
  switch (draft.making) {
    case Making::Pack:
      text += fmt::format("fix pour all insert/pack {} insert_every once region feed "
                          "particles_in_region {}\n",
                          common, rods);
      draft.plan.fewest_rods = rods;
      break;
    case Making::RefilledPack:
      text +=
          fmt::format("fix pour all insert/pack {} insert_every {} region feed {}\n", common, every,
                      random.chance(0.5) ? fmt::format("particles_in_region {}", rods)
                                         : std::string("volumefraction_region 0.01"));
      draft.plan.most_rods = 100000;
      break;
    case Making::Stream:
      draft.plan.files["face.stl"] = face(draft);
      text += fmt::format("fix face all mesh/surface/planar file face.stl type 1\n"
                          "fix pour all insert/stream {} nparticles {} particlerate {:.6g} "
                          "insertion_face face extrude_length {:.6g}\n",
                          common, rods, rods / (draft.dt * 300.0), 2.5 * draft.longest());
      draft.effects.forces_known = false;  // rods on their way to the face fly at a set speed
      draft.effects.energy_may_grow = true;
      break;
    default:
      text +=
          fmt::format("fix pour all insert/rate/region {} nparticles {} particlerate {:.6g} "
                      "insert_every {} region feed\n",
                      common, rods, rods / (draft.dt * static_cast<double>(every) * 2.0), every);
  }
  draft.effects.inserting = true;
  draft.can_restart = random.chance(0.3);
  draft.fix_text += text;
}

}  // namespace

void choose_rods(Draft &draft)
{
  using M = Making;
  draft.making = draft.random.pick({M::DataFile, M::DataFile, M::DataFile, M::DataFile, M::DataFile,
                                    M::DataFile, M::DataFile, M::ByHand, M::Pack, M::Pack,
                                    M::RefilledPack, M::Rate, M::Stream});
  if (draft.making == M::ByHand) draft.plan.most_rods = std::min(draft.plan.most_rods, 12);
  if (draft.making == M::DataFile || draft.making == M::ByHand)
    place_rods(draft);
  else
    choose_insertion(draft);
}

}  // namespace grammar
