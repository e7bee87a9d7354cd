// SPDX-License-Identifier: GPL-2.0-or-later
// The programs from end to end: what they print, write and return.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "../program_folder.h"
#include "fibre_frames.h"
#include "meshes.h"
#include "page_examples.h"
#include "scratch_folder.h"
#include "test_bed.h"

namespace spherocylinder {
namespace {

const std::string kPrograms = program_folder(PROGRAM_FOLDER);
const std::string kDocs = DOCS_FOLDER;
const std::string kTests = POSTPROC_TESTS_FOLDER;

// The first row of a CSV file by column.
std::map<std::string, double> csv_row(const std::string &text)
{
  std::istringstream lines(text);
  std::string names, row, name, field;
  std::getline(lines, names);
  std::getline(lines, row);
  std::istringstream name_fields(names), row_fields(row);
  std::map<std::string, double> values;
  while (std::getline(name_fields, name, ',')) {
    std::getline(row_fields, field, ',');
    values[name] = field.empty() ? NAN : std::stod(field);
  }
  return values;
}

std::vector<std::map<std::string, double>> csv_rows(const std::string &text)
{
  const std::size_t header = text.find('\n') + 1;
  std::vector<std::map<std::string, double>> rows;
  for (std::size_t at = header; at < text.size(); at = text.find('\n', at) + 1)
    rows.push_back(csv_row(text.substr(0, header) + text.substr(at)));
  return rows;
}

std::size_t count_lines(const std::string &text)
{
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class Programs : public ScratchFolder {
 protected:
  void SetUp() override
  {
    BedOptions options;
    options.rods = 30;
    options.length = 0.3;
    options.vessel_radius = 0.305;
    const auto rods = random_bed(options);
    bed_ = dump_text(rods, 1000);
    write("bed.dump", bed_);
    write("drum.dump", bed_);
    write("vessel.stl", stl_text(cone_mesh(0.305, 0.305, 0.0, 0.5, 60)));
    for (const int step : {0, 500, 1000})
      write(fmt::format("blade_{}.stl", step),
            stl_text(box_mesh({-0.2, 0.2, -0.01, 0.01, 0.3 + 1e-4 * step, 0.35 + 1e-4 * step})));
    for (const char *name : {"seed1.dump", "seed2.dump", "seed3.dump"}) {
      options.seed += 2;
      write(name, dump_text(random_bed(options), 1000));
    }
    write("fibres.dump", fibres().dump());
    write("pour.dump", dump_text({}, 0) + dump_text({rods.begin(), rods.begin() + 10}, 500) + bed_);
  }

  // An arc of ten segments, one in line beside it of four, a ring of twelve and a rod.
  static FibreBed fibres()
  {
    FibreBed bed;
    std::vector<Vec3> circle;
    for (int k = 0; k <= 12; k++)
      circle.push_back(
          {0.15 + 0.05 * std::cos(k * M_PI / 6), 0.1 + 0.05 * std::sin(k * M_PI / 6), 0.01});
    bed.add_chain(1, points_on_arc({-0.1, 0.0, 0.01}, 0.04, 10, 0.1), 0.005);
    bed.add_chain(2, points_in_line({-0.1, 0.05, 0.00499}, {1.0, 0.0, 0.0}, 0.04, 4), 0.005);
    bed.add_chain(3, circle, 0.005);
    bed.add({{{0.0, -0.1, 0.01}, {1.0, 0.0, 0.0}, 0.05}, 0.005});
    return bed;
  }

  // Runs in the test's folder; standard output and error end up in `out` and `error`.
  int run(const std::string &command)
  {
    const int status =
        std::system(fmt::format("cd '{}' && PATH='{}':\"$PATH\" {} >out.txt 2>error.txt",
                                folder().string(), kPrograms, command)
                        .c_str());
    out_ = read("out.txt");
    error_ = read("error.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // All files of the test's folder but those that `run` writes.
  std::map<std::string, std::string> files() const
  {
    std::map<std::string, std::string> found;
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder()))
      if (entry.is_regular_file())
        found[entry.path()] = read(entry.path().lexically_relative(folder()));
    found.erase(folder() / "out.txt");
    found.erase(folder() / "error.txt");
    return found;
  }

  // Exit code 2 and a single sentence, headed by the program's name, that holds `words`.
  void expect_sentence(const std::string &command, const std::string &words)
  {
    EXPECT_EQ(run(command), 2) << command;
    EXPECT_EQ(count_lines(error_), 1u) << error_;
    EXPECT_EQ(error_.find(command.substr(0, command.find(' ')) + ": "), 0u) << error_;
    EXPECT_NE(error_.find(words), std::string::npos) << error_;
  }

  // And no file is there that was not, and none has changed.
  void expect_failure(const std::string &command, const std::string &words)
  {
    const auto before = files();
    expect_sentence(command, words);
    EXPECT_TRUE(files() == before) << command;
  }

  // The same before anything was measured.
  void expect_refusal(const std::string &command, const std::string &words)
  {
    expect_failure(command, words);
    EXPECT_EQ(out_, "") << command;
  }

  // A heap at rest, poured by the deck in.heap: heap.dump, heap.pairs and heap.walls.
  void pour_heap()
  {
    std::filesystem::create_directory(folder() / "mpi");
    ASSERT_EQ(
        run("env OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_tmpdir_base=$PWD/mpi lmp -in '" +
            kTests + "/in.heap'"),
        0)
        << out_ << error_;
  }

  // The same fractions and volumes within `tolerance` of them.
  void expect_same_packing(const std::string &a, const std::string &b, double tolerance)
  {
    auto first = csv_row(read(a)), second = csv_row(read(b));
    EXPECT_EQ(read(a).substr(0, read(a).find('\n')), read(b).substr(0, read(b).find('\n')));
    for (const std::string name :
         {"rods", "z_top_m", "rods_volume_m3", "whole_volume_m3", "vf_whole", "vf_whole_net",
          "vf_whole_clipped", "inner_bottom_m", "inner_top_m", "inner_volume_m3", "vf_inner",
          "vf_inner_net", "bulk_margin_m", "bulk_volume_m3", "vf_bulk", "vf_bulk_net"}) {
      if (std::isnan(first[name]))
        EXPECT_TRUE(std::isnan(second[name])) << name;
      else
        EXPECT_NEAR(first[name], second[name], tolerance * (std::abs(first[name]) + 1e-9)) << name;
    }
  }

  bool can_render() { return run("command -v xvfb-run") == 0 || std::getenv("DISPLAY"); }

  // Width and height in a PNG file's header (RFC 2083, 11.2.1).
  std::pair<int, int> png_size(const std::string &name)
  {
    const std::string bytes = read(name);
    if (bytes.substr(0, 8) != "\x89PNG\r\n\x1a\n") return {0, 0};
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = 0; i < 4; i++)
        value = 256 * value + static_cast<unsigned char>(bytes[at + i]);
      return value;
    };
    return {number(16), number(20)};
  }

  void expect_examples_run(const std::string &page)
  {
    const auto commands = examples_of_page(kDocs + "/" + page, "rod_");
    EXPECT_GE(commands.size(), 2u);
    for (const std::string &command : commands) {
      EXPECT_EQ(run(command), 0) << command << "\n" << error_;
      const bool lacks_ffmpeg = error_.find("ffmpeg is not installed") != std::string::npos &&
                                command.find("--film") != std::string::npos;
      EXPECT_TRUE(error_.empty() || lacks_ffmpeg) << command << "\n" << error_;
    }
  }

  std::string bed_, out_, error_;
};

TEST_F(Programs, HelpShowsAnExample)
{
  for (const std::string program :
       {"rod_packing", "rod_orientation", "rod_contacts", "rod_vtk", "rod_render"}) {
    EXPECT_EQ(run(program + " --help"), 0);
    EXPECT_NE(out_.find("Example: " + program + " "), std::string::npos) << out_;
    EXPECT_EQ(error_, "");
  }
}

TEST_F(Programs, ExamplesOfThePages)
{
  expect_examples_run("rod_packing.md");
  expect_examples_run("rod_orientation.md");
  pour_heap();
  expect_examples_run("rod_contacts.md");
  expect_examples_run("rod_vtk.md");
}

TEST_F(Programs, ExamplesOfThePictures)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  expect_examples_run("rod_render.md");
  EXPECT_EQ(png_size("bed.png"), (std::pair{1200, 900}));
  EXPECT_EQ(png_size("speed.png"), (std::pair{800, 600}));
  // Steps 500 and 1000 of pour.dump; step 0 has no rods.
  EXPECT_EQ(png_size("pour_0001.png"), (std::pair{400, 600}));
  EXPECT_EQ(png_size("pour_0002.png"), (std::pair{400, 600}));
  EXPECT_FALSE(std::filesystem::exists(folder() / "pour_0003.png"));
  EXPECT_EQ(png_size("heap_0002.png"), (std::pair{400, 300}));
  EXPECT_EQ(png_size("drum.png"), (std::pair{400, 300}));
}

// One standing rod of radius r, half cylinder length h, centre at height z in a vessel of radius R.
TEST_F(Programs, PackingOfOneRod)
{
  const double pi = std::acos(-1.0), r = 0.01, h = 0.09, z = 0.2, R = 0.1;
  write("one.dump", dump_text({{1, 1, {{{0, 0, z}, {0, 0, 1}, h}, r}}}, 5));
  ASSERT_EQ(run("rod_packing one.dump --vessel-radius 0.1 --csv one.csv --tolerance 1e-6"), 0);
  auto row = csv_row(read("one.csv"));
  EXPECT_EQ(row["step"], 5);
  EXPECT_EQ(row["rods"], 1);
  EXPECT_NEAR(row["lambda_mean"], 10, 1e-9);
  EXPECT_NEAR(row["mean_elevation_deg"], 90, 1e-9);
  EXPECT_NEAR(row["z_top_m"], z, 1e-12);
  EXPECT_NEAR(row["highest_point_m"], 0.3, 1e-12);
  const double whole = pi * R * R * z, half_sphere = 2.0 / 3.0 * pi * r * r * r;
  EXPECT_NEAR(row["vf_whole"], (pi * r * r * 2 * h + 2 * half_sphere) / whole, 1e-9);
  // Clipped at the rod's own centre: half of it is left.
  EXPECT_NEAR(row["vf_whole_clipped"], (pi * r * r * h + half_sphere) / whole,
              row["vf_whole_clipped_integration_error"] + 1e-9);
  // The inner cylinder ends at mid-height plus half of 2^(-1/3) z, below the rod's centre; the
  // rod's lower round end lies in it if its bottom is low enough, as here.
  EXPECT_NEAR(row["inner_top_m"], 0.1 + 0.1 * std::cbrt(0.5), 1e-9);
  EXPECT_NEAR(row["inner_volume_m3"], whole / 2, 1e-12);
  EXPECT_NEAR(row["vf_inner"],
              (pi * r * r * (row["inner_top_m"] - (z - h)) + half_sphere) / (whole / 2),
              row["vf_inner_integration_error"] + 1e-9);
  EXPECT_NEAR(row["vf_parkhouse_kelly"], 0.4605, 5e-5);
  EXPECT_TRUE(std::isnan(row["mean_sin_gamma"]));  // takes two rods
}

