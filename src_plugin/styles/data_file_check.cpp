// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/data_file_check.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "lmptype.h"
#include "rods/fibre_segments.h"

using namespace LAMMPS_NS;

namespace {

// LIGGGHTS's buffer for a line of a data file, its newline and closing 0 included.
constexpr size_t kLineBuffer = 256;

// A data file's axis may be off unit length by what printing six digits costs, no more.
constexpr double kAxisTolerance = 1e-5;

constexpr const char *kAtomColumns =
    "id type diameter length density x y z ux uy uz, and perhaps three image flags";
constexpr const char *kVelocityColumns = "id vx vy vz wx wy wz";
constexpr const char *kFibreColumns =
    "id fibre place, and as write_data writes it also ends q1 q2 q3 q4 bend_x bend_y twist";

// Found by the innermost reader of a word, told by look_through_data_file.
struct Fault {
  std::string text;
};

[[noreturn]] __attribute__((format(printf, 1, 2))) void fail(const char *format, ...)
{
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  throw Fault{text};
}

std::string shortened(const std::string &text)
{
  constexpr size_t kLongest = 60;
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

std::vector<std::string> words_of(std::string line)
{
  line.resize(std::min(line.find('#'), line.size()));
  std::vector<std::string> words;
  size_t end = 0;
  for (;;) {
    const size_t begin = line.find_first_not_of(" \t\n\r\f", end);
    if (begin == std::string::npos) return words;
    end = std::min(line.find_first_of(" \t\n\r\f", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
  }
}

double number(const std::string &word, const char *what)
{
  char *end = nullptr;
  const double value = strtod(word.c_str(), &end);
  // strtod would also take nan, inf and hexadecimal numbers.
  if (word.find_first_not_of("+-.0123456789eE") != std::string::npos || *end != '\0' ||
      end == word.c_str() || !std::isfinite(value))
    fail("%s must be a number (got %s)", what, shortened(word).c_str());
  return value;
}

long integer(const std::string &word, const char *what, long lowest, long highest)
{
  char *end = nullptr;
  errno = 0;
  const long value = strtol(word.c_str(), &end, 10);
  if (end == word.c_str() || *end != '\0' || errno != 0 || value < lowest || value > highest) {
    if (highest >= INT_MAX - 1)
      fail("%s must be an integer >= %ld (got %s)", what, lowest, shortened(word).c_str());
    fail("%s must be %ld to %ld, an integer (got %s)", what, lowest, highest,
         shortened(word).c_str());
  }
  return value;
}

class DataFile {
 public:
  DataFile(FILE *file, const DataFileSurroundings &surroundings)
      : file_(file), surroundings_(surroundings)
  {
  }

  void check()
  {
    if (!next_line()) return;  // the title; LIGGGHTS tells of an empty file
    read_header();
    for (bool goes_on = !line_.empty(); goes_on; goes_on = next_filled_line()) read_section();
  }

  long line_number() const { return number_; }
  long atom() const { return atom_; }
  bool has_fibres() const { return !lines_of_segments_.empty(); }

 private:
  FILE *file_;
  DataFileSurroundings surroundings_;
  std::string line_;
  long number_ = 0;  // of the line
  long atom_ = 0;    // whose line it is, 0 if none's
  long rods_ = 0, segments_ = 0;
  size_t columns_ = 0, fibre_columns_ = 0;
  std::unordered_map<long, long> lines_of_atoms_, lines_of_velocities_,
      lines_of_segments_;                                  // by id
  std::map<std::pair<long, long>, long> lines_of_places_;  // by fibre and place

  bool next_line()
  {
    line_.clear();
    atom_ = 0;
    int c = 0;
    while ((c = fgetc(file_)) != EOF && c != '\n') line_.push_back(static_cast<char>(c));
    if (c == EOF && line_.empty()) return false;
    number_++;
    if (line_.size() + 2 > kLineBuffer)
      fail("a line must be shorter than %zu characters (got %zu)", kLineBuffer - 1, line_.size());
    return true;
  }

  bool next_filled_line()
  {
    while (next_line())
      if (line_.find_first_not_of(" \t\r\f") != std::string::npos) return true;
    return false;
  }

  bool says(const char *words) const { return line_.find(words) != std::string::npos; }

  // Up to the first line with none of a header's words.
  void read_header()
  {
    while (next_line()) {
      line_.resize(std::min(line_.find('#'), line_.size()));
      const std::vector<std::string> words = words_of(line_);
      if (words.empty()) continue;
      bool is_of_a_fix = false;
      for (const std::string &header : surroundings_.fix_headers)
        is_of_a_fix = is_of_a_fix || says(header.c_str());
      if (is_of_a_fix) continue;
      if (says("atoms")) {
        rods_ = integer(words[0], "the number of atoms", 0, LONG_MAX);
      } else if (says("segments")) {
        segments_ = integer(words[0], "the number of segments", 0, LONG_MAX);
      } else if (says("atom types")) {
        const long types = integer(words[0], "the number of atom types", 1, INT_MAX);
        if (!surroundings_.adds) surroundings_.types = static_cast<int>(types);
      } else if (says("xlo xhi") || says("ylo yhi") || says("zlo zhi")) {
        read_box_line(words, says("xlo") ? 0 : says("ylo") ? 1 : 2);
      } else if (says("xy xz yz")) {
        for (int k = 0; k < 3; k++) number(words.at(k), "a tilt factor xy xz yz");
      } else if (!says("ellipsoids") && !says("lines") && !says("bonds") && !says("angles") &&
                 !says("dihedrals") && !says("impropers") && !says("types") &&
                 !says("extra bond per atom")) {
        return;
      }
    }
    line_.clear();
  }

  void read_box_line(const std::vector<std::string> &words, int d)
  {
    const char name = static_cast<char>('x' + d);
    const std::string what = std::string(1, name) + "lo and " + name + "hi";
    const double lo = number(words[0], what.c_str());
    const double hi = number(words.at(1), what.c_str());
    if (!(lo < hi))
      fail("%clo must be < %chi (got %s %s)", name, name, words[0].c_str(), words[1].c_str());
    if (surroundings_.adds) return;
    surroundings_.lo[d] = lo;
    surroundings_.hi[d] = hi;
  }

  // line_ is the section's name.
  void read_section()
  {
    const std::string name = joined(words_of(line_));
    if (is_ours(name)) {
      if (next_line() && !words_of(line_).empty())
        fail("the line after %s must be blank (got %s)", name.c_str(), shortened(line_).c_str());
      const long lines = name == "Fibres" ? segments_ : rods_;
      if (lines == 0 && name == "Fibres")
        fail("the header must say how many lines the Fibres section has, such as 12 segments");
      for (long k = 0; k < lines; k++) {
        if (!next_line())
          fail("the file ends after %ld of %ld lines of the %s section", k, lines, name.c_str());
        const std::vector<std::string> words = words_of(line_);
        if (name == "Atoms")
          read_atom(words);
        else if (name == "Fibres")
          read_segment(words);
        else
          read_velocity(words);
      }
      return;
    }
    const auto &own = surroundings_.fix_sections;
    const bool is_known = name == "Masses" || name == "Pair Coeffs" || name == "PairIJ Coeffs" ||
                          std::find(own.begin(), own.end(), name) != own.end();
    if (!is_known) {
      if (!name.empty() && name.find_first_of("0123456789+-.") == 0)
        fail("expected a section's name or the end of the file after %ld atoms, as the header says "
             "(got %s)",
             rods_, shortened(name).c_str());
      while (next_line()) continue;  // LIGGGHTS tells of an unknown section
      return;
    }
    // As many lines as its reader wants: up to the next section of numbers that is ours.
    while (next_line()) {
      const std::string other = joined(words_of(line_));
      if (is_ours(other)) return read_section();
    }
  }

  static bool is_ours(const std::string &name)
  {
    return name == "Atoms" || name == "Velocities" || name == "Fibres";
  }

  static std::string joined(const std::vector<std::string> &words)
  {
    std::string text;
    for (const std::string &word : words) text += (text.empty() ? "" : " ") + word;
    return text;
  }

  long id_of_line(const std::vector<std::string> &words, const char *section)
  {
    if (words.empty()) fail("a line of the %s section must not be blank", section);
    atom_ = integer(words[0], "an atom's id", 1, INT_MAX - 1);
    return atom_;
  }

  void read_atom(const std::vector<std::string> &words)
  {
    const long id = id_of_line(words, "Atoms");
    if (words.size() != 11 && words.size() != 14)
      fail("%zu columns, wanted 11 or 14: %s", words.size(), kAtomColumns);
    if (columns_ == 0) columns_ = words.size();
    if (words.size() != columns_)
      fail("%zu columns, wanted %zu as in the lines before", words.size(), columns_);
    const auto [earlier, is_new] = lines_of_atoms_.emplace(id, number_);
    if (!is_new) fail("this id has been given in line %ld already", earlier->second);

    integer(words[1], "type", 1, surroundings_.types);
    const double diameter = number(words[2], "diameter");
    const double length = number(words[3], "length");
    const double density = number(words[4], "density");
    if (diameter <= 0.0) fail("diameter must be > 0 (got %s)", words[2].c_str());
    if (length < diameter)
      fail("length is the total length and must be >= the diameter %s (got %s)", words[2].c_str(),
           words[3].c_str());
    if (density <= 0.0) fail("density must be > 0 (got %s)", words[4].c_str());
    for (int d = 0; d < 3; d++) {
      const char name[2] = {static_cast<char>('x' + d), '\0'};
      const double x = number(words[5 + d], name);
      const double lo = surroundings_.lo[d], hi = surroundings_.hi[d];
      if (!surroundings_.periodic[d] && !(x >= lo && x < hi))
        fail("%s must lie in the box, which is not periodic there, %g <= %s < %g (got %s)", name,
             lo, name, hi, words[5 + d].c_str());
    }
    const double u[3] = {number(words[8], "ux"), number(words[9], "uy"), number(words[10], "uz")};
    const double axis_length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    if (!(std::fabs(axis_length - 1.0) <= kAxisTolerance))
      fail("axis ux uy uz must have length 1 within %g (got %s %s %s, length %g)", kAxisTolerance,
           words[8].c_str(), words[9].c_str(), words[10].c_str(), axis_length);
    for (size_t k = 11; k < words.size(); k++)
      integer(words[k], "an image flag", -static_cast<long>(IMGMAX), IMGMAX - 1);
  }

  void read_velocity(const std::vector<std::string> &words)
  {
    const long id = id_of_line(words, "Velocities");
    if (words.size() != 7) fail("%zu columns, wanted 7: %s", words.size(), kVelocityColumns);
    if (lines_of_atoms_.count(id) == 0) fail("no such id in the Atoms section");
    const auto [earlier, is_new] = lines_of_velocities_.emplace(id, number_);
    if (!is_new) fail("its velocity has been given in line %ld already", earlier->second);
    const char *const names[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
    for (int k = 0; k < 6; k++) number(words[1 + k], names[k]);
  }

  void read_segment(const std::vector<std::string> &words)
  {
    if (surroundings_.adds)
      fail("a section Fibres cannot be added to rods that are there; use read_data without add");
    const long id = id_of_line(words, "Fibres");
    if (words.size() != 3 && words.size() != 11)
      fail("%zu columns, wanted 3 or 11: %s", words.size(), kFibreColumns);
    if (fibre_columns_ == 0) fibre_columns_ = words.size();
    if (words.size() != fibre_columns_)
      fail("%zu columns, wanted %zu as in the lines before", words.size(), fibre_columns_);
    if (lines_of_atoms_.count(id) == 0) fail("no such id in the Atoms section");
    const auto [earlier, is_new] = lines_of_segments_.emplace(id, number_);
    if (!is_new) fail("its fibre has been given in line %ld already", earlier->second);
    const long fibre = integer(words[1], "fibre", 1, INT_MAX - 1);
    const long place = integer(words[2], "place", 1, INT_MAX - 1);
    const auto [taken, is_free] = lines_of_places_.emplace(std::make_pair(fibre, place), number_);
    if (!is_free)
      fail(
          "place %ld of fibre %ld has been given in line %ld already, a joint would be named twice",
          place, fibre, taken->second);
    if (words.size() == 3) return;
    integer(words[3], "ends", 0, FibreSegments::kAllEnds);
    const char *const names[] = {"q1", "q2", "q3", "q4", "bend_x", "bend_y", "twist"};
    double squared = 0.0;
    for (int k = 0; k < 7; k++) {
      const double value = number(words[4 + k], names[k]);
      if (k < 4) squared += value * value;
    }
    if (!(std::fabs(std::sqrt(squared) - 1.0) <= kAxisTolerance))
      fail("q1 q2 q3 q4 must have length 1 within %g (got length %g)", kAxisTolerance,
           std::sqrt(squared));
  }
};

}  // namespace

DataFileVerdict LAMMPS_NS::look_through_data_file(FILE *file,
                                                  const DataFileSurroundings &surroundings)
{
  DataFile data(file, surroundings);
  std::string fault;
  try {
    data.check();
    return {"", data.has_fibres()};
  } catch (const Fault &found) {
    fault = found.text;
  } catch (const std::out_of_range &) {
    return {"line " + std::to_string(data.line_number()) + ": too few numbers", false};
  }
  std::string where = "line " + std::to_string(data.line_number());
  if (data.atom() > 0) where += ", atom " + std::to_string(data.atom());
  return {where + ": " + fault, false};
}
