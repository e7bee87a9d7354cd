// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_joint_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "atom.h"
#include "comm.h"
#include "core/joint_constants.h"
#include "core/numbers.h"
#include "group.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "modify.h"
#include "neighbor.h"
#include "parallel/from_all_ranks.h"
#include "rods/atom_vec_spherocylinder.h"
#include "rods/rod_driver.h"
#include "rods/rod_threads.h"
#include "styles/fibre_chains.h"
#include "styles/fix_fibres_spherocylinder.h"
#include "styles/fix_particletemplate_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace spherocylinder;

namespace {

using S = FibreSegments;

// Of a thread: fewer joints are worked out sooner than others are told.
constexpr int kFewestJoints = 50;

JointChannels operator+(const JointChannels &a, const JointChannels &b)
{
  return {a.stretch + b.stretch, a.shear + b.shear, a.bend + b.bend, a.twist + b.twist};
}

double sum_of(const JointChannels &c) { return c.stretch + c.shear + c.bend + c.twist; }

}  // namespace

FixJointSpherocylinder::FixJointSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), joints_(lmp), partings_(lmp)
{
  AtomVecSpherocylinder &rods = rods_of(lmp, "Fix joint/spherocylinder");
  threads_ = &rods.attached<RodThreads>();
  segments_ = &rods.attached<FibreSegments>();
  if (const Fix *other = modify->find_fix_style_strict(style, 0))
    if (strcmp(other->id, id) != 0)
      rod_error_all(
          lmp,
          "%s: fix %s (id %s) holds the joints already, a joint would be named twice; one "
          "fix serves all fibres, with moduli by atom type",
          name().c_str(), style, other->id);
  parse(narg, arg);

  virial_flag = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 8;
  global_freq = 1;
  extscalar = extvector = 1;
  force_reneighbor = 1;  // when rods that have come apart are to touch
  next_reneighbor = -1;
}

std::string FixJointSpherocylinder::name() const
{
  return std::string("Fix ") + style + " (id " + id + ")";
}

void FixJointSpherocylinder::parse(int narg, char **arg)
{
  const std::string who = name();
  bool has_modulus = false, has_curvature = false;
  for (int k = 3; k < narg; k += 2) {
    const std::string keyword = arg[k];
    const char *word = k + 1 < narg ? arg[k + 1] : "nothing";
    if (keyword == "rest") {
      rest_ = strcmp(word, "present") == 0 ? Rest::Present : Rest::Straight;
      if (rest_ == Rest::Straight && strcmp(word, "straight") != 0)
        rod_error_all(lmp, "%s: rest must be straight or present (got %s)", who.c_str(), word);
      continue;
    }
    struct Keyword {
      const char *name;
      double *value;
      double least;
      bool may_be_least;
    };
    constexpr double kAny = std::numeric_limits<double>::lowest();
    double damping = 0.0;
    const Keyword keywords[] = {{"youngsModulus", &youngs_modulus_, 0.0, false},
                                {"poissonsRatio", &poissons_ratio_, -1.0, false},
                                {"stretch_factor", &stretch_factor_, 0.0, false},
                                {"bend_factor", &bend_factor_, 0.0, false},
                                {"damping", &damping, 0.0, true},
                                {"damping_stretch", &ratios_.stretch, 0.0, true},
                                {"damping_shear", &ratios_.shear, 0.0, true},
                                {"damping_bend", &ratios_.bend, 0.0, true},
                                {"damping_twist", &ratios_.twist, 0.0, true},
                                {"rest_curvature", &rest_curvature_, kAny, true},
                                {"rest_twist", &rest_twist_, kAny, true},
                                {"join", &join_, 0.0, false},
                                {"yield_stress", &yield_stress_, 0.0, false},
                                {"yield_moment", &yield_moment_, 0.0, false},
                                {"tensile_strength", &strength_.tensile, 0.0, false},
                                {"bending_strength", &strength_.bending, 0.0, false}};
    const auto *found = std::find_if(std::begin(keywords), std::end(keywords),
                                     [&](const Keyword &other) { return keyword == other.name; });
    if (found == std::end(keywords))
      rod_error_all(
          lmp,
          "%s: unknown keyword %s (expected youngsModulus, poissonsRatio, stretch_factor, "
          "bend_factor, damping, damping_stretch, damping_shear, damping_bend, "
          "damping_twist, rest, rest_curvature, rest_twist, join, yield_stress, yield_moment, "
          "tensile_strength or bending_strength)",
          who.c_str(), arg[k]);
    const double value = deck_number(lmp, who, keyword, word);
    if (found->may_be_least ? !(value >= found->least) : !(value > found->least))
      rod_error_all(lmp, "%s: %s must be %s %g (got %s)", who.c_str(), arg[k],
                    found->may_be_least ? ">=" : ">", found->least, word);
    *found->value = value;
    if (keyword == "damping") ratios_ = {damping, damping, damping, damping};
    has_modulus = has_modulus || keyword == "youngsModulus";
    has_poissons_ratio_ = has_poissons_ratio_ || keyword == "poissonsRatio";
    has_curvature = has_curvature || keyword == "rest_curvature" || keyword == "rest_twist";
  }
  if (poissons_ratio_ > 0.5)
    rod_error_all(lmp, "%s: poissonsRatio must be <= 0.5 (got %g)", who.c_str(), poissons_ratio_);
  if (join_ > 0.5)
    rod_error_all(lmp, "%s: join must be <= 0.5 diameters (got %g)", who.c_str(), join_);
  if (yield_stress_ > 0.0 && yield_moment_ > 0.0)
    rod_error_all(lmp, "%s: yield_stress and yield_moment say the same; wanted one of them",
                  who.c_str());
  if (has_curvature && rest_ == Rest::Present)
    rod_error_all(lmp, "%s: rest present leaves no room for rest_curvature and rest_twist",
                  who.c_str());
}

