// SPDX-License-Identifier: GPL-2.0-or-later
// Contact models, their keywords and properties.
#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

std::string choose_keywords(Random &random, Material &material)
{
  std::string words;
  if (material.normal == "linear" && random.chance(0.15)) {
    material.aspect_scaling = true;
    words += " aspect_scaling on";
  }
  if (material.normal == "linear" && random.chance(0.1)) words += " limitForce on";
  if (random.chance(0.1)) words += " tangential_damping off";
  return words;
}

}  // namespace

void choose_material(Draft &draft)
{
  Random &random = draft.random;
  Material &material = draft.plan.material;
  material.types = random.pick({1, 1, 2, 3});
  for (int k = 0; k < material.types; k++)
    material.stiffness_of_type.push_back(random.pick({1.0, 1.0, 0.5, 1.4}));
  material.normal =
      random.pick({"linear", "linear", "linear", "linear", "hertz", "hooke", "hooke/stiffness"});
  material.tangential = random.pick({"off", "off", "history", "history", "no_history"});
  material.restitution = random.pick({1.0, 1.0, 0.9, 0.5, 0.5, 0.2});
  material.friction = random.pick({0.0, 0.2, 0.5, 0.9});
  if (random.chance(0.08)) material.cohesion = random.pick({"sjkr", "sjkr2"});
  if (random.chance(0.12)) material.rolling = random.pick({"cdt", "epsd", "epsd2"});
  material.spread = random.chance(0.5);
  draft.dt = random.pick({1e-5, 1e-5, 5e-6});

  std::string models = fmt::format("model {} tangential {}", material.normal, material.tangential);
  if (!material.cohesion.empty()) models += " cohesion " + material.cohesion;
  if (!material.rolling.empty()) models += " rolling_friction " + material.rolling;
  models += " surface spherocylinder";
  draft.models = models;
  draft.keywords = choose_keywords(random, material);
  if (random.chance(0.3)) draft.sudden_overlap = " sudden_overlap on";
  draft.newton = random.chance(0.01);
  draft.lost = random.pick({"ignore", "ignore", "ignore", "warn", "error"});
  draft.close_skin = random.chance(0.2) ? random.pick({"0.001", "0.003", "0.01"}) : "auto";
}

}  // namespace grammar
