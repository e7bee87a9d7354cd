// SPDX-License-Identifier: GPL-2.0-or-later
#include "figures/figure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkTextProperty.h>

#include "analysis/input_error.h"
#include "pictures/annotation.h"
#include "pictures/drawing_errors.h"
#include "pictures/font.h"
#include "pictures/png_file.h"

namespace spherocylinder {
namespace {

constexpr double text_height = 22.0;
constexpr double line_height = 31.0;  // of the key

// Places around a panel for the axes' numbers and titles.
struct Margins {
  double left = 105, bottom = 95, top = 25, title = 40;
};

// The rectangle a panel's axes span, from the lower left corner of the figure.
struct Area {
  double left, bottom, width, height;
};

void set_pen(vtkContext2D *painter, const Colour &colour, double width)
{
  vtkPen *pen = painter->GetPen();
  pen->SetColor(colour.red, colour.green, colour.blue);
  pen->SetOpacity(255);
  pen->SetWidth(static_cast<float>(width));
  pen->SetLineType(vtkPen::SOLID_LINE);
}

// Lengths of strokes and gaps in turn. VTK's own patterns are in pixels and differ between screen
// and SVG.
std::vector<double> pattern_of(Dash dash)
{
  switch (dash) {
    case Dash::dashed: return {12, 7};
    case Dash::dotted: return {2.5, 5};
    case Dash::dash_dotted: return {14, 6, 3, 6};
    case Dash::solid: break;
  }
  return {};
}

// A line through the points cut into its strokes.
std::vector<std::vector<Point>> strokes_of(const std::vector<Point> &points, Dash dash)
{
  const std::vector<double> pattern = pattern_of(dash);
  if (pattern.empty()) return {points};
  std::vector<std::vector<Point>> strokes{{points.front()}};
  std::size_t piece = 0;  // even: a stroke
  double left = pattern[0];
  for (std::size_t i = 1; i < points.size(); ++i) {
    Point at = points[i - 1];
    double length = std::hypot(points[i].x - at.x, points[i].y - at.y);
    while (length > left) {
      const double part = left / length;
      at = {at.x + part * (points[i].x - at.x), at.y + part * (points[i].y - at.y)};
      length -= left;
      if (piece % 2 == 0)
        strokes.back().push_back(at);
      else
        strokes.push_back({at});
      piece = (piece + 1) % pattern.size();
      left = pattern[piece];
    }
    left -= length;
    if (piece % 2 == 0) strokes.back().push_back(points[i]);
  }
  return strokes;
}

// Corners about the origin, one across.
std::vector<Point> outline_of(Marker marker)
{
  switch (marker) {
    case Marker::square: return {{-0.45, -0.45}, {0.45, -0.45}, {0.45, 0.45}, {-0.45, 0.45}};
    case Marker::diamond: return {{0, -0.65}, {0.65, 0}, {0, 0.65}, {-0.65, 0}};
    case Marker::triangle: return {{-0.6, -0.4}, {0.6, -0.4}, {0, 0.64}};
    case Marker::bar: return {{-1.0, -0.12}, {1.0, -0.12}, {1.0, 0.12}, {-1.0, 0.12}};
    case Marker::circle: break;
  }
  constexpr int corners = 40;
  std::vector<Point> circle;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / corners;
    circle.push_back({0.5 * std::cos(angle), 0.5 * std::sin(angle)});
  }
  return circle;
}

class FigureItem : public vtkContextItem {
 public:
  static FigureItem *New();
  vtkTypeMacro(FigureItem, vtkContextItem)

  void set(const Figure &figure, double scale)
  {
    figure_ = &figure;
    scale_ = scale;
  }

  bool Paint(vtkContext2D *painter) override
  {
    painter_ = painter;
    const double width = figure_->width / static_cast<double>(figure_->panels.size());
    for (std::size_t i = 0; i < figure_->panels.size(); ++i) {
      const Panel &panel = figure_->panels[i];
      const Margins margins;
      const double top = panel.title.empty() ? margins.top : margins.top + margins.title;
      area_ = {width * static_cast<double>(i) + margins.left, margins.bottom,
               width - margins.left - figure_->right_margin,
               figure_->height - margins.bottom - top};
      panel_ = &panel;
      paint_panel();
    }
    return true;
  }

 private:
  double x_of(double x) const
  {
    const Axis &axis = panel_->x;
    return area_.left + area_.width * (x - axis.low) / (axis.high - axis.low);
  }

  double y_of(double y) const
  {
    const Axis &axis = panel_->y;
    return area_.bottom + area_.height * (y - axis.low) / (axis.high - axis.low);
  }