void FixJointSpherocylinder::post_create()
{
  fibres_of(lmp);
  if (join_ == 0.0) return;
  const int joints = FibreChains(lmp, name()).join_meeting_ends(groupbit, join_);
  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out) fprintf(out, "%s: %d joints where ends meet\n", name().c_str(), joints);
}

int FixJointSpherocylinder::setmask() { return POST_FORCE | THERMO_ENERGY; }

bool FixJointSpherocylinder::is_damped() const { return sum_of(ratios_) > 0.0; }

// By type, from the fix's line or, as LIGGGHTS's contact models, from fix property/global.
std::vector<double> FixJointSpherocylinder::material(double value, bool is_given,
                                                     const char *keyword,
                                                     const char *property) const
{
  std::vector<double> values(atom->ntypes + 1, value);
  if (is_given) return values;
  Fix *fix =
      modify->find_fix_property(property, "property/global", "peratomtype", 0, 0, style, false);
  if (!fix)
    rod_error_all(lmp,
                  "%s: no %s is given; wanted the keyword or fix ID all property/global %s "
                  "peratomtype ...",
                  name().c_str(), keyword, property);
  for (int type = 1; type <= atom->ntypes; type++)
    values[type] = type <= fix->size_vector ? fix->compute_vector(type - 1) : none;
  return values;
}

void FixJointSpherocylinder::init()
{
  const std::string who = name();
  moduli_ = material(youngs_modulus_, youngs_modulus_ > 0.0, "youngsModulus", "youngsModulus");
  ratios_of_types_ =
      material(poissons_ratio_, has_poissons_ratio_, "poissonsRatio", "poissonsRatio");
  if (is_damped() && !comm->ghost_velocity)
    rod_error_all(lmp,
                  "%s: damping needs the velocities of ghosts (expected communicate single vel "
                  "yes)",
                  who.c_str());
  standing_groups_ = standing_groups(lmp);
  FibreChains chains(lmp, who);
  if (rest_ == Rest::Present)
    chains.give_present_rest();
  else
    chains.give_rest(rest_curvature_, rest_twist_);
  const FibreSegments &segments = *segments_;
  check_group(segments);
  for (int i = 0; i < atom->nlocal; i++)
    if (segments.is_segment(i)) check_material(atom->type[i]);
  for (int k = 0; k < modify->nfix; k++) {
    auto *fibres = dynamic_cast<FixParticletemplateSpherocylinder *>(modify->fix[k]);
    if (fibres && fibres->makes_fibres()) check_material(fibres->maxtype());
  }
}

