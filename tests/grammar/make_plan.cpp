// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

// Which other setting the deck is run in as well. A run again differs by round-off, which hits
// multiply: only decks whose rods are the same whatever the ranks are, and whose runs are short.
Setting choose_twin(Draft &draft)
{
  using S = Setting;
  if (draft.rods.empty() || !draft.random.chance(0.3)) return S::Same;
  return draft.random.pick({S::OtherRanks, S::OtherSkins, S::HashMap, S::Restarted, S::Restarted,
                            S::UnusedType, S::Balanced});
}

void write_deck(Draft &draft)
{
  Plan &plan = draft.plan;
  std::string source = box_command(draft);
  if (draft.making == Making::ByHand) source += rods_by_hand(draft);
  if (draft.making == Making::DataFile) {
    plan.files["rods.data"] = data_file(draft);
    source = "read_data rods.data\n";
  }
  plan.deck = header(draft, source);
}

void write_runs(Draft &draft)
{
  Plan &plan = draft.plan;
  for (size_t k = 0; k < plan.runs.size(); k++) {
    const Run &run = plan.runs[k];
    plan.deck += run.before + dump_commands("frames", run.dump, draft.unit);
    const bool last = k + 1 == plan.runs.size();
    if (plan.local_rows && last)
      plan.deck +=
          fmt::format("dump rows_dump all local {} dump.rows c_rows[1] c_rows[2] c_rows[3] "
                      "c_rows[4] c_rows[5] c_rows[6] c_rows[7] c_rows[8] c_rows[9] "
                      "c_rows[10] c_rows[11] c_rows[12] c_rows[13]\n"
                      "dump_modify rows_dump format \"%.17g %.17g %.17g %.17g %.17g %.17g "
                      "%.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\n",
                      draft.unit);
    plan.deck += run.command + "undump frames\n";
  }
  plan.deck += "print \"the end of the deck\"\n";
}

}  // namespace

std::string name_of(Setting setting)
{
  switch (setting) {
    case Setting::Same: return "same";
    case Setting::OtherRanks: return "other ranks";
    case Setting::OtherSkins: return "other skins";
    case Setting::HashMap: return "the other map";
    case Setting::Restarted: return "a restart";
    case Setting::UnusedType: return "an unused type";
    case Setting::Balanced: return "fix balance";
  }
  return "";
}

Draft::Draft(long number, Setting in_setting)
    : random(0x9e3779b97f4a7c15ull * static_cast<uint64_t>(number + 1)), setting(in_setting)
{
  plan.number = number;
}

Plan make_plan(long number, Setting setting)
{
  Draft draft(number, setting);
  choose_material(draft);
  choose_scene(draft);
  choose_rods(draft);
  draft.plan.twin = choose_twin(draft);
  draft.plan.box = draft.box;
  choose_fixes(draft);
  choose_computes(draft);
  write_deck(draft);
  choose_runs(draft);
  write_runs(draft);
  draft.plan.start = draft.rods;
  if (draft.random.chance(0.1)) spoil_deck(draft);
  if (setting == Setting::OtherRanks) draft.plan.ranks = draft.plan.ranks == 1 ? 2 : 1;
  return draft.plan;
}

}  // namespace grammar
