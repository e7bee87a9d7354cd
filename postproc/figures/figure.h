// SPDX-License-Identifier: GPL-2.0-or-later
// A figure as for a paper: one or more panels side by side, each with axes, curves, points with
// error bars, labels and a key. Drawn by VTK; needs an X display (see pictures/display.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/output_file.h"

namespace spherocylinder {

struct Colour {
  unsigned char red, green, blue;
};

// Eight colours that differ for every kind of colour vision, and in grey (Okabe and Ito 2008).
namespace okabe_ito {
constexpr Colour black{0, 0, 0}, orange{230, 159, 0}, sky_blue{86, 180, 233}, green{0, 158, 115},
    yellow{240, 228, 66}, blue{0, 114, 178}, vermilion{213, 94, 0}, purple{204, 121, 167};
}
constexpr Colour grey{105, 105, 105};

// Darker, of the same hue: letters are thinner than curves and symbols.
Colour for_letters(const Colour &colour);

enum class Dash { solid, dashed, dotted, dash_dotted };
enum class Marker { circle, square, diamond, triangle, bar };

struct Symbol {
  Marker marker = Marker::circle;
  Colour colour = okabe_ito::black;
  bool filled = true;
  double size = 13.0;  // across, in units of the figure's width and height
};

// Positions x, y are in the units of the panel's axes, all other lengths in those of the figure's
// width and height.
struct Point {
  double x, y;
};

struct Curve {
  std::vector<Point> points;
  Colour colour;
  Dash dash = Dash::solid;
  double width = 2.5;
};

struct Measured {
  double x, y, error;  // error bar from y - error to y + error; none if 0 or NaN
};

struct Series {
  std::vector<Measured> points;
  Symbol symbol;
};

// A strip across the whole panel.
struct Band {
  double low, high;  // y
  Colour colour;
  double opacity;
};

struct Label {
  Point at;  // left end, mid-height of the text
  double shift_x, shift_y;
  std::string text;
  Colour colour;
};

struct KeyEntry {
  std::string text;
  Colour colour;  // of the text
  std::optional<Symbol> symbol;
  std::optional<Dash> line;  // in the symbol's colour
};

struct Tick {
  double value;
  std::string text;  // a tick without text is drawn short
};

struct Axis {
  std::string title;
  double low, high;
  std::vector<Tick> ticks;

  bool holds(double value) const { return value >= low && value <= high; }
};

// An axis from `low` to at least `high`, both widened to round numbers, with ticks there and short
// ones halfway.
Axis round_axis(const std::string &title, double low, double high);

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Band> bands;
  std::vector<Curve> curves;
  std::vector<Series> series;
  std::vector<Label> labels;
  std::vector<KeyEntry> key;
  Point key_at{0.0, 1.0};  // upper left corner, as part of the panel's width and height
};

struct Figure {
  double width = 1200, height = 900;  // the text is 22 high: 10 points if printed 17 cm wide
  double right_margin = 30;           // beside each panel, for labels
  std::vector<Panel> panels;
};

// .png (twice as many pixels as units) or .svg (text as outlines) by the ending of the path. Throws
// InputError for another ending, or if the file cannot be written.
OutputFile open_figure(const std::string &path);
void write_figure(OutputFile &file, const Figure &figure);

}  // namespace spherocylinder
