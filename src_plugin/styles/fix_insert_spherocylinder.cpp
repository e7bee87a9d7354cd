// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_insert_spherocylinder.h"

#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "domain.h"
#include "fix_property_atom.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

struct Numbers {
  const char *keyword, *kind;  // kind: the word between keyword and numbers, null without
  int count;
  const char *or_word;    // may stand for the number
  bool is_whole = false;  // LIGGGHTS reads it by atoi, which takes 1e3 for 1
};

// What LIGGGHTS reads by atof and atoi, which take a word for 0.
constexpr Numbers kNumbers[] = {
    {"vel", "constant", 3, nullptr},
    {"vel", "uniform", 6, nullptr},
    {"vel", "gaussian", 6, nullptr},
    {"omega", "constant", 3, nullptr},
    {"orientation", "constant", 4, nullptr},
    {"maxattempt", nullptr, 1, nullptr, true},
    {"nparticles", nullptr, 1, "INF", true},
    {"mass", nullptr, 1, "INF"},
    {"particlerate", nullptr, 1, nullptr},
    {"massrate", nullptr, 1, nullptr},
    {"insert_every", nullptr, 1, "once", true},
    {"insert_every_time", nullptr, 1, "once"},
    {"every", nullptr, 1, "once", true},
    {"start", nullptr, 1, nullptr, true},
    {"volumefraction_region", nullptr, 1, nullptr},
    {"particles_in_region", nullptr, 1, nullptr, true},
    {"mass_in_region", nullptr, 1, nullptr},
    {"ntry_mc", nullptr, 1, nullptr, true},
    {"extrude_length", nullptr, 1, nullptr},
    {"duration", nullptr, 1, nullptr, true},
    {"duration_time", nullptr, 1, nullptr},
};

// Keywords whose value is a name that may be spelled like a keyword.
constexpr const char *kNames[] = {"distributiontemplate", "region", "insertion_face",
                                  "set_property"};

// Of `points` spread evenly over a box, those that `is_wanted` and that are this rank's: the share
// that is near a face, over all ranks.
template <typename IsWanted>
double share_near_faces_of(LAMMPS *lmp, const double *lo, const double *hi, double bounding_radius,
                           const IsWanted &is_wanted)
{
  constexpr int kPoints = 20000;
  // Steps of the sequence that fills a cube evenly: powers of the root of g^4 = g + 1 (Roberts
  // 2018).
  constexpr double kStep[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  int local[2] = {0, 0}, total[2] = {0, 0};
  double share[3] = {0.5, 0.5, 0.5};
  for (int k = 0; k < kPoints; k++) {
    double point[3];
    for (int d = 0; d < 3; d++) {
      share[d] = std::fmod(share[d] + kStep[d], 1.0);
      point[d] = lo[d] + share[d] * (hi[d] - lo[d]);
    }
    if (!lmp->domain->is_in_subdomain(point) || !is_wanted(point)) continue;
    local[0]++;
    if (lmp->domain->dist_subbox_borders(point) < bounding_radius) local[1]++;
  }
  MPI_Allreduce(local, total, 2, MPI_INT, MPI_SUM, lmp->world);
  return total[0] > 0 ? static_cast<double>(total[1]) / total[0] : 0.0;
}

double share_near_faces_of(LAMMPS *lmp, Region &region, double bounding_radius)
{
  const double lo[3] = {region.extent_xlo, region.extent_ylo, region.extent_zlo};
  const double hi[3] = {region.extent_xhi, region.extent_yhi, region.extent_zhi};
  return share_near_faces_of(lmp, lo, hi, bounding_radius,
                             [&](const double *x) { return region.match(x[0], x[1], x[2]) != 0; });
}

// New rods must not overlap those of other ranks, wherever these are.
template <typename Insertion>
void insert_among_ghosts(LAMMPS *lmp, Insertion &fix)
{
  if (fix.next_reneighbor == lmp->update->ntimestep)
    rods_of(lmp, "Insertion of rods").ghosts().bring_all_before_insertion();
  fix.Insertion::pre_exchange();
}

// Two ranks, or the two sides of a period, do not see each other's new rods.
void check_keeps_from_faces(LAMMPS *lmp, const Fix &fix, bool checks_overlap, bool keeps_from_faces)
{
  const Domain &domain = *lmp->domain;
  if (keeps_from_faces || !checks_overlap) return;
  if (lmp->comm->nprocs == 1 && !domain.xperiodic && !domain.yperiodic && !domain.zperiodic) return;
  rod_error_all(lmp,
                "Fix %s (id %s): check_dist_from_subdomain_border no with overlapcheck yes needs "
                "one rank and no periodic boundary (rods inserted on both sides of a border would "
                "overlap)",
                fix.style, fix.id);
}

}  // namespace

