// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/granular_wall_spherocylinder.h"

#include <utility>

#include "atom.h"
#include "contacts/contact_state.h"
#include "contacts/scatter.h"
#include "contacts/wall_observers.h"
#include "error.h"
#include "fix_mesh_surface.h"
#include "fix_wall_gran.h"
#include "force.h"
#include "host/rod_error.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_threads.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

namespace {

// Of a thread: fewer are done sooner than others are told.
constexpr int kFewestRods = 50, kFewestRodsAtMesh = 20;

}  // namespace

GranularWallSpherocylinder::GranularWallSpherocylinder(LAMMPS *lmp, FixWallGran *parent,
                                                       std::unique_ptr<StockLaw> models)
    : Pointers(lmp), parent_(parent), laws_(lmp, std::move(models)), gatherer_(lmp)
{
  workers_.resize(1);
}

void GranularWallSpherocylinder::settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *)
{
  const bool is_mesh = parent_->is_mesh_wall();
  if (is_mesh) laws_.models().layout().keep_from_host();
  const std::string wrong = laws_.read_keywords(nargs, args);
  if (!wrong.empty()) error->fix_error(FLERR, parent_, wrong.c_str());
  if (!is_mesh) laws_.models().layout().add_other_end();
}

void GranularWallSpherocylinder::init_granular()
{
  AtomVecSpherocylinder &rods = rods_of(lmp, "Fix wall/gran with surface spherocylinder");
  threads_ = &rods.attached<RodThreads>();
  laws_.connect(threads_->count());
  workers_.resize(threads_->count());
  while (static_cast<int>(mesh_gatherers_.size()) < threads_->count())
    mesh_gatherers_.emplace_back(lmp);
  for (Worker &worker : workers_) {
    worker.batch.is_wall = true;
    worker.batch.is_mesh = parent_->is_mesh_wall();
  }
  monitor_ = &rods.attached<ContactMonitor>();
  state_ = &rods.attached<ContactState>();
  joint_shares_ = &rods.attached<JointShares>();
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
  const RodKeywords &keywords = laws_.keywords();
  laws_.begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  shares_ = joint_shares_->bring_up_to_date() ? joint_shares_ : nullptr;
  gatherer_.begin(fix, keywords.effective_mass, keywords.spread_contact,
                  !keywords.linear.aspect_scaling, shares_);
  if (shares_ && history && wall.surface.is_cylinder && adds_forces)
    gatherer_.hand_over_outside(wall.surface, rods, history, laws_.models().layout().values());
  // Observers see contacts in the order of the rods, and LIGGGHTS's models serve one thread.
  const bool at_once = observers.all().empty() && laws_.number() > 1;
  const int number = static_cast<int>(rods.size());
  const int pieces = at_once ? threads_->pieces_of(number, kFewestRods) : 1;
  threads_->run(pieces, [&](int piece) {
    const int first = RodThreads::first_of(piece, pieces, number);
    const int last = RodThreads::first_of(piece + 1, pieces, number);
    work_out(piece, rods.data() + first, last - first, wall, history, adds_forces, observers.all());
  });
  take_what_was_seen();
  laws_.end();
}

void GranularWallSpherocylinder::work_out(int thread, const int *rods, int count, MovingWall wall,
                                          double **history, bool adds_forces,
                                          const ContactObservers &observers)
{
  ContactLaw &law = laws_.of_thread(thread);
  ContactBatch &batch = workers_[thread].batch;
  const WallGatherer gatherer = gatherer_;  // a copy, which no store into the batch may change
  const int values = laws_.models().layout().values();
  for (int n = 0; n < count; n++) {
    const int i = rods[n];
    const EndHistories histories = of_ends(history ? history[i] : nullptr, values);
    gatherer.add(batch, wall, i, histories, [&](int end) {
      if (histories[end]) law.contact_ended(i, -1, nullptr, histories[end]);
    });
    if (batch.count + 2 > kBatch) finish_batch(thread, adds_forces, observers);
  }
  if (batch.count > 0) finish_batch(thread, adds_forces, observers);
}

