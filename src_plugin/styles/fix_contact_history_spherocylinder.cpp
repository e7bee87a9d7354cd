// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_contact_history_spherocylinder.h"

#include <algorithm>
#include <string>
#include <vector>

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

int FixContactHistorySpherocylinder::id_of(int i) const { return atom->tag[i]; }

void FixContactHistorySpherocylinder::move_partner(int i, int from, int to, int id)
{
  partner_[i][to] = id;
  if (from != to)
    std::copy_n(&contacthistory_[i][from * dnum_], dnum_, &contacthistory_[i][to * dnum_]);
}

void FixContactHistorySpherocylinder::copy_contacts(int from, int to, int shift)
{
  std::vector<double> row(1 + npartner_[from] * (1 + dnum_));
  pack_exchange(from, row.data());
  unpack_exchange(to, row.data());
  for (int k = 0; k < npartner_[to]; k++) partner_[to][k] += shift;
}

// The models name their values; three of a row whose first is ...x... and whose second is the same with
// y are a vector, such as the tangential spring and the remembered normal.
void FixContactHistorySpherocylinder::turn_vectors(double *history,
                                                   const spherocylinder::Quaternion &rotation) const
{
  for (int k = 0; k + 2 < dnum_; k++) {
    std::string second = history_id_[k];
    const size_t x = second.find_last_of('x');
    if (x == std::string::npos) continue;
    second[x] = 'y';
    if (second != history_id_[k + 1]) continue;
    store(rotated(spherocylinder::load(history + k), rotation), history + k);
    k += 2;
  }
}

void LAMMPS_NS::bring_histories_to_rods(LAMMPS *lmp)
{
  auto *pair = lmp->force ? dynamic_cast<PairGran *>(lmp->force->pair) : nullptr;
  if (pair && pair->computeflag() && pair->get_fix_history())
    pair->get_fix_history()->pre_exchange();
}
