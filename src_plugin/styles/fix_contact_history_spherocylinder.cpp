// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_contact_history_spherocylinder.h"

#include <algorithm>

#include "atom.h"
#include "force.h"
#include "lammps.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;

FixContactHistorySpherocylinder::FixContactHistorySpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixContactHistory(lmp, narg, arg)
{
}

void FixContactHistorySpherocylinder::pre_exchange()
{
  if (*computeflag_) FixContactHistory::pre_exchange();
}

int FixContactHistorySpherocylinder::rods() const { return atom->nlocal; }

void FixContactHistorySpherocylinder::move_partner(int i, int from, int to, int id)
{
  partner_[i][to] = id;
  if (from != to)
    std::copy_n(&contacthistory_[i][from * dnum_], dnum_, &contacthistory_[i][to * dnum_]);
}

void LAMMPS_NS::bring_histories_to_rods(LAMMPS *lmp)
{
  auto *pair = lmp->force ? dynamic_cast<PairGran *>(lmp->force->pair) : nullptr;
  if (pair && pair->computeflag() && pair->get_fix_history()) pair->get_fix_history()->pre_exchange();
}