void FixJointSpherocylinder::check_material(int type) const
{
  if (!(moduli_[type] > 0.0))
    rod_error_one(lmp, "%s: youngsModulus of atom type %d must be > 0 (got %g)", name().c_str(),
                  type, moduli_[type]);
  if (!(ratios_of_types_[type] > -1.0 && ratios_of_types_[type] <= 0.5))
    rod_error_one(lmp, "%s: poissonsRatio of atom type %d must be > -1 and <= 0.5 (got %g)",
                  name().c_str(), type, ratios_of_types_[type]);
}

// A fibre that the group cuts would be held in part.
void FixJointSpherocylinder::check_group(const FibreSegments &segments) const
{
  int mine[2] = {0, 0}, all[2];
  for (int i = 0; i < atom->nlocal; i++)
    if (segments.is_segment(i) && !(atom->mask[i] & groupbit)) {
      mine[0] = std::max(mine[0], atom->tag[i]);
      mine[1] = std::max(mine[1], segments.fibre(i));
    }
  MPI_Allreduce(mine, all, 2, MPI_INT, MPI_MAX, world);
  if (all[0] == 0) return;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->tag[i] == all[0])
      rod_error_one(
          lmp,
          "%s: rod %d of fibre %d is not in group %s, which would cut the fibre; wanted all "
          "segments of all fibres in the group",
          name().c_str(), all[0], segments.fibre(i), group->names[igroup]);
  MPI_Barrier(world);
}

BeamHalf FixJointSpherocylinder::beam_half(int i) const
{
  const double *shape = atom->shape[i];
  const int type = atom->type[i];
  return {shape[0], shape[2] - shape[0], moduli_[type], ratios_of_types_[type]};
}

// What is held or driven does not give way.
JointedMass FixJointSpherocylinder::jointed_mass(int i) const
{
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double half_length = atom->shape[i][2] - atom->shape[i][0];
  if (atom->mask[i] & standing_groups_) return {kInfinite, kInfinite, kInfinite, half_length};
  return {atom->rmass[i], atom->inertia[i][0], atom->inertia[i][2], half_length};
}

// Another command may have changed it since they were joined.
void FixJointSpherocylinder::check_same_diameter(int i, int j) const
{
  const double a = 2.0 * atom->shape[i][0], b = 2.0 * atom->shape[j][0];
  if (std::fabs(a - b) <= FibreChains::kSameRadius * a) return;
  rod_error_one(lmp,
                "%s: rods %d and %d are joined and must have the same diameter (got %g and %g)",
                name().c_str(), atom->tag[i], atom->tag[j], a, b);
}

void FixJointSpherocylinder::renew()
{
  joints_.find(name().c_str());
  const auto &joints = joints_.joints();
  const size_t count = joints.size();
  constants_.resize(count);
  loads_.resize(count);
  strains_.resize(count);
  for (size_t k = 0; k < count; k++) {
    const int i = joints[k].first, j = joints[k].second;
    check_same_diameter(i, j);
    Constants &c = constants_[k];
    c.stiffness = joint_stiffness(beam_half(i), beam_half(j));
    c.stiffness.stretch *= stretch_factor_;
    c.stiffness.shear *= stretch_factor_;
    c.stiffness.bend *= bend_factor_;
    c.stiffness.twist *= bend_factor_;
    const bool gives_way = !(atom->mask[i] & atom->mask[j] & standing_groups_);
    c.damping = is_damped() && gives_way
                    ? damping_coefficients(ratios_, c.stiffness,
                                           effective_masses(jointed_mass(i), jointed_mass(j)))
                    : JointChannels{0.0, 0.0, 0.0, 0.0};
    const double *row = segments_->rows[i];
    c.rest = {row[S::kBendX], row[S::kBendY], row[S::kTwist]};
    c.yield_moment =
        yield_stress_ > 0.0 ? plastic_moment(yield_stress_, atom->shape[i][0]) : yield_moment_;
  }
  partings_.find(joints_, *segments_);
  find_frequencies();
  seen_builds_ = neighbor->ncalls;
  owned_ = atom->nlocal;
  seen_rods_ = atom->nlocal + atom->nghost;
}

