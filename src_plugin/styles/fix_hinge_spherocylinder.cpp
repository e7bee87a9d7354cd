// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_hinge_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "core/rotation.h"
#include "domain.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "memory.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"
#include "styles/fix_joint_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace spherocylinder;

FixHingeSpherocylinder::FixHingeSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg)
{
  const std::string who = name();
  rods_of(lmp, who.c_str());
  const char *word = narg > 3 ? arg[3] : "nothing";
  if (strcmp(word, "tail") == 0)
    end_ = End::Tail;
  else if (strcmp(word, "head") == 0)
    end_ = End::Head;
  else if (strcmp(word, "free") != 0)
    rod_error_all(lmp, "%s: the end must be tail, head or free (got %s)", who.c_str(), word);
  for (int k = 4; k < narg;) {
    const std::string keyword = arg[k++];
    const int values = keyword == "velocity" ? 3 : 1;
    if (keyword != "stiffness" && keyword != "damping" && keyword != "velocity")
      rod_error_all(lmp, "%s: unknown keyword %s (expected stiffness, damping or velocity)",
                    who.c_str(), keyword.c_str());
    double value[3] = {0.0, 0.0, 0.0};
    for (int d = 0; d < values; d++, k++)
      value[d] = deck_number(lmp, who, keyword, k < narg ? arg[k] : "nothing");
    if (keyword == "stiffness") {
      stiffness_ = value[0];
      if (!(stiffness_ > 0.0))
        rod_error_all(lmp, "%s: stiffness must be > 0 (got %g)", who.c_str(), stiffness_);
    } else if (keyword == "damping") {
      ratio_ = value[0];
      if (!(ratio_ >= 0.0))
        rod_error_all(lmp, "%s: damping must be >= 0 (got %g)", who.c_str(), ratio_);
    } else {
      velocity_ = load(value);
    }
  }

  restart_peratom = 1;
  create_attribute = 1;  // set_arrays is called for rods that come in
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 1;
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nmax; i++) clear(i);
  for (const int kind : {0, 1}) atom->add_callback(kind);  // memory, restart
}

FixHingeSpherocylinder::~FixHingeSpherocylinder()
{
  for (const int kind : {0, 1}) atom->delete_callback(id, kind);
  memory->destroy(held_);
}

std::string FixHingeSpherocylinder::name() const
{
  return std::string("Fix ") + style + " (id " + id + ")";
}

int FixHingeSpherocylinder::setmask() { return INITIAL_INTEGRATE | POST_FORCE | THERMO_ENERGY; }

void FixHingeSpherocylinder::init()
{
  joints_ = dynamic_cast<FixJointSpherocylinder *>(
      modify->find_fix_style_strict("joint/spherocylinder", 0));
  if (!joints_ && stiffness_ == 0.0)
    rod_error_all(lmp,
                  "%s: without fix joint/spherocylinder, whose stiffness it would have, a hinge "
                  "wants the keyword stiffness",
                  name().c_str());
}

// -1: tail, 1: head.
double FixHingeSpherocylinder::side_of(int i) const
{
  if (end_ != End::Free) return end_ == End::Tail ? -1.0 : 1.0;
  const auto &segments = rods_of(lmp, style).attached<FibreSegments>();
  const int joined =
      segments.is_segment(i)
          ? segments.ends(i) & (FibreSegments::kTailJoined | FibreSegments::kHeadJoined)
          : 0;
  if (joined != FibreSegments::kTailJoined && joined != FibreSegments::kHeadJoined)
    rod_error_one(lmp,
                  "%s: rod %d has %s, which is to be held is not told; wanted the end segment of a "
                  "fibre, or tail or head",
                  name().c_str(), atom->tag[i], joined ? "no free end" : "two free ends");
  return joined == FibreSegments::kTailJoined ? 1.0 : -1.0;
}

double FixHingeSpherocylinder::stiffness(int i) const
{
  return stiffness_ > 0.0 ? stiffness_ : joints_->shear_stiffness(i);
}

// From the rod's centre to the end that is held.
Vec3 FixHingeSpherocylinder::arm(int i) const
{
  const double *shape = atom->shape[i];
  return held_[i][kSide] * (shape[2] - shape[0]) * axis_of(load_quaternion(atom->quaternion[i]));
}

