// SPDX-License-Identifier: GPL-2.0-or-later
// scripts/report and run from end to end, with a program that stands in for lmp and hands out the
// same small bed at once: what is computed, kept, named when it fails, and what the page holds.
#include <sys/wait.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "scratch_folder.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

namespace fs = std::filesystem;

std::size_t count(const std::string &text, const std::string &words)
{
  std::size_t found = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

class Report : public ScratchFolder {
 protected:
  void SetUp() override
  {
    if (std::system("command -v xvfb-run >/dev/null") != 0) GTEST_SKIP() << "no xvfb-run";
    const fs::path project = PROJECT_FOLDER, programs = PROGRAM_FOLDER;
    for (const char *part : {"scripts", "input", "src_plugin"})
      fs::copy(project / part, folder() / part, fs::copy_options::recursive);
    fs::create_directories(folder() / "examples/paper");
    fs::copy(project / "examples/paper/literature.csv", folder() / "examples/paper");
    fs::create_directories(folder() / "build/release");
    for (const char *program : {"rod_packing", "rod_orientation", "rod_plot"})
      fs::create_symlink(programs / program, folder() / "build/release" / program);
    // Small pictures, since they take most of the time.
    write_program("rod_render", fmt::format(R"(for word; do
  shift
  case $word in *[0-9]x[0-9]*) word=200x200 ;; esac
  set -- "$@" "$word"
done
exec '{}/rod_render' "$@" --resolution 8
)",
                                            programs.string()));
    write("build/release/libspherocylinder.so", "");

    BedOptions options;
    options.rods = 20;
    const auto rods = random_bed(options);
    std::string fill;
    for (const int step : {25000, 50000, 75000, 100000}) fill += dump_text(rods, step);
    write("bed.fill", fill);
    write("bed.settle", dump_text(rods, 200000));
    write_program("lmp", fmt::format(R"(while [ $# -gt 0 ]; do
  case $1 in
    -in) deck=$2; shift ;;
    -log) log=$2; shift ;;
    -var) eval "$2=$3"; shift 2 ;;
  esac
  shift
done
root='{}'
echo "$deck $lambda ${{limit_fill-study}} $seed $total_time" >>$root/calls
if [ -e $root/broken ] && [ $lambda = 20 ] && [ "${{limit_fill-study}}" = 0 ]; then
  echo "ERROR: this one is broken"
  exit 1
