// SPDX-License-Identifier: GPL-2.0-or-later
// The column `diameter` of text dumps: a rod's own, as `set` and compute property/atom have it,
// where LIGGGHTS would write twice the bounding radius, the rod's length. Stands in front of
// LIGGGHTS's own as hooks.cpp tells.
#include <dlfcn.h>

#include "atom.h"
#include "dump_custom.h"
#include "rods/atom_vec_spherocylinder.h"

namespace LAMMPS_NS {

__attribute__((visibility("default"))) void DumpCustom::pack_diameter(int n)
{
  using Pack = void (*)(DumpCustom *, int);
  static const auto original =
      reinterpret_cast<Pack>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS10DumpCustom13pack_diameterEi"));
  if (!dynamic_cast<AtomVecSpherocylinder *>(atom->avec)) {
    original(this, n);
    return;
  }
  for (int i = 0; i < nchoose; i++) buf[n + i * size_one] = 2.0 * atom->shape[clist[i]][0];
}

}  // namespace LAMMPS_NS
