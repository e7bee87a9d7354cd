// SPDX-License-Identifier: GPL-2.0-or-later
// Runs, and the commands between them with what each does to the rods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draft.h"

namespace grammar {

namespace {

using Change = std::function<void(State &)>;

void each(State &state, const std::function<bool(const Rod &)> &has,
          const std::function<void(Rod &)> &change)
{
  for (auto &[id, rod] : state.rods)
    if (has(rod)) change(rod);
}

std::string words(const Vec3 &a) { return fmt::format("{:.9g} {:.9g} {:.9g}", a.x, a.y, a.z); }

// The commands before one run.
class Pause {
 public:
  Pause(Draft &draft, Run &run) : draft_(draft), random_(draft.random), run_(run) {}

  void choose()
  {
    switch (random_.integer(0, 13)) {
      case 0:
      case 1:
      case 2: delete_some(); break;
      case 3:
      case 4: displace(); break;
      case 5: set_velocity(); break;
      case 6: set_something(); break;
      case 7: change_box(); break;
      case 8: renumber_steps(); break;
      case 9: restart(); break;
      case 10: through_data_file(); break;
      case 11: exclude(); break;
      case 12:
        if (draft_.plan.ranks > 1) add("balance 1.01 shift xyz 10 1.01\n");
        break;
      default:
        add(random_.pick({"run 0\n", "neigh_modify every 1 delay 0 check yes\n",
                          "print \"a pause\"\n", "fix weight all gravity 0.0 vector 0 0 -1\n"}));
        if (run_.before.find("gravity") != std::string::npos) {
          draft_.effects.gravity = {0.0, 0.0, 0.0};
          draft_.can_restart = false;
        }
    }
  }

  // The same deck in one go is the twin of this.
  void restart()
  {
    if (!draft_.can_restart) return;
    add("write_restart half\nclear\n" + header(draft_, "read_restart half\n"));
  }

 private:
  Draft &draft_;
  Random &random_;
  Run &run_;

  void add(const std::string &text) { run_.before += text; }
  void change(const Change &change) { run_.changes.push_back(change); }

  bool driven_or_held() const
  {
    return !draft_.effects.driven.empty() || !draft_.effects.still.empty();
  }

  // A group by type, region or id, and which rods it has.
  std::string name_some(std::function<bool(const Rod &)> &has)
  {
    const int which = random_.integer(0, 2);
    const std::string group = fmt::format("some{}", draft_.groups++);
    if (which == 0) {
      const int type = random_.integer(1, draft_.plan.material.types);
      has = [type](const Rod &rod) { return rod.type == type; };
      add(fmt::format("group {} type {}\n", group, type));
    } else if (which == 1 && draft_.ids_known && draft_.has_part()) {
      const std::set<int> ids(draft_.part.begin(), draft_.part.end());
      has = [ids](const Rod &rod) { return ids.count(rod.id) > 0; };
      add(fmt::format("group {} union part\n", group));
    } else {
      const int d = random_.integer(0, 2);
      const double cut = 0.5 * (draft_.box.lo[d] + draft_.box.hi[d]);
      has = [d, cut](const Rod &rod) { return component(rod.x, d) <= cut; };
      add(fmt::format("region in_{0} block{1} units box\ngroup {0} region in_{0}\n", group,
                      half_space(d, cut)));
    }
    return group;
  }

  std::string half_space(int d, double cut) const
  {
    std::string bounds;
    for (int k = 0; k < 3; k++)
      bounds += k == d ? fmt::format(" INF {:.17g}", cut) : std::string(" INF INF");
    return bounds;
  }

