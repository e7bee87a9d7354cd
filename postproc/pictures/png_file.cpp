// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/png_file.h"

#include <fmt/format.h>

#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "io/input_error.h"
#include "io/output_file.h"

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
  writer->WriteToMemoryOn();
  writer->Write();
  if (writer->GetErrorCode() != 0)
    throw InputError(fmt::format("{}: VTK could not make the picture", path));
  vtkUnsignedCharArray *const bytes = writer->GetResult();
  write_file(path, std::string(reinterpret_cast<const char *>(bytes->GetPointer(0)),
                               static_cast<size_t>(bytes->GetNumberOfValues())));
}

}  // namespace spherocylinder
