// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/displace_rods.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "domain.h"
#include "fix.h"
#include "force.h"
#include "group.h"
#include "host/rod_error.h"
#include "modify.h"
#include "pair_gran.h"
#include "parallel/from_all_ranks.h"
#include "styles/fix_contact_history_spherocylinder.h"
#include "styles/fix_wall_gran_spherocylinder.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

}  // namespace

void DisplaceRods::command(int narg, char **arg)
{
  const int igroup = narg >= 2 ? group->find(arg[0]) : -1;
  if (igroup >= 0) {
    check_nothing_drives(group->bitmask[igroup], arg[0]);
    // Before the centres, with which the rods may go to other ranks. What is wrong with the
    // command LIGGGHTS says.
    if (strcmp(arg[1], "rotate") == 0 && narg >= 9) turn_rods(group->bitmask[igroup], arg);
  }
  DisplaceAtoms::command(narg, arg);
  check_nothing_left();
}

// Beyond a fixed face a rod would be gone at the next run's start, without a word whatever
// `thermo_modify lost` says.
void DisplaceRods::check_nothing_left()
{
  int outside = 0, all = 0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int d = 0; d < 3; d++) {
      const double x = atom->x[i][d];
      if ((domain->boundary[d][0] == 1 && x < domain->boxlo[d]) ||
          (domain->boundary[d][1] == 1 && x >= domain->boxhi[d])) {
        outside++;
        break;
      }
    }
  MPI_Allreduce(&outside, &all, 1, MPI_INT, MPI_SUM, world);
  if (all > 0)
    rod_error_all(lmp,
                  "Displace_atoms: %d rods are outside the box now and would be lost (delete them "
                  "first, or make the box larger by change_box)",
                  all);
}

void DisplaceRods::check_nothing_drives(int groupbit, const char *group_name)
{
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (strcmp(fix->style, "move") != 0) continue;
    int driven = 0, any = 0;
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && (atom->mask[i] & fix->groupbit)) driven++;
    MPI_Allreduce(&driven, &any, 1, MPI_INT, MPI_SUM, world);
    if (any > 0)
      rod_error_all(lmp,
                    "Displace_atoms: fix move (id %s) drives %d rods of group %s and would put "
                    "them back (unfix it first)",
                    fix->id, any, group_name);
  }
}

void DisplaceRods::turn_rods(int groupbit, char **arg)
{
  const sc::Vec3 direction = {force->numeric(FLERR, arg[5]), force->numeric(FLERR, arg[6]),
                              force->numeric(FLERR, arg[7])};
  const double angle = force->numeric(FLERR, arg[8]) * kDegree;
  const double length = sc::norm(direction);
  if (!(length > 0.0)) return;  // LIGGGHTS's error
  const sc::Quaternion rotation = sc::rotation_about((1.0 / length) * direction, angle);
  turn_springs(groupbit, rotation);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double *orientation = atom->quaternion[i];
    sc::store(sc::normalized(rotation * sc::load_quaternion(orientation)), orientation);
    for (double **spin : {atom->omega, atom->angmom})
      sc::store(sc::rotated(sc::load(spin[i]), rotation), spin[i]);
  }
}

// Contacts of rods that are turned together stay what they are. Those with walls and with rods that
// are not turned begin anew.
void DisplaceRods::turn_springs(int groupbit, const sc::Quaternion &rotation)
{
  bring_histories_to_rods(lmp);
  std::vector<int> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) mine.push_back(atom->tag[i]);
  std::vector<int> ids = from_all_ranks(world, mine);
  std::sort(ids.begin(), ids.end());

  int forgotten[2] = {0, 0};
  auto *pair = dynamic_cast<PairGran *>(force->pair);
  auto *histories =
      pair ? dynamic_cast<FixContactHistorySpherocylinder *>(pair->get_fix_history()) : nullptr;
  if (histories)
    forgotten[0] = histories->turn(
        rotation, [&ids](int id) { return std::binary_search(ids.begin(), ids.end(), id); });
  for (int k = 0; k < modify->nfix; k++)
    if (auto *wall = dynamic_cast<FixWallGranSpherocylinder *>(modify->fix[k]))
      forgotten[1] += wall->forget_contacts(groupbit);

  int total[2];
  MPI_Allreduce(forgotten, total, 2, MPI_INT, MPI_SUM, world);
  if (total[0] + total[1] > 0 && comm->me == 0)
    rod_warning(
        lmp,
        "Displace_atoms rotate: %d contacts with rods that are not turned and %d of rods with "
        "walls begin anew, without their friction springs",
        total[0] / 2, total[1]);
}