  void delete_some()
  {
    const std::string compress = random_.pick({"", "", " compress yes", " compress no"});
    const int times = random_.pick({1, 1, 2});
    for (int k = 0; k < times; k++) {
      const double which = random_.uniform(0.0, 1.0);
      if (which < 0.7) {
        std::function<bool(const Rod &)> gone;
        const std::string group = name_some(gone);
        add(fmt::format("delete_atoms group {}{}\n", group, compress));
        change([gone](State &state) {
          for (auto at = state.rods.begin(); at != state.rods.end();)
            at = gone(at->second) ? state.rods.erase(at) : std::next(at);
        });
        if (compress != " compress no") forget_ids();
      } else if (which < 0.85) {
        add(fmt::format("region all_of{0} block INF INF INF INF INF INF units box\n"
                        "delete_atoms porosity all_of{0} 0.3 {1}{2}\n", draft_.groups++,
                        random_.seed(), compress));
        run_.start_known = false;
        draft_.plan.twin = Setting::Same;
        if (compress != " compress no") forget_ids();
      } else {
        add(fmt::format("delete_atoms overlap 0.01 all all{}\n", compress));
        run_.start_known = false;
        draft_.plan.twin = Setting::Same;
        if (compress != " compress no") forget_ids();
      }
    }
    draft_.plan.fewest_rods = 0;
  }

  void forget_ids()
  {
    run_.new_ids = true;
    draft_.ids_known = false;
    draft_.can_restart = draft_.can_restart && !draft_.has_part();
    draft_.plan.twin = Setting::Same;
    // Groups keep their rods, but this program no longer knows their numbers.
    if (!draft_.effects.added_force.empty()) draft_.effects.forces_known = false;
    draft_.effects.added_force.clear();
    draft_.effects.still.clear();
    draft_.effects.driven.clear();
  }

  void displace()
  {
    if (driven_or_held()) return;
    std::function<bool(const Rod &)> has = [](const Rod &) { return true; };
    const std::string group = random_.chance(0.5) ? name_some(has) : "all";
    const double way = random_.pick({0.001, 0.01, 0.05});
    switch (random_.integer(0, 3)) {
      case 0: {
        const Vec3 by = way * random_.direction();
        add(fmt::format("displace_atoms {} move {} units box\n", group, words(by)));
        change([=](State &s) { each(s, has, [&](Rod &rod) { rod.x = rod.x + by; }); });
        break;
      }
      case 1: {
        if (!draft_.plan.walls.empty() && random_.chance(0.8)) return;
        const Vec3 point = 0.3 * draft_.longest() * random_.direction(), axis = random_.direction();
        const double angle = random_.pick({1.0, 30.0, 90.0, -45.0});
        add(fmt::format("displace_atoms {} rotate {} {} {} units box\n", group, words(point),
                        words(axis), angle));
        const double radians = angle * std::acos(-1.0) / 180.0;
        change([=](State &s) {
          each(s, has, [&](Rod &rod) {
            rod.x = point + turned(rod.x - point, axis, radians);
            rod.axis = turned(rod.axis, axis, radians);
          });
        });
        run_.omega_unsaid = true;
        break;
      }
      case 2:
        add(fmt::format("displace_atoms {} random {} {} {} {} units box\n", group, way, way, way,
                        random_.seed()));
        run_.start_known = false;
        break;
      default:
        add(fmt::format("displace_atoms {} ramp x 0.0 {} y {:.9g} {:.9g} units box\n", group, way,
                        draft_.box.lo[1], draft_.box.hi[1]));
        change([=, lo = draft_.box.lo[1], hi = draft_.box.hi[1]](State &s) {
          each(s, has, [&](Rod &rod) {
            rod.x.x += way * std::max(0.0, std::min(1.0, (rod.x.y - lo) / (hi - lo)));
          });
        });
    }
  }

  void set_velocity()
  {
    if (driven_or_held()) return;
    std::function<bool(const Rod &)> has = [](const Rod &) { return true; };
    const std::string group = random_.chance(0.5) ? name_some(has) : "all";
    if (random_.chance(0.7)) {
      const Vec3 v = random_.direction();
      add(fmt::format("velocity {} set {} units box\n", group, words(v)));
      change([=](State &s) { each(s, has, [&](Rod &rod) { rod.v = v; }); });
    } else {
      add(fmt::format("velocity {} zero linear\n", group));
      change([=](State &s) {
        Vec3 sum{0.0, 0.0, 0.0};
        double mass = 0.0;
        each(s, has, [&](Rod &rod) {
          sum = sum + rod.mass * rod.v;
          mass += rod.mass;
        });
        each(s, has, [&](Rod &rod) { rod.v = rod.v - (1.0 / mass) * sum; });
      });
    }
  }

