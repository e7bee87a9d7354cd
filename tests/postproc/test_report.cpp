// SPDX-License-Identifier: GPL-2.0-or-later
// scripts/report and run from end to end, with a program that stands in for lmp and hands out the
// same small bed at once: what is computed, kept, named when it fails, and what the page holds.
#include <sys/wait.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

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
    for (const char *part : {"scripts", "input", "src_plugin", "postproc"})
      fs::copy(project / part, folder() / part, fs::copy_options::recursive);
    fs::create_directories(folder() / "examples/paper");
    fs::copy(project / "examples/paper/literature.csv", folder() / "examples/paper");
    fs::create_directories(folder() / "build/release");
    for (const char *program : {"rod_packing", "rod_orientation", "rod_plot"})
      write_program(program, fmt::format("exec '{}/{}' \"$@\"\n", programs.string(), program));
    // Small pictures, since they take most of the time. Letters of 8 pixels in the same proportion to
    // them, since ones that are too large for the words are refused.
    write_program("rod_render", fmt::format(R"(size= font= option=
for word; do
  case $option in --size) size=$word ;; --font-size) font=$word ;; esac
  option=$word
done
[ -z "$size" ] || size=$((${{size%x*}} * 8 / font))x$((${{size#*x}} * 8 / font))
for word; do
  shift
  case $option in --size) word=$size ;; --font-size) word=8 ;; esac
  option=$word
  set -- "$@" "$word"
done
exec '{}/rod_render' "$@" --resolution 8
)",
                                            programs.string()));
    write("build/release/libspherocylinder.so", "");

    write("columns", "Step time Atoms energy contacts contacts contacts contacts CPU\n");
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
if [ -e $root/second ] && [ $deck = in.fill ] && [ $lambda = 10 ] && [ ${{limit_fill-1}} = 0 ]; then
  mv $root/second $root/second_report
  (cd $root; scripts/report --no-build --quick 2>second_report; echo "exit code $?" >>second_report)