// Rods are held where they are when a run first begins with them.
void FixHingeSpherocylinder::setup(int vflag)
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || held_[i][kSide] != 0.0) continue;
    held_[i][kSide] = side_of(i);
    store(load(atom->x[i]) + arm(i), &held_[i][kX]);
  }
  is_set_up_ = true;
  post_force(vflag);
}

void FixHingeSpherocylinder::initial_integrate(int)
{
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && held_[i][kSide] != 0.0)
      store(load(&held_[i][kX]) + update->dt * velocity_, &held_[i][kX]);
}

void FixHingeSpherocylinder::post_force(int)
{
  energy_ = 0.0;
  force_ = {0.0, 0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && held_[i][kSide] != 0.0) hold(i);
}

void FixHingeSpherocylinder::hold(int i)
{
  const double k = stiffness(i);
  const Vec3 to_end = arm(i);
  double away[3];
  store(load(atom->x[i]) + to_end - load(&held_[i][kX]), away);
  domain->minimum_image(away[0], away[1], away[2]);
  Vec3 force = -k * load(away);
  if (ratio_ > 0.0) {
    const Vec3 speed = load(atom->v[i]) + cross(load(atom->omega[i]), to_end) - velocity_;
    force = force - 2.0 * ratio_ * std::sqrt(k * atom->rmass[i]) * speed;
  }
  add_to(atom->f[i], force);
  add_to(atom->torque[i], cross(to_end, force));
  energy_ += 0.5 * k * norm_squared(load(away));
  force_ = force_ + force;
}

// K (1/m + l^2/I) of a rod alone; damped as in fix joint/spherocylinder.
double FixHingeSpherocylinder::squared_frequency(int i) const
{
  if (!(atom->mask[i] & groupbit) || held_[i][kSide] == 0.0) return 0.0;
  const double length = norm(arm(i));
  const double freedom = 1.0 / atom->rmass[i] + length * length / atom->inertia[i][0];
  const double ratio = ratio_ * std::sqrt(atom->rmass[i] * freedom);
  const double damped = std::sqrt(1.0 + ratio * ratio) + ratio;
  return stiffness(i) * freedom * damped * damped;
}

double FixHingeSpherocylinder::compute_scalar()
{
  double all = 0.0;
  MPI_Allreduce(&energy_, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixHingeSpherocylinder::compute_vector(int n)
{
  const double mine[] = {force_.x, force_.y, force_.z};
  double all = 0.0;
  MPI_Allreduce(&mine[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

/* ----------------------------------------------------------------------
   what is held travels with its rod
------------------------------------------------------------------------- */

void FixHingeSpherocylinder::grow_arrays(int nmax)
{
  memory->grow(held_, nmax, static_cast<int>(kColumns), "hinge:held");
  for (int i = atom->nlocal + atom->nghost; i < nmax; i++) clear(i);
}

void FixHingeSpherocylinder::copy_arrays(int from, int to, int)
{
  std::copy_n(held_[from], static_cast<int>(kColumns), held_[to]);
}

void FixHingeSpherocylinder::clear(int i)
{
  std::fill_n(held_[i], static_cast<int>(kColumns), 0.0);
}

// LIGGGHTS calls it also for all rods when a run first begins, which may be those of a restart.
void FixHingeSpherocylinder::set_arrays(int i)
{
  if (is_set_up_) clear(i);
}

int FixHingeSpherocylinder::pack_exchange(int i, double *buffer)
{
  std::copy_n(held_[i], static_cast<int>(kColumns), buffer);
  return kColumns;
}

int FixHingeSpherocylinder::unpack_exchange(int i, double *buffer)
{
  std::copy_n(buffer, static_cast<int>(kColumns), held_[i]);
  return kColumns;
}

int FixHingeSpherocylinder::pack_restart(int i, double *buffer)
{
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

// LIGGGHTS has left each fix's values one after the other, its number of values first.
void FixHingeSpherocylinder::unpack_restart(int i, int nth)
{
  double *values = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; k++) m += static_cast<int>(values[m]);
  unpack_exchange(i, &values[m + 1]);
}

int FixHingeSpherocylinder::size_restart(int) { return maxsize_restart(); }

int FixHingeSpherocylinder::maxsize_restart() { return kColumns + 1; }

double FixHingeSpherocylinder::memory_usage()
{
  return sizeof(double) * static_cast<double>(kColumns) * atom->nmax;
}
