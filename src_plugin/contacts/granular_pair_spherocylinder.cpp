// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/granular_pair_spherocylinder.h"

#include <optional>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "compute_pair_gran_local.h"
#include "contacts/contact_rows.h"
#include "contacts/contact_state.h"
#include "contacts/material_checks.h"
#include "contacts/observers.h"
#include "contacts/rod_pair_geometry.h"
#include "core/five_step_search.h"
#include "error.h"
#include "force.h"
#include "host/rod_error.h"
#include "lists/lists_in_use.h"
#include "neigh_list.h"
#include "pair_gran.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_threads.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

GranularPairSpherocylinder::GranularPairSpherocylinder(LAMMPS *lmp, PairGran *parent,
                                                       std::unique_ptr<StockLaw> models)
    : Pointers(lmp),
      parent_(parent),
      laws_(lmp, std::move(models)),
      close_pairs_(lmp),
      false_histories_(lmp),
      joint_histories_(lmp),
      gatherer_(lmp),
      sudden_overlaps_(lmp)
{
}

GranularPairSpherocylinder::~GranularPairSpherocylinder()
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(atom->avec);
  if (!rods) return;
  auto &lists = rods->attached<ListsInUse>();
  if (lists.touching_pairs == &touching_pairs_) lists = ListsInUse(lmp);
  auto &state = rods->attached<ContactState>();
  if (state.sudden_overlaps == &sudden_overlaps_) state.sudden_overlaps = nullptr;
}

void GranularPairSpherocylinder::settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *)
{
  const std::string wrong = laws_.read_keywords(nargs, args);
  if (!wrong.empty()) error->all(FLERR, wrong.c_str());
  sudden_overlaps_.allow(laws_.keywords().sudden_overlap);
  use_search();
  has_settings_ = true;
}

void GranularPairSpherocylinder::use_search()
{
  if (!laws_.keywords().five_step)
    touching_pairs_.search_by(closest_points);
  else if (laws_.keywords().spread_contact)  // which goes by the closest points
    touching_pairs_.search_by(closest_points_in_five_steps);
  else
    touching_pairs_.search_by(five_step_points);
}

void GranularPairSpherocylinder::init_granular()
{
  if (!has_settings_)
    rod_error_all(lmp, "Pair gran with surface spherocylinder: a restart file does not hold its "
                       "keywords, give pair_style and pair_coeff again after read_restart");
  AtomVecSpherocylinder &rods = rods_of(lmp, "Pair gran with surface spherocylinder");
  if (force->newton_pair)
    rod_error_all(lmp, "Pair gran with surface spherocylinder requires newton off (got newton on)");
  if (parent_->storeContactForces() || parent_->storeContactForcesStress())
    rod_error_all(lmp, "Pair gran with surface spherocylinder stores no contact forces, as fix "
                       "continuum/weighted wants them (expected compute pair/gran/local)");
  RodThreads &threads = rods.attached<RodThreads>();
  threads.want(laws_.keywords().threads);
  threads.begin_run();
  threads_ = &threads;
  workers_.resize(threads.count());
  laws_.connect(threads.count());
  highest_type_ = force->registry.max_type();
  side_ = laws_.models().layout().offset_of("rod_normal_x");
  monitor_ = &rods.attached<ContactMonitor>();
  state_ = &rods.attached<ContactState>();
  joint_shares_ = &rods.attached<JointShares>();
  if (laws_.keywords().all_ghosts) rods.ghosts().send_all_for("ghosts all");
  check_models_are_restarted_ones(rods.attached<ContactState>().restarted);
  close_pairs_.reset(*parent_, laws_.keywords().close_skin);
  auto &lists = rods.attached<ListsInUse>();
  lists.counts = &close_pairs_.counts();
  lists.close_pairs = &close_pairs_;
  lists.touching_pairs = &touching_pairs_;
  rods.attached<ContactState>().sudden_overlaps = &sudden_overlaps_;
}

void GranularPairSpherocylinder::write_restart_settings(FILE *file)
{
  const int64_t hash = laws_.models().hashcode();
  fwrite(&hash, sizeof(int64_t), 1, file);
}