  void line(double x0, double y0, double x1, double y1)
  {
    painter_->DrawLine(static_cast<float>(scale_ * x0), static_cast<float>(scale_ * y0),
                       static_cast<float>(scale_ * x1), static_cast<float>(scale_ * y1));
  }

  enum class Side { left, centre, right };

  void words(double x, double y, const std::string &text, const Colour &colour, Side side,
             bool upwards = false)
  {
    vtkTextProperty *style = painter_->GetTextProp();
    set_font(style, static_cast<int>(scale_ * text_height));
    style->SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
    style->SetJustification(side == Side::left     ? VTK_TEXT_LEFT
                            : side == Side::centre ? VTK_TEXT_CENTERED
                                                   : VTK_TEXT_RIGHT);
    style->SetVerticalJustificationToCentered();
    style->SetOrientation(upwards ? 90.0 : 0.0);
    painter_->DrawString(static_cast<float>(scale_ * x), static_cast<float>(scale_ * y),
                         text.c_str());
  }

  void symbol(double x, double y, const Symbol &symbol)
  {
    set_pen(painter_, symbol.colour, scale_ * 2.0);
    const Colour inside = symbol.filled ? symbol.colour : Colour{255, 255, 255};
    painter_->GetBrush()->SetColor(inside.red, inside.green, inside.blue, 255);
    std::vector<float> corners;
    for (const Point &p : outline_of(symbol.marker)) {
      corners.push_back(static_cast<float>(scale_ * (x + symbol.size * p.x)));
      corners.push_back(static_cast<float>(scale_ * (y + symbol.size * p.y)));
    }
    const int count = static_cast<int>(corners.size() / 2);
    painter_->DrawPolygon(corners.data(), count);
    corners.insert(corners.end(), corners.begin(), corners.begin() + 2);
    painter_->DrawPoly(corners.data(), count + 1);
  }

  void paint_panel()
  {
    paint_bands();
    paint_axes();
    for (const Curve &curve : panel_->curves) paint(curve);
    for (const Series &series : panel_->series) paint(series);
    for (const Label &label : panel_->labels)
      words(x_of(label.at.x) + label.shift_x, y_of(label.at.y) + label.shift_y, label.text,
            label.colour, Side::left);
    paint_key();
  }

  void paint_bands()
  {
    for (const Band &band : panel_->bands) {
      painter_->GetPen()->SetLineType(vtkPen::NO_PEN);
      painter_->GetBrush()->SetColor(band.colour.red, band.colour.green, band.colour.blue,
                                     static_cast<unsigned char>(255 * band.opacity));
      const double low = y_of(std::max(band.low, panel_->y.low));
      const double high = y_of(std::min(band.high, panel_->y.high));
      painter_->DrawRect(
          static_cast<float>(scale_ * area_.left), static_cast<float>(scale_ * low),
          static_cast<float>(scale_ * area_.width), static_cast<float>(scale_ * (high - low)));
    }
  }

  void paint_axes()
  {
    constexpr double tick = 9.0;
    const double right = area_.left + area_.width, top = area_.bottom + area_.height;
    set_pen(painter_, okabe_ito::black, scale_ * 1.5);
    line(area_.left, area_.bottom, right, area_.bottom);
    line(area_.left, area_.bottom, area_.left, top);
    for (const Tick &t : panel_->x.ticks) {
      line(x_of(t.value), area_.bottom, x_of(t.value),
           area_.bottom - (t.text.empty() ? 0.6 : 1.0) * tick);
      words(x_of(t.value), area_.bottom - 24, t.text, okabe_ito::black, Side::centre);
    }
    for (const Tick &t : panel_->y.ticks) {
      line(area_.left - (t.text.empty() ? 0.6 : 1.0) * tick, y_of(t.value), area_.left,
           y_of(t.value));
      words(area_.left - 15, y_of(t.value), t.text, okabe_ito::black, Side::right);
    }
    words(area_.left + 0.5 * area_.width, area_.bottom - 66, panel_->x.title, okabe_ito::black,
          Side::centre);
    words(area_.left - 78, area_.bottom + 0.5 * area_.height, panel_->y.title, okabe_ito::black,
          Side::centre, true);
    if (!panel_->title.empty())
      words(area_.left, top + 30, panel_->title, okabe_ito::black, Side::left);
  }

  // `points` in the figure's own lengths.
  void polyline(const std::vector<Point> &points, const Colour &colour, double width, Dash dash)
  {
    set_pen(painter_, colour, scale_ * width);
    for (const auto &stroke : strokes_of(points, dash)) {
      if (stroke.size() < 2) continue;
      std::vector<float> pixels;
      for (const Point &p : stroke) {
        pixels.push_back(static_cast<float>(scale_ * p.x));
        pixels.push_back(static_cast<float>(scale_ * p.y));
      }
      painter_->DrawPoly(pixels.data(), static_cast<int>(stroke.size()));
    }
  }

