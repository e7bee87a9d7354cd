// SPDX-License-Identifier: GPL-2.0-or-later
// Runs LIGGGHTS on a deck as a user does: a folder, files in it, a program, its output.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace decks {

enum class Program {
  Lmp,        // this project's lmp
  Preloaded,  // the stock liggghts with LD_PRELOAD=libspherocylinder.so
  Stock       // the stock liggghts alone
};

struct Launch {
  Program program = Program::Lmp;
  int ranks = 1;
  // A deck takes a second or two; a program that waits for ever is killed (unit: second).
  int time_limit = 60;
  std::string before = {};     // commands of the shell, each with its ; at the end
  std::string arguments = {};  // further ones of the program
};

struct Outcome {
  int exit_code = -1;
  std::string output;  // standard output and error together
};

// A fresh folder, removed with the object unless the test has failed.
class DeckFolder {
 public:
  DeckFolder();
  ~DeckFolder();
  DeckFolder(const DeckFolder &) = delete;
  DeckFolder &operator=(const DeckFolder &) = delete;

  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }
  void write(const std::string &name, const std::string &text) const;
  std::string read(const std::string &name) const;

  // Runs the program on the deck in this folder and waits for it.
  Outcome run(const std::string &deck, const Launch &launch = {}) const;

 private:
  std::filesystem::path path_;
};

// The columns of a dump or of the thermo output, one row an atom or a line.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  double at(size_t row, const std::string &column) const;
  bool has(const std::string &column) const;
};

// One time step of a dump custom or dump local file, its rows in the order of the first column.
struct Snapshot {
  long step = 0;
  Table atoms;
};

std::vector<Snapshot> read_dump(const std::filesystem::path &file);

// The thermo lines of the last run in a program's output.
Table read_thermo(const std::string &output);

// The two commands of a dump with enough digits to get every bit back. Columns id, type, ix, iy
// and iz are integers, all others real numbers.
std::string exact_dump(const std::string &file, long every, const std::string &columns);

// The same of a compute's local rows: all columns c_<compute>[1] ... of them.
std::string exact_local_dump(const std::string &file, long every, const std::string &compute,
                             int columns);

}  // namespace decks
