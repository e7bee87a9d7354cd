// SPDX-License-Identifier: GPL-2.0-or-later
// What VTK complains of while it draws. It goes on then, with a black or incomplete picture.
#pragma once

#include <string>

#include <vtkLogger.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>

namespace spherocylinder {

// Collects VTK's complaints, instead of printing them, for as long as it lives.
class DrawingErrors {
 public:
  DrawingErrors();
  ~DrawingErrors();
  DrawingErrors(const DrawingErrors &) = delete;
  DrawingErrors &operator=(const DrawingErrors &) = delete;

  // Throws InputError with these words and the first complaint if there was any error.
  void expect_none(const std::string &what) const;

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkSmartPointer<vtkStringOutputWindow> window_;
};

}  // namespace spherocylinder