void GranularPairSpherocylinder::read_restart_settings(FILE *file, int64_t hash)
{
  int64_t stored = -1;
  if (comm->me == 0 && fread(&stored, sizeof(int64_t), 1, file) != 1)
    error->one(FLERR, "Pair gran: restart file ends within the pair style");
  if (comm->me == 0 && (hash != -1 ? hash : stored) != laws_.models().hashcode())
    error->one(FLERR, "Pair gran: restart file was written with other contact models");
  laws_.models().set_up_history();  // as long as the stored one, until init_granular
  if (auto *rods = dynamic_cast<AtomVecSpherocylinder *>(atom->avec))
    rods->attached<ContactState>().restarted = {laws_.models().hashcode(),
                                                laws_.models().layout().values()};
}

// The models' values are known by their places alone, of which other models may have as many.
void GranularPairSpherocylinder::check_models_are_restarted_ones(ContactState::Restarted &restarted)
{
  const int values = laws_.models().layout().values();
  if (restarted.values > 0 && values > 0 && restarted.hashcode != laws_.models().hashcode())
    rod_error_all(
        lmp,
        "Pair gran with surface spherocylinder: the restart file holds contacts of other "
        "contact models, of %d values each (got models with %d; expected the same models)",
        restarted.values, values);
  restarted = {};
}

void GranularPairSpherocylinder::bring_pairs_up_to_date(PairGran &pair, bool migrated,
                                                        bool run_begins)
{
  if (migrated || run_begins) check_types_have_properties(lmp, highest_type_);
  if (!migrated && run_begins) {
    close_pairs_.check_rods_are_the_same();
    if (!gatherer_.rods_are_as_read(pair.freeze_group_bit(), laws_.keywords().effective_mass))
      rod_error_one(
          lmp, "Run: pre no cannot be used after a command has changed the size, mass, type or "
               "frozen group of rods, contacts still have those before (expected run without "
               "pre no)");
  }
  close_pairs_.update(pair, *threads_, gatherer_, migrated);
  if (migrated) gatherer_.read_masses(pair.freeze_group_bit(), laws_.keywords().effective_mass);
  shares_ = joint_shares_->bring_up_to_date() ? joint_shares_ : nullptr;
  touching_pairs_.share_by(shares_);
  touching_pairs_.cut(*threads_, close_pairs_.entries(), gatherer_.rods().size());
}

void GranularPairSpherocylinder::compute_force(PairGran *pair, int eflag, int vflag, int)
{
  if (eflag || vflag)
    pair->ev_setup(eflag, vflag);
  else
    pair->evflag = pair->vflag_fdotr = 0;

  const bool migrated = close_pairs_.have_rods_migrated();
  // With `pre no` a run begins with its first step.
  const bool run_begins = update->setupflag || update->ntimestep == update->firststep + 1;
  bring_pairs_up_to_date(*pair, migrated, run_begins);
  const NeighList *list = pair->listgranhistory;
  const PairHistories histories = {list ? list->firstneigh : nullptr,
                                   list ? list->firstdouble : nullptr, pair->dnum(), side_};
  laws_.begin({update->dt, pair->computeflag() != 0, pair->computeflag() && pair->shearupdate()});
  work_out(*pair, histories, side_ >= 0 && (migrated || run_begins));
  laws_.end();
  close_pairs_.counts().touching = touching_pairs_.count();
  sudden_overlaps_.end_step(migrated, shares_);
}

// `may_be_false`: histories of pairs that do not touch any more.
void GranularPairSpherocylinder::find_touching(PairGran &pair, const PairHistories &histories,
                                               bool may_be_false)
{
  const std::vector<Capsule> &rods = gatherer_.rods();
  threads_->run(static_cast<int>(touching_pairs_.pieces().size()),
                [&](int piece) { touching_pairs_.find(piece, rods, histories.flags); });
  if (may_be_false)
    false_histories_.drop(touching_pairs_, rods, histories.flags, histories.values, pair.dnum(),
                          side_);
}

// Pairs that no longer touch forget their contact.
void GranularPairSpherocylinder::end_contacts(int piece, int thread, const PairHistories &histories)
{
  ContactLaw &law = laws_.of_thread(thread);
  for (const CloseRodPairs::Entry &entry : touching_pairs_.parted(piece)) {
    double *values = histories.values_of(entry.i, entry.index);
    law.contact_ended(entry.i, entry.j, histories.flags_of(entry.i, entry.index), values);
    if (histories.remember_sides()) store(kZero, values + side_);
  }
}

