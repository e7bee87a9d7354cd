// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/wall_arguments.h"

#include <algorithm>
#include <cstring>

#include "fix.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "modify.h"

using namespace LAMMPS_NS;

namespace {

bool is_variable(const char *text) { return strncmp(text, "v_", 2) == 0; }

char some_position[] = "0.0", some_radius[] = "1.0";

}  // namespace

WallArguments::WallArguments(LAMMPS *lmp, int narg, char **arg)
{
  // A fix that is defined again leaves a gap until it is made, which LIGGGHTS's wall does not expect.
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (!lmp->modify->fix[k])
      rod_error_all(lmp, "Fix wall/gran (id %s) is defined already: unfix it first", arg[0]);

  constexpr int kFirst = 3;  // after id, group and style, which may have any names
  others.assign(arg, arg + std::min(narg, kFirst));
  for (int k = kFirst; k < narg; k++) {
    if (strcmp(arg[k], "turn") != 0) {
      others.push_back(arg[k]);
      continue;
    }
    if (k + 3 >= narg)
      rod_error_all(lmp,
                    "Fix wall/gran (id %s): turn must be followed by a rate and two coordinates of "
                    "the centre in the plane",
                    arg[0]);
    turns = true;
    turning = deck_number(lmp, fix_and_id(arg), "the rate of turn", arg[++k]);
    for (double &coordinate : centre)
      coordinate = deck_number(lmp, fix_and_id(arg), "the centre of turn", arg[++k]);
  }

  // LIGGGHTS reads on without looking where the line ends.
  for (size_t k = kFirst; k < others.size(); k++)
    if (strcmp(others[k], "primitive") == 0 && k + 4 >= others.size())
      rod_error_all(
          lmp,
          "Fix wall/gran (id %s): primitive must be followed by type, an atom type, a wall style "
          "and where it is (got %d words)",
          arg[0], static_cast<int>(others.size() - k - 1));

  // primitive type tp wallstyle position
  for (size_t k = kFirst; k + 4 < others.size(); k++) {
    if (strcmp(others[k], "primitive") != 0) continue;
    const char *style = others[k + 3];
    const bool is_plane = strlen(style) == 6 && strcmp(style + 1, "plane") == 0;
    if (is_variable(others[k + 4])) {
      if (others[k + 4][2] == '\0')
        rod_error_all(lmp,
                      "Fix wall/gran (id %s): v_ must be followed by the name of a variable (got "
                      "none)",
                      arg[0]);
      variable = others[k + 4] + 2;
      others[k + 4] = is_plane ? some_position : some_radius;
    }
    for (size_t m = k + 5; !is_plane && m < k + 7 && m < others.size(); m++)
      if (is_variable(others[m]))
        rod_error_all(lmp,
                      "Fix wall/gran (id %s): a %s must have an axis of two numbers (got %s); its "
                      "radius may be a variable",
                      arg[0], style, others[m]);
  }
}
