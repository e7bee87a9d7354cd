// SPDX-License-Identifier: GPL-2.0-or-later
// The letters of pictures and figures: DejaVu Sans, which has the Greek ones.
#pragma once

#include <string>

class vtkTextProperty;

namespace spherocylinder {

// Throws InputError if the font's file cannot be read.
void need_font();

// Upright, `size` pixels high.
void set_font(vtkTextProperty *style, int size);

struct TextSize {
  int width, height;  // pixels
};

// Of a text of one or more lines. Needs no display.
TextSize size_of_text(const std::string &words, int font_size);

}  // namespace spherocylinder
