// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/dump_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "io/input_error.h"
#include "io/progress.h"
#include "io/row_parser.h"
#include "io/text.h"

namespace spherocylinder {
namespace {

// A double does not tell 2^53 from 2^53 + 1.
constexpr double kTooLargeId = 9007199254740992.0;

constexpr std::string_view kItemStep = "ITEM: TIMESTEP";
constexpr std::string_view kItemBox = "ITEM: BOX BOUNDS";
constexpr std::string_view kItemTime = "ITEM: TIME";

// What announces the number of rows, and the rows.
std::string_view item_count(DumpKind kind)
{
  return kind == DumpKind::Atoms ? "ITEM: NUMBER OF ATOMS" : "ITEM: NUMBER OF ENTRIES";
}

std::string_view item_rows(DumpKind kind)
{
  return kind == DumpKind::Atoms ? "ITEM: ATOMS" : "ITEM: ENTRIES";
}

std::string_view name_of_rows(DumpKind kind)
{
  return kind == DumpKind::Atoms ? "atoms" : "entries";
}

std::string_view name_of_row(DumpKind kind) { return kind == DumpKind::Atoms ? "atom" : "entry"; }

bool starts_with(std::string_view text, std::string_view head)
{
  return text.substr(0, head.size()) == head;
}

}  // namespace

DumpReader::DumpReader(const std::string &path, DumpKind kind) : lines_(path), kind_(kind) {}

void DumpReader::fail(const std::string &what) const
{
  throw InputError(fmt::format("{}:{}: {}", lines_.path(), lines_.line_number(), what));
}

bool DumpReader::read_line()
{
  if (!lines_.next_line(line_)) return false;
  line_ = trimmed_end(line_);
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
      throw InputError(fmt::format("{}: {}, wanted a dump that begins with '{}'", lines_.path(),
                                   lines_.line_number() == 0 ? "is empty" : "holds no text",
                                   kItemStep));
    }
  } while (line_.empty());
  if (line_ != kItemStep)
    fail(fmt::format("{}, wanted '{}'{}", shown(line_), kItemStep,
                     any_frame_ ? " or the end of the file (more lines than the header says?)"
                                : ": not a LIGGGHTS dump file"));

  const std::string_view count_line = item_count(kind_), rows_line = item_rows(kind_);
  frame.path = lines_.path();
  frame.step = integer_line("the time step");
  frame.time.reset();
  std::int64_t count = -1;
  bool have_box = false;
  while (true) {
    need_line("an 'ITEM:' line");
    if (line_ == count_line) {
      count = integer_line(fmt::format("the number of {}", name_of_rows(kind_)));
    } else if (starts_with(line_, kItemBox)) {
      read_box(frame);
      have_box = true;
    } else if (line_ == kItemTime) {
      need_line("the time");
      const auto time = to_number<double>(line_);
      if (!time || !std::isfinite(*time))
        fail(fmt::format("the time is {}, wanted a finite number", shown(line_)));
      frame.time = time;
    } else if (std::string_view head = line_.substr(0, rows_line.size() + 1);
               head == rows_line || head == std::string(rows_line) + " ") {
      break;
    } else if (starts_with(line_, "ITEM: UNITS") || starts_with(line_, "ITEM: LABEL")) {
      need_line("a word");
    } else {
      fail(fmt::format("{}, wanted '{}', '{}' or '{}'", shown(line_), count_line, kItemBox,
                       rows_line));
    }
  }
  if (count < 0) fail(fmt::format("'{}' came before '{}'", rows_line, count_line));
  if (!have_box) fail(fmt::format("'{}' came before '{}'", rows_line, kItemBox));

  read_columns(line_.substr(rows_line.size()), frame);
  read_rows(frame, count);
  if (kind_ == DumpKind::Atoms) check_ids(frame);
  any_frame_ = true;
  return true;
}

// The two letters of a direction: p periodic, f fixed, s shrink-wrapped, m the same with a minimum.
// Old files have none.
void DumpReader::read_boundary(std::string_view words, DumpFrame &frame)
{
  frame.periodic = {};
  auto word = take_word(words);
  if (word.empty()) return;
  for (bool &periodic : frame.periodic) {
    const bool known = word.size() == 2 && word.find_first_not_of("pfsm") == std::string_view::npos;
    if (!known || (word[0] == 'p') != (word[1] == 'p'))
      fail(fmt::format("the boundary flag of the box is {}, wanted pp or two of f, s and m",
                       shown(word)));
    periodic = word[0] == 'p';
    word = take_word(words);
  }
  if (!word.empty()) fail(fmt::format("{} after three boundary flags of the box", shown(word)));
}

