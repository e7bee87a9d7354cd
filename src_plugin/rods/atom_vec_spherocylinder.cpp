// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/atom_vec_spherocylinder.h"

#include <algorithm>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "host/rod_error.h"
#include "memory.h"
#include "modify.h"
#include "rods/data_lines.h"
#include "rods/field_arrays.h"
#include "rods/field_travel.h"
#include "rods/kept_forces.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

// Arrays that are full grow by half, at least by this many rods: LIGGGHTS's rows of pointers are
// written for rods to come, too.
constexpr int kGrowBy = 1024;

}  // namespace

AtomVecSpherocylinder::AtomVecSpherocylinder(LAMMPS *lmp)
    : AtomVec(lmp), attachments_(lmp), fibres_(attached<FibreSegments>()), ghosts_(lmp)
{
  molecular = 0;
  comm_x_only = 0;  // the orientation travels too
  comm_f_only = 0;
  size_forward = rod_field_size(kForward) + 1;  // and the place of a ghost where not all are sent
  size_reverse = rod_field_size(kReverse);
  size_border = rod_field_size(kBorder);
  size_velocity = rod_field_size(kForwardVelocity);
  size_data_atom = kAtomsLineValues;
  size_data_vel = kVelocitiesLineValues;
  xcol_data = kFirstOfPosition;

  // superquadric_flag opens LIGGGHTS's dumps and computes to shape, quaternion and inertia.
  atom->superquadric_flag = 1;
  atom->radius_flag = atom->rmass_flag = atom->density_flag = 1;
  atom->omega_flag = atom->torque_flag = atom->angmom_flag = 1;
}

AtomVecSpherocylinder::~AtomVecSpherocylinder() = default;

void AtomVecSpherocylinder::settings(int narg, char **)
{
  if (narg > 0) error->all(FLERR, "Illegal atom_style spherocylinder command: takes no arguments");
  if (domain->dimension != 3)
    error->all(FLERR, "Atom style spherocylinder requires a 3d simulation (dimension 3)");
}

void AtomVecSpherocylinder::init()
{
  AtomVec::init();
  if (watcher_) watcher_->run_begins();
}

/* ----------------------------------------------------------------------
   memory
------------------------------------------------------------------------- */

void AtomVecSpherocylinder::grow(int n)
{
  nmax = n == 0 ? nmax + std::max(kGrowBy, nmax / 2) : n;
  atom->nmax = nmax;
  if (nmax < 0) error->one(FLERR, "Per-processor system is too big");

  grow_rod_fields(*atom, *memory, nmax, comm->nthreads);
  grow_reset();

  // A rod has no blockiness and no vfrac, but stock commands may read them.
  for (int i = 0; i < nmax; i++) {
    atom->blockiness[i][0] = atom->blockiness[i][1] = 2.0;
    atom->vfrac[i] = 0.0;
  }

  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    modify->fix[atom->extra_grow[iextra]]->grow_arrays(nmax);
}

void AtomVecSpherocylinder::grow_reset()
{
  x_ = atom->x;
  shape_ = atom->shape;
  quaternion_ = atom->quaternion;
}

bigint AtomVecSpherocylinder::memory_usage()
{
  return rod_field_bytes(*atom, nmax, comm->nthreads);
}

void AtomVecSpherocylinder::copy(int i, int j, int delflag)
{
  if (watcher_) watcher_->places_change();
  copy_rod_fields(*atom, i, j);
  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    modify->fix[atom->extra_grow[iextra]]->copy_arrays(i, j, delflag);
}

// LIGGGHTS calls this before rods go from rank to rank, when box and cuts are new and histories
// with their rods: at each rebuild of the lists.
void AtomVecSpherocylinder::clear_bonus()
{
  if (watcher_) watcher_->rods_migrate();
}

/* ----------------------------------------------------------------------
   the rod itself
------------------------------------------------------------------------- */

void AtomVecSpherocylinder::set_rod(int i, double diameter, double total_length, double rod_density,
                                    int shared_ends)
{
  const bool is_whole = diameter > 0.0 && total_length > 0.0;
  const sc::MassProperties properties =
      is_whole ? sc::mass_properties(diameter, total_length, rod_density, shared_ends)
               : sc::MassProperties{};
  atom->radius[i] = 0.5 * total_length;
  atom->density[i] = rod_density;
  atom->rmass[i] = properties.mass;
  atom->volume[i] = properties.volume;
  atom->area[i] = properties.area;
  shape_[i][0] = shape_[i][1] = 0.5 * diameter;
  shape_[i][2] = 0.5 * total_length;
  atom->inertia[i][0] = atom->inertia[i][1] = properties.inertia_transverse;
  atom->inertia[i][2] = properties.inertia_axial;
}

/* ----------------------------------------------------------------------
   rods that travel: rod_fields.h
------------------------------------------------------------------------- */

