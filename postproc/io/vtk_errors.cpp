// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/vtk_errors.h"

#include <fmt/format.h>

#include "io/input_error.h"

namespace spherocylinder {

VtkErrors::VtkErrors()
    : before_(vtkOutputWindow::GetInstance()),
      verbosity_(vtkLogger::GetCurrentVerbosityCutoff()),
      window_(vtkSmartPointer<vtkStringOutputWindow>::New())
{
  vtkOutputWindow::SetInstance(window_);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkErrors::~VtkErrors()
{
  vtkOutputWindow::SetInstance(before_);
  vtkLogger::SetStderrVerbosity(verbosity_);
}

// VTK writes "ERROR: In FILE, line N" and on the next line "CLASS (ADDRESS): WHAT".
void VtkErrors::expect_none(const std::string &what) const
{
  const std::string text = window_->GetOutput();
  const auto error = text.find("ERROR:");
  if (error == std::string::npos) return;
  const auto begin = text.find('\n', error) + 1;
  throw InputError(
      fmt::format("{} (VTK: {})", what, text.substr(begin, text.find('\n', begin) - begin)));
}

}  // namespace spherocylinder
