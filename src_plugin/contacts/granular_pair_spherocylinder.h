// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contacts/contact_laws.h"
#include "contacts/contact_monitor.h"
#include "contacts/contact_state.h"
#include "contacts/false_histories.h"
#include "contacts/gather_pairs.h"
#include "contacts/joint_histories.h"
#include "contacts/scatter.h"
#include "contacts/sudden_overlaps.h"
#include "granular_pair_style.h"
#include "lists/close_rod_pairs.h"
#include "lists/joint_shares.h"
#include "lists/touching_rod_pairs.h"

namespace LAMMPS_NS {

// What the stock pair_style gran runs for rods: from the lists to touching pairs, batches of contacts,
// their law, and forces.
class GranularPairSpherocylinder : private Pointers,
                                   public LIGGGHTS::PairStyles::IGranularPairStyle {
 public:
  GranularPairSpherocylinder(LAMMPS *lmp, PairGran *parent, std::unique_ptr<StockLaw> models);
  ~GranularPairSpherocylinder() override;

  void settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *history) override;
  void init_granular() override;
  void write_restart_settings(FILE *file) override;
  void read_restart_settings(FILE *file, int64_t hash) override;
  void compute_force(PairGran *pair, int eflag, int vflag, int addflag) override;

  int64_t hashcode() override { return laws_.models().hashcode(); }
  bool contact_match(const std::string type, const std::string model) override
  {
    return laws_.models().is(type, model);
  }
  int get_history_offset(const std::string name) override
  {
    return laws_.models().history_offset(name);
  }
  double stressStrainExponent() override { return laws_.models().stress_strain_exponent(); }

 private:
  PairGran *parent_;
  ContactLaws laws_;
  bool has_settings_ = false;  // false for a pair style made by read_restart
  int highest_type_ = 0;       // that material properties are there for
  int side_ = -1;              // where histories keep the remembered normal, -1 if they do not

  CloseRodPairs close_pairs_;
  TouchingRodPairs touching_pairs_;
  FalseHistories false_histories_;
  JointHistories joint_histories_;
  PairGatherer gatherer_;
  // What a thread works with.
  struct alignas(spherocylinder::kCacheLine) Worker {
    ContactBatch batch;
    ContactMonitor::Seen seen;
    SuddenOverlaps::Seen deep;
  };
  std::vector<Worker> workers_;
  SharedScatter shared_scatter_;
  const RodThreads *threads_ = nullptr;  // these four: attached to the rods
  ContactMonitor *monitor_ = nullptr;
  const ContactState *state_ = nullptr;
  JointShares *joint_shares_ = nullptr;
  const JointShares *shares_ = nullptr;  // of this step, null without fibres
  SuddenOverlaps sudden_overlaps_;

  void use_search();
  void check_models_are_restarted_ones(ContactState::Restarted &restarted);
  void bring_pairs_up_to_date(PairGran &pair, bool migrated, bool run_begins);
  void find_touching(PairGran &pair, const PairHistories &histories, bool may_be_false);
  void end_contacts(int piece, int thread, const PairHistories &histories);
  void work_out(PairGran &pair, const PairHistories &histories, bool may_be_false);
  template <typename Use>
  void work_out_piece(int piece, int thread, const PairGran &pair, const PairHistories &histories,
                      Use use);
  void work_out_at_once(PairGran &pair, const PairHistories &histories, bool are_found);
  void keep_sides(const ContactBatch &batch) const;
};

}  // namespace LAMMPS_NS
