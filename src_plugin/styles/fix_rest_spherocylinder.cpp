// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_rest_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "core/rotation.h"
#include "error.h"
#include "fix_gravity.h"
#include "force.h"
#include "host/deck_numbers.h"
#include "host/rod_error.h"
#include "modify.h"
#include "output.h"
#include "rods/atom_vec_spherocylinder.h"
#include "signal_handling.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
namespace sc = spherocylinder;

namespace {

// A rod that falls through ten diameters: what starts to slip or to topple shows in that time.
constexpr double kWindowInDiameters = 10.0;

}  // namespace

FixRestSpherocylinder::FixRestSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), largest_energy_(1e-5), largest_unbalanced_(1e-2)
{
  rods_of(lmp, "Fix rest/spherocylinder");
  if (narg < 4) rod_error_all(lmp, "Fix %s (id %s): expected an interval in steps", style, id);
  interval_ = deck_whole_number(lmp, fix_and_id(arg), "the interval", arg[3]);
  if (interval_ < 1)
    rod_error_all(lmp, "Fix %s (id %s): the interval must be >= 1 step (got %s)", style, id,
                  arg[3]);
  parse_options(narg, arg);

  nevery = 1;  // the step after a look may be the last
  vector_flag = 1;
  size_vector = 5;
  global_freq = 1;
  extvector = 0;
}

void FixRestSpherocylinder::parse_options(int narg, char **arg)
{
  for (int i = 4; i < narg; i += 2) {
    double *option = strcmp(arg[i], "energy") == 0       ? &largest_energy_
                     : strcmp(arg[i], "unbalanced") == 0 ? &largest_unbalanced_
                     : strcmp(arg[i], "window") == 0     ? &window_
                                                         : nullptr;
    if (!option)
      rod_error_all(lmp,
                    "Fix %s (id %s): unknown keyword %s (expected energy, unbalanced or window)",
                    style, id, arg[i]);
    const char *value = i + 1 < narg ? arg[i + 1] : "nothing";
    *option = deck_number(lmp, fix_and_id(arg), arg[i], value);
    if (!(*option > 0.0) || std::isinf(*option))
      rod_error_all(lmp, "Fix %s (id %s): %s must be > 0 (got %s)", style, id, arg[i], value);
  }
}

int FixRestSpherocylinder::setmask() { return END_OF_STEP; }

void FixRestSpherocylinder::init() { gravity_ = find_gravity(); }

// Not in init, which write_restart calls too, nor in setup, which `run pre no` leaves out.
void FixRestSpherocylinder::begin_run()
{
  run_began_ = update->firststep;
  rest_began_ = last_step_ = kNever;
  seconds_at_rest_ = 0.0;
  ended_run_ = false;
}

// Of all fixes gravity together: the scale of energies and forces.
double FixRestSpherocylinder::find_gravity() const
{
  double total[3] = {};
  for (int i = 0; i < modify->nfix; i++) {
    if (strcmp(modify->fix[i]->style, "gravity") != 0) continue;
    double one[3];
    static_cast<FixGravity *>(modify->fix[i])->get_gravity(one);
    for (int k = 0; k < 3; k++) total[k] += one[k];
  }
  const double gravity = sc::norm(sc::load(total));
  if (!(gravity > 0.0))
    rod_error_all(lmp,
                  "Fix %s (id %s) requires a fix gravity: energies and forces are measured by "
                  "the rods' weight",
                  style, id);
  return gravity;
}

double FixRestSpherocylinder::default_window() const
{
  double mine = 0.0, largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) mine = std::max(mine, 2.0 * atom->shape[i][0]);
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  return std::sqrt(2.0 * kWindowInDiameters * largest / gravity_);
}

void FixRestSpherocylinder::end_of_step()
{
  if (run_began_ != update->firststep) begin_run();
  if (update->ntimestep == last_step_) {
    end_run_now();
    return;
  }
  if (update->ntimestep % interval_ != 0) return;
  look();
  const double window = window_ > 0.0 ? window_ : default_window();
  if (rest_began_ != kNever && seconds_at_rest_ >= window && !ended_run_) announce_last_step();
}

