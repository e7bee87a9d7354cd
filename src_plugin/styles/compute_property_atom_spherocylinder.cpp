// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/compute_property_atom_spherocylinder.h"

#include <cmath>
#include <cstring>

#include "atom.h"
#include "core/rotation.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

using Rods = AtomVecSpherocylinder;

struct RodColumn {
  const char *name;
  ComputePropertyAtomSpherocylinder::RodValue value;
};

constexpr RodColumn kRodColumns[] = {
    {"ux", [](const Rods &rods, const Atom &, int i) { return rods.capsule(i).segment.axis.x; }},
    {"uy", [](const Rods &rods, const Atom &, int i) { return rods.capsule(i).segment.axis.y; }},
    {"uz", [](const Rods &rods, const Atom &, int i) { return rods.capsule(i).segment.axis.z; }},
    {"quatw", [](const Rods &, const Atom &atom, int i) { return atom.quaternion[i][0]; }},
    {"quati", [](const Rods &, const Atom &atom, int i) { return atom.quaternion[i][1]; }},
    {"quatj", [](const Rods &, const Atom &atom, int i) { return atom.quaternion[i][2]; }},
    {"quatk", [](const Rods &, const Atom &atom, int i) { return atom.quaternion[i][3]; }},
    {"shapex", [](const Rods &, const Atom &atom, int i) { return atom.shape[i][0]; }},
    {"shapey", [](const Rods &, const Atom &atom, int i) { return atom.shape[i][1]; }},
    {"shapez", [](const Rods &, const Atom &atom, int i) { return atom.shape[i][2]; }},
    {"diameter", [](const Rods &, const Atom &atom, int i) { return 2.0 * atom.shape[i][0]; }},
    {"length", [](const Rods &, const Atom &atom, int i) { return 2.0 * atom.shape[i][2]; }},
    {"aspect",
     [](const Rods &, const Atom &atom, int i) { return atom.shape[i][2] / atom.shape[i][0]; }},
    {"density", [](const Rods &, const Atom &atom, int i) { return atom.density[i]; }},
    {"volume", [](const Rods &, const Atom &atom, int i) { return atom.volume[i]; }},
    {"eqradius", [](const Rods &, const Atom &atom,
                    int i) { return std::cbrt(atom.volume[i] / (4.0 * M_PI / 3.0)); }},
    {"inertiax", [](const Rods &, const Atom &atom, int i) { return atom.inertia[i][0]; }},
    {"inertiay", [](const Rods &, const Atom &atom, int i) { return atom.inertia[i][1]; }},
    {"inertiaz", [](const Rods &, const Atom &atom, int i) { return atom.inertia[i][2]; }}};

ComputePropertyAtomSpherocylinder::RodValue rod_value(const char *name)
{
  for (const RodColumn &column : kRodColumns)
    if (strcmp(column.name, name) == 0) return column.value;
  return nullptr;
}

}  // namespace

ComputePropertyAtomSpherocylinder::ComputePropertyAtomSpherocylinder(LAMMPS *lmp, int &iarg,
                                                                     int narg, char **arg)
    : Compute(lmp, iarg, narg, arg), rods_(rods_of(lmp, "Compute property/atom of rods"))
{
  if (narg < iarg + 1)
    rod_error_all(lmp, "Compute %s (id %s): at least one property must be given", style, id);
  std::vector<char *> stock = {arg[0], arg[1], arg[2]};
  for (; iarg < narg; iarg++) {
    const RodValue value = rod_value(arg[iarg]);
    columns_.push_back({value, value ? -1 : stock_columns_});
    if (value) continue;
    stock.push_back(arg[iarg]);
    stock_columns_++;
  }
  if (stock_columns_ > 0) {
    int first = 3;
    stock_ = std::make_unique<ComputePropertyAtom>(lmp, first, static_cast<int>(stock.size()),
                                                   stock.data());
  }
  peratom_flag = 1;
  size_peratom_cols = columns_.size() == 1 ? 0 : static_cast<int>(columns_.size());
}

ComputePropertyAtomSpherocylinder::~ComputePropertyAtomSpherocylinder() = default;

void ComputePropertyAtomSpherocylinder::init()
{
  if (stock_) stock_->init();
}

void ComputePropertyAtomSpherocylinder::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  const size_t width = columns_.size();
  values_.resize((atom->nlocal + 1) * width);
  rows_.resize(atom->nlocal + 1);
  for (size_t row = 0; row < rows_.size(); row++) rows_[row] = values_.data() + row * width;
  if (width == 1)
    vector_atom = values_.data();
  else
    array_atom = rows_.data();

  if (stock_) stock_->compute_peratom();
  for (size_t k = 0; k < width; k++) {
    const Column &column = columns_[k];
    for (int i = 0; i < atom->nlocal; i++) {
      const bool is_member = atom->mask[i] & groupbit;
      rows_[i][k] = !is_member            ? 0.0
                    : column.rod_value    ? column.rod_value(rods_, *atom, i)
                    : stock_columns_ == 1 ? stock_->vector_atom[i]
                                          : stock_->array_atom[i][column.stock];
    }
  }
}

double ComputePropertyAtomSpherocylinder::memory_usage()
{
  return static_cast<double>(values_.capacity() * sizeof(double) +
                             rows_.capacity() * sizeof(double *)) +
         (stock_ ? stock_->memory_usage() : 0.0);
}
