// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/png_file.h"

#include <fmt/format.h>

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

#include "io/input_error.h"

namespace spherocylinder {

void write_png(vtkRenderWindow *window, const std::string &path, int shrink)
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> smaller;
  smaller->SetInputConnection(grab->GetOutputPort());
  smaller->SetShrinkFactors(shrink, shrink, 1);
  smaller->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(smaller->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw InputError(fmt::format("{}: the picture could not be written", path));
}

}  // namespace spherocylinder