  void paint(const Curve &curve)
  {
    std::vector<Point> points;
    for (const Point &p : curve.points) points.push_back({x_of(p.x), y_of(p.y)});
    polyline(points, curve.colour, curve.width, curve.dash);
  }

  void paint(const Series &series)
  {
    constexpr double cap = 5.0;
    for (const Measured &m : series.points) {
      if (m.error > 0.0) {
        set_pen(painter_, series.symbol.colour, scale_ * 1.8);
        const double x = x_of(m.x), low = y_of(std::max(m.y - m.error, panel_->y.low)),
                     high = y_of(std::min(m.y + m.error, panel_->y.high));
        line(x, low, x, high);
        for (const double y : {low, high}) line(x - cap, y, x + cap, y);
      }
      symbol(x_of(m.x), y_of(m.y), series.symbol);
    }
  }

  void paint_key()
  {
    const double x = area_.left + panel_->key_at.x * area_.width;
    double y = area_.bottom + panel_->key_at.y * area_.height - 0.5 * line_height;
    for (const KeyEntry &entry : panel_->key) {
      const Colour colour = entry.symbol ? entry.symbol->colour : entry.colour;
      if (entry.line) polyline({{x, y}, {x + 50, y}}, colour, 2.0, *entry.line);
      if (entry.symbol) symbol(x + 25, y, *entry.symbol);
      words(x + (entry.symbol || entry.line ? 62 : 0), y, entry.text, entry.colour, Side::left);
      y -= line_height;
    }
  }

  const Figure *figure_ = nullptr;
  const Panel *panel_ = nullptr;
  vtkContext2D *painter_ = nullptr;
  double scale_ = 1.0;
  Area area_{};
};

vtkStandardNewMacro(FigureItem)

std::string ending_of(const std::string &path)
{
  return std::filesystem::path(path).extension();
}

// VTK gives the drawing a size in pixels but no viewBox, without which it cannot be shown at
// another size.
void add_view_box(const std::string &path, const Figure &figure)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  std::string svg = text.str();
  const std::string head = "<svg ";
  const auto at = svg.find(head);
  if (at == std::string::npos)
    throw InputError(fmt::format("{}: the figure could not be written", path));
  svg.insert(at + head.size(),
             fmt::format("viewBox=\"0 0 {:g} {:g}\" ", figure.width, figure.height));
  std::ofstream file(path);
  file << svg;
  file.close();
  if (!file) throw InputError(fmt::format("{}: could not be written to its end", path));
}

void write_svg(vtkRenderWindow *window, const OutputFile &file, const Figure &figure)
{
  vtkNew<vtkSVGExporter> exporter;
  exporter->SetRenderWindow(window);
  exporter->SetFileName(file.working_path().c_str());
  exporter->SetTitle(std::filesystem::path(file.path()).stem().c_str());
  exporter->SetDescription("");
  exporter->Write();
  add_view_box(file.working_path(), figure);
}

}  // namespace

Colour for_letters(const Colour &colour)
{
  constexpr double shade = 0.6;
  const auto darker = [](unsigned char part) { return static_cast<unsigned char>(shade * part); };
  return {darker(colour.red), darker(colour.green), darker(colour.blue)};
}

Axis round_axis(const std::string &title, double low, double high)
{
  const RoundRange range = round_range(low, high);
  Axis axis{title, range.low, range.high, {}};
  for (int i = 0; i < range.labels; ++i) {
    const double value = range.low + i * (range.high - range.low) / (range.labels - 1);
    axis.ticks.push_back({value, fmt::format("{:.6g}", value)});
    const double half = 0.5 * (range.high - range.low) / (range.labels - 1);
    if (i > 0) axis.ticks.push_back({value - half, ""});
  }
  return axis;
}

OutputFile open_figure(const std::string &path)
{
  if (ending_of(path) != ".png" && ending_of(path) != ".svg")
    throw InputError(fmt::format("--out: must end in .png or .svg (got '{}')", path));
  need_font();
  return OutputFile(path);
}

void write_figure(OutputFile &file, const Figure &figure)
{
  const bool is_png = ending_of(file.path()) == ".png";
  const double scale = is_png ? 2.0 : 1.0;
  const DrawingErrors errors;
  vtkNew<FigureItem> item;
  item->set(figure, scale);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(is_png ? 8 : 0);
  window->SetSize(static_cast<int>(scale * figure.width), static_cast<int>(scale * figure.height));
  window->AddRenderer(renderer);
  window->Render();
  if (is_png)
    write_png(window, file.working_path());
  else
    write_svg(window, file, figure);
  errors.expect_none(fmt::format("{}: the figure cannot be drawn", file.path()));
  file.finish();
}

}  // namespace spherocylinder
