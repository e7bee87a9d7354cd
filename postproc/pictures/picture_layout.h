// SPDX-License-Identifier: GPL-2.0-or-later
// Where rods, bars and letters stand in a picture. Pixels from its lower left corner.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spherocylinder {

struct PictureWords {
  std::string caption;
  std::string title;                  // of the colour bar, broken into lines
  std::vector<std::string> labels;    // beside the colour bar; none: no colour bar
  bool below = false, above = false;  // whether there are values beyond the ends of the bar

  // A label as it is drawn: those of ends with values beyond them have a sign before them.
  std::string label(std::size_t i) const;
};

struct PictureLayout {
  int font_size;
  double left, right, bottom, top;  // room for rods and vessel
  double caption_y, scale_y, scale_label_y, scale_thickness;
  double bar_left, bar_bottom, bar_width, bar_height;
  double label_gap;     // between the colour bar and the labels
  double labels_width;  // of the widest
  double title_y;       // lower edge
};

// The text cut into lines at blanks, none longer than its longest word or ten letters.
std::string broken_into_lines(const std::string &text);

// With letters as wanted or, for `font_size` 0, as large as fits well. A caption is taken for at
// least 44 digits wide, and labels to have a sign, so that the pictures of a film, whose captions differ, have letters of one
// size. Throws InputError if letters of that size, or if any, leave no room for the rods.
PictureLayout lay_out(int width, int height, int font_size, const PictureWords &words);

}  // namespace spherocylinder
