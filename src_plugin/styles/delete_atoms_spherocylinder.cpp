// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/delete_atoms_spherocylinder.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "contacts/contact_state.h"
#include "contacts/sudden_overlaps.h"
#include "delete_atoms.h"
#include "force.h"
#include "pair_gran.h"
#include "parallel/from_all_ranks.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fibre_chains.h"
#include "styles/fix_contact_history_spherocylinder.h"

using namespace LAMMPS_NS;

namespace {

using IdPair = std::pair<int, int>;  // before, after

// Of all ranks' rods, in the order of the ids before.
std::vector<IdPair> all_ids(LAMMPS *lmp, const std::vector<int> &before)
{
  std::vector<int> mine;
  for (size_t i = 0; i < before.size(); i++) {
    mine.push_back(before[i]);
    mine.push_back(lmp->atom->tag[i]);
  }
  const std::vector<int> all = from_all_ranks(lmp->world, mine);

  std::vector<IdPair> ids;
  for (size_t k = 0; k < all.size(); k += 2) ids.emplace_back(all[k], all[k + 1]);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

// The last of several `compress` counts; what it may stand behind depends on the style.
bool DeleteAtomsSpherocylinder::compresses(int narg, char **arg) const
{
  bool compress = true;
  for (int k = 1; k + 1 < narg; k++)
    if (strcmp(arg[k], "compress") == 0) compress = strcmp(arg[k + 1], "no") != 0;
  return compress;
}

// LIGGGHTS deletes and keeps the ids; ids are then made anew here, in LIGGGHTS's way, while each
// rod's old one is known.
void DeleteAtomsSpherocylinder::command(int narg, char **arg)
{
  std::vector<char *> args(arg, arg + narg);
  char compress[] = "compress", no[] = "no";
  const int least =
      narg > 0 && (strcmp(arg[0], "group") == 0 || strcmp(arg[0], "region") == 0) ? 2 : 4;
  if (narg >= least) {  // else the sentence is LIGGGHTS's
    args.push_back(compress);
    args.push_back(no);
  }
  DeleteAtoms(lmp).command(static_cast<int>(args.size()), args.data());

  const std::vector<int> before(atom->tag, atom->tag + atom->nlocal);
  if (compresses(narg, arg)) {
    std::fill_n(atom->tag, atom->nlocal, 0);
    atom->tag_extend();
    if (atom->map_style) {
      atom->map_init();
      atom->map_set();
    }
  }

  auto *pair = dynamic_cast<PairGran *>(force->pair);
  auto *histories =
      pair ? dynamic_cast<FixContactHistorySpherocylinder *>(pair->get_fix_history()) : nullptr;
  const std::vector<IdPair> ids = all_ids(lmp, before);
  const auto new_id = [&ids](int old) {
    const auto found = std::lower_bound(ids.begin(), ids.end(), IdPair(old, 0));
    return found != ids.end() && found->first == old ? found->second : 0;
  };
  if (histories) histories->rename_partners(new_id);
  auto &rods = static_cast<AtomVecSpherocylinder &>(*atom->avec);
  SuddenOverlaps *sudden_overlaps = rods.attached<ContactState>().sudden_overlaps;
  if (sudden_overlaps) sudden_overlaps->rename(new_id);
  if (!rods.attached<FibreSegments>().rows) return;
  const int cut = FibreChains(lmp, "Command delete_atoms").cut_lost_joints();
  if (cut == 0 || comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out) fprintf(out, "  %d ends of fibres are free where a segment was\n", cut);
}
