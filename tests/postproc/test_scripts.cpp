// SPDX-License-Identifier: GPL-2.0-or-later
// scripts/setup, scripts/build and scripts/check with programs that stand in for apt-get, cmake,
// clang-format and clang-tidy: what they ask for, what they leave alone.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "scratch_folder.h"

namespace spherocylinder {
namespace {

namespace fs = std::filesystem;

class Scripts : public ScratchFolder {
 protected:
  void SetUp() override
  {
    const fs::path project = PROJECT_FOLDER;
    for (const char *part : {"scripts", "input"})
      fs::copy(project / part, folder() / part, fs::copy_options::recursive);
    fs::create_directories(folder() / "bin");
    fs::create_directories(folder() / "build/release");
  }

  void write_program(const std::string &name, const std::string &text)
  {
    write(name, "#!/bin/sh\n" + text);
    fs::permissions(folder() / name, fs::perms::owner_all);
  }

  // Exit code; what it says is in out.txt and error.txt.
  int run(const std::string &command)
  {
    const int status =
        std::system(fmt::format("cd '{0}' && PATH='{0}/bin':$PATH {1} >out.txt 2>error.txt",
                                folder().string(), command)
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // A machine that lacks two packages; `plan` is what `apt-get install -s` prints.
  void lack_packages(const std::string &plan)
  {
    write("plan", plan);
    write_program("bin/dpkg-query",
                  "case $* in *libvtk9-dev*|*xvfb*) exit 1 ;; esac\nprintf installed\n");
    write_program("bin/sudo", "exec \"$@\"\n");
    write_program("bin/apt-get", fmt::format(R"(echo "$*" >>'{0}/apt-get.calls'
case "$*" in
  *" -s "*) cat '{0}/plan'; [ ! -e '{0}/no_plan' ] || exit 100 ;;
esac
)",
                                             folder().string()));
  }
};

TEST_F(Scripts, SetupInstallsWhatIsMissing)
{
  lack_packages("NOTE: This is only a simulation!\nInst xvfb (1.0 Debian:12 [amd64])\n"
                "Inst libvtk9-dev (9.1 Debian:12 [amd64])\nConf xvfb (1.0 Debian:12 [amd64])\n");
  ASSERT_EQ(run("scripts/setup"), 0) << read("error.txt");
  EXPECT_EQ(read("apt-get.calls"),
            "update -q\n"
            "install -q -y --no-install-recommends -s libvtk9-dev xvfb\n"
            "install -q -y --no-install-recommends --no-remove libvtk9-dev xvfb\n");
}

TEST_F(Scripts, SetupForStudies)
{
  lack_packages("Inst snakemake (7.21.0-1 Debian:12 [all])\n");
  write_program("bin/dpkg-query", "case $* in *snakemake*) exit 1 ;; esac\nprintf installed\n");
  ASSERT_EQ(run("scripts/setup"), 0) << read("error.txt");
  EXPECT_EQ(read("apt-get.calls"), "");
  ASSERT_EQ(run("scripts/setup --studies"), 0) << read("error.txt");
  EXPECT_NE(read("apt-get.calls").find("--no-remove snakemake\n"), std::string::npos);
  EXPECT_EQ(run("scripts/setup --all"), 2);
  EXPECT_EQ(read("error.txt"), "setup: expected --studies, --check or nothing (got '--all')\n");
}

TEST_F(Scripts, SetupForChecks)
{
  lack_packages("Inst clang-tidy (1:14.0-55.7 Debian:12 [amd64])\n");
  write_program("bin/dpkg-query", "case $* in *clang-tidy*) exit 1 ;; esac\nprintf installed\n");
  ASSERT_EQ(run("scripts/setup --studies --check"), 0) << read("error.txt");
  EXPECT_NE(read("apt-get.calls").find("--no-remove clang-tidy\n"), std::string::npos);
}

// As on a machine with ParaView: its Python and VTK's exclude each other.
TEST_F(Scripts, SetupRemovesNothing)
{
  lack_packages("Remv paraview [5.11.0+dfsg-1]\nRemv python3-paraview [5.11.0+dfsg-1]\n"
                "Inst python3-vtk9 (9.1 Debian:12 [amd64])\nInst xvfb (1.0 Debian:12 [amd64])\n");
  EXPECT_EQ(run("scripts/setup"), 1);
  EXPECT_EQ(read("error.txt"),
            "setup: to install libvtk9-dev xvfb apt-get would remove paraview python3-paraview: "
            "nothing is installed\n"
            "setup: remove those first if you can do without them, or use another machine or a "
            "container\n");
  EXPECT_EQ(read("apt-get.calls"),
            "update -q\ninstall -q -y --no-install-recommends -s libvtk9-dev xvfb\n");
}

TEST_F(Scripts, SetupWithoutAPlan)
{
  lack_packages("E: Unable to locate package libvtk9-dev\n");
  write("no_plan", "");
  EXPECT_EQ(run("scripts/setup"), 1);
  EXPECT_EQ(read("error.txt"),
            "E: Unable to locate package libvtk9-dev\n"
            "setup: apt-get cannot install libvtk9-dev xvfb: nothing is installed\n");
}

TEST_F(Scripts, BuildTakesTargets)
{
  write_program("bin/cmake", "echo \"$*\" >>cmake.calls\n");
  ASSERT_EQ(run("env -u CI scripts/build"), 0);
  ASSERT_EQ(run("env -u CI scripts/build dev"), 0);
  ASSERT_EQ(run("env CI=1 scripts/build release lmp rod_packing"), 0);
  EXPECT_EQ(read("cmake.calls"), "--preset release\n--build --preset release\n"
                                 "--preset dev\n--build --preset dev\n"
                                 "--preset release -DCMAKE_COMPILE_WARNING_AS_ERROR=ON\n"
                                 "--build --preset release --target lmp rod_packing\n");
}

TEST_F(Scripts, CheckAsksBothTools)
{
  write_program("bin/clang-format", "echo \"format $*\" >>clang.calls\n");
  write_program("bin/clang-tidy", "echo \"tidy $*\" >>clang.calls\n");
  fs::create_directories(folder() / "build/quick");
  write("build/quick/compile_commands.json",
        fmt::format("[{{\"file\": \"{}/built.cpp\"}}]\n", fs::canonical(folder()).string()));
  for (const char *file : {"built.cpp", "other.cpp", "some.h", "page.md"}) write(file, "");
  ASSERT_EQ(run("scripts/check *.cpp *.h *.md"), 0) << read("out.txt") << read("error.txt");
  EXPECT_EQ(read("clang.calls"), "format --dry-run -Werror built.cpp other.cpp some.h\n"
                                 "tidy -p build/quick --quiet built.cpp\n");
  write_program("bin/clang-tidy", "exit 1\n");
  EXPECT_NE(run("scripts/check built.cpp"), 0);
}

TEST_F(Scripts, CheckSaysWhatIsMissing)
{
  write_program("bin/clang-format", "");
  for (const char *tool : {"bash", "dirname"})
    fs::create_symlink(fs::path("/usr/bin") / tool, folder() / "bin" / tool);
  EXPECT_EQ(run("PATH=bin /usr/bin/bash scripts/check"), 1);
  EXPECT_EQ(read("error.txt"), "check: clang-tidy is missing, scripts/setup --check installs it\n");
}

}  // namespace
}  // namespace spherocylinder