// What lies between an owner and its ghost across a periodic boundary. New ghosts of a triclinic box
// are in lamda coordinates, where a period is 1.
GhostGain AtomVecSpherocylinder::gain_across(unsigned travel, const int *pbc) const
{
  GhostGain gain;
  if ((travel & kBorder) && domain->triclinic) {
    gain.period = {double(pbc[0]), double(pbc[1]), double(pbc[2])};
  } else {
    gain.period = period_across(*domain, pbc);
  }
  if (deform_vremap) {
    gain.box_speed = {pbc[0] * h_rate[0] + pbc[5] * h_rate[5] + pbc[4] * h_rate[4],
                      pbc[1] * h_rate[1] + pbc[3] * h_rate[3], pbc[2] * h_rate[2]};
    gain.box_speed_groups = deform_groupbit;
  }
  return gain;
}

int AtomVecSpherocylinder::pack(unsigned travel, int n, const int *list, double *buf, int pbc_flag,
                                const int *pbc) const
{
  return pack_rod_fields(*atom, travel, n, list, pbc_flag ? gain_across(travel, pbc) : GhostGain{},
                         buf);
}

const double *AtomVecSpherocylinder::unpack(unsigned travel, int n, int first, const double *buf)
{
  const double *in = unpack_rod_fields(*atom, travel, n, first, buf);
  if (travel & (kBorder | kWhole))
    for (int i = first; i < first + n; i++)
      set_rod(i, 2.0 * shape_[i][0], 2.0 * atom->radius[i], atom->density[i]);
  return in;
}

