// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_move_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "atom.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "force.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

constexpr double kTwoPi = 6.28318530717958647692;

// Part of a diameter by which a rod's first step of a run may differ from its velocity's.
constexpr double kFirstStepTolerance = 1e-3;

// LIGGGHTS's fix warns that it leaves the angular momentum alone; this one does not.
class WithoutAngularMomentum {
 public:
  explicit WithoutAngularMomentum(LAMMPS *lmp) : lmp_(lmp), flag_(lmp->atom->angmom_flag)
  {
    lmp_->atom->angmom_flag = 0;
  }
  ~WithoutAngularMomentum() { lmp_->atom->angmom_flag = flag_; }
  operator LAMMPS *() const { return lmp_; }

 private:
  LAMMPS *lmp_;
  int flag_;
};

// A direction that is NULL is left to the forces.
bool gives_all_directions(char **arg)
{
  if (strcmp(arg[3], "rotate") == 0) return true;
  const bool is_variable = strcmp(arg[3], "variable") == 0;
  for (int d = 0; d < 3; d++) {
    const bool is_free =
        strcmp(arg[4 + d], "NULL") == 0 && (!is_variable || strcmp(arg[7 + d], "NULL") == 0);
    if (is_free) return false;
  }
  return true;
}

}  // namespace

FixMoveSpherocylinder::FixMoveSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : FixMove(WithoutAngularMomentum(lmp), narg, arg),
      is_rotation_(strcmp(arg[3], "rotate") == 0),
      is_variable_(strcmp(arg[3], "variable") == 0),
      drives_centres_(gives_all_directions(arg)),
      origin_(update->ntimestep)
{
  rods_of(lmp, "Fix move");
  const int period_at = is_rotation_ ? 10 : strcmp(arg[3], "wiggle") == 0 ? 7 : 0;
  if (!period_at) return;
  const double period = force->numeric(FLERR, arg[period_at]);
  if (period == 0.0) rod_error_all(lmp, "Fix move (id %s): period must not be 0", id);
  if (!is_rotation_) return;
  for (int d = 0; d < 3; d++) (&direction_.x)[d] = force->numeric(FLERR, arg[7 + d]);
  direction_ = (1.0 / sc::norm(direction_)) * direction_;
  rate_ = kTwoPi / period;
}

void FixMoveSpherocylinder::restart(char *state)
{
  FixMove::restart(state);
  origin_ = static_cast<bigint>(*reinterpret_cast<double *>(state));
}

double FixMoveSpherocylinder::angle_now() const
{
  return rate_ * static_cast<double>(update->ntimestep - origin_) * update->dt;
}

void FixMoveSpherocylinder::init()
{
  FixMove::init();
  // A new fix has turned nothing; the rods of a restart file have been turned up to its step.
  if (!angle_is_known_) angle_ = angle_now();
  angle_is_known_ = is_first_step_ = true;
}

void FixMoveSpherocylinder::initial_integrate(int vflag)
{
  const int nlocal = atom->nlocal;
  std::vector<double> before;
  if (is_first_step_ && nlocal > 0) before.assign(atom->x[0], atom->x[0] + 3 * nlocal);
  FixMove::initial_integrate(vflag);

  const double angle = is_rotation_ ? angle_now() - angle_ : 0.0;
  angle_ += angle;
  const sc::Quaternion rotation = sc::rotation_about(direction_, angle);
  for (int i = 0; i < nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (is_first_step_) check_first_step(i, &before[3 * i], angle);
    if (is_rotation_) {
      turn(i, rotation);
      continue;
    }
    const sc::Vec3 omega = sc::load(atom->omega[i]);
    const double speed = sc::norm(omega);
    if (speed > 0.0) turn(i, sc::rotation_about((1.0 / speed) * omega, speed * update->dt));
  }
  is_first_step_ = false;
}

void FixMoveSpherocylinder::turn(int i, const sc::Quaternion &rotation)
{
  const sc::Quaternion turned = sc::normalized(rotation * sc::load_quaternion(atom->quaternion[i]));
  sc::store(turned, atom->quaternion[i]);
  sc::store(sc::angular_momentum(sc::load(atom->omega[i]), sc::axis_of(turned), atom->inertia[i][2],
                                 atom->inertia[i][0]),
            atom->angmom[i]);
}

// LIGGGHTS puts each rod at its place as of the fix's definition plus the motion since. If
// something else has moved it, or it was in another group then, that is a jump.
void FixMoveSpherocylinder::check_first_step(int i, const double *before, double angle) const
{
  const double dt = update->dt;
  double moved_squared = 0.0, jump_squared = 0.0, way_squared = 0.0;
  for (int d = 0; d < 3; d++) {
    const double moved = atom->x[i][d] - before[d], way = atom->v[i][d] * dt;
    moved_squared += moved * moved;
    jump_squared += (moved - way) * (moved - way);
    way_squared += way * way;
  }
  const double diameter = 2.0 * atom->shape[i][0];
  const double jump = std::sqrt(jump_squared), moved = std::sqrt(moved_squared);
  const double swing = std::fabs(angle - rate_ * dt) * atom->radius[i];
  const double *start = array_atom[i];
  const bool never_seen = start[0] == 0.0 && start[1] == 0.0 && start[2] == 0.0;
  // A variable may ask for any first step.
  const bool jumps = is_variable_
                         ? never_seen && moved > diameter
                         : jump > kFirstStepTolerance * diameter + std::sqrt(way_squared) ||
                               swing > kFirstStepTolerance * diameter;
  if (!jumps) return;
  rod_error_one(
      lmp,
      "Fix move (id %s): rod %d would jump by %g in the first step of this run: it is not "
      "where it was when the fix was defined, plus the motion since (it has joined the "
      "group later, or set, displace_atoms, timestep or reset_timestep came "
      "between); unfix and define the fix again",
      id, atom->tag[i], std::max(is_variable_ ? moved : jump, swing));
}