// Segments on the other side of a joint: as they are in each step. Asked for before the joints of a step are
// found.
void FixJointSpherocylinder::add_used_ghosts(std::vector<int> &ghosts) const
{
  FibreJoints joints(lmp);
  joints.find(name().c_str());
  for (const FibreJoints::Joint &joint : joints.joints())
    for (const int i : {joint.first, joint.second})
      if (i >= atom->nlocal) ghosts.push_back(i);
  FibrePartings partings(lmp);
  partings.find(joints, *segments_);
  partings.add_ghosts(ghosts);
}

// A damper of ratio zeta of the pair has the ratio sqrt(2) zeta in the highest mode of equal rods, and
// with velocities half a step old the step that is stable shrinks to sqrt(1 + zeta^2) - zeta of it.
void FixJointSpherocylinder::find_frequencies()
{
  std::vector<JointChannels> sums(atom->nlocal, JointChannels{0.0, 0.0, 0.0, 0.0});
  const auto &joints = joints_.joints();
  for (size_t k = 0; k < joints.size(); k++)
    for (const int i : {joints[k].first, joints[k].second})
      if (i < atom->nlocal) sums[i] = sums[i] + constants_[k].stiffness;
  const auto with_damping = [](double squared, double ratio) {
    const double z = std::sqrt(2.0) * ratio, factor = std::sqrt(1.0 + z * z) + z;
    return squared * factor * factor;
  };
  squared_frequency_.assign(atom->nlocal, 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    if (sums[i].stretch == 0.0 || (atom->mask[i] & standing_groups_)) continue;
    const JointChannels squared = squared_joint_frequencies(jointed_mass(i), sums[i]);
    squared_frequency_[i] = std::max(
        {with_damping(squared.stretch, ratios_.stretch), with_damping(squared.shear, ratios_.shear),
         with_damping(squared.bend, ratios_.bend), with_damping(squared.twist, ratios_.twist)});
  }
}

void FixJointSpherocylinder::check_rest() const
{
  for (size_t k = 0; k < constants_.size(); k++) {
    const JointRest &rest = constants_[k].rest;
    const double bend = std::hypot(rest.bend_x, rest.bend_y), twist = std::fabs(rest.twist);
    if (bend < kLargestJointAngle && twist < kLargestJointAngle) continue;
    const FibreJoints::Joint &joint = joints_.joints()[k];
    rod_error_one(
        lmp,
        "%s: without load the joint of rods %d and %d is bent by %g and twisted by %g degrees; "
        "wanted less than 179 of either",
        name().c_str(), atom->tag[joint.first], atom->tag[joint.second], bend * degrees,
        rest.twist * degrees);
  }
}

void FixJointSpherocylinder::setup(int vflag)
{
  renew();
  check_rest();
  const int mine = !partings_.empty();
  int any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  any_partings_ = any != 0;
  reported_ = broken_joints();
  post_force(vflag);
}

void FixJointSpherocylinder::compute_load(int k)
{
  const int i = joints_.joints()[k].first, j = joints_.joints()[k].second;
  const Constants &c = constants_[k];
  const JointedRod first = joints_.rod(i), second = joints_.rod(j);
  const JointDeformation d = joint_deformation(first, second);
  if (!(d.bend_squared() < kLargestJointAngle * kLargestJointAngle &&
        std::fabs(d.twist) < kLargestJointAngle))
    rod_error_one(lmp,
                  "%s: the joint of rods %d and %d is bent by %g and twisted by %g degrees; wanted "
                  "less than 179 of either, where they can be told apart",
                  name().c_str(), atom->tag[i], atom->tag[j], std::sqrt(d.bend_squared()) * degrees,
                  d.twist * degrees);
  loads_[k] = elastic_load(first, d, c.stiffness, c.rest);
  strains_[k] = d;
  if (!is_damped()) return;
  add_damping(first, {load(atom->v[i]), load(atom->omega[i])}, second,
              {load(atom->v[j]), load(atom->omega[j])}, d, c.damping, loads_[k]);
}

