// SPDX-License-Identifier: GPL-2.0-or-later
// Each runnable block of a page (```liggghts or ```sh) is written to a file `example` in a fresh
// folder, beside the files of tests/docs/decks and input/, and run by the page's own surroundings:
//   decks/<page>.in   a deck with `include example` in its right place, run by lmp, or
//   decks/<page>.sh   a shell script with `. ./example`
// (or <page>_<number>.in for one example that needs others). It passes if the program ends with exit code 0.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "../program_folder.h"
#include "manual_page.h"

namespace fs = std::filesystem;

namespace docs {

namespace {

// One rank starts without Open MPI's daemon, in a session folder of its own; the others: root, and
// more ranks than cores, allowed.
constexpr const char *kEnvironment =
    "OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_tmpdir_base=$PWD "
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 "
    "OMPI_MCA_btl=self,vader OMPI_MCA_pml=ob1";
constexpr int kTimeLimit = 30;  // of one example (unit: second)

bool is_runnable(const Block &block)
{
  return block.language == "liggghts" || block.language == "sh";
}

bool is_of_a_tool(const ManualPage &page)
{
  return page.name.rfind("rod_", 0) == 0 || page.name == "rods_to_multisphere" ||
         page.name == "multisphere_to_rods" || page.name == "place_rods";
}

bool is_of_a_style(const ManualPage &page)
{
  return page.name != "README" && page.name != "with_liggghts" && page.name != "from_multisphere" &&
         page.name != "architecture" && page.name != "cluster" && !is_of_a_tool(page);
}

std::vector<ManualPage> style_pages()
{
  std::vector<ManualPage> pages;
  for (const ManualPage &page : read_manual())
    if (is_of_a_style(page)) pages.push_back(page);
  return pages;
}

struct Example {
  std::string page;
  int number;  // on its page, from 1
  Block block;
};

// What GoogleTest and CTest show beside a test's name.
void PrintTo(const Example &example, std::ostream *out)
{
  *out << example.page << ".md, line " << example.block.line;
}

std::vector<Example> all_examples()
{
  std::vector<Example> examples;
  for (const ManualPage &page : read_manual()) {
    if (is_of_a_tool(page)) continue;  // run by tests/postproc
    int number = 0;
    for (const Block &block : page.blocks)
      if (is_runnable(block)) examples.push_back({page.name, ++number, block});
  }
  return examples;
}

std::string read(const fs::path &file)
{
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path fresh_folder()
{
  std::string name = (fs::temp_directory_path() / "example.XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make the folder " + name);
  return name;
}

class ManualExample : public testing::TestWithParam<Example> {};

TEST_P(ManualExample, Runs)
{
  const Example &example = GetParam();
  const fs::path folder = fresh_folder();
  fs::copy(INPUT_FOLDER, folder);
  fs::copy(EXAMPLE_DECKS_FOLDER, folder);
  std::ofstream(folder / "example") << example.block.text;

  const bool is_deck = example.block.language == "liggghts";
  const std::string ending = is_deck ? ".in" : ".sh";
  const std::string own = example.page + "_" + std::to_string(example.number) + ending;
  const std::string surroundings = fs::exists(folder / own) ? own : example.page + ending;
  ASSERT_TRUE(fs::exists(folder / surroundings))
      << "tests/docs/decks wants a file " << surroundings << " for the examples of this page";
  const std::string program = is_deck ? program_to_test(LMP_PROGRAM) + " -in " + surroundings
                                      : "LMP=" + program_to_test(LMP_PROGRAM) +
                                            " LIBRARY=" + program_to_test(SPHEROCYLINDER_LIBRARY) +
                                            " PROJECT=" DOCS_FOLDER "/.. sh -e " + surroundings;
  const std::string command = "cd " + folder.string() + " && export " + kEnvironment +
                              " && timeout " + std::to_string(kTimeLimit) +
                              (is_deck ? " " : " env ") + program + " > output 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
      << "docs/" << example.page << ".md, line " << example.block.line << ":\n"
      << example.block.text << "\n"
      << read(folder / "output");
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(, ManualExample, testing::ValuesIn(all_examples()),
                         [](const testing::TestParamInfo<Example> &info) {
                           return info.param.page + "_" + std::to_string(info.param.number);
                         });

std::string page_name(const testing::TestParamInfo<ManualPage> &info) { return info.param.name; }

class StylePage : public testing::TestWithParam<ManualPage> {};
class AnyPage : public testing::TestWithParam<ManualPage> {};

// LIGGGHTS's headings in LIGGGHTS's order; which of the two about output depends on the style.
TEST_P(StylePage, HasTheHeadingsOfLiggghts)
{
  const ManualPage &page = GetParam();
  std::vector<std::string> wanted = {"Syntax", "Examples", "Description"};
  if (page.name.rfind("compute_", 0) == 0)
    wanted.push_back("Output info");
  else if (page.name.rfind("fix_", 0) == 0)
    wanted.push_back("Restart, fix_modify, output, run start/stop, minimize info");
  else if (page.name != "decks" && page.name != "programs_lmp")
    wanted.push_back("Restart");
  wanted.insert(wanted.end(), {"Restrictions", "Related commands", "Default"});
  EXPECT_EQ(page.headings, wanted);
}

TEST_P(StylePage, ExamplesCanBeRun)
{
  const ManualPage &page = GetParam();
  int examples = 0;
  for (const Block &block : page.blocks) {
    if (block.heading != "Examples") continue;
    EXPECT_TRUE(is_runnable(block)) << "line " << block.line << ": mark it liggghts or sh";
    examples++;
  }
  EXPECT_GT(examples, 0);
}

TEST_P(AnyPage, LinksLeadSomewhere)
{
  for (const std::string &link : GetParam().links) {
    const size_t hash = link.find('#');
    const std::string file = link.substr(0, hash);
    const fs::path target = fs::path(DOCS_FOLDER) / (file.empty() ? GetParam().name + ".md" : file);
    ASSERT_TRUE(fs::exists(target)) << link;
    if (hash == std::string::npos) continue;
    const std::vector<std::string> anchors = read_page(target).anchors;
    EXPECT_NE(std::find(anchors.begin(), anchors.end(), link.substr(hash + 1)), anchors.end())
        << link;
  }
}

// The README and those of other folders: pages, pictures and folders they point at.
TEST(ReadMe, LinksLeadSomewhere)
{
  const fs::path root = fs::path(DOCS_FOLDER).parent_path();
  for (const char *name :
       {"README.md", "tests/README.md", "studies/README.md", "studies/packing/README.md"}) {
    const fs::path file = root / name;
    ASSERT_TRUE(fs::exists(file)) << file;
    for (const std::string &link : read_page(file).links)
      EXPECT_TRUE(fs::exists(file.parent_path() / link.substr(0, link.find('#'))))
          << name << ": " << link;
  }
}

INSTANTIATE_TEST_SUITE_P(, StylePage, testing::ValuesIn(style_pages()), page_name);
INSTANTIATE_TEST_SUITE_P(, AnyPage, testing::ValuesIn(read_manual()), page_name);

}  // namespace

}  // namespace docs
