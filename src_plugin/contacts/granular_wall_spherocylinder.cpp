// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/granular_wall_spherocylinder.h"

#include <optional>
#include <utility>

#include "atom.h"
#include "compute_pair_gran_local.h"
#include "contacts/contact_rows.h"
#include "contacts/material_checks.h"
#include "contacts/observers.h"
#include "error.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

GranularWallSpherocylinder::GranularWallSpherocylinder(LAMMPS *lmp, FixWallGran *parent,
                                                       std::unique_ptr<StockModels> models)
    : Pointers(lmp),
      parent_(parent),
      models_(std::move(models)),
      vector_law_(lmp),
      law_(models_.get()),
      gatherer_(lmp),
      monitor_(lmp)
{
  batch_.is_wall = true;
}

void GranularWallSpherocylinder::settings(int nargs, char **args,
                                          LIGGGHTS::IContactHistorySetup *history)
{
  if (parent_->is_mesh_wall())
    rod_error_all(lmp,
                  "Fix wall/gran (id %s): surface spherocylinder cannot use a mesh; rods know "
                  "planes and the inside of cylinders (primitive)",
                  parent_->id);
  const std::vector<char *> others = keywords_.take_from(lmp, nargs, args);
  const std::string wrong = models_->read_keywords(keywords_, others, history);
  if (!wrong.empty()) error->fix_error(FLERR, parent_, wrong.c_str());
}

void GranularWallSpherocylinder::init_granular()
{
  AtomVecSpherocylinder &rods = rods_of(lmp, "Fix wall/gran with surface spherocylinder");
  // The models of each end have half of the values, the tangential spring first.
  const bool has_springs = models_->is("tangential", "history") && parent_->dnum() > 0;
  const int springs[] = {has_springs ? 0 : -1, has_springs ? parent_->dnum() / 2 : -1};
  models_->connect(force->registry, keywords_, springs);
  monitor_.reset(rods);
  if (models_->has_tangential()) check_friction(lmp);
  law_ = models_.get();
  const std::optional<Tangential> tangential = models_->in_batches();
  if (tangential && keywords_.are_all_of_rods) {
    vector_law_.connect(force->registry, *tangential, keywords_.linear, springs);
    law_ = &vector_law_;
  }
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
  std::optional<RateCollector> rates;
  std::optional<RowWriter> rows;
  ContactObservers observers;
  const bool adds_forces = fix.computeflag() != 0;
  if (adds_forces && fix.store_sum_normal_force()) observers.push_back(&sums);
  if (fix.store_force_contact() || fix.store_force_contact_stress() || fix.store_force())
    observers.push_back(&loads);
  if (fix.heattransfer_flag()) observers.push_back(&heat);
  if (ContactRates *wanted = monitor_.rates()) observers.push_back(&rates.emplace(lmp, *wanted, 0));
  if (ContactRows *wanted =
          ContactRows::collecting(fix.compute_wall_gran_local(), update->ntimestep))
    observers.push_back(&rows.emplace(lmp, *wanted, &fix));

  law_->begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  gatherer_.begin(fix, keywords_.effective_mass, !keywords_.linear.aspect_scaling);
  for (const int i : rods) {
    double *values = history ? history[i] : nullptr;
    gatherer_.add(batch_, wall, i, values, [&](int end) {
      if (values) law_->part(i, -1, end, nullptr, values);
    });
    if (batch_.count + 2 > kBatch) finish_batch(adds_forces, observers);
  }
  if (batch_.count > 0) finish_batch(adds_forces, observers);
  law_->end();
}

void GranularWallSpherocylinder::finish_batch(bool adds_forces, const ContactObservers &observers)
{
  law_->evaluate(batch_);
  for (int k = 0; k < batch_.count; k++)
    monitor_.look(batch_.i[k], -1, batch_.loads.stiffness[k], batch_.loads.effective_mass[k],
                  batch_.arms.overlap[k], 2.0 * batch_.arms.radius_i[k]);
  if (adds_forces) scatter_walls(batch_, *atom);
  show(batch_, observers);
  batch_.count = 0;
}

void GranularWallSpherocylinder::part(int i, double *history)
{
  for (const int end : {0, 1}) law_->part(i, -1, end, nullptr, history);
}