// One, two, three and more threads than there are processors: what is printed and written has the same bits.
TEST_F(Programs, ThreadsChangeNothing)
{
  BedOptions options;
  options.rods = 300;
  options.length = 0.3;
  options.vessel_radius = 0.305;
  const auto rods = random_bed(options);
  write("many.dump", dump_text({rods.begin(), rods.begin() + 100}, 0) + dump_text(rods, 500));
  std::vector<std::string> commands = {
      "rod_packing many.dump --vessel-radius 0.305 --frame all --csv out.csv --profiles out",
      "rod_packing many.dump --vessel vessel.stl --region -0.1 0.1 -0.1 0.1 0 0.2 --csv out.csv",
      "rod_orientation many.dump --vessel-radius 0.305 --csv out.csv --summary-csv out_sum.csv "
      "--wall-csv out_wall.csv",
      "rod_contacts many.dump --vessel-radius 0.305 --csv out.csv --tables out --contacts-csv "
      "out_contacts.csv"};
  if (can_render())
    commands.push_back("rod_render many.dump --vessel-radius 0.305 --size 400x300 --out out.png");
  for (const std::string &command : commands) {
    std::map<std::string, std::string> one;
    for (const int threads : {1, 2, 3, 8}) {
      ASSERT_EQ(run(fmt::format("env OMP_NUM_THREADS={} {}", threads, command)), 0) << error_;
      std::map<std::string, std::string> now = files();
      now["printed"] = out_;
      if (threads == 1) one = now;
      EXPECT_TRUE(now == one) << threads << " threads: " << command;
    }
  }
}

TEST_F(Programs, ThreadsThatCannotBeMeant)
{
  for (const std::string wrong : {"0", "-1", "two", "1.5", "1025"}) {
    EXPECT_EQ(run("env OMP_NUM_THREADS=" + wrong + " rod_packing bed.dump --floor 0"), 2);
    EXPECT_EQ(error_, "rod_packing: OMP_NUM_THREADS must be a whole number from 1 to 1024 (got '" +
                          wrong + "')\n");
  }
}

TEST_F(Programs, PackingOfAllFramesLeavesOutTheEmptyOne)
{
  ASSERT_EQ(run("rod_packing pour.dump --vessel-radius 0.305 --frame all --csv all.csv"), 0);
  EXPECT_EQ(count_lines(read("all.csv")), 3u);  // header, steps 500 and 1000
  EXPECT_EQ(csv_row(read("all.csv"))["step"], 500);
}

// Two rods across each other in a box of 0.4 m x 0.2 m with walls, the upper one's centre 0.1 m
// above the floor: what is above that is clipped, the inner box, 0.3175 m x 0.1587 m, cuts rods' ends.
TEST_F(Programs, PackingOfABoxWithWalls)
{
  const double pi = std::acos(-1.0), r = 0.01, cap = 2.0 / 3.0 * pi * r * r * r;
  write("walls.dump", dump_text({{1, 1, {{{0.1, 0.2, 0.05}, {1, 0, 0}, 0.18}, r}},
                                 {2, 1, {{{0.1, 0.2, 0.1}, {0, 1, 0}, 0.09}, r}}},
                                0));
  const std::string box = "--box -0.1 0.3 0.1 0.3 0 1";
  ASSERT_EQ(run("rod_packing walls.dump " + box + " --csv w.csv --profiles w --bin 0.02"), 0)
      << error_;
  auto row = csv_row(read("w.csv"));
  const double first = pi * r * r * 0.36 + 2 * cap, second = pi * r * r * 0.18 + 2 * cap;
  const double whole = 0.4 * 0.2 * 0.1;
  EXPECT_NEAR(row["whole_volume_m3"], whole, 1e-12);
  EXPECT_NEAR(row["vf_whole"], (first + second) / whole, 1e-8);
  EXPECT_NEAR(row["vf_whole_clipped"], (first + second / 2) / whole,
              row["vf_whole_clipped_integration_error"] + 1e-8);
  EXPECT_NEAR(row["inner_volume_m3"], whole / 2, 1e-12);
  EXPECT_NEAR(row["inner_bottom_m"], 0.05 * (1 - std::cbrt(0.5)), 1e-9);
  // The first rod alone reaches below 0.0897 m.
  EXPECT_NEAR(row["vf_inner"], pi * r * r * 0.4 * std::cbrt(0.5) / (whole / 2),
              0.002 * row["vf_inner"]);
  EXPECT_TRUE(std::isnan(row["inner_radius_m"]));
  double sum = 0.0;
  for (const auto &bin : csv_rows(read("w_height.csv"))) sum += bin.at("solid_m3");
  EXPECT_NEAR(sum, first + second, 1e-8 * sum);
  EXPECT_FALSE(std::filesystem::exists(folder() / "w_wall.csv"));

  expect_refusal("rod_packing walls.dump --box -0.1 0.3 0.1 0.19 0 1",
                 "2 of 2 rod centres are outside the box -0.1 0.3 0.1 0.19 0 1");
  expect_refusal("rod_packing walls.dump --box 0.3 -0.1 0.1 0.3 0 1",
                 "--box: the upper bound in x must be above the lower (got 0.3 -0.1)");
  expect_refusal("rod_packing walls.dump --vessel-radius 1 " + box, "--box: holds the bed");
  expect_refusal("rod_packing walls.dump --inner-radius 1 " + box, "--inner-radius: wanted with");
  expect_refusal("rod_packing walls.dump", "wanted --vessel-radius, --vessel, --box or --region");

  // The same box as a mesh says the same, to the tolerance of both.
  write("box.stl", stl_text(box_mesh({-0.1, 0.3, 0.1, 0.3, 0, 1})));
  ASSERT_EQ(run("rod_packing walls.dump --vessel box.stl --csv m.csv --profiles m --bin 0.02"), 0)
      << error_;
  expect_same_packing("w.csv", "m.csv", 1e-4);
  EXPECT_EQ(csv_rows(read("m_height.csv")).size(), csv_rows(read("w_height.csv")).size());
  EXPECT_NEAR(csv_row(read("m_height.csv"))["vf"], csv_row(read("w_height.csv"))["vf"], 1e-6);
}

// A vessel of 720 facets beside the round one: its section is smaller by 1 - sin(2 pi/n)/(2 pi/n) =
// 1.3e-5, and its wall up to R (1 - cos(pi/n)) = 1e-5 R further in.
TEST_F(Programs, PackingOfAMeshIsThatOfACylinder)
{
  write("round.stl", stl_text(cone_mesh(0.305, 0.305, 0.0, 0.5, 720)));
  const std::string options = " --bulk-margin 0.05 --tolerance 1e-5 --csv ";
  ASSERT_EQ(run("rod_packing bed.dump --vessel-radius 0.305" + options + "c.csv"), 0) << error_;
  ASSERT_EQ(run("rod_packing bed.dump --vessel round.stl" + options + "m.csv"), 0) << error_;
  expect_same_packing("c.csv", "m.csv", 1e-4);
  EXPECT_NE(out_.find("V_f whole, clipped"), std::string::npos) << out_;
}

// One standing rod in a cube of 0.2 m, its centre at 0.1 m: pi r^2 h and the round ends.
TEST_F(Programs, PackingOfOneRodInACube)
{
  const double pi = std::acos(-1.0), r = 0.01, h = 0.05, cap = 2.0 / 3.0 * pi * r * r * r;
  write("one.dump", dump_text({{1, 1, {{{0, 0, 0.1}, {0, 0, 1}, h}, r}}}, 5));
  write("cube.stl", stl_text(box_mesh({-0.1, 0.1, -0.1, 0.1, 0, 0.2})));
  ASSERT_EQ(run("rod_packing one.dump --vessel cube.stl --region 0 1 -1 1 0.06 0.16 --csv o.csv"),
            0)
      << error_;
  auto row = csv_row(read("o.csv"));
  const double whole = 0.2 * 0.2 * 0.1, rod = pi * r * r * 2 * h + 2 * cap;
  EXPECT_NEAR(row["whole_volume_m3"], whole, 1e-6 * whole);
  EXPECT_NEAR(row["vf_whole"], rod / whole, 1e-6);
  EXPECT_NEAR(row["vf_whole_clipped"], 0.5 * rod / whole,
              row["vf_whole_clipped_integration_error"] + 1e-6);
  EXPECT_NEAR(row["inner_volume_m3"], 0.5 * whole, 1e-6 * whole);
  // The part of the window that is in the cube: of half of the rod 0.09 m of its length and
  // the upper end.
  EXPECT_NEAR(row["region_volume_m3"], 0.1 * 0.2 * 0.1, 1e-8);
  EXPECT_NEAR(row["vf_region"], 0.5 * (pi * r * r * 0.09 + cap) / 0.002, 1e-6);
}

// A vessel with a displacer in its middle is not convex: no inner region and no bulk, as the table
// says; what the displacer takes is missing from the volume.
TEST_F(Programs, PackingOfAVesselWithADisplacer)
{
  write("one.dump", dump_text({{1, 1, {{{0.07, 0, 0.1}, {0, 1, 0}, 0.05}, 0.01}}}, 5));
  write("hollow.stl",
        stl_text(both(box_mesh({-0.1, 0.1, -0.1, 0.1, 0, 0.2}),
                      turned_over(box_mesh({-0.05, 0.05, -0.05, 0.05, 0.05, 0.15})))));
  ASSERT_EQ(run("rod_packing one.dump --vessel hollow.stl --csv h.csv"), 0) << error_;
  auto row = csv_row(read("h.csv"));
  EXPECT_NEAR(row["whole_volume_m3"], 0.2 * 0.2 * 0.1 - 0.1 * 0.1 * 0.05, 1e-8);
  EXPECT_TRUE(std::isnan(row["vf_inner"]));
  EXPECT_TRUE(std::isnan(row["vf_bulk"]));
  EXPECT_NE(out_.find("  V_f inner and bulk         none             the vessel is not convex, "
                      "--region takes a part of it\n"),
            std::string::npos)
      << out_;
}

TEST_F(Programs, VesselsThatCannotBeUsed)
{
  const Triangles cube = box_mesh({-0.4, 0.4, -0.4, 0.4, 0, 0.8});
  Triangles open = cube, turned = cube;
  open.resize(10);
  std::swap(turned[3].a, turned[3].b);
  write("cube.stl", stl_text(cube));
  write("open.stl", stl_text(open));
  write("turned.stl", stl_text(turned));
  write("inwards.stl", stl_text(turned_over(cube)));
  write("small.stl", stl_text(box_mesh({-0.001, 0.001, -0.001, 0.001, 0, 0.001})));
  write("empty.stl", "solid\nendsolid\n");
  write("text.stl", "no mesh\n");
  write("bytes.stl", std::string(90, '\x01'));
  write("vessel.obj", stl_text(cube));
  const std::string command = "rod_packing bed.dump --vessel ";
  const auto says = [&](const std::string &name, const std::string &sentence) {
    expect_refusal(command + name, "rod_packing: " + sentence);
  };
  says("open.stl",
       "open.stl: the vessel is not closed: 4 edges belong to one triangle only, one of them at (");
  says("turned.stl",
       "turned.stl: the vessel has 3 edges of which one triangle faces inwards and the other "
       "outwards, wanted all outwards\n");
  says(
      "inwards.stl",
      "inwards.stl: the vessel has triangles that face inwards: they enclose -0.512 m^3, wanted > 0, all "
      "facing outwards\n");
  says("empty.stl", "empty.stl: holds no triangles, wanted at least one\n");
  says("text.stl", "text.stl: ");
  says("bytes.stl", "bytes.stl: ");
  says("none.stl", "none.stl: cannot be opened\n");
  says("vessel.obj", "vessel.obj: must be a mesh whose name ends in .stl or .vtk (got '.obj')\n");
  says("small.stl",
       "bed.dump: step 1000: 30 of 30 rod centres are outside the vessel small.stl, wanted none\n");
  says("cube.stl --vessel-radius 1",
       "--vessel: holds the bed, wanted without --vessel-radius, --centre, --floor, --box\n");
  says("cube.stl --inner-radius 1",
       "--inner-radius, --inner-bottom, --inner-top: wanted without --vessel, of which --region "
       "takes a part\n");
  says("cube.stl --region 1 2 1 2 1 2",
       "--region: nothing of the vessel cube.stl is in 1 2 1 2 1 2, wanted a part of it\n");
}