InsertionArguments::InsertionArguments(LAMMPS *lmp, int narg, char **arg) : words_(arg, arg + narg)
{
  for (int k = 3; k < narg; k++) {
    bool is_name = false;
    for (const char *name : kNames) is_name = is_name || words_[k] == name;
    if (is_name) {
      k++;
      continue;
    }
    if (words_[k] == "compress_tags" && k + 1 < narg && words_[k + 1] == "yes")
      rod_error_all(
          lmp,
          "Fix %s (id %s): compress_tags yes gives rods new ids that contact histories do "
          "not know; leave it out",
          arg[2], arg[0]);
    for (const Numbers &wanted : kNumbers) {
      if (words_[k] != wanted.keyword) continue;
      int first = k + 1;
      if (wanted.kind && (first >= narg || words_[first++] != wanted.kind)) continue;
      if (wanted.or_word && first < narg && words_[first] == wanted.or_word) break;
      if (first + wanted.count > narg)
        rod_error_all(lmp, "Fix %s (id %s): %s wants %d numbers (got %d)", arg[2], arg[0],
                      wanted.keyword, wanted.count, narg - first);
      double values[6];
      for (int m = 0; m < wanted.count; m++)
        values[m] = deck_number(lmp, fix_and_id(arg), wanted.keyword, words_[first + m]);
      if (wanted.is_whole)
        words_[first] =
            std::to_string(deck_whole_number(lmp, fix_and_id(arg), wanted.keyword, words_[first]));
      if (strcmp(wanted.keyword, "orientation") == 0) {
        double squared = 0.0;
        for (int m = 0; m < 4; m++) squared += values[m] * values[m];
        const double size = std::sqrt(squared);
        if (!(std::fabs(size - 1.0) <= kQuaternionTolerance))
          rod_error_all(lmp,
                        "Fix %s (id %s): the quaternion of orientation constant must have length 1 "
                        "within %g (got %s %s %s %s, length %g)",
                        arg[2], arg[0], kQuaternionTolerance, words_[first].c_str(),
                        words_[first + 1].c_str(), words_[first + 2].c_str(),
                        words_[first + 3].c_str(), size);
        for (int m = 0; m < 4; m++) {
          char text[32];
          snprintf(text, sizeof(text), "%.17g", values[m] / size);
          words_[first + m] = text;
        }
      }
      k = first + wanted.count - 1;
      break;
    }
  }
  for (std::string &word : words_) pointers_.push_back(word.data());
}

FixInsertPackSpherocylinder::FixInsertPackSpherocylinder(LAMMPS *lmp, InsertionArguments arguments)
    : FixInsertPack(lmp, arguments.count(), arguments.values())
{
}

void FixInsertPackSpherocylinder::init()
{
  FixInsertPack::init();
  check_keeps_from_faces(lmp, *this, check_ol_flag, check_dist_from_subdomain_border_);
}

// LIGGGHTS counts the volume that fills the region from the particles' radii: it is shown those of
// spheres of the rods' volume.
int FixInsertPackSpherocylinder::calc_ninsert_this()
{
  std::vector<double> equivalent(atom->nlocal + 1);
  for (int i = 0; i < atom->nlocal; i++)
    equivalent[i] = std::cbrt(atom->volume[i] / (4.0 * M_PI / 3.0));
  double *const bounding = atom->radius;
  atom->radius = equivalent.data();
  const int missing = FixInsertPack::calc_ninsert_this();
  atom->radius = bounding;
  return missing;
}

void FixInsertPackSpherocylinder::pre_exchange() { insert_among_ghosts<FixInsertPack>(lmp, *this); }

double FixInsertPackSpherocylinder::share_near_faces(double bounding_radius) const
{
  if (!check_ol_flag || !check_dist_from_subdomain_border_) return 0.0;
  return share_near_faces_of(lmp, *ins_region, bounding_radius);
}

FixInsertRateRegionSpherocylinder::FixInsertRateRegionSpherocylinder(LAMMPS *lmp,
                                                                     InsertionArguments arguments)
    : FixInsertRateRegion(lmp, arguments.count(), arguments.values())
{
}

void FixInsertRateRegionSpherocylinder::init()
{
  FixInsertRateRegion::init();
  check_keeps_from_faces(lmp, *this, check_ol_flag, check_dist_from_subdomain_border_);
}

void FixInsertRateRegionSpherocylinder::pre_exchange()
{
  insert_among_ghosts<FixInsertRateRegion>(lmp, *this);
}

double FixInsertRateRegionSpherocylinder::share_near_faces(double bounding_radius) const
{
  if (!check_ol_flag || !check_dist_from_subdomain_border_) return 0.0;
  return share_near_faces_of(lmp, *ins_region, bounding_radius);
}

FixInsertStreamSpherocylinder::FixInsertStreamSpherocylinder(LAMMPS *lmp,
                                                             InsertionArguments arguments)
    : FixInsertStream(lmp, arguments.count(), arguments.values())
{
}

// LIGGGHTS sets a new rod's angular velocity here, 0 until its release: our integrator goes by the
// angular momentum.
void FixInsertStreamSpherocylinder::end_of_step()
{
  // The first such fix moves the rods of all, whatever their groups.
  const int group = groupbit;
  groupbit = 1;
  FixInsertStream::end_of_step();
  groupbit = group;
  if (!i_am_integrator) return;
  constexpr int kInserted = 3, kReleased = 4;  // steps, in the release data
  const double now = static_cast<double>(update->ntimestep);
  double **release = fix_release->array_atom;
  for (int i = 0; i < atom->nlocal; i++) {
    if (release[i][kInserted] == 0.0 || release[i][kReleased] < now) continue;
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    sc::store(sc::angular_momentum(sc::load(atom->omega[i]), axis, atom->inertia[i][2],
                                   atom->inertia[i][0]),
              atom->angmom[i]);
  }
}

void FixInsertStreamSpherocylinder::pre_exchange()
{
  insert_among_ghosts<FixInsertStream>(lmp, *this);
}

double FixInsertStreamSpherocylinder::share_near_faces(double bounding_radius) const
{
  if (!check_ol_flag) return 0.0;
  return share_near_faces_of(lmp, ins_vol_xmin, ins_vol_xmax, bounding_radius,
                             [](const double *) { return true; });
}