void FixRestSpherocylinder::look()
{
  double sums[2] = {}, largest[2] = {};  // rods, energies over m g D; squared force, torque ratios
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double weight = atom->rmass[i] * gravity_ / force->ftm2v;
    const sc::Vec3 omega = sc::load(atom->omega[i]);
    const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
    const sc::Vec3 angmom =
        sc::angular_momentum(omega, axis, atom->inertia[i][2], atom->inertia[i][0]);
    const double energy =
        0.5 * force->mvv2e *
        (atom->rmass[i] * sc::norm_squared(sc::load(atom->v[i])) + sc::dot(omega, angmom));
    sums[0] += 1.0;
    sums[1] += energy / (weight * 2.0 * atom->shape[i][0]);
    const double arm = atom->shape[i][2];  // half the total length
    largest[0] = std::max(largest[0], sc::norm_squared(sc::load(atom->f[i])) / (weight * weight));
    largest[1] = std::max(largest[1], sc::norm_squared(sc::load(atom->torque[i])) /
                                          (weight * arm * weight * arm));
  }
  double all_sums[2], all_largest[2];
  MPI_Allreduce(sums, all_sums, 2, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(largest, all_largest, 2, MPI_DOUBLE, MPI_MAX, world);
  mean_energy_ = all_sums[0] > 0.0 ? all_sums[1] / all_sums[0] : 0.0;
  net_force_ = std::sqrt(all_largest[0]);
  net_torque_ = std::sqrt(all_largest[1]);

  // Written so that a value that is no number is no rest.
  const bool at_rest = all_sums[0] > 0.0 && mean_energy_ <= largest_energy_ &&
                       net_force_ <= largest_unbalanced_ && net_torque_ <= largest_unbalanced_;
  if (!at_rest)
    rest_began_ = kNever;
  else if (rest_began_ == kNever)
    rest_began_ = update->ntimestep;
  seconds_at_rest_ =
      at_rest ? static_cast<double>(update->ntimestep - rest_began_) * update->dt : 0.0;
}

// The step after this one is the last: what thermo output and dumps need for it (energies, virial)
// is tallied only in steps known beforehand.
void FixRestSpherocylinder::announce_last_step()
{
  ended_run_ = true;
  if (update->ntimestep >= update->laststep) return;  // as it would have
  last_step_ = update->ntimestep + 1;
  modify->addstep_compute_all(last_step_);
}

// Thermo output as at the end of any run, and a frame of each dump, after which the loop over steps
// is left.
void FixRestSpherocylinder::end_run_now()
{
  update->laststep = update->ntimestep;
  update->nsteps = static_cast<int>(update->ntimestep - update->firststep);
  output->next_thermo = output->next = update->ntimestep;
  if (output->ndump > 0 && !update->restrict_output) {
    for (int i = 0; i < output->ndump; i++) output->next_dump[i] = update->ntimestep;
    output->next_dump_any = update->ntimestep;
  }
  if (!SignalHandler::request_quit) asked_to_quit_ = SignalHandler::request_quit = true;
}

// LIGGGHTS would stop reading the deck too, as after Ctrl-C. The message comes after the lines of
// thermo output. The next run is another one though reset_timestep may give it the same first step.
void FixRestSpherocylinder::post_run()
{
  // A run of no steps ends by itself.
  const bool ended_this_run = ended_run_ && run_began_ != kNever;
  run_began_ = kNever;
  if (asked_to_quit_) SignalHandler::request_quit = false;
  asked_to_quit_ = false;
  if (!ended_this_run || comm->me != 0) return;
  for (FILE *stream : {screen, logfile})
    if (stream)
      fprintf(stream,
              "Fix %s (id %s): at rest since step " BIGINT_FORMAT
              ", kinetic energy %.3g m g D a rod, largest net force %.3g m g, net torque %.3g m g "
              "L/2: the run ends\n",
              style, id, rest_began_, mean_energy_, net_force_, net_torque_);
}

// At the last look 1: kinetic energy a rod / (m g D); 2: largest net force / (m g); 3: largest net
// torque / (m g L/2); 4: time at rest; 5: whether this run was ended
double FixRestSpherocylinder::compute_vector(int n)
{
  const double values[5] = {mean_energy_, net_force_, net_torque_, seconds_at_rest_,
                            ended_run_ ? 1.0 : 0.0};
  return values[n];
}
