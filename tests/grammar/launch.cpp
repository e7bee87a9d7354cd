// SPDX-License-Identifier: GPL-2.0-or-later
#include "launch.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <sys/wait.h>

#include "judge.h"

namespace grammar {

namespace {

// As in tests/decks/deck_run.cpp: one rank needs no mpirun and its own session folder.
constexpr const char *kSingleRank =
    "OMPI_MCA_ess_singleton_isolated=1 OMPI_MCA_btl=self OMPI_MCA_pml=ob1 "
    "OMPI_MCA_orte_tmpdir_base=$PWD";
constexpr const char *kManyRanks =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_mpi_yield_when_idle=1 mpirun --oversubscribe --bind-to none";

}  // namespace

Ended run_lmp(const std::filesystem::path &folder, const std::string &lmp, int ranks,
              int time_limit)
{
  // KILL: LIGGGHTS takes SIGTERM as a wish to end the run.
  const std::string start =
      ranks == 1 ? fmt::format("env {} timeout -s KILL {}", kSingleRank, time_limit)
                 : fmt::format("env {} --timeout {} -np {}", kManyRanks, time_limit, ranks);
  const std::string command =
      fmt::format("cd {} && ASAN_OPTIONS=detect_leaks=0 {} {} -in in.deck > output 2>&1",
                  folder.string(), start, lmp);
  const auto began = std::chrono::steady_clock::now();
  const int status = std::system(command.c_str());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  std::ifstream in(folder / "output");
  Ended ended;
  ended.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  ended.in_time = took.count() < time_limit;
  ended.output = {std::istreambuf_iterator<char>(in), {}};
  return ended;
}

void check_end(const Ended &ended)
{
  if (!ended.in_time) throw Wrong("did not end in time");
  for (const char *word : {"Segmentation fault", "exited on signal", "AddressSanitizer",
                           "runtime error:", "terminate called"})
    if (ended.output.find(word) != std::string::npos)
      throw Wrong(std::string("ended by a signal: ") + word);
  if (ended.exit_code >= 128)
    throw Wrong(fmt::format("ended by a signal: exit code {}", ended.exit_code));
}

}  // namespace grammar
