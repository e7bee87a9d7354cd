// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/deck_numbers.h"

#include <climits>
#include <cmath>
#include <cstdlib>

#include "host/rod_error.h"

using namespace LAMMPS_NS;

double LAMMPS_NS::deck_number(LAMMPS *lmp, const std::string &who, const std::string &what,
                              const std::string &word)
{
  char *end = nullptr;
  const double value = strtod(word.c_str(), &end);
  // strtod would also take nan, inf and hexadecimal numbers.
  if (word.find_first_not_of("+-.0123456789eE") != std::string::npos || *end != '\0' ||
      end == word.c_str() || !std::isfinite(value))
    rod_error_all(lmp, "%s: %s must be a number (got %s)", who.c_str(), what.c_str(), word.c_str());
  return value;
}

int LAMMPS_NS::deck_whole_number(LAMMPS *lmp, const std::string &who, const std::string &what,
                                 const std::string &word)
{
  const double value = deck_number(lmp, who, what, word);
  if (value != std::floor(value) || std::fabs(value) > INT_MAX)
    rod_error_all(lmp, "%s: %s must be a whole number (got %s)", who.c_str(), what.c_str(),
                  word.c_str());
  return static_cast<int>(value);
}

std::string LAMMPS_NS::fix_and_id(char **arg)
{
  return std::string("Fix ") + arg[2] + " (id " + arg[0] + ")";
}