// A heap or a drum: half of a rod in a region, a quarter of two that cross, an image of one.
TEST_F(Programs, PackingOfARegion)
{
  const double pi = std::acos(-1.0), r = 0.01;
  const double rod = pi * r * r * 0.18 + 4.0 / 3.0 * pi * r * r * r;
  const double steinmetz = 16.0 / 3.0 * r * r * r;
  std::string text = dump_text({{1, 1, {{{0, 0, 0.1}, {1, 0, 0}, 0.09}, r}},
                                {2, 1, {{{0, 0, 0.1}, {0, 1, 0}, 0.09}, r}},
                                {3, 1, {{{0.98, 0.5, 0.1}, {1, 0, 0}, 0.09}, r}}},
                               0);
  write("heap.dump", text);
  ASSERT_EQ(run("rod_packing heap.dump --region -0.01 0.3 -0.2 0.2 0 0.1 --csv h.csv"), 0)
      << error_;
  auto row = csv_row(read("h.csv"));
  EXPECT_TRUE(std::isnan(row["vf_whole"]));
  EXPECT_TRUE(std::isnan(row["vf_inner"]));
  EXPECT_NEAR(row["region_volume_m3"], 0.31 * 0.4 * 0.1, 1e-12);
  // Below their axes: of the first what is at x > -0.01, of the second all.
  const double solid = 0.5 * (rod / 2 + pi * r * r * 0.01) + 0.5 * rod;
  EXPECT_NEAR(row["vf_region"] * row["region_volume_m3"], solid, 2e-4 * solid);
  EXPECT_NEAR((row["vf_region"] - row["vf_region_net"]) * row["region_volume_m3"], steinmetz,
              0.02 * steinmetz);
  EXPECT_NE(out_.find("V_f region"), std::string::npos) << out_;
  EXPECT_EQ(out_.find("V_f whole"), std::string::npos) << out_;

  // The third reaches 0.08 m over the boundary of the box of 2 m.
  text.replace(text.find("ff ff ff"), 8, "pp pp ff");
  write("heap.dump", text);
  ASSERT_EQ(run("rod_packing heap.dump --region -1 -0.8 0.4 0.6 0 0.2 --csv h.csv"), 0) << error_;
  row = csv_row(read("h.csv"));
  EXPECT_NEAR(row["vf_region"] * row["region_volume_m3"],
              pi * r * r * (0.98 + 0.09 - 1.0) + 2.0 / 3.0 * pi * r * r * r, 1e-10);
  EXPECT_FALSE(std::isnan(row["vf_whole"]));

  expect_refusal("rod_packing bed.dump --region 0 1 0 1 1 0", "--region: the upper bound in z");
  expect_refusal("rod_packing bed.dump --region 0 1 0 1 0 1 --profiles p",
                 "--profiles: wanted with");
}

// Short rods: no theory, in the table, the CSV file and the figure's table; no number above 1.
TEST_F(Programs, TheoryIsForSlenderRods)
{
  for (const double lambda : {1.5, 2.5, 4.0}) {
    BedOptions options;
    options.rods = 40;
    options.length = lambda * options.diameter;
    write("short.dump", dump_text(random_bed(options), 0));
    ASSERT_EQ(run("rod_packing short.dump --vessel-radius 0.105 --csv short.csv"), 0) << error_;
    EXPECT_NE(out_.find("  random contacts            none             the equation is for slender "
                        "rods, lambda >= 5\n"),
              std::string::npos)
        << out_;
    EXPECT_EQ(out_.find("2 ln(lambda)/lambda is for slender rods, lambda >= 2.72\n") !=
                  std::string::npos,
              lambda < 2.7)
        << out_;
    for (const std::string which : {"isotropic", "horizontal", "measured"})
      EXPECT_TRUE(std::isnan(csv_row(read("short.csv"))["vf_random_contact_" + which])) << which;
    ASSERT_EQ(run("rod_orientation short.dump --vessel-radius 0.105 --summary-csv o.csv"), 0);
    EXPECT_NE(out_.find("the equation is for slender rods, lambda >= 5\n"), std::string::npos)
        << out_;
    EXPECT_TRUE(std::isnan(csv_row(read("o.csv"))["vf_random_contact"]));
    EXPECT_TRUE(std::isnan(csv_row(read("o.csv"))["half_contacts_of_vf_inner"]));
  }
}

// Parallel rods share little excluded volume: random contacts would fill more than all space.
TEST_F(Programs, TheoryIsForRandomContacts)
{
  std::vector<Rod> rods;
  for (int i = 0; i < 6; i++)
    rods.push_back({i + 1, 1, {{{0, 0, 0.05 + 0.02 * i}, {1, 0, 0}, 0.045}, 0.005}});
  write("parallel.dump", dump_text(rods, 0));
  ASSERT_EQ(run("rod_packing parallel.dump --vessel-radius 0.105 --csv parallel.csv"), 0);
  EXPECT_NE(out_.find("none             as measured, <|sin gamma|> = 0.0000: parallel, above the "
                      "densest packing, 0.8931\n"),
            std::string::npos)
      << out_;
  auto row = csv_row(read("parallel.csv"));
  EXPECT_TRUE(std::isnan(row["vf_random_contact_measured"]));
  EXPECT_NEAR(row["vf_random_contact_isotropic"], 0.4241, 5e-5);
}

// Two crossing rods whose axes cross: Steinmetz's body, 16 r^3/3, is counted twice in vf and once
// in vf_net; it lies in the inner cylinder.
TEST_F(Programs, PackingSaysTheOverlap)
{
  write("two.dump", dump_text({{1, 1, {{{0, 0, 0.1}, {1, 0, 0}, 0.09}, 0.01}},
                               {2, 1, {{{0, 0, 0.1}, {0, 1, 0}, 0.09}, 0.01}},
                               {3, 1, {{{0, 0, 0.2}, {0, 1, 0}, 0.09}, 0.01}}},
                              0));
  ASSERT_EQ(run("rod_packing two.dump --vessel-radius 0.2 --csv two.csv"), 0);
  auto row = csv_row(read("two.csv"));
  const double overlap = 16.0 / 3.0 * 1e-6;
  EXPECT_EQ(row["overlap_pairs"], 1);
  EXPECT_NEAR(row["overlap_volume_m3"], overlap, row["overlap_volume_integration_error_m3"]);
  EXPECT_LE(row["overlap_volume_integration_error_m3"], 0.011 * overlap);
  EXPECT_NEAR((row["vf_whole"] - row["vf_whole_net"]) * row["whole_volume_m3"],
              row["overlap_volume_m3"], 1e-14);
  EXPECT_NEAR((row["vf_inner"] - row["vf_inner_net"]) * row["inner_volume_m3"],
              row["overlap_volume_m3"], 1e-14);
  EXPECT_NE(out_.find("of 1 pairs"), std::string::npos) << out_;
}

// Mean and standard error of two beds, by hand: (a + b)/2, |a - b|/2.
TEST_F(Programs, PackingOfSeveralSeeds)
{
  BedOptions options;
  options.rods = 40;
  options.length = 0.3;
  options.vessel_radius = 0.305;
  options.seed = 49979687;
  write("other.dump", dump_text(random_bed(options), 1000));
  ASSERT_EQ(run("rod_packing bed.dump --vessel-radius 0.305 --bulk-margin 0.05 --csv a.csv"), 0);
  ASSERT_EQ(run("rod_packing other.dump --vessel-radius 0.305 --bulk-margin 0.05 --csv b.csv"), 0);
  ASSERT_EQ(run("rod_packing bed.dump other.dump --vessel-radius 0.305 --bulk-margin 0.05 "
                "--csv both.csv --profiles both --bin 0.05"),
            0);
  auto a = csv_row(read("a.csv")), b = csv_row(read("b.csv")), both = csv_row(read("both.csv"));
  const std::pair<std::string, std::string> means[] = {{"vf_whole", "vf_whole_error"},
                                                       {"vf_inner", "vf_inner_error"},
                                                       {"vf_bulk", "vf_bulk_error"},
                                                       {"z_top_m", "z_top_error_m"}};
  for (const auto &[name, error] : means) {
    EXPECT_NEAR(both[name], 0.5 * (a[name] + b[name]), 1e-9) << name;
    EXPECT_NEAR(both[error], 0.5 * std::abs(a[name] - b[name]), 1e-9) << name;
    EXPECT_TRUE(std::isnan(a[error])) << name;
  }
  EXPECT_GT(csv_row(read("both_wall.csv"))["vf_error"], 0.0);
  EXPECT_NE(out_.find("mean and standard error over 2 files"), std::string::npos) << out_;
}

// The profiles' solid adds up to that of the summary.
TEST_F(Programs, PackingProfilesAddUp)
{
  ASSERT_EQ(run("rod_packing bed.dump --vessel-radius 0.305 --csv a.csv --profiles p --bin 0.02"),
            0);
  auto row = csv_row(read("a.csv"));
  const auto solid = [&](const std::string &name) {
    double sum = 0.0;
    for (const auto &bin : csv_rows(read(name))) sum += bin.at("solid_m3");
    return sum;
  };
  const double all = row["rods_volume_m3"];
  EXPECT_NEAR(solid("p_height.csv"), all, 1e-8 * all);
  const double clipped = row["vf_whole_clipped"] * row["whole_volume_m3"];
  const double error =
      row["vf_whole_clipped_integration_error"] * row["whole_volume_m3"] + 1e-4 * clipped;
  EXPECT_NEAR(solid("p_radius.csv"), clipped, error);
  EXPECT_NEAR(solid("p_wall.csv"), clipped, error);
}

// Periodic boxes of rods placed one after the other: their volume over the box's.
TEST_F(Programs, PackingOfAPeriodicBox)
{
  const double volume = std::acos(-1.0) * (1e-4 * 0.18 + 4.0 / 3.0 * 1e-6);
  std::vector<Rod> rods;
  for (int i = 0; i < 5; i++)
    rods.push_back({i + 1, 1, {{{0.95, 0.1 * i, 0.25 + 0.2 * i}, {1, 0, 0}, 0.09}, 0.01}});
  // Crosses the image of the first rod, which reaches into the next box.
  rods.push_back({6, 1, {{{-0.99, 0.05, 0.25}, {0, 1, 0}, 0.09}, 0.01}});
  std::string text = dump_text(rods, 0);
  text.replace(text.find("ff ff ff"), 8, "pp pp ff");
  write("box.dump", text);
  ASSERT_EQ(run("rod_packing box.dump --csv box.csv --profiles box --bin 0.1"), 0);
  auto row = csv_row(read("box.csv"));
  EXPECT_NEAR(row["vf_whole"], 6 * volume / (4.0 * 1.05), 1e-9);  // box 2 m x 2 m, top at 1.05
  EXPECT_EQ(row["overlap_pairs"], 1);
  EXPECT_NEAR(row["overlap_volume_m3"], 16.0 / 3.0 * 1e-6, 1e-7);
  EXPECT_TRUE(std::isnan(row["inner_radius_m"]));
  EXPECT_NEAR(row["inner_bottom_m"], 1.05 / 4, 1e-9);
  double sum = 0.0;
  for (const auto &bin : csv_rows(read("box_height.csv"))) sum += bin.at("solid_m3");
  EXPECT_NEAR(sum, 6 * volume, 1e-8 * volume);
  EXPECT_FALSE(std::filesystem::exists(folder() / "box_wall.csv"));

  text.replace(text.find("pp pp ff"), 8, "pp pp pp");  // box from -1 to 11 in z
  write("box.dump", text);
  ASSERT_EQ(run("rod_packing box.dump --csv box.csv --profiles box --bin 1"), 0);
  row = csv_row(read("box.csv"));
  EXPECT_NEAR(row["vf_whole"], 6 * volume / (4.0 * 12.0), 1e-9);
  EXPECT_TRUE(std::isnan(row["vf_inner"]));
}

