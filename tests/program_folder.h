// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

// Where the programs to be tested are: the build's folder, or PROGRAM_FOLDER of the environment. So the
// tests of one build try another's programs, as .ci/run does with those of the sanitizers.
inline std::string program_folder(const std::string &built)
{
  const char *folder = std::getenv("PROGRAM_FOLDER");
  return folder ? std::filesystem::absolute(folder).string() : built;
}

inline std::string program_to_test(const std::filesystem::path &built)
{
  return program_folder(built.parent_path().string()) + "/" + built.filename().string();
}
