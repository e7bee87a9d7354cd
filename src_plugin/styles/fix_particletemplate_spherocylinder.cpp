// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_particletemplate_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

#include "comm.h"
#include "core/mass_properties.h"
#include "core/numbers.h"
#include "domain.h"
#include "error.h"
#include "fix_insert.h"
#include "fix_particledistribution_discrete.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "insertion/particle_to_insert_spherocylinder.h"
#include "memory.h"
#include "modify.h"
#include "probability_distribution.h"
#include "region.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "styles/fix_insert_spherocylinder.h"

using namespace LAMMPS_NS;
using namespace LMP_PROBABILITY_NS;

namespace {

// Segments of a straight fibre may touch by what rounding costs, over the diameter.
constexpr double kTouch = 1e-9;

bool is_one_of(const char *word, std::initializer_list<const char *> words)
{
  return std::any_of(words.begin(), words.end(),
                     [&](const char *other) { return strcmp(word, other) == 0; });
}

// FixTemplateSphere's constructor knows the keywords of its own style only and takes `radius` for
// a mistake in any other, so it is shown the command without ours.
class StockArguments {
 public:
  StockArguments(int narg, char **arg)
  {
    for (int i = 0; i < narg; i++) {
      const bool takes_two = strcmp(arg[i], "radius") == 0 || strcmp(arg[i], "length") == 0;
      const bool takes_one =
          is_one_of(arg[i], {"all_in_region", "segments", "rest_curvature", "rest_twist"});
      if (i > 3 && (takes_two || takes_one))
        i += takes_two ? 2 : 1;
      else
        arguments_.push_back(arg[i]);
    }
  }
  int count() const { return static_cast<int>(arguments_.size()); }
  char **values() { return arguments_.data(); }

 private:
  std::vector<char *> arguments_;
};

}  // namespace

FixParticletemplateSpherocylinder::FixParticletemplateSpherocylinder(LAMMPS *lmp, int narg,
                                                                     char **arg)
    : FixTemplateSphere(lmp, StockArguments(narg, arg).count(), StockArguments(narg, arg).values())
{
  rods_of(lmp, "Fix particletemplate/spherocylinder");
  parse_rod_keywords(narg, arg);
  if (relative)
    rod_error_all(lmp, "Fix %s (id %s): relative must be no (got yes); a rod's size is given in m",
                  style, id);
  StockArguments stock(narg, arg);
  if (iarg < stock.count())
    rod_error_all(lmp, "Fix %s (id %s): unknown keyword %s", style, id, stock.values()[iarg]);

  density_ = expectancy(pdf_density);
  bounding_radius_ = makes_fibres() ? bounding_radius_of(shape_) : 0.5 * total_length_;
  volume_expect = volume_of(shape_);
  mass_expect = makes_fibres()
                    ? density_ * volume_expect
                    : spherocylinder::mass_properties(diameter_, total_length_, density_).mass;
  // The stock guard against mistaken units is an absolute volume made for grains; a thin fibre in
  // metres is smaller. Our sizes are checked on their own.
  vol_limit = std::min(vol_limit, 0.5 * volume_expect);

  if (container_) check_container_is_large_enough();
}

FixParticletemplateSpherocylinder::~FixParticletemplateSpherocylinder()
{
  delete pti;
  if (pti_list) delete_ptilist();
}

void FixParticletemplateSpherocylinder::post_create()
{
  FixTemplateSphere::post_create();
  if (makes_fibres()) fibres_of(lmp);
}

// A run may begin without any fibre, and get them from here.
void FixParticletemplateSpherocylinder::init()
{
  if (!makes_fibres()) return;
  fibres_of(lmp);
  if (modify->n_fixes_style_strict("joint/spherocylinder") > 0) return;
  rod_error_all(
      lmp,
      "Fix %s (id %s): segments %d makes fibres, but no fix holds them together (expected "
      "fix ID all joint/spherocylinder)",
      style, id, number_spheres());
}