fi
cp $root/bed.${{deck#in.}} dump.${{deck#in.}}
echo "200000 4.0 20 2.5e-9 6.25 0.001 0.0125 0.2 1.0" >$log
touch restart.${{deck#in.}}
)",
                                     folder().string()));
  }

  void write_program(const std::string &name, const std::string &text)
  {
    write("build/release/" + name, "#!/bin/sh\n" + text);
    fs::permissions(folder() / "build/release" / name, fs::perms::owner_all);
  }

  // All pictures on one display.
  int run_script(const std::string &command)
  {
    const int status =
        std::system(fmt::format("cd '{}' && xvfb-run -a -s '-screen 0 640x480x24 -noreset' "
                                "sh -c 'exec scripts/{} 2>error.txt' >out.txt",
                                folder().string(), command)
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  int run(const std::string &arguments) { return run_script("report --no-build " + arguments); }

  std::size_t calls() { return count(read("calls"), "\n"); }
};

TEST_F(Report, KeepsWhatIsDoneAndHoldsAll)
{
  // Six cases of two stages each; the second stage of the broken one is not run.
  write("broken", "");
  EXPECT_EQ(run("--quick --jobs 6"), 1);
  EXPECT_EQ(calls(), 11u) << read("calls");
  EXPECT_EQ(count(read("calls"), " 86028121 4\n"), 11u) << read("calls");
  const std::string error = read("error.txt");
  EXPECT_NE(error.find("report: lambda20_limits_none_seed86028121 failed"), std::string::npos);
  EXPECT_NE(error.find("ERROR: this one is broken"), std::string::npos) << error;
  EXPECT_NE(error.find("report: failed: lambda20_limits_none_seed86028121\n"), std::string::npos);
  EXPECT_EQ(count(read("build/report/results/beds.csv"), "\n"), 6u);
  EXPECT_FALSE(fs::exists(folder() / "build/report/report.html"));

  // Only that one is computed now.
  fs::remove(folder() / "broken");
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  EXPECT_EQ(calls(), 13u) << read("calls");
  EXPECT_NE(read("out.txt").find("report: 6 beds, 5 of them kept"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder() / "examples/paper/report.html"));

  // And nothing the third time, not even from the dumps.
  fs::remove_all(folder() / "build/cases_quick");
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(calls(), 13u);
  EXPECT_NE(read("out.txt").find("report: 6 beds, 6 of them kept"), std::string::npos);

  const std::string beds = read("build/report/results/beds.csv");
  EXPECT_EQ(count(beds, "\n"), 7u) << beds;
  EXPECT_EQ(count(beds, ",6.25,0.001,0.0125,0.2,2.5e-9,4.0,"), 6u) << beds;
  const std::string elevation = read("build/report/results/elevation.csv");
  EXPECT_EQ(count(elevation, "\n"), 1u + 6u * 12u);
  for (const char *figure : {"figure3.png", "figure3.svg", "figure4.png", "figure4.svg"})
    EXPECT_TRUE(fs::exists(folder() / "build/report/results" / figure)) << figure;

  // Figure 1 has five pictures, figure 2 two; none lies outside the page.
  const std::string page = read("build/report/report.html");
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,iVBOR"), 9u);
  EXPECT_EQ(count(page, "src="), 9u);
  EXPECT_EQ(count(page, "href="), 0u);
  EXPECT_NE(page.find("This is the quick version"), std::string::npos);
  EXPECT_EQ(page.find(folder().string()), std::string::npos);
  EXPECT_EQ(count(page, "<td>6.25</td>"), 12u);  // in the table of means and of every bed
  EXPECT_NE(page.find("<td>0.721 ± 0.001</td>"), std::string::npos);
}

// Two beds, of V_f 0.3 and 0.4: mean 0.35, standard error of half the difference, 0.05. Only the
// table is made here.
TEST_F(Report, TableOfMeans)
{
  write("beds.csv",
        "lambda,limits,seed,vf_inner,vf_whole,vf_theory,mean_sin_gamma,mean_elevation_deg,"
        "nematic_order,contacts_per_rod,largest_overlap_over_diameter,energy_J\n"
        "20,none,1,0.3,0.2,0.2996,0.785398163,30,-0.1,6,0.01,1e-9\n"
        "20,none,2,0.4,0.2,0.2996,0.785398163,32,-0.3,6,0.03,3e-9\n");
  ASSERT_EQ(std::system(fmt::format("cd '{}' && bash -c 'chosen=beds.csv; . scripts/lib/html.sh; "
                                    "table_of_means' >table.html",
                                    folder().string())
                            .c_str()),
            0);
  // Random contacts at lambda = 20 for isotropic rods: 0.2348 (test_figures.cpp).
  EXPECT_NE(read("table.html").find(
                "<td>20</td><td>none</td><td>2</td><td>0.3500 ± 0.0500</td><td>0.2000 ± 0.0000</td>"
                "<td>0.2996</td><td>0.2348</td><td>31.0 ± 1.0</td><td>-0.200 ± 0.100</td>"
                "<td>6.00 ± 0.00</td><td>0.0300</td><td>3.0e-09</td>"),
            std::string::npos)
      << read("table.html");
}

// scripts/run does the same cases, for a table and a picture of each.
TEST_F(Report, RunMakesATable)
{
  for (const char *script : {"scripts/setup", "scripts/build"}) write(script, "#!/bin/sh\n");
  ASSERT_EQ(run_script("run 10 --out beds --jobs 2"), 0) << read("error.txt");
  EXPECT_EQ(calls(), 4u);
  const std::string summary = read("beds/summary.csv");
  EXPECT_EQ(count(summary, "\n"), 3u) << summary;
  EXPECT_EQ(count(summary, "\n10,study,86028121,"), 1u) << summary;
  EXPECT_EQ(count(summary, "\n10,none,86028121,"), 1u) << summary;
  EXPECT_EQ(count(read("out.txt"), " 6.25 "), 2u) << read("out.txt");
  EXPECT_TRUE(fs::exists(folder() / "beds/lambda10_limits_none_seed86028121/bed.png"));
  EXPECT_EQ(count(read("calls"), " 86028121 10\n"), 4u) << read("calls");
}

TEST_F(Report, WrongOptions)
{
  const auto refused = [&](const std::string &arguments, const std::string &words) {
    EXPECT_EQ(run(arguments), 2) << arguments;
    const std::string error = read("error.txt");
    EXPECT_EQ(count(error, "\n"), 1u) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  refused("--seeds 3", "report: --seeds must be 5 to 10 (got '3')");
  refused("--jobs 0", "report: --jobs must be a whole number > 0 (got '0')");
  refused("--out", "report: --out wants a folder");
  refused("--slow", "report: expected an option, see --help (got '--slow')");
  fs::create_directories(folder() / "old/results");
  write("old/results/beds.csv", "lambda,vf\n");
  refused("--out old", "beds.csv has other columns than this script writes");
  fs::remove(folder() / "build/release/rod_plot");
  refused("", "--no-build: build/release/rod_plot is not there");
}

}  // namespace
}  // namespace spherocylinder