TEST_F(Programs, SeveralLengthsAreSaid)
{
  write("two.dump", dump_text({{1, 1, {{{0, 0, 0.1}, {1, 0, 0}, 0.09}, 0.01}},
                               {2, 1, {{{0, 0, 0.2}, {1, 0, 0}, 0.19}, 0.01}}},
                              0));
  ASSERT_EQ(run("rod_packing two.dump --vessel-radius 1"), 0);
  EXPECT_NE(out_.find("lambda 15 (number mean; 10 to 20"), std::string::npos) << out_;
}

TEST_F(Programs, OrientationOfEvenDirections)
{
  std::vector<Rod> rods;
  for (const Vec3 &u : even_directions(2000))
    rods.push_back({static_cast<std::int64_t>(rods.size()) + 1, 1, {{{0, 0, 1}, u, 0.1}, 0.01}});
  write("even.dump", dump_text(rods, 0));
  ASSERT_EQ(run("rod_orientation even.dump --bins 10 --csv bins.csv --summary-csv means.csv"), 0);
  EXPECT_EQ(count_lines(read("bins.csv")), 11u);
  auto bin = csv_row(read("bins.csv"));
  EXPECT_NEAR(bin["isotropic_fraction"], 0.1, 1e-9);
  EXPECT_NEAR(bin["density"], 1.0, 0.02);  // six digits of the dump move a few axes over an edge
  EXPECT_NEAR(bin["elevation_high_deg"], std::asin(0.1) * 180 / std::acos(-1.0), 1e-6);
  auto means = csv_row(read("means.csv"));
  EXPECT_NEAR(means["mean_elevation_deg"], 32.70, 0.05);
  EXPECT_NEAR(means["nematic_order"], 0.0, 0.01);
  EXPECT_EQ(means["chi2_degrees_of_freedom"], 9);
}

// Means over files: those of the rows of each file, and the standard error of the mean of three.
TEST_F(Programs, MeansOfSeveralFiles)
{
  std::vector<double> elevations;
  for (const std::string name : {"seed1", "seed2", "seed3"}) {
    ASSERT_EQ(run("rod_orientation " + name + ".dump --vessel-radius 0.305 --summary-csv one.csv"),
              0);
    auto row = csv_row(read("one.csv"));
    EXPECT_GT(row["mean_elevation_error_deg"], 1.0);
    elevations.push_back(row["mean_elevation_deg"]);
  }
  ASSERT_EQ(run("rod_orientation seed1.dump seed2.dump seed3.dump --vessel-radius 0.305 "
                "--summary-csv all.csv --csv bins.csv --wall-csv wall.csv --wall-bins-csv wb.csv"),
            0)
      << error_;
  const double mean = (elevations[0] + elevations[1] + elevations[2]) / 3;
  double squares = 0.0;
  for (const double elevation : elevations) squares += std::pow(elevation - mean, 2);
  auto row = csv_row(read("all.csv"));
  EXPECT_EQ(row["rods"], 90);
  EXPECT_EQ(row["step"], 1000);
  EXPECT_NEAR(row["mean_elevation_deg"], mean, 1e-6);
  EXPECT_NEAR(row["mean_elevation_error_deg"], std::sqrt(squares / 6), 1e-6);
  EXPECT_GT(row["vf_inner_error"], 0.0);
  EXPECT_NE(out_.find("means of the files"), std::string::npos);
  EXPECT_EQ(count_lines(read("bins.csv")), 19u);
  // Distances by quarters of a rod of 0.3 m, up to the vessel's radius.
  auto wall = csv_row(read("wall.csv"));
  EXPECT_NEAR(wall["distance_high_m"], 0.075, 1e-9);
  expect_refusal("rod_orientation seed1.dump seed2.dump --frame all",
                 "--frame: must be first, last or a step for 2 files (got 'all')");
}

// Nothing said of one bed becomes nothing, not zero; one value has no error; and means are over
// beds of the same rods, each once.
TEST_F(Programs, MeansSayNoMoreThanIsKnown)
{
  ASSERT_EQ(run("rod_contacts seed1.dump seed2.dump --csv c.csv"), 0) << error_;
  auto contacts = csv_row(read("c.csv"));
  EXPECT_EQ(contacts["rods"], 60);
  EXPECT_TRUE(std::isnan(contacts["pair_forces"]));
  EXPECT_TRUE(std::isnan(contacts["wall_forces"]));

  write("one.dump", dump_text({{1, 1, {{{0, 0, 0.1}, {1, 0, 0}, 0.09}, 0.01}}}, 0));
  ASSERT_EQ(
      run("rod_orientation one.dump --floor 0 --wall-width 1 --summary-csv o.csv --wall-csv w.csv"),
      0);
  for (const char *file : {"o.csv", "w.csv"}) {
    auto row = csv_row(read(file));
    EXPECT_EQ(row["rods"], 1) << file;
    EXPECT_TRUE(std::isnan(row["mean_elevation_error_deg"])) << file;
    EXPECT_TRUE(std::isnan(row["mean_sin_gamma"])) << file;
  }
  EXPECT_EQ(out_.find("nan"), std::string::npos) << out_;
  expect_refusal("rod_packing bed.dump ./bed.dump --vessel-radius 0.305", "is given twice");
  expect_failure(
      "rod_packing bed.dump one.dump --vessel-radius 0.305",
      "one.dump: its rods are 0.02 m thick, aspect ratio 10, those of bed.dump 0.01 m, 30");
}

// Between 5 mm above the floor and 5 mm below the highest centre are 3 mm of a bed of rods 20 mm
// thick: too thin a slice to be the bulk. 30 mm are one.
TEST_F(Programs, BulkHasSomeThickness)
{
  for (const double height : {0.013, 0.04}) {
    write("two.dump", dump_text({{1, 1, {{{0, 0, 0.01}, {1, 0, 0}, 0.09}, 0.01}},
                                 {2, 1, {{{0, 0.1, height}, {1, 0, 0}, 0.09}, 0.01}}},
                                0));
    ASSERT_EQ(run("rod_packing two.dump --vessel-radius 0.2 --bulk-margin 0.005 --csv p.csv"), 0);
    EXPECT_EQ(std::isnan(csv_row(read("p.csv"))["vf_bulk"]), height < 0.02);
  }
}

// What the dump's digits leave open: with six of them a gap of 2e-7 m is in doubt, with twelve not.
TEST_F(Programs, DoubtfulContactsFollowTheDigits)
{
  const std::string head =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
      "ITEM: ATOMS id x y z shapex shapez quat1 quat2 quat3 quat4\n";
  const auto doubtful = [&](const std::string &x, const std::string &y) {
    write("d.dump",
          head + "1 " + x + " 0 0 0.01 0.05 1 0 0 0\n2 " + y + " 0 0 0.01 0.05 1 0 0 0\n");
    EXPECT_EQ(run("rod_contacts d.dump --csv c.csv"), 0) << error_;
    return csv_row(read("c.csv"))["doubtful_pairs"];
  };
  EXPECT_EQ(doubtful("0.123456", "0.143456"), 1);
  EXPECT_EQ(doubtful("0.123456000002", "0.143456200001"), 0);
  EXPECT_EQ(doubtful("0.1", "0.1201"), 0);  // 1e-4 m apart
  // A rod far away, whose own place is known to 5 cm only, makes no other doubtful.
  write("d.dump", std::string(head).replace(head.find("\n2\n"), 3, "\n3\n") +
                      "1 0.123456 0 0 0.01 0.05 1 0 0 0\n2 0.1437 0 0 0.01 0.05 1 0 0 0\n"
                      "3 -10000.2 0 0 0.01 0.05 1 0 0 0\n");
  ASSERT_EQ(run("rod_contacts d.dump --csv c.csv"), 0) << error_;
  EXPECT_EQ(csv_row(read("c.csv"))["doubtful_pairs"], 0);
}

