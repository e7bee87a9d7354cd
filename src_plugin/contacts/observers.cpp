// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/observers.h"

#include "atom.h"
#include "contacts/contact_rows.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "pair_gran.h"
#include "walls/mesh_surface.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void PairVirial::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k], j = batch.j[k];
    const Vec3 between = load(atom->x[i]) - load(atom->x[j]), force_on_i = batch.loads.force.get(k);
    pair_.ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, 0.0, force_on_i.x, force_on_i.y,
                       force_on_i.z, between.x, between.y, between.z);
  }
}

template <typename Host>
void NormalForceSums<Host>::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int j = batch.j[k];
    const double along = dot(batch.loads.force.get(k), batch.arms.normal.get(k));
    *host_.get_sum_normal_force_ptr(batch.i[k]) += along;
    if (j >= 0 && j < atom->nlocal) *host_.get_sum_normal_force_ptr(j) += along;
  }
}
namespace LAMMPS_NS {
template class NormalForceSums<PairGran>;
template class NormalForceSums<FixWallGran>;
}  // namespace LAMMPS_NS

void RowWriter::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    if (!batch.can_move(k)) continue;
    const int i = batch.i[k];
    const Vec3 normal = batch.arms.normal.get(k);
    const ContactRow row = {i,
                            batch.j[k],
                            batch.loads.force.get(k),
                            batch.loads.torque_i.get(k),
                            normal,
                            load(atom->x[i]) + batch.arms.arm_i.get(k) - batch.depth_i(k) * normal,
                            batch.arms.velocity_j.get(k),
                            batch.history[k],
                            batch.arms.radius_i[k],
                            batch.arms.radius_j[k],
                            batch.arms.distance[k],
                            batch.arms.overlap[k]};
    if (wall_ && mesh_)
      rows_.add_mesh_contact(*wall_, *mesh_, mesh_->id(batch.end[k]), row);
    else if (wall_)
      rows_.add_wall_contact(*wall_, batch.end[k], row);
    else
      rows_.add_pair_contact(row);
  }
}
