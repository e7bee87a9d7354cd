// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/place_together.h"

#include <algorithm>
#include <vector>

#include <mpi.h>

#include "atom.h"
#include "fix.h"
#include "fix_particledistribution_discrete.h"
#include "group.h"
#include "host/rod_error.h"
#include "insertion/particle_to_insert_spherocylinder.h"
#include "insertion/shared_placement.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/fibre_segments.h"

using namespace LAMMPS_NS;

namespace {

// Of a rank, sent to all others at a time.
constexpr int kMostProposed = 2000;

struct Proposal {
  int which;  // in the distribution's list
  DrawnPlace place;
};

class Placing {
 public:
  Placing(LAMMPS *lmp, const PlacingTask &task)
      : lmp_(lmp),
        task_(task),
        shared_(lmp, task.distribution->max_rad()),
        is_placed_(task.wanted, 0)
  {
    for (int k = 0; k < task.wanted; k++) waiting_.push_back(k);
  }

  void run()
  {
    while (propose()) settle();
  }

  bool is_placed(int k) const { return is_placed_[k] != 0; }

 private:
  LAMMPS *lmp_;
  const PlacingTask &task_;
  SharedPlacement shared_;
  int tries_ = 0;
  std::vector<int> waiting_;
  std::vector<char> is_placed_;
  std::vector<Proposal> proposals_;
  std::vector<SharedPlacement::Body> bodies_;

  ParticleToInsertSpherocylinder &body(int k) const
  {
    return static_cast<ParticleToInsertSpherocylinder &>(*task_.distribution->pti_list[k]);
  }

  // What this rank knows to be clear, one for each that waits. Whether any rank has one.
  bool propose()
  {
    proposals_.clear();
    bodies_.clear();
    for (const int k : waiting_) {
      if (static_cast<int>(proposals_.size()) == kMostProposed) break;
      while (tries_ < task_.most_tries) {
        tries_++;
        DrawnPlace place;
        if (!task_.draw(body(k), place)) continue;
        SharedPlacement::Body capsules = body(k).capsules_at(place.x, place.quat);
        if (!shared_.is_in_box(capsules) || !body(k).fits_container(capsules)) continue;
        if (task_.keeps_clear && !shared_.is_clear_here(capsules)) continue;
        proposals_.push_back({k, place});
        bodies_.push_back(std::move(capsules));
        break;
      }
    }
    const int mine = static_cast<int>(proposals_.size());
    int all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_SUM, lmp_->world);
    return all > 0;
  }

  void settle()
  {
    const std::vector<char> stays =
        task_.keeps_clear ? shared_.place(bodies_) : std::vector<char>(bodies_.size(), 1);
    for (size_t k = 0; k < proposals_.size(); k++) {
      if (!stays[k]) continue;
      const DrawnPlace &place = proposals_[k].place;
      body(proposals_[k].which).accept(place.x, place.v, place.omega, place.quat);
      is_placed_[proposals_[k].which] = 1;
    }
    waiting_.erase(
        std::remove_if(waiting_.begin(), waiting_.end(), [&](int k) { return is_placed_[k] != 0; }),
        waiting_.end());
  }
};

// A fibre that the joints' group cuts off would fall apart.
void check_group(LAMMPS *lmp, const Fix &insertion, const ParticleToInsertSpherocylinder &fibre)
{
  const Fix *joints = lmp->modify->find_fix_style_strict("joint/spherocylinder", 0);
  if (joints && ((fibre.groupbit | 1) & joints->groupbit)) return;
  rod_error_one(
      lmp,
      "Fix %s (id %s): fibres must be in group %s of fix joint/spherocylinder, which holds "
      "them together; give the template or the insertion that group",
      insertion.style, insertion.id, joints ? lmp->group->names[joints->igroup] : "all");
}

// Beyond all fibres there are, of any rank.
void number_fibres(LAMMPS *lmp, const std::vector<ParticleToInsertSpherocylinder *> &fibres)
{
  const auto &segments = rods_of(lmp, "Insertion of fibres").attached<FibreSegments>();
  int mine = 0, highest = 0;
  for (int i = 0; i < lmp->atom->nlocal; i++) mine = std::max(mine, segments.fibre(i));
  MPI_Allreduce(&mine, &highest, 1, MPI_INT, MPI_MAX, lmp->world);
  const int count = static_cast<int>(fibres.size());
  int up_to_me = 0;
  MPI_Scan(&count, &up_to_me, 1, MPI_INT, MPI_SUM, lmp->world);
  int id = highest + up_to_me - count;
  for (ParticleToInsertSpherocylinder *fibre : fibres) fibre->fibre = ++id;
}

}  // namespace

PlacingResult LAMMPS_NS::place_together(LAMMPS *lmp, const Fix &insertion, const PlacingTask &task)
{
  Placing placing(lmp, task);
  placing.run();

  PlacingResult result;
  std::vector<ParticleToInsert *> placed, left;
  std::vector<ParticleToInsertSpherocylinder *> fibres;
  ParticleToInsert **list = task.distribution->pti_list;
  for (int k = 0; k < task.wanted; k++) {
    (placing.is_placed(k) ? placed : left).push_back(list[k]);
    if (!placing.is_placed(k)) continue;
    auto &body = static_cast<ParticleToInsertSpherocylinder &>(*list[k]);
    result.bodies++;
    result.rods += body.nparticles;
    result.mass += body.mass_ins;
    if (!body.is_fibre()) continue;
    check_group(lmp, insertion, body);
    fibres.push_back(&body);
  }
  std::copy(left.begin(), left.end(), std::copy(placed.begin(), placed.end(), list));
  number_fibres(lmp, fibres);
  return result;
}
