// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/font.h"

#include <fstream>

#include <fmt/format.h>

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "io/input_error.h"

namespace spherocylinder {

void need_font()
{
  if (!std::ifstream(FONT_FILE))
    throw InputError(
        fmt::format("the font {} cannot be read (Debian package fonts-dejavu-core)", FONT_FILE));
}

void set_font(vtkTextProperty *style, int size)
{
  style->SetFontFamily(VTK_FONT_FILE);
  style->SetFontFile(FONT_FILE);
  style->SetFontSize(size);
  style->ShadowOff();
  style->BoldOff();
  style->ItalicOff();
}

TextSize size_of_text(const std::string &words, int font_size)
{
  constexpr int kPointsAnInch = 72;  // so that points are pixels, as in VTK's windows
  vtkNew<vtkTextProperty> style;
  set_font(style, font_size);
  int box[4] = {0, -1, 0, -1};  // of its pixels, first and last
  vtkTextRenderer::GetInstance()->GetBoundingBox(style, vtkStdString(words), box, kPointsAnInch);
  return {box[1] - box[0] + 1, box[3] - box[2] + 1};
}

}  // namespace spherocylinder
