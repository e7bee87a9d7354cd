// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/rod_error.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "error.h"
#include "lammps.h"

using namespace LAMMPS_NS;

namespace {

std::string formatted(const char *format, va_list arguments)
{
  char text[512];
  vsnprintf(text, sizeof(text), format, arguments);
  return text;
}

}  // namespace

void LAMMPS_NS::rod_error_all(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->all(FLERR, text.c_str());
  std::abort();  // not reached: Error::all ends the program
}

void LAMMPS_NS::rod_error_one(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->one(FLERR, text.c_str());
  std::abort();  // not reached: Error::one ends the program
}

void LAMMPS_NS::rod_warning(LAMMPS *lmp, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  lmp->error->warning(FLERR, text.c_str());
  // A rank other than the first has no log file, and with -screen none or FILE no screen either.
  if (!lmp->screen && !lmp->logfile) fprintf(stderr, "WARNING: %s\n", text.c_str());
}
