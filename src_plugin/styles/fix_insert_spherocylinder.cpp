// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_insert_spherocylinder.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "domain.h"
#include "fix_mesh_surface.h"
#include "fix_property_atom.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "insertion/particle_to_insert_spherocylinder.h"
#include "math_extra_liggghts.h"
#include "parallel/from_all_ranks.h"
#include "random_park.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/fibre_segments.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "styles/place_together.h"
#include "tri_mesh.h"
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

void place_share(LAMMPS *lmp, const Fix &fix, const PlacingTask &task, int &placed, int &rods,
                 double &mass)
{
  const PlacingResult result = place_together(lmp, fix, task);
  placed = result.bodies;
  rods = result.rods;
  mass = result.mass;
}

// Rods and fibres in the region, of all ranks: a rod whose centre is there, and of a fibre the share of its
// segments whose centres are.
int bodies_in(LAMMPS *lmp, Region &region)
{
  const Atom &atom = *lmp->atom;
  const auto &segments = rods_of(lmp, "Insertion of rods").attached<FibreSegments>();
  double mine = 0.0, all = 0.0;
  std::vector<int> numbers;  // fibre, whether the segment is in
  for (int i = 0; i < atom.nlocal; i++) {
    const double *x = atom.x[i];
    const int is_in = region.match(x[0], x[1], x[2]) != 0;
    if (segments.is_segment(i))
      numbers.insert(numbers.end(), {segments.fibre(i), is_in});
    else
      mine += is_in;
  }
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, lmp->world);
  const std::vector<int> of_all = from_all_ranks(lmp->world, numbers);
  std::map<int, std::pair<int, int>> fibres;  // segments, those that are in
  for (size_t k = 0; k < of_all.size(); k += 2) {
    fibres[of_all[k]].first++;
    fibres[of_all[k]].second += of_all[k + 1];
  }
  for (const auto &[id, fibre] : fibres) all += static_cast<double>(fibre.second) / fibre.first;
  return static_cast<int>(std::lround(all));
}

// New rods must not overlap those of other ranks, wherever these are.
template <typename Insertion>
void insert_among_ghosts(LAMMPS *lmp, Insertion &fix)
{
  if (fix.next_reneighbor == lmp->update->ntimestep && !find_fibres(lmp))
    rods_of(lmp, "Insertion of rods").ghosts().bring_all_before_insertion();
  fix.Insertion::pre_exchange();
}