void GranularPairSpherocylinder::work_out(PairGran &pair, const PairHistories &histories,
                                          bool may_be_false)
{
  PairVirial virial(lmp, pair);
  NormalForceSums<PairGran> sums(lmp, pair);
  std::optional<RowWriter> rows;
  ContactObservers observers = state_->observers();
  if (pair.evflag) observers.push_back(&virial);
  if (pair.computeflag() && pair.store_sum_normal_force()) observers.push_back(&sums);
  if (ContactRows *wanted = ContactRows::collecting(pair.cpl(), update->ntimestep)) {
    wanted->begin_rows();
    observers.push_back(&rows.emplace(lmp, *wanted));
  }

  const int pieces = static_cast<int>(touching_pairs_.pieces().size());
  const bool may_hand_over = shares_ && histories.flags && pair.computeflag() && pair.shearupdate();
  const bool at_once = observers.empty() && laws_.number() > 1 && pieces > 1 && !may_be_false;
  if (!at_once || may_hand_over) find_touching(pair, histories, may_be_false);
  if (may_hand_over)
    joint_histories_.hand_over(touching_pairs_, gatherer_.rods(), *shares_, histories,
                               laws_.models().layout());
  if (at_once) {
    work_out_at_once(pair, histories, may_hand_over);
  } else {
    // One after the other: observers see contacts in the order of the list.
    for (int piece = 0; piece < pieces; piece++) end_contacts(piece, 0, histories);
    for (int piece = 0; piece < pieces; piece++)
      work_out_piece(piece, 0, pair, histories, [&](const ContactBatch &batch) {
        if (pair.computeflag()) scatter_pairs(batch, pair, *atom);
        show(batch, observers);
      });
  }
  for (Worker &worker : workers_) {
    monitor_->take(worker.seen);
    sudden_overlaps_.take(worker.deep);
  }
}

// What a thread does with a piece of the touching pairs. `use(batch)`: with the loads of each batch.
template <typename Use>
void GranularPairSpherocylinder::work_out_piece(int piece, int thread, const PairGran &pair,
                                                const PairHistories &histories, Use use)
{
  ContactLaw &law = laws_.of_thread(thread);
  auto &[batch, seen, deep] = workers_[thread];
  const TouchingRodPairs::Piece &pairs = touching_pairs_.pieces()[piece];
  const bool springs_go_on = pair.computeflag() && pair.shearupdate();
  for (int first = pairs.first; first < pairs.first + pairs.count; first += kBatch) {
    gatherer_.fill(batch, touching_pairs_, pairs, first, histories,
                   laws_.keywords().spread_contact);
    law.evaluate(batch);
    relative_overlaps(batch.arms, batch.depth);
    add_spread(batch);
    if (shares_) take_weights(batch);
    if (any_above(batch.depth, SuddenOverlaps::kWatched, batch.count))
      for (int k = 0; k < batch.count; k++)
        // At a joint a contact begins as deep as the one that it goes on from, and of no share.
        deep.look(batch.i[k], batch.j[k], batch.depth[k] * (shares_ ? batch.weight[k] : 1.0),
                  batch.can_move(k));
    if (springs_go_on && histories.remember_sides()) keep_sides(batch);
    monitor_->look(batch, seen);
    use(batch);
  }
}

void GranularPairSpherocylinder::work_out_at_once(PairGran &pair, const PairHistories &histories,
                                                  bool are_found)
{
  const std::vector<Capsule> &rods = gatherer_.rods();
  const bool adds_forces = pair.computeflag() != 0;
  shared_scatter_.begin(touching_pairs_, pair, *atom);
  threads_->run(
      static_cast<int>(touching_pairs_.pieces().size()),
      [&](int piece) {
        if (!are_found) touching_pairs_.find(piece, rods, histories.flags);
        shared_scatter_.find_later_rods(piece);
      },
      [&](int piece) {
        shared_scatter_.find_waiting_rods(piece);
        end_contacts(piece, piece, histories);
        work_out_piece(piece, piece, pair, histories, [&](const ContactBatch &batch) {
          if (adds_forces) shared_scatter_.add(piece, batch);
        });
      },
      [&](int piece) { shared_scatter_.add_to_waiting_rods(piece); });
}

void GranularPairSpherocylinder::keep_sides(const ContactBatch &batch) const
{
  for (int k = 0; k < batch.count; k++)
    if (batch.can_move(k))
      store(remembered_side(batch.arms.normal.get(k), batch.depth[k]), batch.history[k] + side_);
}
