// SPDX-License-Identifier: GPL-2.0-or-later
// A test with a folder of its own that goes away with it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace spherocylinder {

class ScratchFolder : public ::testing::Test {
 protected:
  ScratchFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "rods-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
  }

  ~ScratchFolder() override
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  const std::filesystem::path &folder() const { return folder_; }
  std::string path(const std::string &name) const { return (folder_ / name).string(); }

  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  std::string read(const std::string &name) const
  {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace spherocylinder
