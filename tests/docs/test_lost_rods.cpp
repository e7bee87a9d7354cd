// SPDX-License-Identifier: GPL-2.0-or-later
// Stock LIGGGHTS lets atoms that leave a bounded box go without a word. Each deck of the project and
// each deck of the manual asks for an error instead: `thermo_modify lost error`, which a later
// thermo_style would undo, holds at every run.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "manual_page.h"

namespace fs = std::filesystem;

namespace docs {

namespace {

std::string read(const fs::path &file)
{
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

using Files = std::map<std::string, std::string>;  // name, text

Files files_of(const std::vector<fs::path> &folders)
{
  Files files;
  for (const fs::path &folder : folders)
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.is_regular_file()) files[entry.path().filename()] = read(entry.path());
  return files;
}

// Words of each command, those of included files in their place; lines that end in & are one.
std::vector<std::vector<std::string>> commands_of(const std::string &text, const Files &files)
{
  std::vector<std::vector<std::string>> commands;
  std::istringstream lines(text);
  std::vector<std::string> words;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream parts(line.substr(0, line.find('#')));
    words.insert(words.end(), std::istream_iterator<std::string>(parts), {});
    if (words.empty()) continue;
    if (words.back() == "&") {
      words.pop_back();
      continue;
    }
    const bool includes = words[0] == "include" && words.size() > 1;
    const auto included = includes ? files.find(words[1]) : files.end();
    if (included == files.end()) {
      commands.push_back(words);
    } else {
      const auto inner = commands_of(included->second, files);
      commands.insert(commands.end(), inner.begin(), inner.end());
    }
    words.clear();
  }
  return commands;
}

struct Runs {
  int all = 0, unguarded = 0;
};

Runs runs_of(const std::string &text, const Files &files)
{
  Runs runs;
  bool guarded = false;
  for (const auto &words : commands_of(text, files)) {
    if (words[0] == "thermo_style" || words[0] == "clear") guarded = false;
    if (words[0] == "thermo_modify") {
      const auto lost = std::find(words.begin(), words.end(), "lost");
      if (lost != words.end()) guarded = lost + 1 != words.end() && *(lost + 1) == "error";
    }
    if (words[0] != "run") continue;
    runs.all++;
    if (!guarded) runs.unguarded++;
  }
  return runs;
}

TEST(LostRods, TheRuleFindsThem)
{
  const Files files = {{"log", "thermo_modify norm no lost error\n"}};
  EXPECT_EQ(runs_of("include log\nrun 1\n", files).unguarded, 0);
  EXPECT_EQ(runs_of("run 1\ninclude log\n", files).unguarded, 1);
  EXPECT_EQ(runs_of("include log\nthermo_style custom &\n  step\nrun 1\n", files).unguarded, 1);
  EXPECT_EQ(runs_of("include log\nclear\nrun 1\n", files).unguarded, 1);
  EXPECT_EQ(runs_of("thermo_modify lost ignore\nrun 1\nrun 1\n", files).unguarded, 2);
}

TEST(LostRods, AreAnErrorInEveryDeck)
{
  const fs::path root = fs::path(DOCS_FOLDER).parent_path();
  const fs::path input = root / "input", scenes = root / "bench/scenes";
  for (const fs::path &folder :
       {input, scenes, root / "examples/mixed", root / "examples/multisphere",
        root / "studies/minimal", root / "studies/speed_accuracy", root / "tests/postproc"}) {
    const Files files = files_of({input, folder});
    for (const auto &entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      // What only ends others: in.contact_bench before it guards the run.
      if (name.rfind("in.", 0) != 0 || name.rfind("in.write_", 0) == 0) continue;
      EXPECT_EQ(runs_of(files.at(name), files).unguarded, 0) << entry.path();
    }
  }
}

TEST(LostRods, AreAnErrorInEveryDeckOfTheManual)
{
  int runs = 0;
  for (const ManualPage &page : read_manual()) {
    int number = 0;
    for (const Block &block : page.blocks) {
      if (block.language != "liggghts" && block.language != "sh") continue;
      number++;
      if (block.language != "liggghts") continue;
      Files files = files_of({INPUT_FOLDER, EXAMPLE_DECKS_FOLDER});
      files["example"] = block.text;
      const std::string own = page.name + "_" + std::to_string(number) + ".in";
      const auto deck = files.count(own) > 0 ? files.find(own) : files.find(page.name + ".in");
      if (deck == files.end()) continue;  // said by the test that runs the example
      const Runs found = runs_of(deck->second, files);
      runs += found.all;
      EXPECT_EQ(found.unguarded, 0) << page.name << ".md, line " << block.line;
    }
  }
  EXPECT_GT(runs, 10);
}

}  // namespace

}  // namespace docs
