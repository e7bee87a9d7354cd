// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/wall_observers.h"

#include "atom.h"
#include "compute_pair_gran_local.h"
#include "contact_interface.h"
#include "contacts/contact_rows.h"
#include "fix_contact_property_atom_wall.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "host/private_members.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

WallObservers::WallObservers(LAMMPS *lmp, FixWallGran &fix, const ContactObservers &others,
                             const MeshSurface *mesh)
    : sums_(lmp, fix), loads_(lmp, fix, mesh), heat_(fix, mesh), all_(others)
{
  const bool adds_forces = fix.computeflag() != 0;
  if (adds_forces && fix.store_sum_normal_force()) all_.push_back(&sums_);
  if (fix.store_force_contact() || fix.store_force_contact_stress() || fix.store_force())
    all_.push_back(&loads_);
  if (fix.heattransfer_flag()) all_.push_back(&heat_);
  if (adds_forces && mesh && fix.stress_flag() && mesh->fix().trackStress())
    all_.push_back(&stress_.emplace(lmp, *mesh));
  if (ContactRows *wanted =
          ContactRows::collecting(fix.compute_wall_gran_local(), lmp->update->ntimestep))
    all_.push_back(&rows_.emplace(lmp, *wanted, &fix, mesh));
}

bool WallLoads::are_one_load(const ContactBatch &batch, int k, int other) const
{
  return batch.i[k] == batch.i[other] && (!mesh_ || batch.end[k] == batch.end[other]);
}

// LIGGGHTS's stress of a wall goes by the last of the rod's contacts.
void WallLoads::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    const int i = batch.i[k];
    if (fix_.store_force()) add_to(fix_.fix_wallforce()->array_atom[i], batch.loads.force.get(k));
    if (!fix_.store_force_contact() && !fix_.store_force_contact_stress()) continue;
    bool is_last = true;
    LIGGGHTS::ContactModels::ForceData total;
    total.reset();
    for (int other = 0; other < batch.count; other++) {
      if (!are_one_load(batch, k, other)) continue;
      if (other > k) is_last = false;
      add_to(total.delta_F, batch.loads.force.get(other));
      add_to(total.delta_torque, batch.loads.torque_i.get(other));
    }
    if (!is_last) continue;
    const int id = mesh_ ? mesh_->id(batch.end[k]) : 0;
    if (fix_.store_force_contact() && update->ntimestep % fix_.store_force_contact_every() == 0)
      fix_.add_contactforce_wall(i, total, id);
    if (fix_.store_force_contact_stress()) {
      double delta[3], wall_velocity[3];
      store(batch.arms.distance[k] * batch.arms.normal.get(k), delta);
      store(batch.arms.velocity_j.get(k), wall_velocity);
      fix_.add_contactforce_stress_wall(i, total, delta, wall_velocity, id);
    }
  }
}

void WallHeat::see(const ContactBatch &batch)
{
  TriMesh *mesh = mesh_ ? mesh_->fix().triMesh() : nullptr;
  for (int k = 0; k < batch.count; k++) {
    // LIGGGHTS's flux goes by the root of the contact's area. A share w of it is that of w^2 times the
    // area: of the circle of a sphere w times as large that is w times as deep, of its projection, or of
    // the area that the deck gives.
    const double share = mesh_ ? batch.weight[k] : 1.0;
    double &given_area = given_contact_area(fix_);
    const double whole_area = given_area;
    given_area *= share * share;
    fix_.addHeatFlux(mesh, batch.i[k], share * batch.arms.radius_i[k],
                     share * batch.arms.overlap[k], 1.0);
    given_area = whole_area;
  }
}

// LIGGGHTS looks at a sphere: its velocity is that of its centre, and it wears where it does not part, by the
// velocity along the way from the centre to the contact point. So while LIGGGHTS looks the rod is a sphere that
// has the end of the arm as its centre, and the velocity of the contact point.
void MeshStress::see(const ContactBatch &batch)
{
  for (int k = 0; k < batch.count; k++) {
    const int i = batch.i[k];
    const Vec3 arm = batch.arms.arm_i.get(k);
    const Vec3 down = -batch.depth_i(k) * batch.arms.normal.get(k);
    const Vec3 position = load(atom->x[i]), velocity = load(atom->v[i]);
    store(position + arm, atom->x[i]);
    store(velocity_at(velocity, load(atom->omega[i]), arm + down), atom->v[i]);
    double force[3], to_contact[3], wall_velocity[3];
    store(batch.loads.force.get(k), force);
    store(down, to_contact);
    store(batch.arms.velocity_j.get(k), wall_velocity);
    mesh_.fix().add_particle_contribution(i, force, to_contact, batch.end[k], wall_velocity);
    store(position, atom->x[i]);
    store(velocity, atom->v[i]);
  }
}
