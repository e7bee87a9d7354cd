// SPDX-License-Identifier: GPL-2.0-or-later
// What a tool's page says a user may type.
#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace spherocylinder {

// The commands of a page's section "Examples": its lines that begin with `head`.
inline std::vector<std::string> examples_of_page(const std::string &page, const std::string &head)
{
  std::ifstream file(page);
  std::vector<std::string> commands;
  bool in_section = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("## ", 0) == 0) in_section = line == "## Examples";
    if (in_section && line.rfind(head, 0) == 0) commands.push_back(line);
  }
  return commands;
}

}  // namespace spherocylinder