void FixJointSpherocylinder::compute_loads()
{
  threads_->run_over(joints(), kFewestJoints, [&](int begin, int end) {
    for (int k = begin; k < end; k++) compute_load(k);
    if (is_plastic())
      for (int k = begin; k < end; k++) yield(k);
  });
}

// Ranks that share a joint come to the same bits: a bend depends on the rods' orientations alone.
void FixJointSpherocylinder::yield(int k)
{
  Constants &c = constants_[k];
  if (!yields(strains_[k], c.rest, c.stiffness.bend, c.yield_moment)) return;
  const JointRest before = c.rest;
  c.rest = rest_after_yielding(strains_[k], before, c.stiffness.bend, c.yield_moment);
  double *row = segments_->rows[joints_.joints()[k].first];
  row[S::kBendX] = c.rest.bend_x;
  row[S::kBendY] = c.rest.bend_y;
  row[S::kPlasticWork] += plastic_work(before, c.rest, c.yield_moment);
  compute_load(k);
}

// This rank's: of joints whose first rod it owns.
std::vector<EndsChange> FixJointSpherocylinder::changes_of_ends()
{
  std::vector<EndsChange> changes;
  partings_.add_parted(changes);
  if (!strength_.is_finite()) return changes;
  for (int k = 0; k < joints(); k++) {
    const int i = joints_.joints()[k].first;
    const Constants &c = constants_[k];
    if (i >= atom->nlocal ||
        utilisation(strains_[k], c.rest, c.stiffness, atom->shape[i][0], strength_) < 1.0)
      continue;
    changes.push_back(EndsChange::broken(*segments_, i, joints_.joints()[k].second));
    segments_->rows[i][S::kReleasedEnergy] =
        sum_of(joint_energies(strains_[k], c.stiffness, c.rest));
  }
  return changes;
}

// Joints break, and rods that lay in each other come apart. A joint's owner decides and all ranks hear of it: a
// stretch across a periodic boundary is not the same in the last digit on both sides. Rods are exchanged anew in
// the next step, with what touches then.
void FixJointSpherocylinder::part()
{
  static_assert(sizeof(EndsChange) == 7 * sizeof(int), "sent as so many ints");
  const std::vector<EndsChange> changes = changes_of_ends();
  const int mine = !changes.empty();
  int any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;

  const int *ints = reinterpret_cast<const int *>(changes.data());
  const std::vector<int> all =
      from_all_ranks(world, std::vector<int>(ints, ints + 7 * changes.size()));
  bool breaks = false;
  for (size_t k = 0; k < all.size(); k += 7) {
    const EndsChange change = {all[k],
                               {all[k + 1], all[k + 2], all[k + 3]},
                               {all[k + 4], all[k + 5], all[k + 6]}};
    for (const EndsChange::OfRod &rod : {change.first, change.second})
      for (const int i : joints_.at(change.fibre, rod.place))
        segments_->rows[i][S::kEnds] = (segments_->ends(i) & ~rod.cleared) | rod.set;
    breaks = breaks || (change.first.set & S::kHeadBroken);
  }
  segments_->changes++;
  any_partings_ = true;
  next_reneighbor = update->ntimestep + 1;
  renew();
  if (!breaks) return;
  compute_loads();
  report_broken(broken_joints());
}