void GranularWallSpherocylinder::compute_mesh_forces(FixWallGran &fix, const MeshSurface &mesh,
                                                     int number, const RodsNearMesh &rods,
                                                     bool is_new, MeshHistories &histories)
{
  const WallObservers observers(lmp, fix, state_->observers(), &mesh);
  const bool adds_forces = fix.computeflag() != 0;
  const RodKeywords &keywords = laws_.keywords();
  laws_.begin({update->dt, adds_forces, adds_forces && fix.shearupdate()});
  const int near = static_cast<int>(rods.end() - rods.begin());
  const bool at_once = observers.all().empty() && laws_.number() > 1;
  const int pieces = at_once ? threads_->pieces_of(near, kFewestRodsAtMesh) : 1;
  shares_ = joint_shares_->bring_up_to_date() ? joint_shares_ : nullptr;
  for (MeshGatherer &gatherer : mesh_gatherers_)
    gatherer.begin(fix, mesh, number, histories, keywords.effective_mass,
                   !keywords.linear.aspect_scaling, shares_);
  const int owned = atom->nlocal;
  threads_->run(pieces, [&](int piece) {
    const auto *first = rods.begin() + RodThreads::first_of(piece, pieces, near);
    const auto *last = rods.begin() + RodThreads::first_of(piece + 1, pieces, near);
    work_out_mesh(piece, first, last, piece == 0 ? 0 : first->rod,
                  piece + 1 == pieces ? owned : last->rod, is_new, adds_forces, observers.all());
  });
  take_what_was_seen();
  warn_of_pierced(fix, mesh, number);
  laws_.end();
}

void GranularWallSpherocylinder::work_out_mesh(int thread, const RodsNearMesh::Near *begin,
                                               const RodsNearMesh::Near *end, int first_rod,
                                               int next_rod, bool is_new, bool adds_forces,
                                               const ContactObservers &observers)
{
  ContactLaw &law = laws_.of_thread(thread);
  ContactBatch &batch = workers_[thread].batch;
  MeshGatherer &gatherer = mesh_gatherers_[thread];
  int rod = first_rod;
  const auto forget_rods_before = [&](int near) {
    for (; rod < near; rod++) gatherer.forget(rod, law);
    rod = near + 1;
  };
  for (const RodsNearMesh::Near *near = begin; near != end; near++) {
    if (is_new) forget_rods_before(near->rod);
    const int found = gatherer.find(*near, law);
    for (int first = 0; first < found;) {
      if (batch.count > 0 && batch.count + found - first > kBatch)
        finish_batch(thread, adds_forces, observers);
      first = gatherer.add(batch, first);
    }
  }
  if (is_new) forget_rods_before(next_rod);
  if (batch.count > 0) finish_batch(thread, adds_forces, observers);
}

void GranularWallSpherocylinder::warn_of_pierced(const FixWallGran &fix, const MeshSurface &mesh,
                                                 int number)
{
  for (const MeshGatherer &gatherer : mesh_gatherers_) {
    const int rod = gatherer.pierced_rod();
    if (rod < 0 || !told_of_pierced_.insert(number).second) continue;
    rod_warning(
        lmp,
        "Fix wall/gran (id %s): rod %d goes through a face of mesh %s, near triangle %d, at "
        "step " BIGINT_FORMAT "; it is pushed to the side where its centre is",
        fix.id, atom->tag[rod], mesh.fix().id, mesh.id(gatherer.pierced_triangle()),
        update->ntimestep);
  }
}

void GranularWallSpherocylinder::finish_batch(int thread, bool adds_forces,
                                              const ContactObservers &observers)
{
  auto &[batch, seen] = workers_[thread];
  laws_.of_thread(thread).evaluate(batch);
  add_spread(batch);
  if (batch.is_mesh || shares_) take_weights(batch);
  if (adds_forces) scatter_walls(batch, *atom);
  monitor_->look(batch, seen);
  show(batch, observers);
  batch.count = batch.spread_count = 0;
}

void GranularWallSpherocylinder::take_what_was_seen()
{
  for (Worker &worker : workers_) monitor_->take(worker.seen);
}

void GranularWallSpherocylinder::contacts_ended(int i, double *history)
{
  for (double *of_end : of_ends(history, laws_.models().layout().values()))
    laws_.chosen().contact_ended(i, -1, nullptr, of_end);
}