// "BOX BOUNDS ff ff ff" has two numbers a line; a tilted box ("xy xz yz ff ff ff") has three.
void DumpReader::read_box(DumpFrame &frame)
{
  std::string_view words = line_.substr(kItemBox.size());
  constexpr std::string_view kTilts = " xy xz yz";
  frame.box_is_tilted = starts_with(words, kTilts);
  if (frame.box_is_tilted) words.remove_prefix(kTilts.size());
  read_boundary(words, frame);
  for (auto &bounds : frame.box) {
    need_line("the bounds of the box");
    std::string_view rest = line_;
    for (double &bound : bounds) {
      const auto number = to_number<double>(take_word(rest));
      if (!number || !std::isfinite(*number))
        fail(fmt::format("the bounds of the box are {}, wanted two finite numbers", shown(line_)));
      bound = *number;
    }
    if (frame.box_is_tilted && !to_number<double>(take_word(rest)))
      fail(fmt::format("the bounds of the box are {}, wanted a tilt behind them", shown(line_)));
    if (!take_word(rest).empty())
      fail(fmt::format("the bounds of the box are {}, wanted {} numbers", shown(line_),
                       frame.box_is_tilted ? 3 : 2));
    if (bounds[1] < bounds[0])
      fail(fmt::format("the upper bound of the box is {}, wanted >= {}", bounds[1], bounds[0]));
  }
}

void DumpReader::read_columns(std::string_view names, DumpFrame &frame)
{
  frame.header_line = lines_.line_number();
  frame.columns.clear();
  is_text_.clear();
  for (auto name = take_word(names); !name.empty(); name = take_word(names)) {
    is_text_.push_back(name == "element");
    if (is_text_.back()) continue;
    if (!is_printable(name))
      fail(fmt::format("the name of column {} is {}, wanted plain letters", is_text_.size(),
                       shown(name)));
    if (frame.find_column(name)) fail(fmt::format("column {} appears twice", shown(name)));
    frame.columns.emplace_back(name);
  }
  if (kind_ == DumpKind::Atoms && !frame.find_column("id")) fail("column 'id' is missing");
}

void DumpReader::read_rows(DumpFrame &frame, std::int64_t count)
{
  frame.values.clear();
  frame.rows = 0;
  const auto wanted = static_cast<std::size_t>(count);
  const RowParser parser(frame.columns, is_text_);
  Progress progress(fmt::format("{}: reading", lines_.path()));
  while (frame.rows < wanted) {
    const LineBlock block = lines_.next_lines(wanted - frame.rows);
    if (block.lines == 0)
      fail(fmt::format("the file ends after {} {} of step {}, wanted {}", frame.rows,
                       name_of_rows(kind_), frame.step, count));
    if (const auto failure = parser.append(block, frame.values)) {
      const std::size_t row = frame.rows + failure->line;
      const std::string what =
          failure->what.empty()
              ? fmt::format("step {} has {} {} lines, wanted {}", frame.step, row,
                            name_of_row(kind_), count)
              : fmt::format("{} line {}: {}", name_of_row(kind_), row + 1, failure->what);
      throw InputError(fmt::format("{}:{}: {}", lines_.path(), frame.line_of(row), what));
    }
    frame.rows += block.lines;
    progress.show(lines_.part_read());
  }
}

void DumpReader::check_ids(const DumpFrame &frame) const
{
  const std::size_t column = *frame.find_column("id");
  std::vector<std::pair<double, std::size_t>> ids(frame.rows);
  for (std::size_t row = 0; row < frame.rows; row++) {
    const double id = frame.value(row, column);
    if (!(id >= 1.0 && id < kTooLargeId && id == std::floor(id)))
      throw InputError(fmt::format("{}:{}: id is {}, wanted a whole number from 1 up, below 2^53",
                                   lines_.path(), frame.line_of(row), id));
    ids[row] = {id, row};
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(
      ids.begin(), ids.end(), [](const auto &a, const auto &b) { return a.first == b.first; });
  if (twice != ids.end())
    throw InputError(fmt::format("{}:{}: id {} was already on line {}, wanted each id once",
                                 lines_.path(), frame.line_of((twice + 1)->second), twice->first,
                                 frame.line_of(twice->second)));
}

}  // namespace spherocylinder