void FixParticletemplateSpherocylinder::parse_rod_keywords(int narg, char **arg)
{
  double radius = 0.0, curvature = 0.0, twist = 0.0;
  int segments = 1;
  const char *rest = nullptr;  // the keyword that a rod has no use for
  for (int i = 4; i < narg; i++) {
    const bool is_radius = strcmp(arg[i], "radius") == 0;
    if (is_radius || strcmp(arg[i], "length") == 0) {
      if (i + 2 >= narg)
        rod_error_all(lmp, "Fix %s (id %s): not enough arguments after %s", style, id, arg[i]);
      if (strcmp(arg[i + 1], "constant") != 0)
        rod_error_all(lmp,
                      "Fix %s (id %s): %s must be constant (got %s); mix sizes by several "
                      "templates in particledistribution/discrete",
                      style, id, arg[i], arg[i + 1]);
      const double value = deck_number(lmp, fix_and_id(arg), arg[i], arg[i + 2]);
      if (!(value > 0.0))
        rod_error_all(lmp, "Fix %s (id %s): %s must be > 0 (got %s)", style, id, arg[i],
                      arg[i + 2]);
      (is_radius ? radius : total_length_) = value;
      i += 2;
    } else if (strcmp(arg[i], "all_in_region") == 0) {
      if (i + 1 >= narg)
        rod_error_all(lmp, "Fix %s (id %s): not enough arguments after %s", style, id, arg[i]);
      const int iregion = domain->find_region(arg[i + 1]);
      if (iregion < 0)
        rod_error_all(lmp, "Fix %s (id %s): region %s does not exist", style, id, arg[i + 1]);
      container_ = domain->regions[iregion];
      if (strcmp(container_->style, "mesh/tet") == 0)
        rod_error_all(lmp,
                      "Fix %s (id %s): region %s of style mesh/tet cannot tell how far a rod's end "
                      "is from its surface; wanted a region of another style, or all_in yes in "
                      "the insertion command",
                      style, id, arg[i + 1]);
      i++;
    } else if (is_one_of(arg[i], {"segments", "rest_curvature", "rest_twist"})) {
      if (i + 1 >= narg)
        rod_error_all(lmp, "Fix %s (id %s): not enough arguments after %s", style, id, arg[i]);
      if (strcmp(arg[i], "segments") == 0) {
        segments = deck_whole_number(lmp, fix_and_id(arg), arg[i], arg[i + 1]);
        if (segments < 1)
          rod_error_all(lmp, "Fix %s (id %s): segments must be >= 1 (got %s)", style, id,
                        arg[i + 1]);
      } else {
        const double value = deck_number(lmp, fix_and_id(arg), arg[i], arg[i + 1]);
        (strcmp(arg[i], "rest_curvature") == 0 ? curvature : twist) = value;
        if (value != 0.0) rest = arg[i];
      }
      i++;
    }
  }
  if (radius == 0.0)
    rod_error_all(lmp, "Fix %s (id %s): have to define 'radius constant R'", style, id);
  if (total_length_ == 0.0)
    rod_error_all(lmp, "Fix %s (id %s): have to define 'length constant L'", style, id);
  diameter_ = 2.0 * radius * force->cg(atom_type);
  total_length_ *= force->cg(atom_type);
  if (total_length_ < diameter_)
    rod_error_all(lmp,
                  "Fix %s (id %s): length is the total length and must be >= the diameter %g "
                  "(got %g)",
                  style, id, diameter_, total_length_);
  if (rest && segments == 1)
    rod_error_all(lmp,
                  "Fix %s (id %s): %s is of the joints of a fibre and wants segments >= 2 (got 1)",
                  style, id, rest);
  make_shape(segments, curvature / force->cg(atom_type), twist / force->cg(atom_type));
}

