// SPDX-License-Identifier: GPL-2.0-or-later
// A manual page as text: its headings, its links, and the runnable blocks of its examples.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace docs {

struct Block {
  std::string language;  // what stands behind the three backquotes
  std::string heading;   // the second-level heading it is under
  std::string text;
  int line = 0;  // of the opening backquotes, from 1
};

struct ManualPage {
  std::string name;                   // of the file, without .md
  std::vector<std::string> headings;  // of the second level, in order
  std::vector<std::string> anchors;   // of all headings, as GitHub makes them
  std::vector<Block> blocks;
  std::vector<std::string> links;  // targets inside the manual: no http
};

// What GoogleTest shows beside a test's name.
inline void PrintTo(const ManualPage &page, std::ostream *out) { *out << page.name << ".md"; }

ManualPage read_page(const std::filesystem::path &file);

// All pages of the manual, sorted by name.
std::vector<ManualPage> read_manual();

}  // namespace docs
