// SPDX-License-Identifier: GPL-2.0-or-later
// Rods that find their contacts in five steps: those that are found are the same, others are not
// there. Which and how many are missed: tests/unit/five_step_search_test.cpp.
#include <algorithm>
#include <cmath>

#include "claim.h"
#include "off_centre_impact.h"
#include "run_mode.h"

using namespace decks;

namespace {

class FiveStepSearch : public RunMode {};

constexpr const char *kFiveStep = "search five_step spread_contact off sudden_overlap on";

// The end of one rod lies in the side of another, half a diameter deep, at so small an angle that
// their lines are nearest beyond both; two parallel rods lie in each other side by side, half a length
// apart.
Scene missed_contacts(const std::string &keywords)
{
  Scene scene;
  Rod lower, leaning, shifted;
  leaning.axis = normalized({7.0, -0.5, 0.0});
  leaning.position = Vec3{0.027, 0.0045, 0.0} - leaning.half_cylinder() * leaning.axis;
  scene.rods = {lower, leaning};
  lower.position.z = 0.5;
  shifted.position = {0.05, 0.005, 0.5};
  scene.rods.push_back(lower);
  scene.rods.push_back(shifted);
  scene.physics = linear_material(1e4, 1e4, 0.5, 0.2) +
                  rod_pair("linear tangential history", keywords) +
                  "fix motion all nve/spherocylinder\n";
  scene.dt = 1e-6;
  scene.steps = 2000;
  return scene;
}

// Compute contact/spherocylinder knows of them all the same.
TEST_P(FiveStepSearch, MissedContactsHaveNoForce)
{
  for (const char *keywords : {kFiveStep, "search five_step sudden_overlap on"}) {
    const std::vector<Frame> frames = run(missed_contacts(keywords), GetParam());
    EXPECT_EQ(largest_difference({frames.front()}, {frames.back()}), 0.0);
    for (const double contacts : frames.back().contacts) EXPECT_EQ(contacts, 1.0);
  }
  const std::vector<Frame> exact = run(missed_contacts(""), GetParam());
  for (size_t i = 0; i < exact[0].rods.size(); i++)
    EXPECT_GT(norm(exact.back().rods[i].position - exact.front().rods[i].position), 1e-4);
}

// An end on a side, at any angle, is found in the fourth step.
TEST(FiveStepImpact, FoundContactsAreTheSame)
{
  ImpactSet set;
  set.partner = Partner::Rod;
  set.aspect_ratio = 20.0;
  set.restitutions = {0.5, 0.9};
  set.elevations = {5.0, 45.0, 85.0};
  set.steps_per_contact = 1600;
  set.keywords = "spread_contact off";
  const std::vector<MeasuredRestitution> exact = measure_restitution(set);
  set.keywords = kFiveStep;
  const std::vector<MeasuredRestitution> five_step = measure_restitution(set);
  double error = 0.0;
  for (size_t k = 0; k < exact.size(); k++)
    error = std::max(error, std::fabs(five_step[k].measured / exact[k].measured - 1.0));
  // A velocity of 1e-5 m/s, from overlaps of micrometres and less at 1 m from the origin.
  expect_holds({"Five-step search, an end on a side: restitution, relative", "search exact", 1e-6},
               error);
}

DECKS_IN_ALL_MODES(FiveStepSearch);

}  // namespace
