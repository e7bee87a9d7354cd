// SPDX-License-Identifier: GPL-2.0-or-later
#include "deck_run.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "../program_folder.h"

namespace decks {

namespace {

// One rank without mpirun: Open MPI would start a daemon and search for networks, which takes
// longer than most decks. Without the daemon all such programs share one session folder and remove
// it from under each other, so each deck has its own.
constexpr const char *kSingleRank =
    "OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_btl=self OMPI_MCA_pml=ob1 "
    "OMPI_MCA_orte_tmpdir_base=$PWD";
// Open MPI refuses root, and more ranks than cores, unless told. Idle ranks leave the core to
// others.
constexpr const char *kManyRanks =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_mpi_yield_when_idle=1 mpirun --oversubscribe --bind-to none";

// In a sanitizer build: LIGGGHTS and Open MPI leave memory behind at their end, which is theirs.
constexpr const char *kSanitizers = "ASAN_OPTIONS=detect_leaks=0";

bool is_integer_column(const std::string &name)
{
  return name == "id" || name == "type" || name == "ix" || name == "iy" || name == "iz";
}

std::string command_for(const std::string &deck, const Launch &launch)
{
  std::string program =
      launch.program == Program::Lmp ? program_to_test(LMP_PROGRAM) : LIGGGHTS_PROGRAM;
  if (launch.program == Program::Preloaded)
    program = fmt::format("env LD_PRELOAD={} {}", program_to_test(SPHEROCYLINDER_LIBRARY), program);
  const std::string start =
      launch.ranks == 1
          // KILL: LIGGGHTS takes SIGTERM as a wish to end the run.
          ? fmt::format("env {} timeout -s KILL {}", kSingleRank, launch.time_limit)
          : fmt::format("env {} --timeout {} -np {}", kManyRanks, launch.time_limit, launch.ranks);
  return fmt::format("{} {} -in {} {}", start, program, deck, launch.arguments);
}

std::vector<std::string> words_of(const std::string &line)
{
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<double> numbers_of(const std::string &line)
{
  std::vector<double> numbers;
  for (const std::string &word : words_of(line)) {
    char *end = nullptr;
    numbers.push_back(strtod(word.c_str(), &end));  // reads nan and inf too
    if (*end != '\0') return {};
  }
  return numbers;
}

}  // namespace

DeckFolder::DeckFolder()
{
  std::string name = (std::filesystem::temp_directory_path() / "deck.XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make the folder " + name);
  path_ = name;
}

DeckFolder::~DeckFolder()
{
  if (testing::Test::HasFailure()) {
    fmt::print("The failed deck is kept in {}\n", path_.string());
    return;
  }
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void DeckFolder::write(const std::string &name, const std::string &text) const
{
  std::ofstream(path_ / name) << text;
}

std::string DeckFolder::read(const std::string &name) const
{
  std::ifstream in(path_ / name);
  return {std::istreambuf_iterator<char>(in), {}};
}

Outcome DeckFolder::run(const std::string &deck, const Launch &launch) const
{
  const std::string command =
      fmt::format("cd {} && {} {} {} > output.{} 2>&1", path_.string(), launch.before, kSanitizers,
                  command_for(deck, launch), deck);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128, read("output." + deck)};
}

double Table::at(size_t row, const std::string &column) const
{
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) throw std::out_of_range("no column " + column);
  return rows.at(row).at(found - columns.begin());
}

bool Table::has(const std::string &column) const
{
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::vector<Snapshot> read_dump(const std::filesystem::path &file)
{
  std::ifstream in(file);
  if (!in) throw std::runtime_error("no dump " + file.string());
  std::vector<Snapshot> snapshots;
  std::string line;
  while (std::getline(in, line)) {
    if (line.rfind("ITEM: TIMESTEP", 0) == 0) {
      snapshots.emplace_back();
      std::getline(in, line);
      snapshots.back().step = std::stol(line);
    } else if (line.rfind("ITEM: ATOMS", 0) == 0 || line.rfind("ITEM: ENTRIES", 0) == 0) {
      const std::vector<std::string> words = words_of(line);
      snapshots.back().atoms.columns.assign(words.begin() + 2, words.end());
    } else if (!snapshots.empty() && !snapshots.back().atoms.columns.empty()) {
      snapshots.back().atoms.rows.push_back(numbers_of(line));
    }
  }
  for (Snapshot &snapshot : snapshots)  // the first column is the id
    std::sort(snapshot.atoms.rows.begin(), snapshot.atoms.rows.end());
  return snapshots;
}

Table read_thermo(const std::string &output)
{
  Table table;
  std::istringstream in(output);
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    const std::vector<std::string> words = words_of(line);
    if (!words.empty() && words[0] == "Step") {
      table = {words, {}};
      inside = true;
    } else if (inside && line.rfind("WARNING", 0) != 0) {  // which may come between rows
      const std::vector<double> numbers = numbers_of(line);
      inside = numbers.size() == table.columns.size();
      if (inside) table.rows.push_back(numbers);
    }
  }
  return table;
}

std::string exact_dump(const std::string &file, long every, const std::string &columns)
{
  std::string format;
  for (const std::string &name : words_of(columns))
    format += is_integer_column(name) ? "%d " : "%.17g ";
  format.pop_back();
  return fmt::format("dump frames all custom {} {} {}\ndump_modify frames format \"{}\"\n", every,
                     file, columns, format);
}

std::string exact_local_dump(const std::string &file, long every, const std::string &compute,
                             int columns)
{
  std::string names, format;
  for (int k = 1; k <= columns; k++) {
    names += fmt::format(" c_{}[{}]", compute, k);
    format += k == 1 ? "%.17g" : " %.17g";
  }
  return fmt::format("dump {0}_rows all local {1} {2}{3}\ndump_modify {0}_rows format \"{4}\"\n",
                     compute, every, file, names, format);
}

}  // namespace decks