// Two ranks, or the two sides of a period, do not see each other's new rods.
void check_keeps_from_faces(LAMMPS *lmp, const Fix &fix, bool checks_overlap, bool keeps_from_faces)
{
  const Domain &domain = *lmp->domain;
  if (keeps_from_faces || !checks_overlap || find_fibres(lmp)) return;
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

template <typename Insertion>
InsertionInRegion<Insertion>::InsertionInRegion(LAMMPS *lmp, InsertionArguments arguments)
    : Insertion(lmp, arguments.count(), arguments.values())
{
}

template <typename Insertion>
void InsertionInRegion<Insertion>::init()
{
  Insertion::init();
  check_keeps_from_faces(this->lmp, *this, this->check_ol_flag,
                         this->check_dist_from_subdomain_border_);
  if (find_fibres(this->lmp)) this->warn_boxentent = false;
}

template <typename Insertion>
void InsertionInRegion<Insertion>::pre_exchange()
{
  insert_among_ghosts<Insertion>(this->lmp, *this);
}

template <typename Insertion>
double InsertionInRegion<Insertion>::share_near_faces(double bounding_radius) const
{
  if (!this->check_ol_flag || !this->check_dist_from_subdomain_border_ || find_fibres(this->lmp))
    return 0.0;
  return share_near_faces_of(this->lmp, *this->ins_region, bounding_radius);
}

// Draws as FixInsertPack does, but for its distance from the faces of this rank's part of the box.
template <typename Insertion>
void InsertionInRegion<Insertion>::x_v_omega(int wanted, int &placed, int &rods, double &mass)
{
  if (!find_fibres(this->lmp)) return Insertion::x_v_omega(wanted, placed, rods, mass);
  const auto draw = [this](ParticleToInsertSpherocylinder &body, DrawnPlace &place) {
    if (this->all_in_flag)
      this->ins_region->generate_random_shrinkby_cut(place.x, body.r_bound_ins, true);
    else
      this->ins_region->generate_random(place.x, true);
    std::copy_n(this->v_insert, 3, place.v);
    this->generate_random_velocity(place.v);
    if (this->quat_random_) MathExtraLiggghts::random_unit_quat(this->random, this->quat_insert);
    std::copy_n(this->omega_insert, 3, place.omega);
    std::copy_n(this->quat_insert, 4, place.quat);
    return true;
  };
  place_share(
      this->lmp, *this,
      {this->fix_distribution, wanted, this->calc_maxtry(wanted), this->check_ol_flag != 0, draw},
      placed, rods, mass);
}

template class LAMMPS_NS::InsertionInRegion<FixInsertPack>;
template class LAMMPS_NS::InsertionInRegion<FixInsertRateRegion>;

// LIGGGHTS counts the volume that fills the region from the particles' radii: it is shown those of
// spheres of the rods' volume. Where it counts particles, segments of a fibre are parts of one.
int FixInsertPackSpherocylinder::calc_ninsert_this()
{
  if (ntotal_region > 0 && find_fibres(lmp)) {
    const int there = bodies_in(lmp, *ins_region);
    insertion_ratio = std::min(1.0, static_cast<double>(there) / ntotal_region);
    return std::max(0, ntotal_region - there);
  }
  std::vector<double> equivalent(atom->nlocal + 1);
  for (int i = 0; i < atom->nlocal; i++)
    equivalent[i] = std::cbrt(atom->volume[i] / (4.0 * M_PI / 3.0));
  double *const bounding = atom->radius;
  atom->radius = equivalent.data();
  const int missing = FixInsertPack::calc_ninsert_this();
  atom->radius = bounding;
  return missing;
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
  if (!check_ol_flag || find_fibres(lmp)) return 0.0;
  return share_near_faces_of(lmp, ins_vol_xmin, ins_vol_xmax, bounding_radius,
                             [](const double *) { return true; });
}

// Parts of the box may be smaller than what is placed together.
void FixInsertStreamSpherocylinder::init()
{
  FixInsertStream::init();
  if (find_fibres(lmp)) warn_boxentent = false;
}

// Draws as FixInsertStream does, but for its distance from the faces of this rank's part of the box.
void FixInsertStreamSpherocylinder::x_v_omega(int wanted, int &placed, int &rods, double &mass)
{
  if (!find_fibres(lmp)) return FixInsertStream::x_v_omega(wanted, placed, rods, mass);
  const auto draw = [this](ParticleToInsertSpherocylinder &body, DrawnPlace &place) {
    const double bounding_radius = body.r_bound_ins;
    if (all_in_flag)
      ins_face->generateRandomOwnedGhostWithin(place.x, bounding_radius);
    else
      ins_face->generateRandomOwnedGhost(place.x);
    const double depth =
        check_ol_flag ? extrude_length_max : extrude_length_max - 2.0 * bounding_radius;
    const double behind = random->uniform() * depth + bounding_radius + extrude_length_min;
    for (int d = 0; d < 3; d++) {
      place.x[d] -= behind * normalvec[d];
      place.v[d] = v_normal[d];
      place.omega[d] = 0.0;
    }
    if (!domain->is_in_subdomain(place.x)) return false;
    if (quat_random_) MathExtraLiggghts::random_unit_quat(random, quat_insert);
    std::copy_n(quat_insert, 4, place.quat);
    return true;
  };
  place_share(lmp, *this, {fix_distribution, wanted, wanted * maxattempt, check_ol_flag != 0, draw},
              placed, rods, mass);
}

// LIGGGHTS says of each rod when it is released, and how it moves then. A fibre is released when its centre
// comes through the face, and moves as one: with the velocity drawn for its first segment.
void FixInsertStreamSpherocylinder::finalize_insertion(int rods)
{
  FixInsertStream::finalize_insertion(rods);
  constexpr int kReleased = 4, kVelocity = 8;  // in the release data
  constexpr double kTiny = 1e-14;              // as LIGGGHTS rounds
  int i = atom->nlocal - rods;
  for (int k = 0; i < atom->nlocal; k++) {
    const auto &body =
        static_cast<ParticleToInsertSpherocylinder &>(*fix_distribution->pti_list[k]);
    const int first = i;
    i += body.nparticles;
    if (!body.is_fibre()) continue;
    double **release = fix_release->array_atom;
    const double way = sc::dot(sc::load(p_ref) - body.centre(), sc::load(normalvec));
    const double speed = sc::norm(sc::load(v_normal));
    const int steps = static_cast<int>((way + kTiny) / (speed * update->dt));
    const sc::Vec3 velocity = sc::load(&release[first][kVelocity]);
    for (int m = 0; m < body.nparticles; m++) {
      const sc::Vec3 arm = sc::load(body.x_ins[m]) - body.centre();
      release[first + m][kReleased] = static_cast<double>(update->ntimestep + steps);
      sc::store(velocity + sc::cross(sc::load(omega_insert), arm), &release[first + m][kVelocity]);
    }
  }
}
