// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

// Where the programs to be tested are: the build's folder, or PROGRAM_FOLDER of the environment, a whole
// path. So the tests of one build try another's programs, those with sanitizers for one.
inline std::string program_folder(const std::string &built)
{
  const char *folder = std::getenv("PROGRAM_FOLDER");
  return folder ? std::filesystem::absolute(folder).string() : built;
}

inline std::string program_to_test(const std::filesystem::path &built)
{
  return program_folder(built.parent_path().string()) + "/" + built.filename().string();
}