// Beds whose tables of contact numbers end at different rows: a bed without rods of 14 contacts has
// 0 of them, so that the fractions add up to 1.
TEST_F(Programs, FractionsOfSeveralFilesAddUp)
{
  ASSERT_EQ(run("rod_contacts seed1.dump seed2.dump seed3.dump --gap 9 --tables t"), 0) << error_;
  double sum = 0.0, errors = 0.0;
  std::istringstream lines(read("t_numbers.csv"));
  std::string line, field;
  for (std::getline(lines, line); std::getline(lines, line);) {
    std::istringstream fields(line);  // step, contacts, rods, fraction, fraction_error
    for (int k = 0; k < 4; k++) std::getline(fields, field, ',');
    sum += std::stod(field);
    std::getline(fields, field, ',');
    errors += !field.empty();
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_GT(errors, 2);
  EXPECT_EQ(errors + 1, static_cast<double>(count_lines(read("t_numbers.csv"))));
}

// V_f as rod_packing has it, and the random contact equation with the measured <|sin gamma|>.
TEST_F(Programs, OrientationGivesPackingsNumbers)
{
  ASSERT_EQ(run("rod_packing bed.dump --vessel-radius 0.305 --csv packing.csv"), 0);
  ASSERT_EQ(run("rod_orientation bed.dump --vessel-radius 0.305 --summary-csv order.csv"), 0);
  auto packing = csv_row(read("packing.csv")), order = csv_row(read("order.csv"));
  EXPECT_NEAR(order["vf_whole"], packing["vf_whole"], 1e-9);
  EXPECT_NEAR(order["vf_inner"], packing["vf_inner"], 2e-4 * packing["vf_inner"]);
  // x = 29: V_f = 10.5 (x/4 + 1/6)/((2 s/pi) x^2 + 2 x + 4/3).
  const double s = order["mean_sin_gamma"];
  const double wanted =
      10.5 * (29.0 / 4 + 1.0 / 6) / (2 * s / std::acos(-1.0) * 29 * 29 + 58 + 4.0 / 3);
  EXPECT_NEAR(order["vf_random_contact"], wanted, 1e-6);
  EXPECT_NEAR(order["half_contacts_of_vf_inner"], 5.25 * order["vf_inner"] / wanted, 1e-5);
  EXPECT_NEAR(order["q_xx"] + order["q_yy"] + order["q_zz"], 0.0, 1e-8);
}

// Lying on a floor and crossed by another: numbers known by hand.
TEST_F(Programs, ContactsOfThreeRods)
{
  write("three.dump", dump_text({{1, 1, {{{0, 0, 0.00999}, {1, 0, 0}, 0.09}, 0.01}},
                                 {2, 1, {{{0.045, 0, 0.02997}, {0, 1, 0}, 0.09}, 0.01}},
                                 {3, 1, {{{0, 0, 0.5}, {0, 1, 0}, 0.09}, 0.01}}},
                                0));
  ASSERT_EQ(run("rod_contacts three.dump --vessel-radius 0.2 --csv c.csv --tables t "
                "--contacts-csv each.csv"),
            0)
      << error_;
  auto row = csv_row(read("c.csv"));
  EXPECT_EQ(row["rods"], 3);
  EXPECT_EQ(row["pair_contacts"], 1);
  EXPECT_EQ(row["wall_contacts"], 2);
  EXPECT_EQ(row["doubtful_pairs"], 0);
  EXPECT_NEAR(row["contacts_per_rod"], 2.0 / 3, 1e-9);
  EXPECT_NEAR(row["contacts_per_rod_with_walls"], 4.0 / 3, 1e-9);
  EXPECT_NEAR(row["rods_without_contact_fraction"], 1.0 / 3, 1e-9);
  EXPECT_EQ(row["side_side_fraction"], 1);
  EXPECT_NEAR(row["mean_side_position"], 0.25, 1e-6);  // 0.045 of 0.09 on one, 0 on the other
  EXPECT_NEAR(row["overlap_mean_diameters"], 0.001, 1e-6);
  EXPECT_NEAR(row["wall_overlap_mean_diameters"], 0.0005, 1e-6);
  EXPECT_TRUE(std::isnan(row["pair_force_mean_N"]));
  EXPECT_EQ(count_lines(read("t_numbers.csv")), 5u);  // 0 to 3 contacts: rod 1 has three with walls
  EXPECT_EQ(count_lines(read("each.csv")), 4u);
  EXPECT_NEAR(csv_row(read("each.csv"))["position_i_m"], 0.045, 1e-9);
  // A gap wide enough reaches nobody else, one that is wider still counts the floor for rod 2.
  ASSERT_EQ(run("rod_contacts three.dump --floor 0 --gap 1.5 --csv c.csv"), 0);
  EXPECT_EQ(csv_row(read("c.csv"))["wall_contacts"], 4);
}

// A heap at rest: its contacts hold the weight of its rods, each force sits on a pair that touches,
// and the forces that act on a rod keep it in place.
TEST_F(Programs, ForcesOfAHeap)
{
  pour_heap();
  ASSERT_EQ(run("rod_contacts heap.dump --vessel-radius 0.05 --local heap.pairs --local-keywords "
                "'id force' --wall-local heap.walls --wall-local-keywords 'id force' --csv c.csv "
                "--tables t"),
            0)
      << error_;
  auto row = csv_row(read("c.csv"));
  const double pi = std::acos(-1.0), r = 0.005, h = 0.04;
  const double weight = 60 * 2700 * pi * r * r * (h + 4 * r / 3) * 9.81;
  // What is left of the settling, and the six digits of the forces.
  EXPECT_NEAR(row["wall_force_sum_z_N"], weight, 1e-5 * weight);
  EXPECT_NEAR(row["wall_force_sum_x_N"], 0.0, 1e-5 * weight);
  EXPECT_EQ(row["pair_forces"], row["pair_contacts"]);
  EXPECT_EQ(row["wall_forces"], row["wall_contacts"]);
  EXPECT_GT(row["pair_contacts"], 100);
  EXPECT_EQ(out_.find("shows apart"), std::string::npos) << out_;
  // Without damping or friction a force is stiffness times overlap: the means are near that.
  EXPECT_NEAR(row["pair_force_mean_N"] / (2e4 * 0.01 * row["overlap_mean_diameters"]), 1.0, 0.1);
  EXPECT_GT(row["pair_force_max_N"], row["pair_force_mean_N"]);
  EXPECT_GT(row["strong_fraction"], 0.1);
  EXPECT_LT(row["strong_fraction"], 0.5);
  EXPECT_GT(row["largest_chain_rods"], 2);

  expect_refusal("rod_contacts heap.dump --local heap.pairs",
                 "heap.pairs:9: column c_ID[13] is missing");
  expect_refusal("rod_contacts heap.dump --local heap.walls --local-keywords 'id force'",
                 "column c_ID[1] is missing, wanted the rods' ids (by --local-keywords)");
  expect_refusal("rod_contacts bed.dump --local heap.pairs --local-keywords 'id force'",
                 "heap.pairs: holds no step 1000, which bed.dump has");
  expect_refusal("rod_contacts heap.dump --local heap.dump", "wanted 'ITEM: NUMBER OF ENTRIES'");
  expect_refusal("rod_contacts heap.dump heap.dump --local heap.pairs",
                 "--local: wanted one for each of the 2 DUMP files (got 1)");
}

TEST_F(Programs, VtkFilesCarryAllColumns)
{
  ASSERT_EQ(run("rod_vtk pour.dump --out p --geometry lines --timestep 0.5"), 0);
  const std::string series = read("p.pvd");
  for (const char *words : {"timestep=\"0\"", "timestep=\"250\"", "file=\"p_0000001000.vtp\""})
    EXPECT_NE(series.find(words), std::string::npos) << series;
  const std::string file = read("p_0000001000.vtp");
  EXPECT_NE(file.find("NumberOfLines=\"30\""), std::string::npos);
  for (const char *name : {"id", "type", "elevation_deg", "speed", "omega", "length", "diameter",
                           "axis", "c_contacts", "vx", "radius"})
    EXPECT_NE(file.find(fmt::format("Name=\"{}\"", name)), std::string::npos) << name;
  EXPECT_NE(read("p_0000000000.vtp").find("NumberOfLines=\"0\""), std::string::npos);
}

// The shell's limit on the length of files stands for a full disk: the first frame is empty and fits. Of a series
// nothing is left, and the sentence names the file that did not fit, not the one beside it.
TEST_F(Programs, VtkSeriesOnAFullDisk)
{
  EXPECT_EQ(
      run("sh -c 'ulimit -f 12; rod_vtk pour.dump --out full --vessel-radius 1 --vessel-height 2'"),
      2);
  EXPECT_EQ(count_lines(error_), 1u) << error_;
  EXPECT_EQ(error_.find("rod_vtk: full_"), 0u) << error_;
  EXPECT_NE(error_.find(".vtp: could not be written to its end"), std::string::npos) << error_;
  for (const auto &file : std::filesystem::directory_iterator(folder()))
    EXPECT_EQ(file.path().filename().string().find("full"), std::string::npos) << file.path();
}

// Wall and floor stand beside the rods in each frame.
TEST_F(Programs, VtkSeriesHoldsTheVessel)
{
  ASSERT_EQ(run("rod_vtk pour.dump --out p --geometry lines --vessel-radius 1 --vessel-height 2"),
            0);
  const std::string series = read("p.pvd");
  std::size_t walls = 0;
  for (auto at = series.find("p_vessel.vtp"); at != std::string::npos;
       at = series.find("p_vessel.vtp", at + 1))
    walls++;
  EXPECT_EQ(walls, 3u) << series;
  EXPECT_NE(series.find("part=\"2\" file=\"p_floor.vtp\""), std::string::npos) << series;
  EXPECT_NE(read("p_floor.vtp").find("NumberOfPolys=\"1\""), std::string::npos);
}

// A mesh is written once, one of a series for each step, the box's faces once; all beside the rods.
TEST_F(Programs, VtkSeriesHoldsMeshes)
{
  ASSERT_EQ(run("rod_vtk pour.dump --out p --geometry lines --mesh vessel.stl --mesh 'blade_*.stl' "
                "--box -1 1 -1 1 0 1"),
            0)
      << error_;
  const std::string series = read("p.pvd");
  for (const char *words : {"timestep=\"500\" part=\"1\" file=\"p_mesh1.vtp\"",
                            "timestep=\"500\" part=\"2\" file=\"p_mesh2_0000000500.vtp\"",
                            "timestep=\"1000\" part=\"2\" file=\"p_mesh2_0000001000.vtp\"",
                            "timestep=\"1000\" part=\"3\" file=\"p_box.vtp\""})
    EXPECT_NE(series.find(words), std::string::npos) << words << " in " << series;
  EXPECT_NE(read("p_mesh1.vtp").find("NumberOfPolys=\"240\""), std::string::npos);
  EXPECT_NE(read("p_mesh2_0000000500.vtp").find("NumberOfPolys=\"12\""), std::string::npos);
  EXPECT_NE(read("p_mesh2_0000000500.vtp"), read("p_mesh2_0000001000.vtp"));
  EXPECT_NE(read("p_box.vtp").find("NumberOfPolys=\"6\""), std::string::npos);

  expect_refusal("rod_vtk bed.dump --out q --box 0 1 0 1 1 0", "--box: the upper bound in z");
  expect_refusal("rod_vtk bed.dump --out q --mesh none.stl", "none.stl: cannot be opened");
  write("blade_x.stl", "");
  expect_sentence("rod_vtk pour.dump --out q --mesh 'blade_x*.stl'",
                  "blade_x*.stl: there is no file of step 0, wanted one for each step drawn");
}

// A drum's wall and floor are others than those of an upright vessel of the same size (where they
// lie: VesselSurface.LiesAlongAnAxis).
TEST_F(Programs, VtkVesselMayLie)
{
  ASSERT_EQ(run("rod_vtk bed.dump --frame last --out p --geometry lines --vessel-radius 0.5 "
                "--vessel-axis x --floor -2 --vessel-height 7"),
            0)
      << error_;
  EXPECT_EQ(run("rod_vtk bed.dump --frame last --out q --geometry lines --vessel-radius 0.5 "
                "--vessel-axis z --floor -2 --vessel-height 7"),
            0)
      << error_;
  EXPECT_NE(read("p_vessel.vtp"), read("q_vessel.vtp"));
  EXPECT_NE(read("p_floor.vtp"), read("q_floor.vtp"));
}

// A rod of radius r, half cylinder length h along u in the x-z plane, 30 degrees above x, so that
// z is turned to it by 60 degrees about y: quaternion (0, sin 30, 0, cos 30). Pointing down instead
// it is the same rod.
TEST_F(Programs, OvitoFile)
{
  const double c = std::sqrt(3.0) / 2.0;
  const auto rod = [&](double sign) {
    return Rod{7, 2, {{{1, 2, 3}, {sign * c, 0, sign * 0.5}, 0.09}, 0.01}};
  };
  write("two.dump", dump_text({rod(1)}, 500) + dump_text({rod(-1)}, 1000));
  ASSERT_EQ(run("rod_vtk two.dump --out o --geometry lines --timestep 0.5 --ovito"), 0) << error_;
  std::istringstream file(read("o.xyz"));
  for (const double time : {250.0, 500.0}) {
    std::string count, header, row;
    std::getline(file, count);
    std::getline(file, header);
    std::getline(file, row);
    EXPECT_EQ(count, "1");
    EXPECT_NE(header.find(fmt::format(" Time={:g} ", time)), std::string::npos) << header;
    EXPECT_NE(header.find("Properties=id:I:1:atom_types:I:1:pos:R:3:orientation:R:4:"
                          "aspherical_shape:R:3:elevation_deg:R:1:velo:R:3:"),
              std::string::npos)
        << header;
    EXPECT_NE(header.find(":c_contacts:R:1"), std::string::npos) << header;
    std::istringstream numbers(row);
    const double expected[] = {7, 2, 1, 2, 3, 0, 0.5, 0, c, 0.01, 0.01, 0.18, 30};
    for (const double value : expected) {
      double number = NAN;
      numbers >> number;
      EXPECT_NEAR(number, value, 2e-5) << row;  // six digits of the dump
    }
  }
}

// The cell is that of the dump, with its periodic directions; columns that say the centre in other
// words are not repeated, and a velocity of one component is no velocity.
TEST_F(Programs, OvitoCell)
{
  const std::string rows = "ITEM: ATOMS id xsu ysu zsu vx shapex shapez quat1 quat2 quat3 quat4\n"
                           "1 0.25 0.5 0.5 7 0.01 0.1 1 0 0 0\n";
  const auto dump = [&](const std::string &box) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS " + box + rows;
  };
  write("box.dump", dump("pp ff pp\n0 2\n-1 1\n0 4\n"));
  ASSERT_EQ(run("rod_vtk box.dump --out o --geometry lines --ovito"), 0) << error_;
  const std::string file = read("o.xyz");
  for (const char *words : {"Lattice=\"2 0 0 0 2 0 0 0 4\"", "Origin=\"0 -1 0\"", "pbc=\"T F T\"",
                            ":elevation_deg:R:1:vx:R:1\n", "\n1 1 0.5 0 2 "})
    EXPECT_NE(file.find(words), std::string::npos) << words << " in " << file;
  std::string tilted = dump("xy xz yz pp pp pp\n0 2 0.5\n-1 1 0\n0 4 0\n");
  for (const std::string scaled : {"xsu", "ysu", "zsu"})
    tilted.replace(tilted.find(scaled), 3, scaled.substr(0, 1));
  write("tilted.dump", tilted);
  EXPECT_EQ(run("rod_vtk tilted.dump --out t --geometry lines"), 0) << error_;
  expect_refusal("rod_vtk tilted.dump --out u --ovito", "tilted.dump: step 0: the box is tilted");
}

