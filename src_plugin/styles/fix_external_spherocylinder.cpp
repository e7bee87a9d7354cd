// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_external_spherocylinder.h"

#include "atom.h"

using namespace LAMMPS_NS;

FixExternalSpherocylinder::FixExternalSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixExternal(lmp, narg, arg), rows_(atom->nmax)
{
  create_attribute = 1;  // set_arrays is called for rods that come in
  for (int i = 0; i < rows_; i++) set_arrays(i);
}

void FixExternalSpherocylinder::grow_arrays(int nmax)
{
  FixExternal::grow_arrays(nmax);
  for (int i = rows_; i < nmax; i++) set_arrays(i);
  rows_ = nmax;
}

void FixExternalSpherocylinder::set_arrays(int i)
{
  for (int d = 0; d < 3; d++) fexternal[i][d] = 0.0;
}
