// SPDX-License-Identifier: GPL-2.0-or-later
// What stands beside the rods in a picture: colour bar, scale bar, caption.
#pragma once

#include <string>

#include <vtkActor2D.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

namespace spherocylinder {

// A length of 1, 2 or 5 times a power of ten, the largest that is not above `most` (> 0).
double round_length(double most);

// The range widened to round numbers (if it is empty, to something around it), and how many labels
// cut it into round steps.
struct RoundRange {
  double low, high;
  int labels;
};

RoundRange round_range(double low, double high);

// "100 mm", "2 m", "50 um".
std::string length_label(double metres);

struct Ink {
  double red, green, blue;
  int font_size;  // pixels of the picture as rendered
};

// Black on light, white on dark backgrounds.
Ink ink_for(const double background[3], int font_size);

// Positions are parts of the picture's width and height, from the lower left.
enum class TextAt { Foot, Middle };  // what of a text's height y means

vtkSmartPointer<vtkTextActor> text(const std::string &words, double x, double y, const Ink &ink,
                                   TextAt height = TextAt::Foot);
vtkSmartPointer<vtkActor2D> bar(double x, double y, double width, double thickness, const Ink &ink);
vtkSmartPointer<vtkActor2D> colour_bar(vtkLookupTable *colours, double x, double y, double width,
                                       double height);

}  // namespace spherocylinder
