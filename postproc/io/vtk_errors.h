// SPDX-License-Identifier: GPL-2.0-or-later
// What VTK complains of while it reads or draws. It goes on then, with a mesh or picture that is empty or
// incomplete.
#pragma once

#include <string>

#include <vtkLogger.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>

namespace spherocylinder {

// Collects VTK's complaints, instead of printing them, for as long as it lives.
class VtkErrors {
 public:
  VtkErrors();
  ~VtkErrors();
  VtkErrors(const VtkErrors &) = delete;
  VtkErrors &operator=(const VtkErrors &) = delete;

  // Throws InputError with these words and the first complaint if there was any error.
  void expect_none(const std::string &what) const;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkSmartPointer<vtkStringOutputWindow> window_;
};

}  // namespace spherocylinder
