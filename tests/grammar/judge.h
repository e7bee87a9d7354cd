// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "plan.h"

namespace grammar {

// What is wrong, in one line; thrown by the checks.
struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How often each rule was applied and held: a rule that no deck comes under proves nothing.
struct Held {
  std::atomic<long> states{0}, contacts{0}, rods_alone{0}, forces_by_pose{0}, starts{0};
  std::atomic<long> momentum{0}, angular_momentum{0}, energy{0}, energy_kept{0};
  std::atomic<long> flights{0}, driven{0}, rows{0};
};
Held &held();

// A right end: what the dumps and the thermo output of the plan say must agree with what the plan
// knows. Returns the last run's last state. Throws Wrong.
State judge_results(const Plan &plan, const std::filesystem::path &folder,
                    const std::string &output);

// At one step: counts, masses, contacts by search, forces by pose.
void check_state(const Plan &plan, const Run &run, const State &state);
// The first state of a run: what the commands before it make of the state before.
void check_start(const Run &run, State before, const State &first);
// During a run: momentum, energy, rods that meet nobody, driven rods, walls.
void check_motion(const Plan &plan, const Run &run, const std::vector<State> &states,
                  bool springs_at_start);
void check_driven(const Plan &plan, const Run &run, const std::vector<State> &states);
// Rows of compute pair/gran/local at the last step.
void check_rows(const Plan &plan, const std::filesystem::path &file, const State &last);
void check_thermo(const Plan &plan, const std::string &output, const State &last);
// The same deck in two settings.
void check_twins(const State &one, const State &other, const std::string &setting);

// The sentence of a run that was refused. Throws Wrong if there is none, or none that says
// something.
std::string sentence_of(const std::string &output);

}  // namespace grammar