void FixParticletemplateSpherocylinder::make_shape(int segments, double curvature, double twist)
{
  const double radius = 0.5 * diameter_, distance = (total_length_ - diameter_) / segments;
  if (segments > 1 && distance < radius)
    rod_error_all(lmp,
                  "Fix %s (id %s): joints must be at least a radius %g apart, in a length of %g "
                  "segments <= %d (got %d, joints %g apart)",
                  style, id, radius, total_length_,
                  std::max(1, static_cast<int>((total_length_ - diameter_) / radius)), segments,
                  distance);
  for (const double angle : {curvature * distance, twist * distance})
    if (!(std::fabs(angle) < spherocylinder::kLargestJointAngle))
      rod_error_all(lmp,
                    "Fix %s (id %s): rest_curvature and rest_twist must turn a joint by less than "
                    "179 degrees (got %g, joints %g apart)",
                    style, id, angle * spherocylinder::degrees, distance);
  shape_ = spherocylinder::fibre_shape(segments, radius, total_length_, curvature, twist);
  const double gap = narrowest_gap_of(shape_);
  if (gap < -kTouch * diameter_)
    rod_error_all(
        lmp,
        "Fix %s (id %s): with this rest_curvature %g and rest_twist %g the fibre overlaps "
        "itself by %g, wanted a fibre whose segments are clear of each other",
        style, id, curvature, twist, -gap);
}

// A box that holds the region must at least hold the rod on its diagonal.
void FixParticletemplateSpherocylinder::check_container_is_large_enough() const
{
  const double extent[3] = {container_->extent_xhi - container_->extent_xlo - diameter_,
                            container_->extent_yhi - container_->extent_ylo - diameter_,
                            container_->extent_zhi - container_->extent_zlo - diameter_};
  const double narrowest = *std::min_element(extent, extent + 3);
  const double diagonal =
      std::sqrt(extent[0] * extent[0] + extent[1] * extent[1] + extent[2] * extent[2]);
  if (narrowest < 0.0)
    rod_error_all(lmp,
                  "Fix %s (id %s): region %s is too small for the rod: it is %g wide at its "
                  "narrowest, wanted more than the rod's diameter %g",
                  style, id, container_->id, narrowest + diameter_, diameter_);
  const double chord = chord_of(shape_);
  if (diagonal < chord)
    rod_error_all(lmp,
                  "Fix %s (id %s): region %s is too small for the rod: it holds a length of %g at "
                  "most, wanted at least the rod's length %g",
                  style, id, container_->id, diagonal + diameter_,
                  makes_fibres() ? chord + diameter_ : total_length_);
}

// Of an atom, and of what is placed as a whole.
double FixParticletemplateSpherocylinder::min_rad() { return max_rad(); }
double FixParticletemplateSpherocylinder::max_rad() { return 0.5 * shape_.segment_length; }
double FixParticletemplateSpherocylinder::max_r_bound() { return bounding_radius_; }

void FixParticletemplateSpherocylinder::describe(ParticleToInsertSpherocylinder &rod) const
{
  rod.container = container_;
  rod.placed = false;
  rod.fibre = 0;
  rod.atom_type = atom_type;
  rod.density_ins = density_;
  rod.volume_ins = volume_expect;
  rod.mass_ins = mass_expect;
  rod.r_bound_ins = bounding_radius_;
  for (int k = 0; k < rod.nparticles; k++) {
    rod.radius_ins[k] = 0.5 * shape_.segment_length;
    for (int d = 0; d < 3; d++) rod.x_ins[k][d] = 0.0;
  }
  for (int d = 0; d < 3; d++) rod.v_ins[d] = rod.omega_ins[d] = 0.0;
  rod.groupbit = groupbit;
}

void FixParticletemplateSpherocylinder::randomize_single()
{
  auto *rod = new ParticleToInsertSpherocylinder(lmp, shape_, nullptr);
  delete pti;
  pti = rod;
  describe(*rod);
}

void FixParticletemplateSpherocylinder::init_ptilist(int n_random_max, const bool,
                                                     FixPropertyAtom *const fix_release)
{
  if (pti_list) error->one(FLERR, "Fix particletemplate/spherocylinder: list exists already");
  n_pti_max = n_random_max;
  pti_list = static_cast<ParticleToInsert **>(
      // An array of pointers. NOLINTNEXTLINE(bugprone-sizeof-expression)
      memory->smalloc(n_pti_max * sizeof(ParticleToInsert *), "pti_list"));
  for (int i = 0; i < n_pti_max; i++)
    pti_list[i] = new ParticleToInsertSpherocylinder(lmp, shape_, fix_release);
}

