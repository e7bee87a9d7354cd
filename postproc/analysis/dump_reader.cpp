// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/dump_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "analysis/input_error.h"
#include "analysis/text.h"

namespace spherocylinder {
namespace {

constexpr double largest_id = 9007199254740992.0;  // 2^53, the last whole number a double counts to

constexpr std::string_view item_step = "ITEM: TIMESTEP";
constexpr std::string_view item_count = "ITEM: NUMBER OF ATOMS";
constexpr std::string_view item_box = "ITEM: BOX BOUNDS";
constexpr std::string_view item_atoms = "ITEM: ATOMS";
constexpr std::string_view item_time = "ITEM: TIME";

bool starts_with(std::string_view text, std::string_view head)
{
  return text.substr(0, head.size()) == head;
}

bool is_item(std::string_view line) { return starts_with(line, "ITEM:"); }

}  // namespace

DumpReader::DumpReader(const std::string &path) : path_(path)
{
  if (std::filesystem::is_directory(path))
    throw InputError(fmt::format("{}: is a folder, wanted a dump file", path));
  file_.open(path, std::ios::binary);
  if (!file_) throw InputError(fmt::format("{}: cannot be opened for reading", path));
}

void DumpReader::fail(const std::string &what) const
{
  throw InputError(fmt::format("{}:{}: {}", path_, line_number_, what));
}

// LIGGGHTS ends every line with a line end, so that a line without one was cut off.
bool DumpReader::read_line()
{
  if (!std::getline(file_, buffer_)) {
    if (file_.bad()) fail("cannot be read any further");
    return false;
  }
  ++line_number_;
  if (file_.eof()) fail("the file is cut off within this line, wanted a line end");
  line_ = trimmed_end(buffer_);
  return true;
}

void DumpReader::need_line(std::string_view what)
{
  if (!read_line()) fail(fmt::format("the file ends here, wanted {}", what));
}

std::int64_t DumpReader::integer_line(std::string_view what)
{
  need_line(what);
  std::string_view rest = line_;
  const auto number = to_number<std::int64_t>(take_word(rest));
  if (!number || *number < 0 || !rest.empty())
    fail(fmt::format("{} is {}, wanted a whole number >= 0", what, shown(line_)));
  return *number;
}

bool DumpReader::next(DumpFrame &frame)
{
  do {
    if (!read_line()) {
      if (any_frame_) return false;
      throw InputError(fmt::format("{}: {}, wanted a dump that begins with '{}'", path_,
                                   line_number_ == 0 ? "is empty" : "holds no text", item_step));
    }
  } while (line_.empty());
  if (line_ != item_step)
    fail(fmt::format("{}, wanted '{}'{}", shown(line_), item_step,
                     any_frame_ ? " or the end of the file (more atom lines than the header says?)"
                                : ": not a LIGGGHTS dump file"));

  frame.path = path_;
  frame.step = integer_line("the time step");
  frame.time.reset();
  std::int64_t count = -1;
  bool have_box = false;
  while (true) {
    need_line("an 'ITEM:' line");
    if (line_ == item_count) {
      count = integer_line("the number of atoms");
    } else if (starts_with(line_, item_box)) {
      read_box(frame);
      have_box = true;
    } else if (line_ == item_time) {
      need_line("the time");
      const auto time = to_number<double>(line_);
      if (!time || !std::isfinite(*time))
        fail(fmt::format("the time is {}, wanted a finite number", shown(line_)));
      frame.time = time;
    } else if (starts_with(line_, item_atoms)) {
      break;
    } else if (starts_with(line_, "ITEM: UNITS") || starts_with(line_, "ITEM: LABEL")) {
      need_line("a word");
    } else {
      fail(fmt::format("{}, wanted '{}', '{}' or '{}'", shown(line_), item_count, item_box,
                       item_atoms));
    }
  }
  if (count < 0) fail(fmt::format("'{}' came before '{}'", item_atoms, item_count));
  if (!have_box) fail(fmt::format("'{}' came before '{}'", item_atoms, item_box));

  read_columns(line_.substr(item_atoms.size()), frame);
  read_rows(frame, count);
  check_ids(frame);
  any_frame_ = true;
  return true;
}

// "BOX BOUNDS ff ff ff" has two numbers a line; a tilted box ("xy xz yz ff ff ff") has three.
void DumpReader::read_box(DumpFrame &frame)
{
  frame.box_is_tilted = line_.find(" xy ") != std::string_view::npos;
  for (auto &bounds : frame.box) {
    need_line("the bounds of the box");
    std::string_view rest = line_;
    for (double &bound : bounds) {
      const auto number = to_number<double>(take_word(rest));
      if (!number || !std::isfinite(*number))
        fail(fmt::format("the bounds of the box are {}, wanted two finite numbers", shown(line_)));
      bound = *number;
    }
    if (bounds[1] < bounds[0])
      fail(fmt::format("the upper bound of the box is {}, wanted >= {}", bounds[1], bounds[0]));
  }
}

void DumpReader::read_columns(std::string_view names, DumpFrame &frame)
{
  frame.header_line = line_number_;
  frame.columns.clear();
  is_text_.clear();
  for (auto name = take_word(names); !name.empty(); name = take_word(names)) {
    is_text_.push_back(name == "element");
    if (is_text_.back()) continue;
    if (frame.find_column(name)) fail(fmt::format("column {} appears twice", shown(name)));
    frame.columns.emplace_back(name);
  }
  if (!frame.find_column("id")) fail("column 'id' is missing");
}

void DumpReader::read_rows(DumpFrame &frame, std::int64_t count)
{
  frame.values.clear();
  frame.rows = 0;
  for (std::int64_t row = 0; row < count; ++row) {
    if (!read_line())
      fail(fmt::format("the file ends after {} atoms of step {}, wanted {}", row, frame.step,
                       count));
    if (is_item(line_))
      fail(fmt::format("step {} has {} atom lines, wanted {}", frame.step, row, count));
    read_row(frame, frame.rows);
    ++frame.rows;
  }
}

void DumpReader::read_row(DumpFrame &frame, std::size_t row)
{
  std::string_view rest = line_;
  std::size_t column = 0;
  for (const bool is_text : is_text_) {
    const auto word = take_word(rest);
    if (word.empty())
      fail(fmt::format("atom line {} has too few words, wanted {}", row + 1, is_text_.size()));
    if (is_text) continue;
    const auto number = to_number<double>(word);
    if (!number || !std::isfinite(*number))
      fail(fmt::format("column '{}' is {}, wanted a finite number", frame.columns[column],
                       shown(word)));
    frame.values.push_back(*number);
    ++column;
  }
  if (!take_word(rest).empty())
    fail(fmt::format("atom line {} has too many words, wanted {}", row + 1, is_text_.size()));
}

void DumpReader::check_ids(const DumpFrame &frame) const
{
  const std::size_t column = *frame.find_column("id");
  std::vector<std::pair<double, std::size_t>> ids(frame.rows);
  for (std::size_t row = 0; row < frame.rows; ++row) {
    ids[row] = {frame.value(row, column), row};
    if (ids[row].first != std::floor(ids[row].first) || std::abs(ids[row].first) > largest_id)
      throw InputError(fmt::format("{}:{}: id is {}, wanted a whole number", path_,
                                   frame.line_of(row), ids[row].first));
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(
      ids.begin(), ids.end(), [](const auto &a, const auto &b) { return a.first == b.first; });
  if (twice != ids.end())
    throw InputError(fmt::format("{}:{}: id {} was already on line {}, wanted each id once", path_,
                                 frame.line_of((twice + 1)->second), twice->first,
                                 frame.line_of(twice->second)));
}

}  // namespace spherocylinder