TEST_F(Programs, WrongOptions)
{
  expect_refusal("rod_packing", "DUMP is required");
  expect_refusal("rod_packing bed.dump", "not periodic in x and y, wanted --vessel-radius");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --bin 1", "wanted with --profiles only");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --profiles p --bin 1e-9",
                 "--bin: 1e-09 m makes more than 100000 bins");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --bulk-margin -1", "a number > 0");
  expect_refusal("rod_packing bed.dump seed1.dump --vessel-radius 1 --frame all",
                 "must be first, last or a step for 2 files");
  expect_refusal("rod_packing bed.dump --vessel-radius 0", "must be a number > 0 (got '0')");
  expect_refusal("rod_packing bed.dump --vessel-radius nan", "must be a number > 0");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --tolerance 1", "from 1e-09 to 0.1");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --centre 1", "--centre");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --colour red", "--colour");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --frame lest",
                 "must be first, last, all or a step >= 0 (got 'lest')");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --frame 7", "step 7 is not among its 1");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --inner-radius 2",
                 "--inner-radius: must be at most the vessel radius 1 (got 2)");
  expect_refusal("rod_packing bed.dump --vessel-radius 1 --inner-top -3", "above the bottom");
  expect_refusal("rod_orientation bed.dump --bins 0", "--bins");
  expect_refusal("rod_orientation bed.dump --spacing wide", "--spacing");
  expect_refusal("rod_orientation bed.dump --near -1", "--near");
  expect_refusal("rod_orientation bed.dump --wall-csv a.csv",
                 "wanted with --vessel-radius or --floor");
  expect_refusal("rod_orientation bed.dump --floor 0 --wall side", "--wall: 'side' is wanted with");
  expect_refusal("rod_orientation bed.dump --vessel-radius 1 --wall-width 1e-9",
                 "--wall-width: 1e-09 m make more than 10000 bins");
  expect_refusal("rod_orientation bed.dump --centre 0 0", "--centre: wanted with --vessel-radius");
  expect_refusal("rod_orientation bed.dump --wall side", "--wall, --wall-width: wanted with");
  expect_refusal("rod_orientation bed.dump --wall-width 1", "--wall, --wall-width: wanted with");
  expect_refusal("rod_contacts bed.dump --strong 3", "--strong requires --local");
  expect_refusal("rod_contacts bed.dump --local-keywords id", "--local-keywords requires --local");
  expect_refusal("rod_contacts bed.dump --bins 5", "--bins requires --tables");
  expect_refusal("rod_packing bed.dump --vessel-radius 0.305 --inner-bottom -1",
                 "--inner-bottom: must be at least the floor 0 (got -1)");
  expect_refusal("rod_contacts", "DUMP is required");
  expect_refusal("rod_contacts bed.dump --gap -1", "--gap");
  expect_refusal("rod_contacts bed.dump --strong 0", "--strong");
  expect_refusal("rod_contacts bed.dump --vessel-radius 0.1", "rod centres are outside the vessel");
  expect_refusal("rod_contacts bed.dump --local none.pairs", "none.pairs: cannot be opened");
  expect_refusal("rod_contacts bed.dump --local bed.dump --local-keywords 'force'",
                 "'id' is not among");
  expect_refusal("rod_contacts bed.dump seed1.dump --contacts-csv a.csv",
                 "--contacts-csv: wanted with one DUMP file only (got 2)");
  expect_refusal("rod_vtk bed.dump --geometry cubes", "--geometry");
  expect_refusal("rod_vtk bed.dump --vessel-radius 1", "must be given together");
  expect_refusal("rod_render bed.dump", "--out is required");
  for (const char *name : {"a.jpg", "a", ".png", "png"})
    expect_refusal(std::string("rod_render bed.dump --out ") + name,
                   fmt::format("--out: must end in .png (got '{}')", name));
  expect_refusal("rod_render bed.dump --out a.png --size big", "--size: must be WIDTHxHEIGHT");
  expect_refusal("rod_render bed.dump --out a.png --size 4001x300",
                 "each from 200 to 4000 (got '4001x300')");
  expect_refusal("rod_render bed.dump --out a.png --colour taste", "column 'taste' is missing");
  expect_refusal("rod_render bed.dump --out a.png --background blurple", "--background");
  expect_refusal(
      "rod_render bed.dump --out a.png --frame all --vessel-radius 1 --top 1 --colour spin",
      "--frame all: needs --range");
  expect_refusal(
      "rod_render pour.dump --out a.png --frame all --vessel-radius 1 --top 1 --auto-range",
      "--frame all: needs --range");
  expect_refusal("rod_render bed.dump --out a.png --range 0 1 --auto-range", "excludes");
  expect_refusal("rod_render bed.dump --out a.png --film a.mp4", "--film: needs --frame all");
  expect_refusal("rod_render bed.dump --out a.png --film a.gif", "must end in .mp4 or .webm");
  expect_refusal("rod_render bed.dump --out a.png --top -1",
                 "bed.dump: step 1000: --top leaves none of its 30 rods");
  expect_refusal("rod_render pour.dump --frame all --out a.png --top -1 --box 5 6 5 6 5 6",
                 "pour.dump: --box, --top leaves no rods of any step");
  expect_refusal("rod_render bed.dump --out a.png --box 0 1 0 1 1 0",
                 "--box: the upper bound in z must be above the lower (got 1 0)");
  expect_refusal("rod_render bed.dump --out a.png --box 0 1 0 1 0 1 --vessel-radius 1",
                 "--box: wanted without --vessel-radius");
  const std::string drum = "rod_render bed.dump --out a.png --vessel-radius 0.4 --vessel-axis ";
  expect_refusal(drum + "w", "--vessel-axis");
  expect_refusal(drum + "y --floor -1",
                 "--floor, --vessel-height: must be given together with --vessel-axis y");
  expect_refusal(drum + "y --floor -1 --vessel-height 0.1",
                 "30 of 30 rod centres are outside the vessel of radius 0.4 along y from -1 to "
                 "-0.9 through (0, 0, 0)");
  expect_refusal("rod_vtk bed.dump --floor 0", "--floor: wanted with --vessel-radius only");
  for (const char *tool : {"rod_render bed.dump --out a.png", "rod_vtk bed.dump"}) {
    expect_refusal(std::string(tool) + " --centre 0 0", "--centre: wanted with --vessel-radius");
    expect_refusal(std::string(tool) + " --vessel-height 1", "--vessel-height");
    expect_refusal(std::string(tool) + " --vessel-axis x", "--vessel-axis: wanted with");
  }
  expect_refusal("rod_render bed.dump --out a.png --top 1 --vessel-radius 1 --floor 2",
                 "--top: must be above the floor 2 (got 1)");
  expect_refusal("rod_render bed.dump --out a.png --cut --view top", "--cut: needs a view");
  expect_refusal("rod_render bed.dump --out a.png --cut --vessel-radius 1 --view top",
                 "--cut: needs a view");
  expect_refusal("rod_render bed.dump --out a.png --range 2 1", "--range");
}

TEST_F(Programs, FilesThatCannotBeWritten)
{
  expect_refusal("rod_orientation bed.dump --csv no/where.csv", "no/where.csv: cannot be opened");
  expect_refusal("rod_contacts bed.dump --csv no/where.csv", "no/where.csv: cannot be opened");
  expect_refusal("rod_contacts bed.dump seed1.dump --tables no/where",
                 "no/where_numbers.csv: cannot be opened");
  expect_refusal("rod_vtk bed.dump --out no/where", "cannot be opened for writing");
  expect_refusal("rod_render bed.dump --out no/where.png", "no/where.png: cannot be opened");
}

TEST_F(Programs, RodsOutsideTheVesselAreCounted)
{
  write("out.dump", dump_text({{1, 1, {{{0, 0, 0.1}, {1, 0, 0}, 0.09}, 0.01}},
                               {2, 1, {{{0.5, 0, 0.1}, {1, 0, 0}, 0.09}, 0.01}},
                               {3, 1, {{{0, 0, -0.1}, {1, 0, 0}, 0.09}, 0.01}}},
                              0));
  for (const char *tool : {"rod_packing out.dump", "rod_render out.dump --out a.png"})
    expect_refusal(std::string(tool) + " --vessel-radius 0.2",
                   "2 of 3 rod centres are outside the vessel");
  // Rods above what is shown are left out, wherever they are; the third is below the floor.
  expect_refusal("rod_render out.dump --out a.png --vessel-radius 0.2 --top 0.05",
                 "1 of 1 rod centres are outside the vessel");
}

// "--font-size" of what does not fit, the number it may be, and that number.
TEST_F(Programs, LettersThatDoNotFitAreRefused)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  expect_refusal("rod_render bed.dump --out a.png --size 300x300 --font-size 400",
                 "--font-size: must be at most ");
  expect_refusal("rod_render bed.dump --out a.png --size 200x200 --no-colour-bar --font-size 60",
                 "in a picture of 200x200");
}

// A box of 2 x 2 x 12 m, periodic in x and z, with one rod of 0.2 m about its middle: the picture
// is aimed at the box, and changes with its height, but not with its depth, where it does not end.
TEST_F(Programs, PeriodicBoxIsDrawn)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  std::string text = dump_text({{1, 1, {{{0, 0, 5}, {1, 0, 0}, 0.09}, 0.01}}}, 0);
  write("free.dump", text);
  text.replace(text.find("ff ff ff"), 8, "pp ff pp");
  write("box.dump", text);
  const auto picture = [&](const std::string &dump) {
    EXPECT_EQ(run("rod_render " + dump + " --out a.png --size 200x300"), 0) << error_;
    return read("a.png");
  };
  const std::string box = picture("box.dump");
  EXPECT_NE(box, picture("free.dump"));
  const auto with_box = [&](const std::string &bounds) {
    const auto at = text.find("BOX BOUNDS");
    return text.replace(at, text.find("ITEM: ATOMS") - at, "BOX BOUNDS pp ff pp\n" + bounds);
  };
  write("deeper.dump", with_box("-1 1\n-9 9\n-1 11\n"));
  EXPECT_EQ(box, picture("deeper.dump"));
  write("higher.dump", with_box("-1 1\n-1 1\n-1 12\n"));
  EXPECT_NE(box, picture("higher.dump"));
}