fi
grep -c , $root/build/report/results/beds.csv >>$root/rows_meanwhile
ls $root/build/cases_quick/*/wall_seconds 2>/dev/null | wc -l >>$root/finished_meanwhile
cp $root/bed.${{deck#in.}} dump.${{deck#in.}}
cat >$log <<LOG
$(cat $root/columns)
 0 0.0 20 0 0 0 0 0.1 0
200000 $total_time.0 20 2.5e-9 6.25 0.001 0.0125 0.2 1.0
Loop time of 1
1 2 3 4 5 6 7 8 9
LOG
touch restart.${{deck#in.}}
)",
                                     folder().string()));
  }

  void write_program(const std::string &name, const std::string &text)
  {
    write("build/release/" + name, "#!/bin/sh\n" + text);
    fs::permissions(folder() / "build/release" / name, fs::perms::owner_all);
  }

  // Where pictures do not matter: programs that only note what is to be drawn.
  void draw_nothing()
  {
    for (const char *program : {"rod_render", "rod_plot"}) {
      fs::rename(folder() / "build/release" / program, folder() / "build" / program);
      write_program(program, fmt::format(R"(echo "$*" >>'{}/{}.calls'
for word; do
  case $word in *.png|*.svg) : >"$word" ;; esac
done
)",
                                         folder().string(), program));
    }
  }

  void draw_again()
  {
    for (const char *program : {"rod_render", "rod_plot"})
      fs::rename(folder() / "build" / program, folder() / "build/release" / program);
  }

  // As a build after a change of sources leaves the programs.
  void build()
  {
    for (const auto &program : fs::directory_iterator(folder() / "build/release"))
      fs::last_write_time(program, fs::file_time_type::clock::now());
  }

  std::vector<int> numbers_in(const std::string &name) const
  {
    std::istringstream text(read(name));
    return {std::istream_iterator<int>(text), {}};
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

  void append(const std::string &name, const std::string &text) { write(name, read(name) + text); }

  // As `sed -i` with these arguments does.
  void edit(const std::string &name, const std::string &arguments)
  {
    ASSERT_EQ(std::system(
                  fmt::format("cd '{}' && sed -i {} {}", folder().string(), arguments, name).c_str()),
              0);
  }

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

  // Figure 1 has five pictures, figure 2 four; none lies outside the page.
  const std::string page = read("build/report/report.html");
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,iVBOR"), 11u);
  EXPECT_EQ(count(page, "src="), 11u);
  // Of 50000 steps a second: the first of figure 1 at 25000, the last at the end.
  EXPECT_EQ(count(page, "\n0.5 s</div>"), 1u);
  EXPECT_EQ(count(page, "\n4 s</div>"), 1u);
  EXPECT_EQ(count(page, "href="), 0u);
  EXPECT_NE(page.find("This is the quick version"), std::string::npos);
  EXPECT_EQ(count(page, "class=\"notice\""), 1u);
  EXPECT_EQ(page.find(folder().string()), std::string::npos);
  EXPECT_EQ(count(page, "<td>6.25</td>"), 12u);  // in the table of means and of every bed
  EXPECT_NE(page.find("<td>0.721 ± 0.001</td>"), std::string::npos);
}

// A bed counts as kept only with the time asked for and with rows in both files, and is measured
// again where the sources of what measures have changed.
TEST_F(Report, KeepsOnlyWhatIsOfThisReport)
{
  draw_nothing();
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  ASSERT_EQ(calls(), 12u);
  const std::string beds = "build/report/results/beds.csv";
  const std::string elevation = "build/report/results/elevation.csv";
  const std::string page = "build/report/report.html";
  const std::string beds_then = read(beds), elevation_then = read(elevation);
  const auto says = [&](const std::string &words) {
    EXPECT_NE(read("out.txt").find(words), std::string::npos) << words << "\n" << read("out.txt");
  };

  // Without any folder of a run: a bed of ten seconds, one without a distribution of elevation.
  fs::rename(folder() / "build/cases_quick", folder() / "build/away");
  edit(beds, "'/^10,none,/s/,4.0,/,10.0,/'");
  edit(elevation, "'/^20,study,/d'");
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  says("report: 1 beds of build/report/results/beds.csv are of another time than 4 s");
  says("report: 6 beds, 4 of them kept");
  EXPECT_EQ(calls(), 16u) << read("calls");
  EXPECT_EQ(count(read(beds), ",4.0,"), 6u) << read(beds);
  EXPECT_EQ(count(read(elevation), "\n"), 1u + 6u * 12u);

  // What a run by hand leaves beside the decks is none of them.
  write("input/in.case", "variable lambda index 30\n");
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(read("out.txt").find("other decks"), std::string::npos) << read("out.txt");

  // Other decks and other programs: both are said, here and on the page, and nothing is computed.
  fs::remove_all(folder() / "build/cases_quick");
  append("input/in.contact", "# another deck\n");
  append("src_plugin/core/near_pairs.cpp", "// another program\n");
  build();
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(calls(), 16u);
  for (const char *words : {"6 of the 6 beds were made with other decks or another plug-in",
                            "6 of the 6 beds were measured by other programs"}) {
    says(words);
    EXPECT_EQ(count(read(page), words), 1u) << words;
    EXPECT_LT(read(page).find(words), read(page).find("<h2>"));
  }

  // With the folders, the beds are measured again and keep what they were made from; so does a
  // file from before a column was added, and lost rows come back.
  fs::remove_all(folder() / "build/cases_quick");
  fs::rename(folder() / "build/away", folder() / "build/cases_quick");
  const std::string beds_now = read(beds);
  edit(beds, "'1s/,sources,/,made_from,/'");
  EXPECT_EQ(run("--quick"), 1);
  EXPECT_EQ(read("error.txt"), "report: build/report/results/beds.csv has no column sources\n");
  write(beds, beds_now);
  edit(beds, "'s/,[^,]*$//'");
  fs::remove(folder() / elevation);
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(calls(), 16u);
  says("report: 6 beds measured again from their dumps in build/cases_quick");
  says("6 of the 6 beds were made with other decks");
  EXPECT_EQ(read("out.txt").find("measured by other programs"), std::string::npos);
  EXPECT_EQ(read(elevation).size(), elevation_then.size());
  // In any order, which is that of the runs' ends.
  const auto rows_without_last_column = [](const std::string &text) {
    std::multiset<std::string> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) rows.insert(line.substr(0, line.rfind(',')));
    return rows;
  };
  EXPECT_NE(read(beds), beds_then);
  EXPECT_EQ(rows_without_last_column(read(beds)), rows_without_last_column(beds_then));
}

// Both beds of figure 2 at one scale, whole and cut.
TEST_F(Report, PicturesOfTheBedsMatch)
{
  draw_nothing();
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  const auto options_of = [&](const std::string &picture) {
    const std::string all = read("rod_render.calls");
    const std::size_t end = all.find("/" + picture + " ");
    if (end == std::string::npos) return "no " + picture;
    const std::size_t begin = all.find(' ', all.rfind('\n', end) + 1);
    return all.substr(begin, all.find(" --out ", begin) - begin);
  };
  const std::string whole = options_of("figure2_limits_none.png");
  EXPECT_NE(whole.find(" --top "), std::string::npos) << whole;
  EXPECT_EQ(options_of("figure2_limits_study.png"), whole);
  EXPECT_EQ(options_of("figure2_limits_none_cut.png"), whole + " --cut --view side");
  EXPECT_EQ(options_of("figure2_limits_study_cut.png"), whole + " --cut --view side");

  // Pictures of other options are drawn again from the dumps; without those, that is said.
  const std::size_t drawn = count(read("rod_render.calls"), "\n");
  EXPECT_EQ(drawn, 9u);
  edit("scripts/report", "'s/^bed_top=0.8/bed_top=0.6/'");
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(count(read("rod_render.calls"), "\n"), 2 * drawn);
  append("postproc/analysis/rods.cpp", "// another program\n");
  build();
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(count(read("rod_render.calls"), "\n"), 3 * drawn);
  fs::remove_all(folder() / "build/cases_quick");
  edit("scripts/report", "'s/^bed_top=0.6/bed_top=0.8/'");
  ASSERT_EQ(run("--quick"), 0) << read("error.txt");
  EXPECT_EQ(count(read("rod_render.calls"), "\n"), 3 * drawn);
  EXPECT_EQ(count(read("build/report/report.html"), "were drawn by another rod_render"), 2u);
}

// Anew means these beds, one after the other: what is kept of them stays until they are done, of
// others for good.
TEST_F(Report, FreshReplacesOneByOne)
{
  draw_nothing();
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  const std::string beds = "build/report/results/beds.csv";
  const fs::path cases = folder() / "build/cases_quick";
  edit(beds, "'$ {p; s/^[^,]*,[^,]*,[^,]*,/10,none,49979687,/}'");
  edit(beds, "'s/,6.25,/,5.25,/'");
  fs::copy(cases / "lambda10_limits_none_seed86028121",
           cases / "lambda10_limits_none_seed49979687");
  fs::remove(folder() / "rows_meanwhile");
  fs::remove(folder() / "finished_meanwhile");

  write("broken", "");
  EXPECT_EQ(run("--quick --fresh --jobs 3"), 1);
  EXPECT_NE(read("out.txt").find("report: 6 beds, 0 of them kept"), std::string::npos);
  EXPECT_EQ(calls(), 12u + 11u) << read("calls");
  // The header and seven beds, of which five are made anew: not those that failed or were not asked
  // for.
  EXPECT_EQ(count(read(beds), "\n"), 8u) << read(beds);
  EXPECT_EQ(count(read(beds), ",6.25,"), 5u) << read(beds);
  EXPECT_EQ(count(read(beds), "20,none,86028121,"), 1u) << read(beds);
  EXPECT_TRUE(fs::exists(cases / "lambda10_limits_none_seed49979687/wall_seconds"));
  // Of seven finished runs no more than three, those under way, are ever gone, and of the rows none.
  const auto rows = numbers_in("rows_meanwhile"), finished = numbers_in("finished_meanwhile");
  ASSERT_EQ(rows.size(), 10u);
  EXPECT_EQ(*std::min_element(rows.begin(), rows.end()), 8);
  ASSERT_EQ(finished.size(), 10u);
  EXPECT_GE(*std::min_element(finished.begin(), finished.end()), 3);
}

// Two at once would remove each other's runs.
TEST_F(Report, OneAtATime)
{
  draw_nothing();
  write("second", "");
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  EXPECT_EQ(read("second_report"),
            "report: another report works in build/cases_quick: wait until it has ended\n"
            "exit code 2\n");
  EXPECT_EQ(calls(), 12u) << read("calls");
}

// A program that is older than what it is made of is not used.
TEST_F(Report, ProgramsOfTheSources)
{
  const auto refused = [&](const std::string &source, const std::string &program) {
    build();
    const fs::path file = folder() / source;
    const auto time_then = fs::last_write_time(file);
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(1));
    EXPECT_EQ(run("--quick"), 2) << source;
    EXPECT_EQ(read("error.txt"),
              fmt::format("report: --no-build: {} is newer than build/release/{}: leave out "
                          "--no-build, or touch the program if it was built from it\n",
                          source, program));
    fs::last_write_time(file, time_then);
  };
  refused("src_plugin/styles/balance.cpp", "libspherocylinder.so");
  refused("src_plugin/core/near_pairs.cpp", "libspherocylinder.so");
  refused("src_plugin/loader/lmp.cpp", "lmp");
  refused("postproc/analysis/rods.cpp", "rod_packing");
  refused("postproc/tools/rod_orientation.cpp", "rod_orientation");
  refused("postproc/pictures/film.cpp", "rod_render");
  refused("postproc/figures/figure.cpp", "rod_plot");

  // The plug-in built anew, the others not.
  const fs::path core = folder() / "src_plugin/core/near_pairs.cpp";
  build();
  const auto later = fs::file_time_type::clock::now() + std::chrono::seconds(1);
  fs::last_write_time(core, later);
  fs::last_write_time(folder() / "build/release/libspherocylinder.so", later);
  EXPECT_EQ(run("--quick"), 2);
  EXPECT_EQ(count(read("error.txt"), "near_pairs.cpp is newer than build/release/rod_packing:"), 1u);
  EXPECT_FALSE(fs::exists(folder() / "calls"));
}

// What the page gives as commands is run as it stands.
TEST_F(Report, CommandsOfThePage)
{
  draw_nothing();
  ASSERT_EQ(run("--quick --jobs 6"), 0) << read("error.txt");
  const std::string page = read("build/report/report.html");
  const std::size_t begin = page.find("<pre>") + 5;
  std::string commands = page.substr(begin, page.find("</pre>") - begin);
  ASSERT_EQ(commands.find('&'), std::string::npos) << commands;  // as typed: nothing escaped
  write("scripts/pasted", "#!/bin/sh\nset -e\n" + commands);
  fs::permissions(folder() / "scripts/pasted", fs::perms::owner_all);
  draw_again();
  ASSERT_EQ(run_script("pasted"), 0) << read("error.txt");
  EXPECT_NE(read("calls").find("in.settle 30 0 86028121 4\n", 12 * 20), std::string::npos);
  for (const char *file :
       {"packing.csv", "orientation.csv", "order.csv", "figure1_1.png", "figure1_5.png",
        "figure2.png", "figure2_cut.png", "figure3.svg", "figure4.svg", "figure3_all.svg",
        "figure4_all.svg"})
    EXPECT_TRUE(fs::exists(folder() / "build/one_bed" / file)) << file;
}

// A log whose columns are others ends with one sentence instead of empty values.
TEST_F(Report, ColumnsOfTheLog)
{
  draw_nothing();
  const auto refused = [&](const std::string &columns, const std::string &words) {
    write("columns", columns + "\n");
    EXPECT_EQ(run("--quick --fresh --jobs 6"), 1) << columns;
    const std::string error = read("error.txt");
    EXPECT_EQ(count(error, "\n"), 1u) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  refused("Step time Atoms power contacts contacts contacts contacts CPU",
          "log.settle has no column energy (its columns are: Step time Atoms power contacts");
  refused("Step time Atoms energy contacts contacts contacts CPU",
          "log.fill has no column contacts:4of4");
  refused("", "log.fill has no table");
}

// Two beds, of V_f 0.3 and 0.4: mean 0.35, standard error of half the difference, 0.05. Only the
// table is made here.
TEST_F(Report, TableOfMeans)
{
  write("beds.csv",
        "lambda,limits,seed,vf_inner,vf_whole,vf_theory,vf_random_contacts,mean_elevation_deg,"
        "nematic_order,contacts_per_rod,largest_overlap_over_diameter,energy_J\n"
        "20,none,1,0.3,0.2,0.2996,0.23,30,-0.1,6,0.01,1e-9\n"
        "20,none,2,0.4,0.2,0.2996,0.24,32,-0.3,6,0.03,3e-9\n");
  ASSERT_EQ(std::system(fmt::format("cd '{}' && bash -c 'chosen=beds.csv; . scripts/lib/html.sh; "
                                    "table_of_means' >table.html",
                                    folder().string())
                            .c_str()),
            0);
  EXPECT_NE(read("table.html").find(
                "<td>20</td><td>none</td><td>2</td><td>0.3500 ± 0.0500</td><td>0.2000 ± 0.0000</td>"
                "<td>0.2996</td><td>0.2350 ± 0.0050</td><td>31.0 ± 1.0</td><td>-0.200 ± 0.100</td>"
                "<td>6.00 ± 0.00</td><td>0.0300</td><td>3.0e-09</td>"),
            std::string::npos)
      << read("table.html");
}

// scripts/run does the same cases, for a table and a picture of each.
TEST_F(Report, RunMakesATable)
{
  write("scripts/setup", "#!/bin/sh\n");
  write("scripts/build", "#!/bin/sh\necho \"$*\" >built\n");
  ASSERT_EQ(run_script("run 10 --out beds --jobs 2"), 0) << read("error.txt");
  // What is used and nothing else, least of all tests.
  EXPECT_EQ(read("built"), "release lmp spherocylinder rod_packing rod_orientation rod_render\n");
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
  refused("--quick --seeds 8", "--quick makes one bed of each kind: it takes no --seeds (got 8)");
  refused("--seeds 8 --quick", "--quick makes one bed of each kind: it takes no --seeds (got 8)");
  refused("--jobs 0", "report: --jobs must be a whole number > 0 (got '0')");
  refused("--out", "report: --out wants a folder");
  refused("--slow", "report: expected an option, see --help (got '--slow')");
  fs::create_directories(folder() / "old/results");
  write("old/results/beds.csv", "lambda,vf\n10,0.3\n");
  refused("--out old", "beds.csv has other columns than this script writes");
  EXPECT_EQ(read("old/results/beds.csv"), "lambda,vf\n10,0.3\n");
  for (const char *program : {"libspherocylinder.so", "rod_plot", "rod_render", "rod_orientation",
                              "rod_packing", "lmp"}) {
    fs::remove(folder() / "build/release" / program);
    refused("", fmt::format("--no-build: build/release/{} is not there", program));
  }
}

}  // namespace
}  // namespace spherocylinder