  void set_something()
  {
    if (driven_or_held()) return;
    std::function<bool(const Rod &)> has = [](const Rod &) { return true; };
    const std::string group = name_some(has);
    const auto all_of = [&](const std::function<void(Rod &)> &what) {
      change([=](State &s) { each(s, has, what); });
    };
    switch (random_.integer(0, 5)) {
      case 0:
        add(fmt::format("set group {} omegax 20.0\n", group));
        all_of([](Rod &rod) { rod.omega.x = 20.0; });
        break;
      case 1:
        add(fmt::format("set group {} density 5000.0\n", group));
        all_of([](Rod &rod) { rod.mass *= 5000.0 / rod.density; rod.density = 5000.0; });
        break;
      case 2: {
        const int type = draft_.plan.material.types;
        add(fmt::format("set group {} type {}\n", group, type));
        all_of([type](Rod &rod) { rod.type = type; });
        break;
      }
      case 3:
        add(fmt::format("set group {} vz -0.5\n", group));
        all_of([](Rod &rod) { rod.v.z = -0.5; });
        break;
      default:
        add(fmt::format("set group {} {}\n", group,
                        random_.pick({"diameter 0.01", "mass 0.01", "shape 0.005 0.005 0.05",
                                      "quat 0 0 1 30", "quat/random 10007", "volume 1e-6",
                                      "angmom 0 0 1", "blockiness 2 2", "length 0.1"})));
        run_.start_known = false;
        draft_.effects.forces_known = false;
    }
  }

  void change_box()
  {
    const int d = random_.integer(0, 2);
    const bool doubtful = random_.chance(0.2);
    if (doubtful) {
      add(random_.pick({"change_box all triclinic\n", "change_box all x delta -0.01 0.01 remap\n",
                        "change_box all boundary p p p\n", "change_box all boundary m m m\n"}));
      run_.start_known = false;
      draft_.effects.forces_known = false;
      draft_.effects.box_changes = true;
      draft_.effects.energy_may_grow = true;
      draft_.effects.only_internal = false;
      draft_.can_restart = false;
      return;
    }
    if (draft_.boundary[d] != "f") return;
    draft_.box.lo[d] -= 0.01;
    draft_.box.hi[d] += 0.02;
    add(fmt::format("change_box all {} final {:.17g} {:.17g} units box\n", "xyz"[d],
                    draft_.box.lo[d], draft_.box.hi[d]));
  }

  void renumber_steps()
  {
    if (!draft_.effects.driven.empty()) return;
    if (random_.chance(0.5)) {
      draft_.step = 100 * draft_.unit;
      add(fmt::format("reset_timestep {}\n", draft_.step));
    } else {
      draft_.dt *= 0.5;
      add(fmt::format("timestep {}\n", draft_.dt));
    }
  }

  void through_data_file()
  {
    if (!draft_.can_restart || !draft_.rods.size() || draft_.making != Making::DataFile) return;
    if (draft_.boundary[0] == "m" || draft_.boundary[1] == "m" || draft_.boundary[2] == "m") return;
    add("write_data half.data\nclear\n" + header(draft_, "read_data half.data\n"));
    draft_.step = 0;
    run_.history_kept = false;
    draft_.effects.driven.clear();
    if (!draft_.ids_known) draft_.can_restart = false;
  }

  void exclude()
  {
    if (!draft_.has_part() || !draft_.ids_known) return;
    add("neigh_modify exclude group part part\n");
    draft_.effects.counts_all_pairs = false;
    draft_.effects.forces_known = false;
    draft_.can_restart = false;
  }
};

std::string run_command(Draft &draft, Run &run)
{
  Random &random = draft.random;
  const long steps = draft.unit * random.pick({1, 2, 3, 5, 5, 8, 10});
  run.steps = steps;
  const double which = random.uniform(0.0, 1.0);
  std::string text = fmt::format("run {}", steps);
  if (which < 0.06) text += " post no";
  else if (which < 0.12) text += fmt::format(" every {} \"print here\"", draft.unit);
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
