// SPDX-License-Identifier: GPL-2.0-or-later
#include "manual_page.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>

namespace docs {

namespace {

// GitHub's rule: lower case, spaces to hyphens, everything but letters, digits, - and _ left out.
std::string anchor_of(const std::string &heading)
{
  std::string anchor;
  for (const unsigned char c : heading) {
    if (std::isalnum(c) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(c));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

void collect_links(const std::string &line, std::vector<std::string> &links)
{
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; it++)
    if ((*it)[1].str().rfind("http", 0) != 0) links.push_back((*it)[1]);
}

}  // namespace

ManualPage read_page(const std::filesystem::path &file)
{
  ManualPage page;
  page.name = file.stem();
  std::ifstream in(file);
  std::string line;
  bool in_block = false;
  for (int number = 1; std::getline(in, line); number++) {
    if (line.rfind("```", 0) == 0) {
      in_block = !in_block;
      if (in_block)
        page.blocks.push_back(
            {line.substr(3), page.headings.empty() ? "" : page.headings.back(), "", number});
    } else if (in_block) {
      page.blocks.back().text += line + "\n";
    } else if (line.rfind("#", 0) == 0) {
      const size_t level = line.find_first_not_of('#');
      const std::string heading = line.substr(line.find_first_not_of(' ', level));
      if (level == 2) page.headings.push_back(heading);
      page.anchors.push_back(anchor_of(heading));
    } else {
      collect_links(line, page.links);
    }
  }
  return page;
}

std::vector<ManualPage> read_manual()
{
  std::vector<ManualPage> pages;
  for (const auto &entry : std::filesystem::directory_iterator(DOCS_FOLDER))
    if (entry.path().extension() == ".md") pages.push_back(read_page(entry.path()));
  std::sort(pages.begin(), pages.end(),
            [](const ManualPage &a, const ManualPage &b) { return a.name < b.name; });
  return pages;
}

}  // namespace docs
