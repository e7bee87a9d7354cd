// SPDX-License-Identifier: GPL-2.0-or-later
// Runs random decks by their numbers and judges each: right, refused with a sentence, or wrong.
#include <atomic>
#include <chrono>
#include <csignal>
#include <exception>
#include <fstream>
#include <mutex>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "judge.h"
#include "launch.h"

namespace fs = std::filesystem;
using namespace grammar;

namespace {

struct Options {
  long from = 0, to = 149;
  int jobs = 1, time_limit = 60;
  double seconds = 1e9;
  bool only_spoilt = false;
  std::string keep, only_write, program = LMP_PROGRAM;
};

struct Tally {
  std::mutex mutex;
  long right = 0, refused = 0, twins = 0, wrong = 0;
  std::map<std::string, long> sentences;
};

// Sentences of the same kind are counted together: without " (id NAME)".
std::string without_name(std::string sentence)
{
  const size_t from = sentence.find(" (id "), to = sentence.find(')', from);
  if (from != std::string::npos && to != std::string::npos) sentence.erase(from, to + 1 - from);
  return sentence;
}

void write_deck(const Plan &plan, const fs::path &folder, const std::string &name)
{
  for (const auto &[file, text] : plan.files) std::ofstream(folder / file) << text;
  std::ofstream(folder / name) << plan.deck;
}

// The state at a right end; none if refused, with its sentence.
bool run_plan(const Plan &plan, const fs::path &folder, const Options &options, State &last,
              std::string &sentence)
{
  write_deck(plan, folder, "in.deck");
  const Ended ended = run_lmp(folder, options.program, plan.ranks, options.time_limit);
  check_end(ended);
  if (ended.exit_code != 0) {
    sentence = sentence_of(ended.output);
    return false;
  }
  if (plan.spoilt) return true;
  last = judge_results(plan, folder, ended.output);
  return true;
}

void judge_deck(long number, const fs::path &folder, const Options &options, Tally &tally)
{
  const Plan plan = make_plan(number);
  if (options.only_spoilt && !plan.spoilt) return;
  fs::create_directories(folder);
  State last, of_twin;
  std::string sentence;
  const bool right = run_plan(plan, folder, options, last, sentence);
  bool twin = false;
  if (right && plan.twin != Setting::Same) {
    const Plan other = make_plan(number, plan.twin);
    fs::create_directories(folder / "twin");
    try {
      twin = run_plan(other, folder / "twin", options, of_twin, sentence);
    } catch (const std::exception &wrong) {
      throw Wrong(fmt::format("with {}: {}", name_of(plan.twin), wrong.what()));
    }
    if (twin) check_twins(last, of_twin, name_of(plan.twin));
  }
  const std::lock_guard<std::mutex> lock(tally.mutex);
  (right ? tally.right : tally.refused)++;
  tally.twins += twin;
  if (!right) tally.sentences[without_name(sentence).substr(0, 90)]++;
}

using Clock = std::chrono::steady_clock;
const Clock::time_point kBegun = Clock::now();

volatile std::sig_atomic_t interrupted = 0;

bool time_is_over(const Options &options)
{
  return interrupted ||
         std::chrono::duration<double>(Clock::now() - kBegun).count() > options.seconds;
}

void work(std::atomic<long> &next, const fs::path &scratch, const Options &options, Tally &tally)
{
  while (!time_is_over(options)) {
    const long number = next++;
    if (number > options.to) return;
    const fs::path folder = scratch / fmt::format("deck.{}", number);
    try {
      judge_deck(number, folder, options, tally);
    } catch (const std::exception &wrong) {
      const std::lock_guard<std::mutex> lock(tally.mutex);
      tally.wrong++;
      fmt::print("deck {}: {}\n", number, wrong.what());
      std::fflush(stdout);
      if (!options.keep.empty()) {
        const fs::path kept = fs::path(options.keep) / fmt::format("deck.{}", number);
        fs::create_directories(options.keep);
        fs::remove_all(kept);
        fs::copy(folder, kept, fs::copy_options::recursive);
        std::ofstream(kept / "reason") << wrong.what() << '\n';
      }
    }
    fs::remove_all(folder);
  }
}

void report(Tally &tally)
{
  const long decks = tally.right + tally.refused + tally.wrong;
  fmt::print("{} decks: {} right ({} of them in a second setting as well), {} refused with a "
             "sentence, {} wrong\n",
             decks, tally.right, tally.twins, tally.refused, tally.wrong);
  const Held &h = held();
  fmt::print(
      "Held: {} states with {} contacts by search, {} rods that touch nothing, {} rods by the "
      "springs of their contacts, {} starts of runs, {} rows; momentum {}, angular momentum {}, "
      "energy {} (kept by elastic rods: {}) times; {} free flights, {} driven and held rods\n",
      h.states.load(), h.contacts.load(), h.rods_alone.load(), h.forces_by_pose.load(),
      h.starts.load(), h.rows.load(), h.momentum.load(), h.angular_momentum.load(), h.energy.load(),
      h.energy_kept.load(), h.flights.load(), h.driven.load());
  std::multimap<long, std::string, std::greater<>> by_count;
  for (const auto &[sentence, count] : tally.sentences) by_count.emplace(count, sentence);
  for (const auto &[count, sentence] : by_count) fmt::print("{:6} {}\n", count, sentence);
}

}  // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Random decks from a grammar of commands, run and judged");
  app.add_option("--from", options.from, "first deck");
  app.add_option("--to", options.to, "last deck");
  app.add_option("--jobs", options.jobs, "decks at a time");
  app.add_option("--time-limit", options.time_limit, "seconds for one deck");
  app.add_option("--seconds", options.seconds, "begin no deck after so many seconds");
  app.add_option("--keep", options.keep, "folder for the decks that end wrong");
  app.add_flag("--only-spoilt", options.only_spoilt, "only the decks with a mistake in one line");
  app.add_option("--write", options.only_write,
                 "write the deck --from into this folder, run nothing");
  app.add_option("--lmp", options.program, "program to run instead of the built lmp");
  CLI11_PARSE(app, argc, argv);

  if (!options.only_write.empty()) {
    const Plan plan = make_plan(options.from);
    fs::create_directories(options.only_write);
    write_deck(plan, options.only_write, "in.deck");
    fmt::print("{}/in.deck, for {} rank(s); second setting: {}\n", options.only_write, plan.ranks,
               name_of(plan.twin));
    return 0;
  }
  std::string scratch = (fs::temp_directory_path() / "decks.XXXXXX").string();
  if (!mkdtemp(scratch.data())) {
    fmt::print("cannot make the folder {}\n", scratch);
    return 2;
  }
  std::signal(SIGTERM, [](int) { interrupted = 1; });  // ends with the report of what was run
  Tally tally;
  std::atomic<long> next{options.from};
  std::vector<std::thread> threads;
  for (int k = 0; k < options.jobs; k++)
    threads.emplace_back([&] { work(next, scratch, options, tally); });
  for (std::thread &thread : threads) thread.join();
  fs::remove_all(scratch);
  report(tally);
  return tally.wrong == 0 ? 0 : 1;
}
