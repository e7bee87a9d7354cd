// SPDX-License-Identifier: GPL-2.0-or-later
// Ways round LIGGGHTS's limits.
#pragma once

#include "neigh_request.h"
#include "neighbor.h"

namespace LAMMPS_NS {

// Irregular's buffer has room for 1,000 numbers of an atom beyond what it has grown to. Contacts with
// other rods may need more; a rod's state and its contacts with walls need less than 100.
constexpr int kRoomForContacts = 900;

// The lists that `requestor` asked for are its own to fill. An occasional list is built when someone
// asks for it: nobody does.
inline void leave_lists_unbuilt(Neighbor &neighbor, const void *requestor)
{
  for (int k = 0; k < neighbor.nrequest; k++)
    if (neighbor.requests[k]->requestor == requestor) neighbor.requests[k]->occasional = 1;
}

}  // namespace LAMMPS_NS