double FixJointSpherocylinder::sum_of_rows(double (*value)(const FibreSegments &, int)) const
{
  double mine = 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (segments_->is_segment(i)) mine += value(*segments_, i);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixJointSpherocylinder::broken_joints() const
{
  return sum_of_rows([](const FibreSegments &segments, int i) {
    return (segments.ends(i) & S::kHeadBroken) != 0 ? 1.0 : 0.0;
  });
}

// The first, and each time that there are twice as many.
void FixJointSpherocylinder::report_broken(double now)
{
  if (now < 2.0 * reported_) return;
  reported_ = now;
  if (comm->me == 0)
    rod_warning(lmp, "%s: at step " BIGINT_FORMAT " %.0f joints of fibres have broken",
                name().c_str(), update->ntimestep, now);
}

void FixJointSpherocylinder::post_run()
{
  if (!strength_.is_finite()) return;
  const double now = broken_joints();
  if (now == reported_) return;
  reported_ = 0.0;
  report_broken(now);
}

FixJointSpherocylinder::State FixJointSpherocylinder::state(int k) const
{
  const int i = joints_.joints()[k].first, j = joints_.joints()[k].second;
  return {i,
          j,
          loads_[k],
          strains_[k],
          constants_[k].stiffness,
          constants_[k].rest,
          beam_half(i).half_length + beam_half(j).half_length};
}

// Joints are worked out by all threads, and added in their order by one.
void FixJointSpherocylinder::post_force(int vflag)
{
  const bool has_new_lists = neighbor->ago == 0 && neighbor->ncalls != seen_builds_;
  if (has_new_lists || seen_rods_ != atom->nlocal + atom->nghost) renew();
  if (vflag) v_setup(vflag);
  evflag = vflag != 0;
  compute_loads();
  if (any_partings_ || strength_.is_finite()) part();

  const auto &joints = joints_.joints();
  const int nlocal = atom->nlocal;
  for (int k = 0; k < static_cast<int>(joints.size()); k++) {
    const int i = joints[k].first, j = joints[k].second;
    const JointLoad &load_k = loads_[k];
    const Vec3 at_i = load_k.point - load(atom->x[i]), at_j = load_k.point - load(atom->x[j]);
    if (i < nlocal) {
      add_to(atom->f[i], load_k.force);
      add_to(atom->torque[i], cross(at_i, load_k.force) + load_k.couple);
    }
    if (j < nlocal) {
      add_to(atom->f[j], -load_k.force);
      add_to(atom->torque[j], -(cross(at_j, load_k.force) + load_k.couple));
    }
    if (evflag) tally(k);
  }
}

void FixJointSpherocylinder::tally(int k)
{
  const int i = joints_.joints()[k].first, j = joints_.joints()[k].second;
  const Vec3 d = load(atom->x[i]) - load(atom->x[j]), &f = loads_[k].force;
  int owned[2], count = 0;
  for (const int rod : {i, j})
    if (rod < atom->nlocal) owned[count++] = rod;
  double virial_of_joint[6] = {d.x * f.x, d.y * f.y, d.z * f.z, d.x * f.y, d.x * f.z, d.y * f.z};
  v_tally(count, owned, 2.0, virial_of_joint);
}

// Of the last step; this rank's share.
JointChannels FixJointSpherocylinder::energy() const
{
  JointChannels sum = {0.0, 0.0, 0.0, 0.0};
  const auto &joints = joints_.joints();
  for (size_t k = 0; k < joints.size(); k++)
    if (joints[k].first < owned_)
      sum = sum + joint_energies(strains_[k], constants_[k].stiffness, constants_[k].rest);
  return sum;
}

double FixJointSpherocylinder::compute_scalar()
{
  const double mine = sum_of(energy());
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

// 1 to 4: energy of stretch, shear, bend, twist (J); 5: joints; 6: energy that bending for good took (J); 7:
// broken joints; 8: the energy they had (J)
double FixJointSpherocylinder::compute_vector(int n)
{
  using Segments = const FibreSegments &;
  if (n == 5)
    return sum_of_rows([](Segments segments, int i) { return segments.rows[i][S::kPlasticWork]; });
  if (n == 6) return broken_joints();
  if (n == 7)
    return sum_of_rows(
        [](Segments segments, int i) { return segments.rows[i][S::kReleasedEnergy]; });
  double joints = 0.0;
  for (const FibreJoints::Joint &joint : joints_.joints()) joints += joint.first < owned_;
  const JointChannels e = energy();
  const double mine[] = {e.stretch, e.shear, e.bend, e.twist, joints};
  double all = 0.0;
  MPI_Allreduce(&mine[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}
