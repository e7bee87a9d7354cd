// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/row_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/parallel.h"
#include "io/text.h"

namespace spherocylinder {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

const char *skip_blanks(const char *at, const char *end)
{
  while (at != end && is_blank(*at)) at++;
  return at;
}

const char *skip_word(const char *at, const char *end)
{
  while (at != end && !is_blank(*at)) at++;
  return at;
}

// A finite number that is a whole word, as to_number of text.h, without looking for the word's end
// first. Returns the end of the word, or null.
const char *read_number(const char *at, const char *end, double &number)
{
  if (at != end && *at == '+') at++;
  const auto [stop, error] = std::from_chars(at, end, number);
  const bool good = error == std::errc{} && (stop == end || is_blank(*stop));
  return good && std::isfinite(number) ? stop : nullptr;
}

struct Piece {
  std::string_view text;
  std::size_t first_line;
};

// Cuts a block after line ends.
std::vector<Piece> pieces_of(const LineBlock &block)
{
  std::vector<Piece> pieces;
  std::size_t line = 0;
  for (std::string_view rest = block.text; !rest.empty();) {
    const std::size_t cut =
        rest.size() > kPieceBytes ? rest.find('\n', kPieceBytes) + 1 : rest.size();
    pieces.push_back({rest.substr(0, cut), line});
    line += static_cast<std::size_t>(std::count(rest.begin(), rest.begin() + cut, '\n'));
    rest.remove_prefix(cut);
  }
  return pieces;
}

}  // namespace

std::optional<RowParser::Failure> RowParser::append(const LineBlock &block,
                                                    std::vector<double> &values) const
{
  const std::size_t width = columns_.size();
  const std::size_t before = values.size();
  values.resize(before + block.lines * width);
  const std::vector<Piece> pieces = pieces_of(block);
  std::vector<std::optional<Failure>> failures(pieces.size());
  for_each_piece(pieces.size(), 1, [&](std::size_t i, std::size_t) {
    failures[i] = parse(pieces[i].text, values.data() + before + pieces[i].first_line * width);
  });
  for (std::size_t i = 0; i < pieces.size(); i++) {
    if (!failures[i]) continue;
    failures[i]->line += pieces[i].first_line;
    return failures[i];
  }
  return std::nullopt;
}

std::optional<RowParser::Failure> RowParser::parse(std::string_view text, double *out) const
{
  const char *at = text.data();
  const char *const end = at + text.size();
  for (std::size_t line = 0; at != end; line++, out += columns_.size()) {
    const auto *line_end = static_cast<const char *>(std::memchr(at, '\n', end - at));
    if (!parse_line(at, line_end, out)) {
      const std::string_view bad(at, line_end - at);
      return Failure{line, bad.substr(0, 5) == "ITEM:" ? "" : complaint(bad)};
    }
    at = line_end + 1;
  }
  return std::nullopt;
}

bool RowParser::parse_line(const char *at, const char *end, double *out) const
{
  for (const bool is_text : is_text_) {
    at = skip_blanks(at, end);
    if (at == end) return false;
    if (is_text) {
      at = skip_word(at, end);
    } else {
      at = read_number(at, end, *out++);
      if (at == nullptr) return false;
    }
  }
  return skip_blanks(at, end) == end;
}

// Reads a line that parse_line refused once more, word by word.
std::string RowParser::complaint(std::string_view line) const
{
  auto column = columns_.begin();
  for (const bool is_text : is_text_) {
    const auto word = take_word(line);
    if (word.empty()) return fmt::format("too few words, wanted {}", is_text_.size());
    if (is_text) continue;
    const auto number = to_number<double>(word);
    if (!number || !std::isfinite(*number))
      return fmt::format("column {} is {}, wanted a finite number", shown(*column), shown(word));
    column++;
  }
  return fmt::format("too many words, wanted {}", is_text_.size());
}

}  // namespace spherocylinder
