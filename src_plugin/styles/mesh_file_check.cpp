// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/mesh_file_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>

using namespace LAMMPS_NS;

namespace {

bool is_number(const std::string &word)
{
  char *end = nullptr;
  const double value = strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' && std::isfinite(value);
}

// Some programs begin binary files with the word that text files begin with; after 80 bytes these say how
// many triangles of 50 bytes follow.
bool is_binary(std::istream &file)
{
  constexpr std::streamoff kHead = 84, kTriangle = 50;
  char head[kHead] = {};
  std::uint32_t triangles = 0;
  file.read(head, kHead);
  const bool has_head = file.gcount() == kHead;
  std::memcpy(&triangles, head + 80, sizeof triangles);
  file.clear();
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  file.seekg(0);
  return has_head && size == kHead + kTriangle * static_cast<std::streamoff>(triangles);
}

std::string at_line(int number, const std::string &what)
{
  return "line " + std::to_string(number) + ": " + what;
}

}  // namespace

std::string LAMMPS_NS::fault_of_stl_file(std::istream &file)
{
  constexpr int kCorners = 3;
  int number = 0, triangles = 0, corners = 0;
  if (is_binary(file)) return "";
  bool in_solid = false, in_facet = false, is_first = true;
  for (std::string line; std::getline(file, line);) {
    number++;
    line.resize(std::min(line.find('#'), line.size()));
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind.empty()) continue;
    if (is_first && kind != "solid") return "";
    is_first = false;
    if (kind == "solid" || kind == "endsolid") {
      in_solid = kind == "solid";
    } else if (kind == "facet") {
      if (!(words >> word)) return at_line(number, "a facet must have its normal (got none)");
      in_facet = true;
      corners = 0;
    } else if (kind == "vertex") {
      if (++corners > kCorners)
        return at_line(number, "a facet must have three vertices (got a fourth)");
      int numbers = 0;
      while (words >> word) numbers += is_number(word) ? 1 : kCorners + 1;
      if (numbers != kCorners)
        return at_line(number, "a vertex must have three numbers (got '" + line + "')");
    } else if (kind == "endfacet") {
      in_facet = false;
      triangles++;
    }
  }
  if (!in_solid && !in_facet) return "";
  return "it breaks off after " + std::to_string(triangles) +
         " triangles, without its last line endsolid";
}