int AtomVecSpherocylinder::pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_needed(kForward, n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_comm_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_needed(kForward | kForwardVelocity, n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_needed(unsigned travel, int n, const int *list, double *buf,
                                       int pbc_flag, const int *pbc)
{
  return ghosts_.pack(travel, n, list, pbc_flag ? gain_across(travel, pbc) : GhostGain{}, buf);
}

void AtomVecSpherocylinder::unpack_comm(int n, int first, double *buf)
{
  ghosts_.unpack(kForward, n, first, buf);
}

void AtomVecSpherocylinder::unpack_comm_vel(int n, int first, double *buf)
{
  ghosts_.unpack(kForward | kForwardVelocity, n, first, buf);
}

int AtomVecSpherocylinder::pack_reverse(int n, int first, double *buf)
{
  if (ghosts_.is_asking()) return ghosts_.pack_asked(n, first, buf);
  return pack_sums(*atom, n, first, buf);
}

void AtomVecSpherocylinder::unpack_reverse(int n, int *list, double *buf)
{
  if (ghosts_.is_asking())
    ghosts_.unpack_asked(n, list, buf);
  else
    add_sums(*atom, n, list, buf);
}

int AtomVecSpherocylinder::pack_border(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_new_ghosts(kBorder, n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_border_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_new_ghosts(kBorder | kBorderVelocity, n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_new_ghosts(unsigned travel, int n, int *list, double *buf,
                                           int pbc_flag, const int *pbc)
{
  ghosts_.forget();
  int m = pack(travel, n, list, buf, pbc_flag, pbc);
  m += pack_border_of_fixes(n, list, buf + m);
  ghosts_.count(list, n, m);
  return m;
}

int AtomVecSpherocylinder::pack_border_of_fixes(int n, int *list, double *buf)
{
  int m = 0;
  for (int iextra = 0; iextra < atom->nextra_border; iextra++)
    m += modify->fix[atom->extra_border[iextra]]->pack_border(n, list, &buf[m]);
  return m;
}

void AtomVecSpherocylinder::unpack_ghosts(unsigned travel, int n, int first, double *buf)
{
  while (first + n > nmax) grow(0);
  int m = static_cast<int>(unpack(travel, n, first, buf) - buf);
  for (int iextra = 0; iextra < atom->nextra_border; iextra++)
    m += modify->fix[atom->extra_border[iextra]]->unpack_border(n, first, &buf[m]);
}

void AtomVecSpherocylinder::unpack_border(int n, int first, double *buf)
{
  unpack_ghosts(kBorder, n, first, buf);
}

void AtomVecSpherocylinder::unpack_border_vel(int n, int first, double *buf)
{
  unpack_ghosts(kBorder | kBorderVelocity, n, first, buf);
}

int AtomVecSpherocylinder::new_atom()
{
  // A new rod takes that of a ghost, whose id a contact may want.
  if (watcher_) watcher_->places_change();
  if (atom->nlocal == nmax) grow(0);
  return atom->nlocal;
}

int AtomVecSpherocylinder::pack_exchange(int i, double *buf)
{
  int m = 1 + pack(kWhole, 1, &i, buf + 1, 0, nullptr);
  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    m += modify->fix[atom->extra_grow[iextra]]->pack_exchange(i, &buf[m]);
  buf[0] = m;
  return m;
}

int AtomVecSpherocylinder::unpack_exchange(double *buf)
{
  const int i = new_atom();
  int m = static_cast<int>(unpack(kWhole, 1, i, buf + 1) - buf);
  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    m += modify->fix[atom->extra_grow[iextra]]->unpack_exchange(i, &buf[m]);
  atom->nlocal++;
  return m;
}

// What LIGGGHTS asks all ranks first when it writes a restart file.
int AtomVecSpherocylinder::size_restart()
{
  if (watcher_) watcher_->rods_are_written();
  const int nlocal = atom->nlocal;
  const KeptForces &forces = attached<KeptForces>();
  int n = (1 + rod_field_size(kWhole) + (forces.are_written() ? KeptForces::kNumbers : 0)) * nlocal;
  for (int iextra = 0; iextra < atom->nextra_restart; iextra++)
    for (int i = 0; i < nlocal; i++) n += modify->fix[atom->extra_restart[iextra]]->size_restart(i);
  return n;
}

int AtomVecSpherocylinder::pack_restart(int i, double *buf)
{
  int m = 1 + pack(kWhole, 1, &i, buf + 1, 0, nullptr);
  for (int iextra = 0; iextra < atom->nextra_restart; iextra++)
    m += modify->fix[atom->extra_restart[iextra]]->pack_restart(i, &buf[m]);
  const KeptForces &forces = attached<KeptForces>();
  if (forces.are_written()) m += forces.pack(i, &buf[m]);
  buf[0] = m;
  return m;
}

int AtomVecSpherocylinder::unpack_restart(double *buf)
{
  if (atom->nlocal == nmax) {
    grow(0);
    if (atom->nextra_store) memory->grow(atom->extra, nmax, atom->nextra_store, "atom:extra");
  }
  const int i = atom->nlocal;
  const int m = static_cast<int>(unpack(kWhole, 1, i, buf + 1) - buf),
            end = static_cast<int>(buf[0]);
  const bool has_forces =
      end - m >= KeptForces::kNumbers && attached<KeptForces>().take(i, buf + end);
  const int others = has_forces ? end - KeptForces::kNumbers : end;
  if (atom->nextra_store)
    for (int k = m; k < others; k++) atom->extra[i][k - m] = buf[k];
  atom->nlocal++;
  return end;
}

/* ----------------------------------------------------------------------
   new rods, and data files
------------------------------------------------------------------------- */

// Of no size yet, density 1, at rest, along z: insertion or the command `set` makes it a rod, and
// none may enter a run without (loader/run_checks.h).
void AtomVecSpherocylinder::create_atom(int itype, double *coord)
{
  const int i = new_atom();
  atom->tag[i] = 0;
  atom->type[i] = itype;
  atom->mask[i] = 1;
  atom->image[i] = ((tagint) IMGMAX << IMG2BITS) | ((tagint) IMGMAX << IMGBITS) | IMGMAX;
  sc::store(sc::load(coord), x_[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->v[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->omega[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->angmom[i]);
  sc::store(sc::Quaternion{1.0, 0.0, 0.0, 0.0}, quaternion_[i]);
  set_rod(i, 0.0, 0.0, 1.0);
  fibres_.clear(i);
  atom->nlocal++;
}

void AtomVecSpherocylinder::data_atom(double *coord, tagint imagetmp, char **values)
{
  const AtomsLine line = read_atoms_line(values);
  create_atom(line.type, coord);
  const int i = atom->nlocal - 1;
  atom->tag[i] = line.id;
  atom->image[i] = imagetmp;
  set_rod(i, line.diameter, line.total_length, line.density);
  sc::store(sc::orientation_of(line.axis), quaternion_[i]);
}

void AtomVecSpherocylinder::data_vel(int m, char **values)
{
  read_velocities_line(*atom, m, values);
}

void AtomVecSpherocylinder::pack_data(double **buf) { pack_data(buf, 0); }

void AtomVecSpherocylinder::pack_data(double **buf, int tag_offset)
{
  for (int i = 0; i < atom->nlocal; i++) pack_atoms_line(*atom, i, tag_offset, buf[i]);
}

void AtomVecSpherocylinder::write_data(FILE *fp, int n, double **buf)
{
  for (int i = 0; i < n; i++) write_atoms_line(fp, buf[i]);
}

void AtomVecSpherocylinder::pack_vel(double **buf) { pack_vel(buf, 0); }

void AtomVecSpherocylinder::pack_vel(double **buf, int tag_offset)
{
  for (int i = 0; i < atom->nlocal; i++) pack_velocities_line(*atom, i, tag_offset, buf[i]);
}

void AtomVecSpherocylinder::write_vel(FILE *fp, int n, double **buf)
{
  for (int i = 0; i < n; i++) write_velocities_line(fp, buf[i]);
}

AtomVecSpherocylinder &LAMMPS_NS::rods_of(LAMMPS *lmp, const char *who)
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec);
  if (!rods)
    rod_error_all(lmp, "%s requires atom_style spherocylinder (got %s)", who,
                  lmp->atom->atom_style);
  return *rods;
}
