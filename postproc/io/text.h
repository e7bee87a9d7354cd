// SPDX-License-Identifier: GPL-2.0-or-later
// Words and numbers of a line of text.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace spherocylinder {

constexpr std::string_view kBlanks = " \t\r";

inline std::string_view trimmed_end(std::string_view text)
{
  const auto last = text.find_last_not_of(kBlanks);
  return last == std::string_view::npos ? std::string_view{} : text.substr(0, last + 1);
}

// Takes the first word off `text`; empty when there is none left.
inline std::string_view take_word(std::string_view &text)
{
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return text = {};
  const auto end = text.find_first_of(kBlanks, begin);
  const std::string_view word = text.substr(begin, end - begin);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end);
  return word;
}

// The whole word as a number, or nothing. Reads "nan" and "inf" too: ask std::isfinite.
template <class Number>
std::optional<Number> to_number(std::string_view word)
{
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

inline bool is_printable(char c) { return c >= ' ' && c <= '~'; }

inline bool is_printable(std::string_view text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return is_printable(c); });
}

// A number for a table on the screen, right-aligned; "-" if there is none.
inline std::string cell(double number, int width, int decimals)
{
  return std::isnan(number) ? fmt::format("{:>{}}", "-", width)
                            : fmt::format("{:{}.{}f}", number, width, decimals);
}

// Text from a file as it can be shown in a message: printable, not too long.
inline std::string shown(std::string_view text, std::size_t longest = 40)
{
  std::string out = "'";
  for (const char c : text.substr(0, longest)) out += is_printable(c) ? c : '?';
  return out + (text.size() > longest ? "...'" : "'");
}

}  // namespace spherocylinder
