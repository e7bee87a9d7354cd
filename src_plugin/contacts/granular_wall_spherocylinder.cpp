// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/granular_wall_spherocylinder.h"

#include <optional>
#include <utility>

#include "atom.h"
#include "compute_pair_gran_local.h"
#include "contacts/contact_monitor.h"
#include "contacts/contact_rows.h"
#include "contacts/contact_state.h"
#include "contacts/observers.h"
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
    : Pointers(lmp), parent_(parent), laws_(lmp, std::move(models)), gatherer_(lmp)
{
  batch_.is_wall = true;
}

void GranularWallSpherocylinder::settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *)
{
  if (parent_->is_mesh_wall())
    rod_error_all(lmp,
                  "Fix wall/gran (id %s): surface spherocylinder cannot use a mesh; rods know "
                  "planes and the inside of cylinders (primitive)",
                  parent_->id);
  const std::string wrong = laws_.read_keywords(nargs, args);
  if (!wrong.empty()) error->fix_error(FLERR, parent_, wrong.c_str());
  laws_.models().layout().add_other_end();
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
  NormalForceSums<FixWallGran> sums(lmp, fix);
  WallLoads loads(lmp, fix);
  WallHeat heat(fix);
  std::optional<RowWriter> rows;
  ContactObservers observers = state_->observers();
  const bool adds_forces = fix.computeflag() != 0;
  if (adds_forces && fix.store_sum_normal_force()) observers.push_back(&sums);
  if (fix.store_force_contact() || fix.store_force_contact_stress() || fix.store_force())
    observers.push_back(&loads);
  if (fix.heattransfer_flag()) observers.push_back(&heat);
  if (ContactRows *wanted =
          ContactRows::collecting(fix.compute_wall_gran_local(), update->ntimestep))
    observers.push_back(&rows.emplace(lmp, *wanted, &fix));

  ContactLaw &law = laws_.chosen();
  const RodKeywords &keywords = laws_.keywords();
  law.begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  gatherer_.begin(fix, keywords.effective_mass, !keywords.linear.aspect_scaling);
  for (const int i : rods) {
    const EndHistories histories = of_ends(history ? history[i] : nullptr);
    gatherer_.add(batch_, wall, i, histories, [&](int end) {
      if (histories[end]) law.contact_ended(i, -1, nullptr, histories[end]);
    });
    if (batch_.count + 2 > kBatch) finish_batch(adds_forces, observers);
  }
  if (batch_.count > 0) finish_batch(adds_forces, observers);
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
  if (adds_forces) scatter_walls(batch_, *atom);
  monitor_->see(batch_);
  show(batch_, observers);
  batch_.count = 0;
}

void GranularWallSpherocylinder::contacts_ended(int i, double *history)
{
  for (double *of_end : of_ends(history)) laws_.chosen().contact_ended(i, -1, nullptr, of_end);
}
