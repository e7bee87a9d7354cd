// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/granular_wall_spherocylinder.h"

#include <utility>

#include "atom.h"
#include "contacts/contact_monitor.h"
#include "contacts/contact_state.h"
#include "contacts/scatter.h"
#include "contacts/wall_observers.h"
#include "error.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

GranularWallSpherocylinder::GranularWallSpherocylinder(LAMMPS *lmp, FixWallGran *parent,
                                                       std::unique_ptr<StockLaw> models)
    : Pointers(lmp),
      parent_(parent),
      laws_(lmp, std::move(models)),
      gatherer_(lmp),
      mesh_gatherer_(lmp)
{
  batch_.is_wall = true;
}

void GranularWallSpherocylinder::settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *)
{
  batch_.is_mesh = parent_->is_mesh_wall();
  if (batch_.is_mesh) laws_.models().layout().keep_from_host();
  const std::string wrong = laws_.read_keywords(nargs, args);
  if (!wrong.empty()) error->fix_error(FLERR, parent_, wrong.c_str());
  if (!batch_.is_mesh) laws_.models().layout().add_other_end();
}

void GranularWallSpherocylinder::init_granular()
{
  AtomVecSpherocylinder &rods = rods_of(lmp, "Fix wall/gran with surface spherocylinder");
  laws_.connect();
  monitor_ = &rods.attached<ContactMonitor>();
  state_ = &rods.attached<ContactState>();
}

void GranularWallSpherocylinder::compute_force(FixWallGran *,
                                               LIGGGHTS::ContactModels::SurfacesIntersectData &,
                                               bool, double *, FixMeshSurface *, int, TriMesh *,
                                               int)
{
  rod_error_one(lmp, "Fix %s (id %s): surface spherocylinder was asked for one sphere's contact",
                parent_->style, parent_->id);
}

void GranularWallSpherocylinder::compute_forces(FixWallGran &fix, const MovingWall &wall,
                                                const std::vector<int> &rods, double **history)
{
  const WallObservers observers(lmp, fix, state_->observers(), nullptr);
  const bool adds_forces = fix.computeflag() != 0;
  ContactLaw &law = laws_.chosen();
  const RodKeywords &keywords = laws_.keywords();
  law.begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  gatherer_.begin(fix, keywords.effective_mass, keywords.spread_contact,
                  !keywords.linear.aspect_scaling);
  for (const int i : rods) {
    const EndHistories histories = of_ends(history ? history[i] : nullptr);
    gatherer_.add(batch_, wall, i, histories, [&](int end) {
      if (histories[end]) law.contact_ended(i, -1, nullptr, histories[end]);
    });
    if (batch_.count + 2 > kBatch) finish_batch(adds_forces, observers.all());
  }
  if (batch_.count > 0) finish_batch(adds_forces, observers.all());
  law.end();
}

void GranularWallSpherocylinder::compute_mesh_forces(FixWallGran &fix, const MeshSurface &mesh,
                                                     int number, const RodsNearMesh &rods,
                                                     bool is_new, MeshHistories &histories)
{
  const WallObservers observers(lmp, fix, state_->observers(), &mesh);
  const bool adds_forces = fix.computeflag() != 0;
  ContactLaw &law = laws_.chosen();
  const RodKeywords &keywords = laws_.keywords();
  law.begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  mesh_gatherer_.begin(fix, mesh, number, histories, keywords.effective_mass,
                       !keywords.linear.aspect_scaling);
  int next_rod = 0;
  const auto forget_rods_before = [&](int rod) {
    for (; next_rod < rod; next_rod++) mesh_gatherer_.forget(next_rod, law);
    next_rod = rod + 1;
  };
  for (const RodsNearMesh::Near &near : rods) {
    if (is_new) forget_rods_before(near.rod);
    const int found = mesh_gatherer_.find(near, law);
    for (int first = 0; first < found;) {
      if (batch_.count > 0 && batch_.count + found - first > kBatch)
        finish_batch(adds_forces, observers.all());
      first = mesh_gatherer_.add(batch_, first);
    }
  }
  if (is_new) forget_rods_before(atom->nlocal);
  if (batch_.count > 0) finish_batch(adds_forces, observers.all());
  law.end();
}

EndHistories GranularWallSpherocylinder::of_ends(double *row)
{
  if (!row) return {nullptr, nullptr};
  return {row, row + laws_.models().layout().values()};
}

void GranularWallSpherocylinder::finish_batch(bool adds_forces, const ContactObservers &observers)
{
  laws_.chosen().evaluate(batch_);
  if (batch_.is_mesh) take_weights(batch_);
  add_spread(batch_);
  if (adds_forces) scatter_walls(batch_, *atom);
  monitor_->see(batch_);
  show(batch_, observers);
  batch_.count = batch_.spread_count = 0;
}

void GranularWallSpherocylinder::contacts_ended(int i, double *history)
{
  for (double *of_end : of_ends(history)) laws_.chosen().contact_ended(i, -1, nullptr, of_end);
}
