// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/rod_keywords.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "host/rod_error.h"
#include "rods/rod_threads.h"

using namespace LAMMPS_NS;

// A length (m), or 0 for `auto`.
static double close_skin_of(LAMMPS *lmp, const char *value)
{
  if (strcmp(value, "auto") == 0) return 0.0;
  char *end = nullptr;
  const double skin = strtod(value, &end);
  if (*end != '\0' || !(skin > 0.0) || !std::isfinite(skin))
    rod_error_all(lmp, "Surface spherocylinder: close_skin must be auto or a length > 0 (got %s)",
                  value);
  return skin;
}

static int threads_of(LAMMPS *lmp, const char *value)
{
  char *end = nullptr;
  const long threads = strtol(value, &end, 10);
  if (end == value || *end != '\0' || threads < 1 || threads > RodThreads::kMost)
    rod_error_all(lmp,
                  "Surface spherocylinder: threads must be a whole number from 1 to %d (got %s)",
                  RodThreads::kMost, value);
  return static_cast<int>(threads);
}

static bool are_all_ghosts(LAMMPS *lmp, const char *value)
{
  if (strcmp(value, "all") != 0 && strcmp(value, "needed") != 0)
    rod_error_all(lmp, "Surface spherocylinder: ghosts must be needed or all (got %s)", value);
  return value[0] == 'a';
}

std::vector<char *> RodKeywords::take_from(LAMMPS *lmp, int nargs, char **args)
{
  std::vector<char *> others;
  *this = RodKeywords();
  for (int k = 0; k < nargs; k++) {
    const bool is_skin = strcmp(args[k], "close_skin") == 0;
    const bool is_threads = strcmp(args[k], "threads") == 0;
    const bool is_ghosts = strcmp(args[k], "ghosts") == 0;
    if (!is_skin && !is_threads && !is_ghosts && strcmp(args[k], "search") != 0) {
      others.push_back(args[k]);
      continue;
    }
    const char *value = ++k < nargs ? args[k] : "nothing";
    if (is_skin)
      close_skin = close_skin_of(lmp, value);
    else if (is_threads)
      threads = threads_of(lmp, value);
    else if (is_ghosts)
      all_ghosts = are_all_ghosts(lmp, value);
    else if (strcmp(value, "five_step") == 0 || strcmp(value, "exact") == 0)
      five_step = value[0] == 'f';
    else
      rod_error_all(lmp, "Surface spherocylinder: search must be exact or five_step (got %s)",
                    value);
  }
  // Every keyword has one value; LIGGGHTS's reader takes it for granted.
  if (others.size() % 2 == 1)
    rod_error_all(
        lmp,
        "Surface spherocylinder: the keywords behind the models must each have a value (the "
        "last word, %s, has none)",
        others.back());
  for (size_t k = 0; k < others.size(); k += 2)
    if (!is_on_off<RodKeywords>(others[k]) && !is_on_off<LinearKeywords>(others[k]))
      are_all_of_rods = false;
  return others;
}

void RodKeywords::register_settings(Settings &settings, bool is_linear)
{
  register_on_off(settings, *this);
  if (is_linear) register_on_off(settings, linear);
}
