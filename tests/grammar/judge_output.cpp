// SPDX-License-Identifier: GPL-2.0-or-later
// Sentences, thermo output, local rows, twins; and the whole of a right end.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "brute_force.h"
#include "deck_run.h"
#include "judge.h"

namespace grammar {

namespace {

State at_start(const Plan &plan)
{
  State state;
  state.rods = plan.start;
  return state;
}

// fix deform's erate: the length at the run's start and a share of it for each unit of time.
void grow(Box &box, const Run &run, double time)
{
  const int d = run.effects.deformed;
  if (d < 0) return;
  const double by = 0.5 * run.effects.rate * time * box.period(d);
  box.lo[d] -= by;
  box.hi[d] += by;
}

// The box of the run's last step. Contacts of a step know the box, and rods that go with it, before
// the step's own change.
Box make_boxes_exact(std::vector<State> &states, const Run &run, const Box &at_start)
{
  Box box = at_start;
  for (State &state : states) {
    const long steps = state.step - run.first_step;
    box = at_start;
    grow(box, run, run.dt * static_cast<double>(steps));
    make_exact(state.box, box);
    if (run.effects.deformed < 0 || !state.box.exact || steps == 0) continue;
    const Box after = state.box;
    const int d = run.effects.deformed;
    state.box.lo[d] = at_start.lo[d];
    state.box.hi[d] = at_start.hi[d];
    grow(state.box, run, run.dt * static_cast<double>(steps - run.effects.every));
    if (!run.effects.remaps_x) continue;
    for (auto &[id, rod] : state.rods) {
      double &along = component(rod.x, d);
      along = state.box.lo[d] + (along - after.lo[d]) * state.box.period(d) / after.period(d);
    }
  }
  return box;
}

// Friction of `linear` is at most mu times the normal force; without spread_contact the contact sits
// where the search finds it. (With it the energy of nearly parallel rods changes as they slide along
// each other, so that a force along them, small beside the spring's, is no friction.)
void check_row(const Material &m, const Touch &touch, const std::vector<double> &row,
               const State &last)
{
  const int i = static_cast<int>(row[0]), j = static_cast<int>(row[1]);
  const auto wrong = [&](const std::string &what) {
    throw Wrong(fmt::format("row of rods {} and {}: {}", i, j, what));
  };
  const Vec3 force{row[3], row[4], row[5]}, normal{row[10], row[11], row[12]};
  if (std::fabs(norm(normal) - 1.0) > 1e-9) wrong("its normal has another length than 1");
  const double along = dot(force, normal), across = norm(force - along * normal);
  const double mu = m.tangential == "off" ? 0.0 : m.friction;
  // Damping can take the normal force to nothing, but not the spring's.
  const double spring = std::max(std::fabs(along), touch.stiffness * row[6]);
  if (m.normal == "linear" && m.cohesion.empty() &&
      across > mu * (1.0 + 1e-6) * std::fabs(along) + (m.spread ? 0.05 : 1e-9) * spring + 1e-12)
    wrong(fmt::format("friction {:.6g}, normal force {:.6g}, coefficient {}", across, along, mu));
  if (!touch.plain || m.spread) return;
  const double side = i == touch.i ? 1.0 : -1.0;
  if (norm(normal - side * touch.normal) > 1e-5) wrong("another normal than by search");
  const Vec3 point{row[7], row[8], row[9]};
  const Vec3 arm = i == touch.i ? touch.arm_i : touch.arm_j;
  if (norm(last.box.nearest(point - last.rods.at(i).x) - last.box.nearest(arm)) >
      1e-5 * touch.reach)
    wrong("another contact point than by search");
}

// Such rods are taken away when LIGGGHTS next makes its lists, sooner or later.
bool has_left(const Rod &rod, const Box &box)
{
  for (int d = 0; d < 3; d++)
    if (!box.periodic[d] && (component(rod.x, d) < box.lo[d] || component(rod.x, d) >= box.hi[d]))
      return true;
  return false;
}

// The last line of numbers below the thermo header, whatever warnings stand between.
std::vector<double> last_thermo(const std::string &output)
{
  std::istringstream in(output);
  std::string line;
  std::vector<double> last;
  size_t columns = 0;
  while (std::getline(in, line)) {
    std::istringstream words_in(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(words_in), {}};
    if (!words.empty() && words[0] == "Step") columns = words.size();
    if (columns == 0 || words.size() != columns) continue;
    std::vector<double> numbers;
    for (const std::string &word : words) {
      char *end = nullptr;
      numbers.push_back(std::strtod(word.c_str(), &end));
      if (*end != '\0') break;
    }
    if (numbers.size() == columns && words[0].find_first_not_of("0123456789") == std::string::npos)
      last = numbers;
  }
  return last;
}

}  // namespace

Held &held()
{
  static Held counts;
  return counts;
}

std::string sentence_of(const std::string &output)
{
  std::istringstream in(output);
  std::string line, sentence;
  while (std::getline(in, line))
    if (line.rfind("ERROR", 0) == 0) sentence = line;
  const size_t colon = sentence.find(": ");
  if (sentence.empty()) throw Wrong("ended with an error, and no sentence says why");
  if (colon == std::string::npos || sentence.size() < colon + 12)
    throw Wrong("the sentence says nothing: " + sentence);
  return sentence.substr(colon + 2);
}

void check_thermo(const Plan &plan, const std::string &output, const State &last)
{
  const std::vector<double> row = last_thermo(output);
  if (row.empty() && plan.ranks > 1) return;  // lines of several ranks may run into each other
  if (row.empty()) throw Wrong("no thermo output");
  double kinetic = 0.0, turning = 0.0;
  for (const auto &[id, rod] : last.rods) {
    kinetic += 0.5 * rod.mass * norm_squared(rod.v);
    turning += 0.5 * dot(rod.omega, rod.angular_momentum());
  }
  const auto differ = [](double a, double b) {
    return std::fabs(a - b) > 1e-9 * (std::fabs(a) + std::fabs(b)) + 1e-15;
  };
  if (static_cast<long>(row[0]) != last.step) return;
  if (row[1] != static_cast<double>(last.rods.size()))
    throw Wrong(fmt::format("thermo says {} rods, the dump has {}", row[1], last.rods.size()));
  if (differ(row[2], kinetic))
    throw Wrong(fmt::format("compute ke {:.9g}, by the dump {:.9g}", row[2], kinetic));
  if (differ(row[3], turning))
    throw Wrong(fmt::format("compute erotate {:.9g}, by the dump {:.9g}", row[3], turning));
  double largest = 0.0;
  for (const Touch &touch : pair_touches(last, plan.material))
    largest = std::max(largest, touch.overlap / touch.reach);
  const Effects &effects = plan.runs.back().effects;
  if (images_are_plain(last) && effects.counts_all_pairs && !effects.remaps_x &&
      std::fabs(largest - row[5]) > 1e-7)
    throw Wrong(fmt::format("largest overlap {:.9g}, by search {:.9g}", row[5], largest));
}

void check_rows(const Plan &plan, const std::filesystem::path &file, const State &last)
{
  const Run &run = plan.runs.back();
  if (!images_are_plain(last) || !run.effects.counts_all_pairs) return;
  const std::vector<decks::Snapshot> snapshots = decks::read_dump(file);
  if (snapshots.empty() || snapshots.back().step != last.step)
    throw Wrong("no rows of contacts at the last step");
  const auto is_still = [&](int id) {
    const Rod &rod = last.rods.at(id);
    return run.effects.still.count(id) > 0 ||
           (run.effects.unknown_held && norm(rod.v) == 0.0 && norm(rod.omega) == 0.0);
  };
  std::map<std::pair<int, int>, Touch> touches;
  for (const Touch &touch : pair_touches(last, plan.material))
    if (!is_still(touch.i) || !is_still(touch.j)) touches[{touch.i, touch.j}] = touch;
  std::map<int, Vec3> sums;
  for (const std::vector<double> &row : snapshots.back().atoms.rows) {
    const int i = static_cast<int>(row.at(0)), j = static_cast<int>(row.at(1));
    const auto found = touches.find(std::minmax(i, j));
    if (found == touches.end())
      throw Wrong(fmt::format("a row for rods {} and {}, which do not touch", i, j));
    const Touch touch = found->second;
    touches.erase(found);
    const Vec3 force{row[3], row[4], row[5]};
    sums[i] = sums[i] + force;
    sums[j] = sums[j] - force;
    // spread_contact: the overlap whose spring has the force that follows from its energy.
    // Rods driven past each other keep their side, which the search does not know.
    if (row[6] > touch.reach) continue;
    const double share = row[6] / touch.overlap;
    const bool shared = plan.material.spread && share > 0.4 && share < 1.2;
    if (touch.plain && !shared && std::fabs(row[6] - touch.overlap) > 1e-7 * touch.reach)
      throw Wrong(fmt::format("overlap of rods {} and {}: {:.9g}, by search {:.9g}", i, j, row[6],
                              touch.overlap));
    check_row(plan.material, touch, row, last);
    held().rows++;
  }
  for (const auto &[pair, touch] : touches)
    if (touch.overlap > 1e-8 * touch.reach)
      throw Wrong(fmt::format("no row for rods {} and {}, which touch", touch.i, touch.j));
  if (!plan.walls.empty() || !run.effects.forces_known) return;
  for (const auto &[id, rod] : last.rods) {
    if (run.effects.still.count(id) || run.effects.driven.count(id)) continue;
    Vec3 wanted = sums[id] + rod.mass * run.effects.gravity;
    const auto added = run.effects.added_force.find(id);
    if (added != run.effects.added_force.end()) wanted = wanted + added->second;
    if (norm(rod.force - wanted) > 1e-8 * (norm(rod.force) + norm(wanted)) + 1e-9)
      throw Wrong(fmt::format("rows of rod {} do not add up to its force", id));
  }
}

void check_twins(const State &one, const State &other, const std::string &setting)
{
  for (const auto &[id, rod] : other.rods)
    if (!one.rods.count(id) && !has_left(rod, other.box))
      throw Wrong(fmt::format("rod {} is there with {} only", id, setting));
  for (const auto &[id, rod] : one.rods) {
    const auto found = other.rods.find(id);
    if (found == other.rods.end() && has_left(rod, one.box)) continue;
    if (found == other.rods.end()) throw Wrong(fmt::format("with {} rod {} is gone", setting, id));
    const Rod &twin = found->second;
    // Round-off, and what hits make of it.
    const double apart = norm(one.box.nearest(twin.x - rod.x)) / rod.radius;
    const double turned = norm(cross(twin.axis, rod.axis)) * rod.half_cylinder() / rod.radius;
    if (!(apart + turned < 1e-4))
      throw Wrong(fmt::format("with {} rod {} is elsewhere by {:.3g} radii, its end by {:.3g}",
                              setting, id, apart, turned));
  }
}

State judge_results(const Plan &plan, const std::filesystem::path &folder,
                    const std::string &output)
{
  if (output.find("the end of the deck") == std::string::npos)
    throw Wrong("exit code 0, but the deck did not come to its end");
  State last = at_start(plan);
  Box box = plan.box;
  bool known = !plan.start.empty(), springs = false;
  for (const Run &run : plan.runs) {
    std::vector<State> states = read_states(folder / run.dump);
    if (states.empty() || states.back().step != run.first_step + run.steps)
      throw Wrong(fmt::format("no rods of step {}", run.first_step + run.steps));
    box = make_boxes_exact(states, run, box);
    for (const State &state : states) check_state(plan, run, state);
    if (known) check_start(run, last, states.front());
    check_motion(plan, run, states, springs);
    check_driven(plan, run, states);
    last = states.back();
    known = springs = true;
  }
  // Walls do not stop what is driven.
  const bool drives = std::any_of(plan.runs.begin(), plan.runs.end(), [](const Run &run) {
    return !run.effects.driven.empty() || run.effects.unknown_held;
  });
  if (static_cast<int>(last.rods.size()) < plan.fewest_rods && plan.walls.size() > 5 && !drives)
    throw Wrong(
        fmt::format("{} rods of {} in a closed vessel", last.rods.size(), plan.fewest_rods));
  check_thermo(plan, output, last);
  if (plan.local_rows) check_rows(plan, folder / "dump.rows", last);
  return last;
}

}  // namespace grammar
