// SPDX-License-Identifier: GPL-2.0-or-later
// The table of LIGGGHTS's styles against the installed LIGGGHTS: the maps of a LAMMPS object without
// the plug-in, the `...Style(` lines of its headers, and for what is in neither a list by hand (read in
// LIGGGHTS's Input::execute_command, Update::set_units, FixInsert and others), whose words must be in
// the library. Neither side may have a name that the other has not.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <mpi.h>

#include "force.h"
#include "host/private_members.h"
#include "input.h"
#include "lammps.h"
#include "loader/host_styles.h"
#include "modify.h"

using namespace LAMMPS_NS;

namespace spherocylinder {

namespace {

using Names = std::set<std::string>;

std::string read(const std::filesystem::path &file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Names table(HostKind kind)
{
  Names names;
  for (const HostStyle &row : host_styles())
    if (row.kind == kind) names.insert(row.name);
  return names;
}

template <typename Map>
Names keys(const Map &map)
{
  Names names;
  for (const auto &entry : map) names.insert(entry.first);
  return names;
}

// The first words of `macro(name,Class)`, or the second where the name comes second, in all headers.
Names in_headers(const std::string &macro, bool second = false)
{
  const std::regex line("^\\s*" + macro + "\\s*\\(\\s*([^,]+),\\s*([^,)]+)");
  Names names;
  for (const auto &entry : std::filesystem::directory_iterator(LIGGGHTS_HEADERS)) {
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string text; std::getline(in, text);)
      if (std::regex_search(text, match, line)) names.insert(match[second ? 2 : 1]);
  }
  return names;
}

// Models name themselves in capitals first: NORMAL_MODEL(HERTZ,hertz,3); the macros' own definitions
// use other words.
Names models(const std::string &macro)
{
  Names names = in_headers(macro, true);
  for (const char *parameter : {"NAME", " NAME", "str", "name"}) names.erase(parameter);
  return names;
}

void expect_same(const Names &table, const Names &host, const std::string &what)
{
  for (const std::string &name : host)
    EXPECT_TRUE(table.count(name)) << what << " " << name << " of LIGGGHTS is not in the table";
  for (const std::string &name : table)
    EXPECT_TRUE(host.count(name)) << what << " " << name << " of the table is not in LIGGGHTS";
}

class HostNames : public testing::Test {
 protected:
  static void SetUpTestSuite()
  {
    MPI_Init(nullptr, nullptr);
    const char *words[] = {"host", "-log", "none", "-screen", "none"};
    lammps = new LAMMPS(5, const_cast<char **>(words), MPI_COMM_WORLD);
  }
  static void TearDownTestSuite()
  {
    delete lammps;
    MPI_Finalize();
  }
  static LAMMPS *lammps;
};

LAMMPS *HostNames::lammps = nullptr;

// Debian's build leaves out what is between #ifdef SUPERQUADRIC_ACTIVE_FLAG, the headers list it.
Names without_superquadrics(Names names)
{
  for (auto at = names.begin(); at != names.end();)
    at = at->find("superquadric") != std::string::npos ? names.erase(at) : std::next(at);
  return names;
}

TEST_F(HostNames, OfTheMaps)
{
  expect_same(table(HostKind::Fix), keys(fix_styles(*lammps->modify)), "fix");
  expect_same(table(HostKind::Compute), keys(compute_styles(*lammps->modify)), "compute");
  expect_same(table(HostKind::Command), keys(command_styles(*lammps->input)), "command");
  Names pairs = keys(*lammps->force->pair_map);
  pairs.insert("none");  // Force::create_pair asks for it by name
  expect_same(table(HostKind::Pair), pairs, "pair style");
}

TEST(HostHeaders, OfTheMapsToo)
{
  expect_same(table(HostKind::Fix), without_superquadrics(in_headers("FixStyle")), "fix");
  expect_same(table(HostKind::Compute), without_superquadrics(in_headers("ComputeStyle")),
              "compute");
  expect_same(table(HostKind::Command), in_headers("CommandStyle"), "command");
}

TEST(HostHeaders, OfStylesWithoutAMap)
{
  expect_same(table(HostKind::AtomStyle), in_headers("AtomStyle"), "atom style");
  expect_same(table(HostKind::Dump), in_headers("DumpStyle"), "dump");
  expect_same(table(HostKind::Region), in_headers("RegionStyle"), "region");
  expect_same(table(HostKind::Reader), in_headers("ReaderStyle"), "reader");
  expect_same(table(HostKind::Integrate), in_headers("IntegrateStyle"), "run style");
  expect_same(table(HostKind::Minimize), in_headers("MinimizeStyle"), "min style");
  expect_same(table(HostKind::MeshModule), in_headers("MeshModuleStyle"), "mesh module");
  expect_same(table(HostKind::MeshMover), in_headers("MeshMoverStyle"), "mesh mover");
  expect_same(table(HostKind::CfdCoupling), in_headers("CfdDataCouplingStyle"), "coupling");
}

TEST(HostHeaders, OfMolecularStyles)
{
  Names host;
  for (const auto &[macro, word] :
       std::map<std::string, std::string>{{"BondStyle", "bond "},
                                          {"AngleStyle", "angle "},
                                          {"DihedralStyle", "dihedral "},
                                          {"ImproperStyle", "improper "},
                                          {"KSpaceStyle", "kspace "}})
    for (const std::string &name : in_headers(macro)) host.insert(word + name);
  expect_same(table(HostKind::Molecular), host, "molecular style");
}

TEST(HostHeaders, OfContactModels)
{
  expect_same(table(HostKind::Surface), models("SURFACE_MODEL"), "surface model");
  expect_same(table(HostKind::Normal), models("NORMAL_MODEL"), "normal model");
  expect_same(table(HostKind::Tangential), models("TANGENTIAL_MODEL"), "tangential model");
  expect_same(table(HostKind::Cohesion), models("COHESION_MODEL"), "cohesion model");
  expect_same(table(HostKind::Rolling), models("ROLLING_MODEL"), "rolling model");
}

// The linker keeps one copy of words with the same end, so that a word is looked for with the zero
// after it; a compiler may have turned the shortest into numbers.
void expect_words_in_library(const Names &names)
{
  static const std::string library = read(LIGGGHTS_LIBRARY);
  for (const std::string &name : names)
    EXPECT_TRUE(name.size() < 5 || library.find(name + '\0') != std::string::npos)
        << name << " is not in the library";
}

TEST(HostWords, OfWhatHasNoMapAndNoHeader)
{
  // clang-format off
  const std::map<HostKind, Names> by_hand = {
      {HostKind::BuiltIn,
       {"angle_coeff", "angle_style", "atom_modify", "atom_style", "bond_coeff", "bond_style",
        "boundary", "box", "clear", "communicate", "compute", "compute_modify", "dielectric",
        "dihedral_coeff", "dihedral_style", "dimension", "dump", "dump_modify", "echo", "fix",
        "fix_modify", "force_dt_reset", "group", "hard_particles", "if", "improper_coeff",
        "improper_style", "include", "jump", "kspace_modify", "kspace_style", "label", "lattice",
        "log", "mass", "min_modify", "min_style", "modify_timing", "neighbor", "newton", "next",
        "package", "pair_coeff", "pair_modify", "pair_style", "pair_write", "partition", "print",
        "processors", "quit", "region", "reset_timestep", "restart", "run_style", "shell",
        "soft_particles", "special_bonds", "suffix", "thermo", "thermo_log", "thermo_modify",
        "thermo_style", "timestep", "uncompute", "undump", "unfix", "units", "variable",
        "write_restart_on_signal"}},
      {HostKind::Units, {"cgs", "electron", "lj", "metal", "micro", "nano", "real", "si"}},
      {HostKind::WallPrimitive,
       {"xcylinder", "xplane", "ycylinder", "yplane", "zcylinder", "zplane"}},
      {HostKind::Insertion,
       {"all_in", "check_dist_from_subdomain_border", "compress_tags",
        "distributiontemplate", "duration", "duration_time", "extrude_length", "insert_every",
        "insert_every_time", "insertion_face", "mass", "mass_in_region", "massrate", "maxattempt",
        "nparticles", "ntry_mc", "omega", "orientation", "overlapcheck", "parallel",
        "particlerate", "particles_in_region", "random_distribute", "region", "save_template",
        "seed", "set_property", "start", "vel", "verbose", "volumefraction_region",
        "warn_region"}}};
  // clang-format on
  for (const auto &[kind, names] : by_hand) {
    expect_same(table(kind), names, word_for(kind));
    expect_words_in_library(names);
  }
}

}  // namespace

}  // namespace spherocylinder
