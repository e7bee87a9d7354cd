// SPDX-License-Identifier: GPL-2.0-or-later
#include "lists/close_pair_counts.h"

#include <cmath>

#include "atom.h"
#include "fix_property_atom.h"
#include "lists/close_rod_pairs.h"
#include "lists/lists_in_use.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;

namespace {

const CloseRodPairs *lists_of(LAMMPS *lmp)
{
  return rods_of(lmp, "Counting close pairs").attached<ListsInUse>().close_pairs;
}

}  // namespace

ClosePairCounts::ClosePairCounts(LAMMPS *lmp, const std::string &of)
    : Pointers(lmp), id_("close_pairs_" + of)
{
}

void ClosePairCounts::begin()
{
  std::vector<std::string> words = {id_,  "all", "property/atom", id_, "scalar", "no", "no",
                                    "no", "0.0"};
  std::vector<char *> arg;
  for (std::string &word : words) arg.push_back(word.data());
  modify->add_fix_property_atom(static_cast<int>(arg.size()), arg.data(), id_.c_str())
      ->set_internal();
}

void ClosePairCounts::end()
{
  if (modify->find_fix(id_.c_str()) >= 0) modify->delete_fix(id_.c_str());
}

double *ClosePairCounts::numbers() const
{
  return modify->fix[modify->find_fix(id_.c_str())]->vector_atom;
}

void ClosePairCounts::count()
{
  const CloseRodPairs *lists = lists_of(lmp);
  if (!lists) return;
  const std::vector<int> counts = lists->pairs_of_rods();
  double *const numbers = this->numbers();
  for (int i = 0; i < atom->nlocal; i++) numbers[i] = counts[i];
}

bool ClosePairCounts::count_if_rods_stay()
{
  const CloseRodPairs *lists = lists_of(lmp);
  if (!lists || !lists->are_of_present_rods()) return false;
  count();
  return true;
}

std::vector<int> ClosePairCounts::counted() const
{
  std::vector<int> counts(atom->nlocal);
  const double *const numbers = this->numbers();
  for (int i = 0; i < atom->nlocal; i++) counts[i] = static_cast<int>(std::lround(numbers[i]));
  return counts;
}

std::vector<int> ClosePairCounts::now() const
{
  const CloseRodPairs *lists = lists_of(lmp);
  return lists && lists->are_of_present_rods() ? lists->pairs_of_rods() : counted();
}
