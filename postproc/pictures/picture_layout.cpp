// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/picture_layout.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "io/input_error.h"
#include "pictures/font.h"

namespace spherocylinder {
namespace {

// Parts of the width and of the height that rods and vessel have at least: if letters of this
// size are asked for, and if the size is left to us.
constexpr double kLeastRoom = 0.5;
constexpr double kGoodRoom = 0.7;

constexpr int kSmallestFont = 6;
constexpr int kUsualSmallestFont = 10;  // if there is room

const std::string kBelowSign = "≤ ", kAboveSign = "≥ ";  // of the same width

constexpr std::size_t kUsualCaption = 44;  // digits

// All lengths grow with the letters.
PictureLayout with_letters(int width, int height, int font_size, const PictureWords &words)
{
  const double letter = font_size, gap = letter;
  PictureLayout at{};
  at.font_size = font_size;
  at.caption_y = gap;
  at.scale_y = at.caption_y + 1.5 * letter;
  at.scale_thickness = std::max(2.0, 0.2 * letter);
  at.scale_label_y = at.scale_y + at.scale_thickness + 0.25 * letter;
  at.left = gap;
  at.bottom = at.scale_label_y + letter + gap;
  at.top = height - gap;
  at.right = width - gap;
  if (words.labels.empty()) return at;

  const TextSize title = size_of_text(words.title, font_size);
  for (const std::string &label : words.labels)
    at.labels_width =
        std::max<double>(at.labels_width, size_of_text(kAboveSign + label, font_size).width);
  at.bar_width = 1.2 * letter;
  at.label_gap = 0.4 * letter;
  const double column =
      std::max<double>(title.width, at.bar_width + at.label_gap + at.labels_width);
  at.bar_left = width - gap - column;
  at.right = at.bar_left - gap;
  const double title_height = title.height + 0.8 * letter;
  at.bar_height =
      std::min({0.6 * height, 30.0 * letter, at.top - at.bottom - title_height - 0.5 * letter});
  at.bar_bottom = 0.5 * (at.bottom + at.top - at.bar_height - title_height);
  at.title_y = at.bar_bottom + at.bar_height + 0.8 * letter;
  return at;
}

bool has_room(const PictureLayout &at, int width, int height, const PictureWords &words,
              double part)
{
  const int caption = std::max(size_of_text(words.caption, at.font_size).width,
                               size_of_text(std::string(kUsualCaption, '0'), at.font_size).width);
  const double labels = 1.3 * at.font_size * static_cast<double>(words.labels.size());
  return at.right - at.left >= part * width && at.top - at.bottom >= part * height &&
         at.left + caption <= width - at.left && at.bar_height >= labels;
}

// The largest letters up to `most` that leave this part of the picture to the rods; 0 if none do.
int largest_font(int most, int width, int height, const PictureWords &words, double part)
{
  for (int size = most; size >= kSmallestFont; size--)
    if (has_room(with_letters(width, height, size, words), width, height, words, part)) return size;
  return 0;
}

}  // namespace

std::string PictureWords::label(std::size_t i) const
{
  if (below && i == 0) return kBelowSign + labels[i];
  return above && i + 1 == labels.size() ? kAboveSign + labels[i] : labels[i];
}

std::string broken_into_lines(const std::string &text)
{
  constexpr std::size_t kLongest = 10;
  std::istringstream words(text);
  std::string lines;
  std::size_t length = 0;
  for (std::string word; words >> word;) {
    const bool fits = !lines.empty() && length + 1 + word.size() <= kLongest;
    if (!lines.empty()) lines += fits ? ' ' : '\n';
    lines += word;
    length = fits ? length + 1 + word.size() : word.size();
  }
  return lines;
}

PictureLayout lay_out(int width, int height, int font_size, const PictureWords &words)
{
  const int most = font_size > 0 ? font_size : std::max(height / 45, kUsualSmallestFont);
  int size = font_size > 0 ? 0 : largest_font(most, width, height, words, kGoodRoom);
  if (size == 0) size = largest_font(most, width, height, words, kLeastRoom);
  if (size == 0)
    throw InputError(fmt::format("--size: letters {} pixels high leave no room for the rods in a "
                                 "picture of {}x{}, wanted a larger one",
                                 kSmallestFont, width, height));
  if (font_size > 0 && size != font_size)
    throw InputError(fmt::format("--font-size: must be at most {} in a picture of {}x{} with these "
                                 "words, so that there is room for the rods (got {})",
                                 size, width, height, font_size));
  return with_letters(width, height, size, words);
}

}  // namespace spherocylinder