// Walls, bodies and a floor without a vessel change the picture, each its own way (which walls:
// MeshSurface.WallsBehind). Pictures of a film show the mesh of their step.
TEST_F(Programs, MeshesAreDrawn)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  const auto picture = [&](const std::string &options) {
    EXPECT_EQ(run("rod_render bed.dump --out a.png --size 300x200 --view side " + options), 0)
        << error_;
    return read("a.png");
  };
  const std::string bare = picture(""), walls = picture("--mesh vessel.stl"),
                    body = picture("--body vessel.stl");
  EXPECT_NE(bare, walls);
  EXPECT_NE(bare, body);
  EXPECT_NE(walls, body);
  EXPECT_NE(picture("--mesh vessel.stl --cut"), walls);
  EXPECT_NE(picture("--floor 0"), bare);

  const std::string film =
      "rod_render pour.dump --frame all --out f.png --size 200x200 --mesh vessel.stl --body ";
  ASSERT_EQ(run(film + "'blade_*.stl'"), 0) << error_;
  const std::string second = read("f_0002.png");
  ASSERT_EQ(run(film + "blade_1000.stl"), 0) << error_;
  EXPECT_EQ(read("f_0002.png"), second);
  ASSERT_EQ(run(film + "blade_500.stl"), 0) << error_;
  EXPECT_NE(read("f_0002.png"), second);
}

TEST_F(Programs, MeshesThatCannotBeDrawn)
{
  write("words.stl", "words");
  for (const std::string option : {"--mesh ", "--body "}) {
    const std::string command = "rod_render bed.dump --out a.png " + option;
    expect_refusal(command + "none.stl", "rod_render: none.stl: cannot be opened\n");
    expect_refusal(command + "words.stl", "rod_render: words.stl: ");
    expect_refusal(command + "bed.dump",
                   "rod_render: bed.dump: must be a mesh whose name ends in .stl or .vtk (got "
                   "'.dump')\n");
    expect_refusal(command + "'m_*.stl'",
                   "rod_render: m_*.stl: there is no file of step 1000, wanted one for each step "
                   "drawn\n");
  }
  expect_refusal("rod_render bed.dump --out a.png --floor 9",
                 "30 of 30 rod centres are below the floor 9, wanted none");
}

// Programs named ffmpeg that write down what they are called with: the film is asked for with the
// pictures' pattern and rate; a failing one is an error; none at all is a line on stderr.
TEST_F(Programs, FilmIsMadeByFfmpeg)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  const std::string command =
      kPrograms + "/rod_render pour.dump --frame all --out p.png --vessel-radius 0.305 --top 0.6 "
                  "--size 200x200 --rate 25 --film p.webm";
  const auto fake = [&](const std::string &last_line) {
    write("bin/ffmpeg", "#!/bin/sh\necho \"$@\" >called.txt\n" + last_line + "\n");
    std::filesystem::permissions(folder() / "bin/ffmpeg", std::filesystem::perms::owner_all);
  };
  std::filesystem::create_directory(folder() / "bin");
  fake("");
  ASSERT_EQ(run("env PATH=bin:\"$PATH\" " + command), 0) << error_;
  EXPECT_EQ(out_, "p_0001.png\np_0002.png\n");
  const std::string called = read("called.txt");
  for (const char *words : {"-framerate 25 ", "-i p_%04d.png ", "libvpx-vp9", ".webm\n"})
    EXPECT_NE(called.find(words), std::string::npos) << called;
  fake("exit 3");
  EXPECT_EQ(run("env PATH=bin:\"$PATH\" " + command), 2);
  EXPECT_EQ(error_, "rod_render: p.webm: ffmpeg ended with exit code 3, wanted 0\n");
}

// --cut leaves the half behind the axis, --top what lies wholly below. Three rods: in front,
// behind, and behind but too high. The caption's numbers are drawn, so that the pictures tell them
// apart: the same picture is made from a dump that holds no more than the rod that is left and the
// one of the same total.
TEST_F(Programs, PartsOfABedAreLeftOut)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  const auto rod = [](int id, double y, double z) {
    return Rod{id, 1, {{{0, y, z}, {1, 0, 0}, 0.05}, 0.01}};
  };
  write("three.dump", dump_text({rod(1, -0.1, 0.1), rod(2, 0.1, 0.1), rod(3, 0.1, 0.35)}, 0));
  write("other.dump", dump_text({rod(1, -0.2, 0.3), rod(2, 0.1, 0.1), rod(3, 0.0, 0.395)}, 0));
  const std::string options = " --vessel-radius 0.3 --view side --size 300x300 ";
  const auto picture = [&](const std::string &call) {
    EXPECT_EQ(run("rod_render " + call + options + "--out a.png"), 0) << error_;
    return read("a.png");
  };
  const std::string cut = picture("three.dump --top 0.3 --cut");
  EXPECT_EQ(cut, picture("other.dump --top 0.3 --cut"));
  EXPECT_NE(cut, picture("three.dump --top 0.3"));
  EXPECT_NE(cut, picture("three.dump --top 0.4 --cut"));
}

// Without a vessel: a rod that lies still looks the same in all pictures of a film though another
// comes and goes, and as in the film that is played backwards. Alone it fills the picture.
TEST_F(Programs, FilmWithoutAVesselIsSteady)
{
  if (!can_render()) GTEST_SKIP() << "neither a display nor xvfb-run";
  const auto rod = [](int id, double x) {
    return Rod{id, 1, {{{x, 0, 0.1}, {1, 0, 0}, 0.05}, 0.01}};
  };
  const auto still = [&](std::int64_t step) { return dump_text({rod(1, 0)}, step); };
  const std::string both = dump_text({rod(1, 0), rod(2, 0.5)}, 7);
  const auto film = [&](const std::string &dump) {
    write("film.dump", dump);
    EXPECT_EQ(run("rod_render film.dump --frame all --out f.png --size 200x200 --timestep 1e-9"), 0)
        << error_;
    std::vector<std::string> pictures;
    for (int i = 1; std::filesystem::exists(folder() / fmt::format("f_{:04}.png", i)); i++) {
      pictures.push_back(read(fmt::format("f_{:04}.png", i)));
      std::filesystem::remove(folder() / fmt::format("f_{:04}.png", i));
    }
    return pictures;
  };
  const auto forth = film(still(5) + both + still(5)), back = film(both + still(5));
  ASSERT_EQ(forth.size(), 3u);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(forth[0], forth[2]);
  EXPECT_EQ(forth[0], back[1]);
  EXPECT_EQ(forth[1], back[0]);
  EXPECT_NE(forth[0], film(still(5))[0]);
}

// A failure after the first of two frames or files, or of the last of several outputs, leaves what
// was there.
TEST_F(Programs, WriteWholeFilesOrNone)
{
  write("twice.dump", bed_ + "ITEM: TIMESTEP\nnonsense\n");
  write("old.csv", "old\n");
  expect_failure("rod_packing twice.dump --frame all --vessel-radius 0.305 --csv old.csv",
                 "the time step is 'nonsense'");
  expect_failure("rod_packing seed1.dump twice.dump --vessel-radius 0.305 --csv new.csv",
                 "the time step is 'nonsense'");
  expect_failure("rod_contacts bed.dump --csv old.csv --tables nowhere/x", "nowhere/x");
  expect_failure("rod_orientation bed.dump --csv old.csv --summary-csv nowhere.csv/x", "nowhere");
  expect_failure("rod_packing bed.dump --vessel-radius 0.305 --csv .", "is a folder");
  EXPECT_EQ(read("old.csv"), "old\n");
}

// What a link leads to is written, there or not, and the link stays.
TEST_F(Programs, WriteThroughLinks)
{
  write("target.csv", "old\n");
  for (const std::string target : {"target.csv", "new.csv"}) {
    std::filesystem::create_symlink(target, folder() / ("link_" + target));
    EXPECT_EQ(run("rod_packing bed.dump --vessel-radius 0.305 --csv link_" + target), 0) << error_;
    EXPECT_TRUE(std::filesystem::is_symlink(folder() / ("link_" + target)));
    EXPECT_NE(read(target).find("vf_whole"), std::string::npos);
  }
  std::filesystem::create_symlink("loop.csv", folder() / "loop.csv");
  expect_sentence("rod_packing bed.dump --vessel-radius 0.305 --csv loop.csv", "loop.csv");
}

// Open files and pipes are written to as they are.
TEST_F(Programs, WriteToPipesAndOpenFiles)
{
  const std::string command = "rod_packing bed.dump --vessel-radius 0.305 --csv ";
  EXPECT_EQ(run(command + "/dev/null"), 0) << error_;
  EXPECT_EQ(run(command + "/dev/stdout | cat"), 0) << error_;
  EXPECT_NE(out_.find("vf_whole"), std::string::npos);
  EXPECT_EQ(run("sh -c '" + command + "/dev/fd/3 3>three.txt'"), 0) << error_;
  EXPECT_NE(read("three.txt").find("vf_whole"), std::string::npos);
  EXPECT_EQ(run("sh -c 'mkfifo p; cat p >got.txt & " + command + "p; wait'"), 0) << error_;
  EXPECT_NE(read("got.txt").find("vf_whole"), std::string::npos);
}

TEST_F(Programs, DoNotWriteOverWhatTheyRead)
{
  const std::string reads = "is read by this run", twice = "is named twice";
  expect_failure("rod_packing bed.dump --vessel-radius 0.305 --csv bed.dump", reads);
  expect_failure("rod_packing bed.dump --vessel-radius 0.305 --csv ./bed.dump", reads);
  std::filesystem::create_hard_link(folder() / "bed.dump", folder() / "other.csv");
  expect_failure("rod_packing bed.dump --vessel-radius 0.305 --csv other.csv", reads);
  expect_failure("rod_contacts bed.dump seed1.dump --csv seed1.dump", "is written by this run");
  expect_failure("rod_orientation bed.dump --csv a.csv --summary-csv a.csv", twice);
  // Names below /proc lead to ordinary files too.
  expect_failure("rod_packing bed.dump --vessel-radius 0.305 --csv /proc/self/cwd/bed.dump", reads);
  std::filesystem::create_hard_link(folder() / "bed.dump", folder() / "bed.png");
  expect_failure("rod_render bed.dump --out bed.png", reads);
}

TEST_F(Programs, NoDisplayAndNoXvfb)
{
  // A PATH with nothing but the program.
  std::filesystem::create_symlink(kPrograms + "/rod_render", folder() / "rod_render");
  const auto before = files();
  EXPECT_EQ(run("env -u DISPLAY PATH=. ./rod_render bed.dump --out a.png"), 2);
  EXPECT_TRUE(files() == before);
  EXPECT_NE(error_.find("rod_render: no X display can be reached and the program xvfb-run is not "
                        "installed"),
            std::string::npos)
      << error_;
}

