// SPDX-License-Identifier: GPL-2.0-or-later
// How many runs, and how each is asked for.
#include <fmt/format.h>

#include "draft.h"
#include "pause.h"

namespace grammar {

namespace {

std::string run_command(Draft &draft, Run &run)
{
  Random &random = draft.random;
  const long steps = draft.unit * random.pick({1, 2, 3, 5, 5, 8, 10});
  run.steps = steps;
  const double which = random.uniform(0.0, 1.0);
  std::string text = fmt::format("run {}", steps);
  if (which < 0.06)
    text += " post no";
  else if (which < 0.12)
    text += fmt::format(" every {} \"print here\"", draft.unit);
  else if (which < 0.2) {
    run.steps += draft.unit;
    text += fmt::format("\nrun {} pre no", draft.unit);
  } else if (which < 0.25) {
    text = fmt::format("run {} upto", draft.step + steps);
  }
  return text + "\n";
}

}  // namespace

void choose_runs(Draft &draft)
{
  Random &random = draft.random;
  const int count = random.pick({1, 1, 2, 2, 3, 4});
  const int restarted = count > 1 ? random.integer(1, count - 1) : 0;
  for (int k = 0; k < count; k++) {
    Run run;
    Pause pause(draft, run);
    if (k > 0) {
      for (int n = random.pick({0, 1, 1, 2}); n > 0; n--) pause.choose();
      if (draft.setting == Setting::Restarted && k == restarted) pause.restart();
    }
    run.effects = draft.effects;
    run.dt = draft.dt;
    run.command = run_command(draft, run);
    run.dump = fmt::format("dump.{}", k);
    run.first_step = draft.step;
    draft.step += run.steps;
    draft.plan.runs.push_back(run);
  }
}

}  // namespace grammar
