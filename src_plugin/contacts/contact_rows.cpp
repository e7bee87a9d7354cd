// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_rows.h"

#include "compute_pair_gran_local.h"

using namespace LAMMPS_NS;

ContactRows *ContactRows::collecting(ComputePairGranLocal *registered, bigint step)
{
  if (!registered || !registered->matchstep(step)) return nullptr;
  return dynamic_cast<ContactRows *>(registered);
}