// Every malformed file through every program: one sentence with file and line, exit code 2.
TEST_F(Programs, MalformedFiles)
{
  const auto with = [&](const std::string &old_text, const std::string &new_text) {
    std::string text = bed_;
    const auto at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    return text.replace(at, old_text.size(), new_text);
  };
  const auto first_row = bed_.find('\n', bed_.find("ITEM: ATOMS")) + 1;
  const auto second_row = bed_.find('\n', first_row) + 1;
  const std::string row = bed_.substr(first_row, second_row - first_row);
  struct Case {
    std::string text, words;
  };
  const Case cases[] = {
      {"", "a.dump: is empty"},
      {"\x01\x02\x03 junk\n", "a.dump:1: "},
      {bed_.substr(0, bed_.size() / 2), "a.dump:"},
      {bed_.substr(0, second_row), "the file ends after 1 atoms of step 1000, wanted 30"},
      {with("\n30\n", "\n29\n"), "a.dump:39: "},
      {with("\n30\n", "\n31\n"), "the file ends after 30 atoms of step 1000, wanted 31"},
      {with("shapez", "shape"), "a.dump:9: column 'shapez' is missing"},
      {with("quat3", "q3"), "a.dump:9: column 'quat3' is missing"},
      {with(row, row + row), "a.dump:11: id 1 was already on line 10"},
      {with(row, "nan" + row.substr(1)), "a.dump:10: atom line 1: column 'id' is 'nan'"},
      {with(row, "1 1 0 0 inf 0 0 0 0 0 0 0.01 0.01 0.1 1 0 0 0 1\n"), "column 'z' is 'inf'"},
      {with(row, "1 1 0 0 0 0 0 0 0 0 0 0.01 0.01 0.1 0 0 0 0 1\n"),
       "a.dump:10: rod 1: the norm of quat1..4 is 0, wanted 1"},
      {with(row, "1 1 0 0 0 0 0 0 0 0 0 0.01 0.01 0.001 1 0 0 0 1\n"),
       "a.dump:10: rod 1: shapez is 0.001, wanted at least shapex, 0.01"},
      {dump_text({}, 0), "holds no rods"},
  };
  for (const Case &bad : cases) {
    write("a.dump", bad.text);
    expect_refusal("rod_packing a.dump --vessel-radius 1", bad.words);
    expect_refusal("rod_orientation a.dump", bad.words);
    expect_refusal("rod_contacts a.dump", bad.words);
    expect_refusal("rod_render a.dump --out a.png", bad.words);
    // Frames before the fault are whole files.
    if (bad.words != "holds no rods") expect_sentence("rod_vtk a.dump", bad.words);
  }
  expect_refusal("rod_packing missing.dump --vessel-radius 1", "missing.dump: cannot be opened");
  expect_refusal("rod_packing . --vessel-radius 1", ".: is a folder");
}

TEST_F(Programs, PackingOfFibres)
{
  const double r = 0.005, wedge = 4.0 / 3.0 * r * r * r, ball = M_PI * wedge, ring_bend = M_PI / 6;
  ASSERT_EQ(run("rod_packing fibres.dump --vessel-radius 0.5 --csv f.csv"), 0) << error_;
  EXPECT_NE(out_.find("27 rods, lambda 25.01 of whole fibres"), std::string::npos) << out_;
  EXPECT_NE(out_.find("3       of 26 segments"), std::string::npos) << out_;
  EXPECT_NE(out_.find(", 1 of them a ring"), std::string::npos) << out_;
  auto row = csv_row(read("f.csv"));
  EXPECT_EQ(row["rods"], 27.0);
  EXPECT_EQ(row["fibres"], 3.0);
  EXPECT_EQ(row["segments"], 26.0);
  EXPECT_EQ(row["rings"], 1.0);
  EXPECT_EQ(row["overlap_pairs"], 0.0);
  const double ring = 12 * 2 * 0.05 * std::sin(ring_bend / 2);
  const double cylinders = M_PI * r * r * (10 * 0.04 + 4 * 0.04 + ring + 0.1);
  const double bent =
      wedge * (9 * (std::tan(0.05) - 0.05) + 12 * (std::tan(ring_bend / 2) - ring_bend / 2));
  EXPECT_NEAR(row["rods_volume_m3"], cylinders + 3 * ball - bent, 1e-9 * cylinders);
  EXPECT_NEAR(row["lambda_mean"], (41.0 + 17.0 + ring / 0.01 + 11.0) / 4, 1e-6);
  // Without the columns they are rods, joints overlap, and nothing is said of fibres.
  write("rods.dump", fibres().dump(""));
  ASSERT_EQ(run("rod_packing rods.dump --vessel-radius 0.5 --csv r.csv"), 0) << error_;
  EXPECT_EQ(out_.find("fibres"), std::string::npos);
  EXPECT_EQ(read("r.csv").find("fibres"), std::string::npos);
  EXPECT_EQ(csv_row(read("r.csv"))["overlap_pairs"], 9 + 3 + 12.0);
  // Columns of other names, if they are said.
  write("other.dump", fibres().dump("c_a c_b"));
  ASSERT_EQ(run("rod_packing other.dump --vessel-radius 0.5 --csv o.csv --fibre-columns c_a c_b"),
            0);
  EXPECT_EQ(read("o.csv"), read("f.csv"));
}

TEST_F(Programs, OrientationOfFibres)
{
  ASSERT_EQ(run("rod_orientation fibres.dump --summary-csv s.csv --fibre-csv c.csv"), 0) << error_;
  auto row = csv_row(read("s.csv"));
  EXPECT_EQ(row["rods"], 27.0);
  EXPECT_EQ(row["near_pairs"], 0.0);
  const double chord = std::sin(0.5) / std::sin(0.05) / 10;
  EXPECT_NEAR(row["end_to_end_over_contour"], (chord + 1.0) / 2, 1e-9);
  EXPECT_NEAR(row["mean_curvature_per_m"],
              (0.1 / 0.04 + M_PI / 6 / (0.1 * std::sin(M_PI / 12))) / 3, 1e-6);
  EXPECT_EQ(csv_rows(read("c.csv")).size(), 12u);
  ASSERT_EQ(run("rod_orientation fibres.dump --by fibre --summary-csv s.csv"), 0) << error_;
  row = csv_row(read("s.csv"));
  EXPECT_EQ(row["rods"], 3.0);  // the ring has no end-to-end vector
  EXPECT_NEAR(row["mean_elevation_deg"], 0.45 / 3 * 180 / M_PI, 1e-6);
}

TEST_F(Programs, ContactsOfFibres)
{
  ASSERT_EQ(run("rod_contacts fibres.dump --floor 0 --csv c.csv"), 0) << error_;
  auto row = csv_row(read("c.csv"));
  EXPECT_EQ(row["pair_contacts"], 0.0);
  EXPECT_EQ(row["wall_contacts"], 5.0);  // of four segments in line on the floor
  EXPECT_EQ(row["contacts_on_shared_ends_left_out"], 3.0);
  EXPECT_EQ(row["contacts_per_fibre_with_walls"], 1.25);
  EXPECT_EQ(row["fibre_contacts"], 0.0);
  write("rods.dump", fibres().dump(""));
  ASSERT_EQ(run("rod_contacts rods.dump --csv r.csv"), 0) << error_;
  EXPECT_EQ(csv_row(read("r.csv"))["pair_contacts"], 24.0);
  EXPECT_EQ(read("r.csv").find("fibre"), std::string::npos);
}

TEST_F(Programs, FibresThatCannotBeUsed)
{
  write("one.dump", fibres().dump("f_fibres[1] c_p"));
  write("rods.dump", fibres().dump(""));
  FibreBed twice = fibres();
  twice.place[3] = 3;
  write("twice.dump", twice.dump());
  write("tilted.dump",
        fibres().dump("f_fibres[1] f_fibres[2]", "xy xz yz pp pp ff\n-1 1 0.1\n-1 1 0\n-1 11 0"));
  for (const std::string tool : {"rod_packing", "rod_orientation", "rod_contacts", "rod_vtk"}) {
    expect_refusal(tool + " one.dump", "one.dump:9: column 'f_fibres[2]' is missing");
    expect_refusal(tool + " twice.dump", "rod 4 is at place 3 of fibre 1, where rod 3 is too");
    expect_refusal(tool + " rods.dump --fibre-columns a b", "rods.dump:9: column 'a' is missing");
    expect_refusal(tool + " fibres.dump --meet 0.6",
                   "--meet: must be a number from 0 to 0.5 (got '0.6')");
    expect_refusal(tool + " fibres.dump --fibre-columns a", "--fibre-columns");
    expect_refusal(tool + " tilted.dump", "the periodic box is tilted");
  }
  expect_refusal("rod_orientation rods.dump --by fibre",
                 "--by: 'fibre' is wanted of a dump with columns of fibre and place");
  expect_failure("rod_orientation rods.dump --fibre-csv c.csv",
                 "--fibre-csv: wanted of a dump with columns of fibre and place");
  expect_refusal("rod_orientation fibres.dump --by rod", "--by");
  expect_refusal("rods_to_multisphere fibres.dump --spheres 9 --density 1",
                 "26 of its 27 rods are segments of fibres, wanted none: bodies of fix multisphere "
                 "do not bend");
  expect_refusal(
      "place_rods --lambda 3 --segments 5 --rods 9",
      "5 segments of a rod of aspect ratio 3 have joints 0.8 radii apart, wanted at least 1");
  expect_refusal("place_rods --segments 0", "--segments");
}

// place_rods makes fibres that the plug-in reads, and dumps as the programs read them.
TEST_F(Programs, FibresOfPlaceRods)
{
  ASSERT_EQ(run("place_rods --lambda 17 --rods 60 --solid 0.03 --segments 4 --out f.data"), 0)
      << error_;
  write(
      "in.fibres",
      "atom_style spherocylinder\nunits si\nboundary p p p\nnewton off\ncommunicate single vel yes\n"
      "read_data f.data\nneighbor 0.005 bin\nneigh_modify delay 0\n"
      "fix E all property/global youngsModulus peratomtype 1e7\n"
      "fix nu all property/global poissonsRatio peratomtype 0.3\n"
      "fix e all property/global coefficientRestitution peratomtypepair 1 0.5\n"
      "pair_style gran model hertz surface spherocylinder\npair_coeff * *\n"
      "fix joints all joint/spherocylinder\nfix move all nve/spherocylinder\ntimestep 1e-7\n"
      "dump d all custom 1 f.dump id type x y z shapex shapey shapez quat1 quat2 quat3 quat4 "
      "f_fibres[1] f_fibres[2]\n"
      "dump_modify d format \"%d %d %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g %g %g\"\n"
      "run 0\n");
  std::filesystem::create_directory(folder() / "mpi");
  ASSERT_EQ(
      run("env OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_orte_tmpdir_base=$PWD/mpi lmp -in in.fibres"),
      0)
      << out_ << error_;
  ASSERT_EQ(run("rod_packing f.dump --csv f.csv"), 0) << error_;
  auto row = csv_row(read("f.csv"));
  EXPECT_EQ(row["fibres"], 60.0);
  EXPECT_EQ(row["segments"], 240.0);
  EXPECT_NEAR(row["lambda_mean"], 17.0, 1e-9);
  EXPECT_NEAR(row["vf_whole"], 0.03, 1e-6);  // the box has six digits
  EXPECT_EQ(row["overlap_pairs"], 0.0);
  ASSERT_EQ(run("rod_orientation f.dump --summary-csv s.csv"), 0) << error_;
  EXPECT_NEAR(csv_row(read("s.csv"))["end_to_end_over_contour"], 1.0, 1e-5);
}

// Fibres carry their numbers into the cells, each triangle is of one segment.
TEST_F(Programs, VtkFilesOfFibres)
{
  ASSERT_EQ(run("rod_vtk fibres.dump --out f"), 0) << error_;
  const std::string file = read("f_0000000007.vtp");
  for (const std::string name : {"fibre", "place", "curvature", "length"})
    EXPECT_NE(file.find("Name=\"" + name + "\""), std::string::npos) << name;
  ASSERT_EQ(run("rod_vtk fibres.dump --out s --geometry segments"), 0) << error_;
  EXPECT_NE(read("s_0000000007.vtp"), file);
  ASSERT_EQ(run("rod_vtk fibres.dump --out l --geometry lines"), 0) << error_;
}

}  // namespace
}  // namespace spherocylinder