void FixParticletemplateSpherocylinder::delete_ptilist()
{
  if (n_pti_max == 0) return;
  for (int i = 0; i < n_pti_max; i++) delete pti_list[i];
  memory->sfree(pti_list);
  pti_list = nullptr;
  n_pti_max = 0;
  requested_ = 0;
}

void FixParticletemplateSpherocylinder::randomize_ptilist(int n_random, int distribution_groupbit,
                                                          int distorder)
{
  requested_ = n_random;
  for (int i = 0; i < n_random; i++) {
    auto &rod = static_cast<ParticleToInsertSpherocylinder &>(*pti_list[i]);
    describe(rod);
    rod.groupbit = groupbit | distribution_groupbit;
    rod.distorder = distorder;
  }
}

void FixParticletemplateSpherocylinder::direct_set_ptlist(const int, const void *const, const int,
                                                          const int)
{
  rod_error_one(lmp, "Fix %s (id %s): insert/stream/predefined reads spheres and cannot place rods",
                style, id);
}

unsigned int FixParticletemplateSpherocylinder::generate_hash()
{
  unsigned int hash = 0;
  unsigned int start = seed_orig * 420001;  // as in FixTemplateSphere
  add_hash_value(atom_type, start, hash);
  add_hash_value(diameter_, start, hash);
  add_hash_value(total_length_, start, hash);
  add_hash_value(density_, start, hash);
  if (makes_fibres()) {
    add_hash_value(number_spheres(), start, hash);
    add_hash_value(shape_.rest.bend_y, start, hash);
    add_hash_value(shape_.rest.twist, start, hash);
  }
  return hash;
}

// Called by every rank once the rods of this insertion are in. LIGGGHTS only warns that there are
// fewer than requested; here a rod that no later step will place is an error with the numbers.
void FixParticletemplateSpherocylinder::finalize_insertion()
{
  int local[2] = {requested_, 0}, total[2];
  for (int i = 0; i < requested_; i++)
    local[1] += static_cast<ParticleToInsertSpherocylinder &>(*pti_list[i]).placed;
  requested_ = 0;
  MPI_Allreduce(local, total, 2, MPI_INT, MPI_SUM, world);
  if (total[1] == total[0]) return;

  const char *inserter = "insert", *bodies = makes_fibres() ? "fibres" : "rods";
  bool tries_again = false;
  double near_faces = 0.0;
  for (int i = 0; i < modify->nfix; i++) {
    auto *insert = dynamic_cast<FixInsert *>(modify->fix[i]);
    if (!insert || !insert->has_inserted()) continue;
    inserter = insert->id;
    tries_again = tries_again || insert->ins_every() > 0;
    if (const auto *centres = dynamic_cast<const InsertionNearFaces *>(insert))
      near_faces = centres->share_near_faces(bounding_radius_);
  }

  char why[200] = "";
  if (near_faces > 0.005)
    snprintf(why, sizeof(why),
             " (no centre was tried in %.0f %% of its space, nearer than half a rod's length %g to "
             "a face of a processor's part of the box)",
             100.0 * near_faces, bounding_radius_);
  if (!tries_again)
    rod_error_all(lmp,
                  "Fix %s (id %s): insertion %s placed %d of %d %s%s; use a larger region, fewer "
                  "%s or more attempts (maxattempt)%s",
                  style, id, inserter, total[1], total[0], bodies, why, bodies,
                  *why && comm->nprocs > 1 ? ", or fewer processors or other cuts" : "");
  if (comm->me == 0)
    rod_warning(lmp, "Fix %s (id %s): insertion %s placed %d of %d %s at this step%s", style, id,
                inserter, total[1], total[0], bodies, why);
}
