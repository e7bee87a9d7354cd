// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_vec_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "error.h"
#include "far_rods.h"
#include "fix.h"
#include "fix_contact_history_spherocylinder.h"
#include "memory.h"
#include "modify.h"
#include "rod_checks.h"
#include "rod_insertion_list.h"
#include "rod_integrators.h"
#include "rod_shifts.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

// Arrays that are full grow by half, at least by this many rods: LIGGGHTS's rows of pointers are
// written for rods to come, too.
constexpr int kGrowBy = 1024;

double *put(double *buf, const double *values, int n)
{
  memcpy(buf, values, n * sizeof(double));
  return buf + n;
}

const double *get(const double *buf, double *values, int n)
{
  memcpy(values, buf, n * sizeof(double));
  return buf + n;
}

}  // namespace

AtomVecSpherocylinder::AtomVecSpherocylinder(LAMMPS *lmp) : AtomVec(lmp)
{
  molecular = 0;
  comm_x_only = 0;  // the orientation travels too
  comm_f_only = 0;
  size_forward = 7;  // x, quaternion
  size_reverse = 6;  // f, torque
  size_border = 13;  // x, tag, type, mask, shape, density, quaternion
  size_velocity = 6;
  size_data_atom = 11;  // id type diameter length density x y z ux uy uz
  size_data_vel = 7;
  xcol_data = 6;

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
  bring_histories_to_rods(lmp);  // LIGGGHTS may go on to make its lists anew, without contacts
  check_atom_style_is_alone(lmp);
  check_rods_are_whole(lmp, *this);
  images_may_touch_twice_ = check_rods_fit_periodic_box(lmp, true);
  moved_groups_ = check_each_rod_is_integrated_once(lmp);
}

/* ----------------------------------------------------------------------
   memory
------------------------------------------------------------------------- */

void AtomVecSpherocylinder::grow(int n)
{
  nmax = n == 0 ? nmax + std::max(kGrowBy, nmax / 2) : n;
  atom->nmax = nmax;
  if (nmax < 0) error->one(FLERR, "Per-processor system is too big");

  memory->grow(atom->tag, nmax, "atom:tag");
  memory->grow(atom->type, nmax, "atom:type");
  memory->grow(atom->mask, nmax, "atom:mask");
  memory->grow(atom->image, nmax, "atom:image");
  memory->grow(atom->x, nmax, 3, "atom:x");
  memory->grow(atom->v, nmax, 3, "atom:v");
  memory->grow(atom->f, nmax * comm->nthreads, 3, "atom:f");
  memory->grow(atom->radius, nmax, "atom:radius");
  memory->grow(atom->density, nmax, "atom:density");
  memory->grow(atom->rmass, nmax, "atom:rmass");
  memory->grow(atom->volume, nmax, "atom:volume");
  memory->grow(atom->vfrac, nmax, "atom:vfrac");
  memory->grow(atom->area, nmax, "atom:area");
  memory->grow(atom->omega, nmax, 3, "atom:omega");
  memory->grow(atom->torque, nmax * comm->nthreads, 3, "atom:torque");
  memory->grow(atom->angmom, nmax, 3, "atom:angmom");
  memory->grow(atom->shape, nmax, 3, "atom:shape");
  memory->grow(atom->blockiness, nmax, 2, "atom:blockiness");
  memory->grow(atom->inertia, nmax, 3, "atom:inertia");
  memory->grow(atom->quaternion, nmax, 4, "atom:quaternion");
  grow_reset();

  // A rod has no blockiness and no vfrac, but stock commands may read them.
  for (int i = 0; i < nmax; i++) {
    blockiness[i][0] = blockiness[i][1] = 2.0;
    atom->vfrac[i] = 0.0;
  }

  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    modify->fix[atom->extra_grow[iextra]]->grow_arrays(nmax);
}

void AtomVecSpherocylinder::grow_reset()
{
  tag = atom->tag;
  type = atom->type;
  mask = atom->mask;
  image = atom->image;
  x = atom->x;
  v = atom->v;
  f = atom->f;
  radius = atom->radius;
  density = atom->density;
  rmass = atom->rmass;
  volume = atom->volume;
  area = atom->area;
  omega = atom->omega;
  torque = atom->torque;
  angmom = atom->angmom;
  shape = atom->shape;
  blockiness = atom->blockiness;
  inertia = atom->inertia;
  quaternion = atom->quaternion;
}

bigint AtomVecSpherocylinder::memory_usage()
{
  bigint bytes = 0;
  if (atom->memcheck("tag")) bytes += memory->usage(tag, nmax);
  if (atom->memcheck("type")) bytes += memory->usage(type, nmax);
  if (atom->memcheck("mask")) bytes += memory->usage(mask, nmax);
  if (atom->memcheck("image")) bytes += memory->usage(image, nmax);
  if (atom->memcheck("x")) bytes += memory->usage(x, nmax, 3);
  if (atom->memcheck("v")) bytes += memory->usage(v, nmax, 3);
  if (atom->memcheck("f")) bytes += memory->usage(f, nmax * comm->nthreads, 3);
  if (atom->memcheck("radius")) bytes += memory->usage(radius, nmax);
  if (atom->memcheck("density")) bytes += memory->usage(density, nmax);
  if (atom->memcheck("rmass")) bytes += memory->usage(rmass, nmax);
  if (atom->memcheck("volume")) bytes += memory->usage(volume, nmax);
  if (atom->memcheck("vfrac")) bytes += memory->usage(atom->vfrac, nmax);
  if (atom->memcheck("area")) bytes += memory->usage(area, nmax);
  if (atom->memcheck("omega")) bytes += memory->usage(omega, nmax, 3);
  if (atom->memcheck("torque")) bytes += memory->usage(torque, nmax * comm->nthreads, 3);
  if (atom->memcheck("angmom")) bytes += memory->usage(angmom, nmax, 3);
  if (atom->memcheck("shape")) bytes += memory->usage(shape, nmax, 3);
  if (atom->memcheck("blockiness")) bytes += memory->usage(blockiness, nmax, 2);
  if (atom->memcheck("inertia")) bytes += memory->usage(inertia, nmax, 3);
  if (atom->memcheck("quaternion")) bytes += memory->usage(quaternion, nmax, 4);
  return bytes;
}

void AtomVecSpherocylinder::copy(int i, int j, int delflag)
{
  bring_histories_to_rods(lmp);
  tag[j] = tag[i];
  type[j] = type[i];
  mask[j] = mask[i];
  image[j] = image[i];
  put(x[j], x[i], 3);
  put(v[j], v[i], 3);
  radius[j] = radius[i];
  density[j] = density[i];
  rmass[j] = rmass[i];
  volume[j] = volume[i];
  area[j] = area[i];
  put(omega[j], omega[i], 3);
  put(angmom[j], angmom[i], 3);
  put(shape[j], shape[i], 3);
  put(inertia[j], inertia[i], 3);
  put(quaternion[j], quaternion[i], 4);

  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    modify->fix[atom->extra_grow[iextra]]->copy_arrays(i, j, delflag);
}

// LIGGGHTS calls this before rods go from rank to rank, when box and cuts are new and histories
// with their rods: at each rebuild of the lists.
void AtomVecSpherocylinder::clear_bonus()
{
  if (is_handing_over_) return;
  if (domain->box_change_size || domain->box_change_shape)
    images_may_touch_twice_ = check_rods_fit_periodic_box(lmp, !images_may_touch_twice_);
  if (images_may_touch_twice_) check_pairs_touch_once(lmp);
  check_new_rods_are_integrated(lmp, moved_groups_);
  is_handing_over_ = true;
  hand_over_far_rods(lmp);
  is_handing_over_ = false;
}

/* ----------------------------------------------------------------------
   the rod itself
------------------------------------------------------------------------- */

void AtomVecSpherocylinder::set_rod(int i, double diameter, double total_length,
                                    double rod_density)
{
  const bool is_whole = diameter > 0.0 && total_length > 0.0;
  const sc::MassProperties properties =
      is_whole ? sc::mass_properties(diameter, total_length, rod_density) : sc::MassProperties{};
  radius[i] = 0.5 * total_length;
  density[i] = rod_density;
  rmass[i] = properties.mass;
  volume[i] = properties.volume;
  area[i] = properties.area;
  shape[i][0] = shape[i][1] = 0.5 * diameter;
  shape[i][2] = 0.5 * total_length;
  inertia[i][0] = inertia[i][1] = properties.inertia_transverse;
  inertia[i][2] = properties.inertia_axial;
}

RodInsertionList &AtomVecSpherocylinder::insertion_list()
{
  if (!insertion_list_) insertion_list_ = std::make_unique<RodInsertionList>(lmp, *this);
  return *insertion_list_;
}

RodShifts &AtomVecSpherocylinder::rod_shifts()
{
  if (!rod_shifts_) rod_shifts_ = std::make_unique<RodShifts>(lmp);
  return *rod_shifts_;
}

/* ----------------------------------------------------------------------
   every step: owned rods to their ghosts, forces back
------------------------------------------------------------------------- */

// What a ghost's position and velocity gain over its owner's across a periodic boundary. `lamda`:
// in the coordinates of a triclinic box, where a period is 1, as at a rebuild of the lists.
AtomVecSpherocylinder::PeriodicShift AtomVecSpherocylinder::periodic_shift(const int *pbc,
                                                                           bool lamda) const
{
  PeriodicShift shift;
  if (lamda) {
    for (int d = 0; d < 3; d++) shift.dx[d] = pbc[d];
  } else {
    shift.dx[0] = pbc[0] * domain->xprd + pbc[5] * domain->xy + pbc[4] * domain->xz;
    shift.dx[1] = pbc[1] * domain->yprd + pbc[3] * domain->yz;
    shift.dx[2] = pbc[2] * domain->zprd;
  }
  if (deform_vremap) {
    shift.dv[0] = pbc[0] * h_rate[0] + pbc[5] * h_rate[5] + pbc[4] * h_rate[4];
    shift.dv[1] = pbc[1] * h_rate[1] + pbc[3] * h_rate[3];
    shift.dv[2] = pbc[2] * h_rate[2];
  }
  return shift;
}

// Velocity and spin of a ghost of rod j.
double *AtomVecSpherocylinder::put_motion(double *out, int j, const PeriodicShift &shift) const
{
  put(out, v[j], 3);
  if (deform_vremap && (mask[j] & deform_groupbit))
    for (int d = 0; d < 3; d++) out[d] += shift.dv[d];
  return put(out + 3, omega[j], 3);
}

// LIGGGHTS's arrays are in one piece: of ghosts by the thousand, their rows are worked out rather
// than looked up.
template <bool VELOCITY>
int AtomVecSpherocylinder::pack_forward(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  if (n == 0) return 0;
  const PeriodicShift shift = pbc_flag ? periodic_shift(pbc, false) : PeriodicShift();
  const double sx = shift.dx[0], sy = shift.dx[1], sz = shift.dx[2];
  const double *const positions = x[0], *const quaternions = quaternion[0];
  const double *const velocities = v[0], *const omegas = omega[0];
  const bool remaps = deform_vremap && pbc_flag;
  double *out = buf;
  for (int k = 0; k < n; k++) {
    const size_t j = list[k];
    const double *position = positions + 3 * j;
    out[0] = position[0] + sx;
    out[1] = position[1] + sy;
    out[2] = position[2] + sz;
    out = put(out + 3, quaternions + 4 * j, 4);
    if (!VELOCITY) continue;
    put(out, velocities + 3 * j, 3);
    if (remaps && (mask[j] & deform_groupbit))
      for (int d = 0; d < 3; d++) out[d] += shift.dv[d];
    out = put(out + 3, omegas + 3 * j, 3);
  }
  return static_cast<int>(out - buf);
}

int AtomVecSpherocylinder::pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_forward<false>(n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_comm_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_forward<true>(n, list, buf, pbc_flag, pbc);
}

template <bool VELOCITY>
void AtomVecSpherocylinder::unpack_forward(int n, int first, const double *buf)
{
  if (n == 0) return;
  double *position = x[first], *orientation = quaternion[first];
  double *velocity = v[first], *spin = omega[first];
  const double *in = buf;
  for (int k = 0; k < n; k++) {
    in = get(in, position + 3 * k, 3);
    in = get(in, orientation + 4 * k, 4);
    if (!VELOCITY) continue;
    in = get(in, velocity + 3 * k, 3);
    in = get(in, spin + 3 * k, 3);
  }
}

void AtomVecSpherocylinder::unpack_comm(int n, int first, double *buf)
{
  unpack_forward<false>(n, first, buf);
}

void AtomVecSpherocylinder::unpack_comm_vel(int n, int first, double *buf)
{
  unpack_forward<true>(n, first, buf);
}

int AtomVecSpherocylinder::pack_reverse(int n, int first, double *buf)
{
  double *out = buf;
  for (int i = first; i < first + n; i++) {
    out = put(out, f[i], 3);
    out = put(out, torque[i], 3);
  }
  return static_cast<int>(out - buf);
}

void AtomVecSpherocylinder::unpack_reverse(int n, int *list, double *buf)
{
  const double *in = buf;
  for (int k = 0; k < n; k++) {
    const int j = list[k];
    for (int d = 0; d < 3; d++) f[j][d] += *in++;
    for (int d = 0; d < 3; d++) torque[j][d] += *in++;
  }
}

/* ----------------------------------------------------------------------
   at a rebuild of the lists: new ghosts. Size and density travel; mass and inertia are worked out
   again at the other side, to the same bits.
------------------------------------------------------------------------- */

template <bool VELOCITY>
int AtomVecSpherocylinder::pack_ghosts(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  const PeriodicShift shift =
      pbc_flag ? periodic_shift(pbc, domain->triclinic != 0) : PeriodicShift();
  double *out = buf;
  for (int k = 0; k < n; k++) {
    const int j = list[k];
    for (int d = 0; d < 3; d++) *out++ = x[j][d] + shift.dx[d];
    *out++ = ubuf(tag[j]).d;
    *out++ = ubuf(type[j]).d;
    *out++ = ubuf(mask[j]).d;
    *out++ = shape[j][0];
    *out++ = radius[j];
    *out++ = density[j];
    out = put(out, quaternion[j], 4);
    if (VELOCITY) out = put_motion(out, j, shift);
  }

  int m = static_cast<int>(out - buf);
  for (int iextra = 0; iextra < atom->nextra_border; iextra++)
    m += modify->fix[atom->extra_border[iextra]]->pack_border(n, list, &buf[m]);
  return m;
}

int AtomVecSpherocylinder::pack_border(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_ghosts<false>(n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_border_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack_ghosts<true>(n, list, buf, pbc_flag, pbc);
}

template <bool VELOCITY>
void AtomVecSpherocylinder::unpack_ghosts(int n, int first, double *buf)
{
  const double *in = buf;
  for (int i = first; i < first + n; i++) {
    if (i == nmax) grow(0);
    in = get(in, x[i], 3);
    tag[i] = static_cast<int>(ubuf(*in++).i);
    type[i] = static_cast<int>(ubuf(*in++).i);
    mask[i] = static_cast<int>(ubuf(*in++).i);
    const double rod_radius = *in++;
    const double bounding_radius = *in++;
    const double rod_density = *in++;
    set_rod(i, 2.0 * rod_radius, 2.0 * bounding_radius, rod_density);
    in = get(in, quaternion[i], 4);
    if (VELOCITY) {
      in = get(in, v[i], 3);
      in = get(in, omega[i], 3);
    }
  }

  int m = static_cast<int>(in - buf);
  for (int iextra = 0; iextra < atom->nextra_border; iextra++)
    m += modify->fix[atom->extra_border[iextra]]->unpack_border(n, first, &buf[m]);
}

void AtomVecSpherocylinder::unpack_border(int n, int first, double *buf)
{
  unpack_ghosts<false>(n, first, buf);
}

void AtomVecSpherocylinder::unpack_border_vel(int n, int first, double *buf)
{
  unpack_ghosts<true>(n, first, buf);
}

/* ----------------------------------------------------------------------
   whole rods: to another rank, to a restart file
------------------------------------------------------------------------- */

namespace {
constexpr int kStateSize = 23;  // values of pack_state
}

// xyz must come first: read_restart looks for them there.
int AtomVecSpherocylinder::pack_state(int i, double *buf) const
{
  double *out = put(buf, x[i], 3);
  *out++ = ubuf(tag[i]).d;
  *out++ = ubuf(type[i]).d;
  *out++ = ubuf(mask[i]).d;
  *out++ = ubuf(image[i]).d;
  out = put(out, v[i], 3);
  *out++ = shape[i][0];
  *out++ = radius[i];
  *out++ = density[i];
  out = put(out, quaternion[i], 4);
  out = put(out, omega[i], 3);
  out = put(out, angmom[i], 3);
  return static_cast<int>(out - buf);
}

int AtomVecSpherocylinder::unpack_state(int i, const double *buf)
{
  const double *in = get(buf, x[i], 3);
  tag[i] = static_cast<int>(ubuf(*in++).i);
  type[i] = static_cast<int>(ubuf(*in++).i);
  mask[i] = static_cast<int>(ubuf(*in++).i);
  image[i] = static_cast<tagint>(ubuf(*in++).i);
  in = get(in, v[i], 3);
  const double rod_radius = *in++;
  const double bounding_radius = *in++;
  const double rod_density = *in++;
  set_rod(i, 2.0 * rod_radius, 2.0 * bounding_radius, rod_density);
  in = get(in, quaternion[i], 4);
  in = get(in, omega[i], 3);
  in = get(in, angmom[i], 3);
  return static_cast<int>(in - buf);
}

int AtomVecSpherocylinder::new_atom()
{
  bring_histories_to_rods(lmp);  // a new rod takes the place of a ghost, whose id a contact may want
  if (atom->nlocal == nmax) grow(0);
  return atom->nlocal;
}

int AtomVecSpherocylinder::pack_exchange(int i, double *buf)
{
  int m = 1 + pack_state(i, buf + 1);
  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    m += modify->fix[atom->extra_grow[iextra]]->pack_exchange(i, &buf[m]);
  buf[0] = m;
  return m;
}

int AtomVecSpherocylinder::unpack_exchange(double *buf)
{
  const int i = new_atom();
  int m = 1 + unpack_state(i, buf + 1);
  for (int iextra = 0; iextra < atom->nextra_grow; iextra++)
    m += modify->fix[atom->extra_grow[iextra]]->unpack_exchange(i, &buf[m]);
  atom->nlocal++;
  return m;
}

int AtomVecSpherocylinder::size_restart()
{
  const int nlocal = atom->nlocal;
  int n = (1 + kStateSize) * nlocal;
  for (int iextra = 0; iextra < atom->nextra_restart; iextra++)
    for (int i = 0; i < nlocal; i++)
      n += modify->fix[atom->extra_restart[iextra]]->size_restart(i);
  return n;
}

int AtomVecSpherocylinder::pack_restart(int i, double *buf)
{
  int m = 1 + pack_state(i, buf + 1);
  for (int iextra = 0; iextra < atom->nextra_restart; iextra++)
    m += modify->fix[atom->extra_restart[iextra]]->pack_restart(i, &buf[m]);
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
  int m = 1 + unpack_state(i, buf + 1);
  if (atom->nextra_store) {
    const int size = static_cast<int>(buf[0]) - m;
    for (int k = 0; k < size; k++) atom->extra[i][k] = buf[m++];
  }
  atom->nlocal++;
  return m;
}

/* ----------------------------------------------------------------------
   new rods, and data files
------------------------------------------------------------------------- */

// Of no size yet, density 1, at rest, along z: insertion or the command `set` makes it a rod, and
// none may enter a run without (check_rods_are_whole).
void AtomVecSpherocylinder::create_atom(int itype, double *coord)
{
  const int i = new_atom();
  tag[i] = 0;
  type[i] = itype;
  mask[i] = 1;
  image[i] = ((tagint) IMGMAX << IMG2BITS) | ((tagint) IMGMAX << IMGBITS) | IMGMAX;
  put(x[i], coord, 3);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, v[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, omega[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, angmom[i]);
  sc::store(sc::Quaternion{1.0, 0.0, 0.0, 0.0}, quaternion[i]);
  set_rod(i, 0.0, 0.0, 1.0);
  atom->nlocal++;
}

// id type diameter length density x y z ux uy uz, as ReadDataSpherocylinder has checked them
void AtomVecSpherocylinder::data_atom(double *coord, tagint imagetmp, char **values)
{
  create_atom(atoi(values[1]), coord);
  const int i = atom->nlocal - 1;
  tag[i] = atoi(values[0]);
  image[i] = imagetmp;
  set_rod(i, atof(values[2]), atof(values[3]), atof(values[4]));
  const sc::Vec3 axis = {atof(values[8]), atof(values[9]), atof(values[10])};
  sc::store(sc::orientation_of((1.0 / sc::norm(axis)) * axis), quaternion[i]);
}

// vx vy vz wx wy wz, space frame
void AtomVecSpherocylinder::data_vel(int m, char **values)
{
  for (int d = 0; d < 3; d++) {
    v[m][d] = atof(values[d]);
    omega[m][d] = atof(values[3 + d]);
  }
  const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(quaternion[m]));
  sc::store(sc::angular_momentum(sc::load(omega[m]), axis, inertia[m][2], inertia[m][0]),
            angmom[m]);
}

void AtomVecSpherocylinder::pack_data(double **buf) { pack_data(buf, 0); }

void AtomVecSpherocylinder::pack_data(double **buf, int tag_offset)
{
  for (int i = 0; i < atom->nlocal; i++) {
    double *out = buf[i];
    *out++ = ubuf(tag[i] + tag_offset).d;
    *out++ = ubuf(type[i]).d;
    *out++ = 2.0 * shape[i][0];
    *out++ = 2.0 * radius[i];
    *out++ = density[i];
    out = put(out, x[i], 3);
    sc::store(sc::axis_of(sc::load_quaternion(quaternion[i])), out);
    out += 3;
    *out++ = ubuf((image[i] & IMGMASK) - IMGMAX).d;
    *out++ = ubuf((image[i] >> IMGBITS & IMGMASK) - IMGMAX).d;
    *out++ = ubuf((image[i] >> IMG2BITS) - IMGMAX).d;
  }
}

void AtomVecSpherocylinder::write_data(FILE *fp, int n, double **buf)
{
  for (int i = 0; i < n; i++) {
    fprintf(fp, "%d %d", (int) ubuf(buf[i][0]).i, (int) ubuf(buf[i][1]).i);
    for (int k = 2; k < 11; k++) fprintf(fp, " %-1.16e", buf[i][k]);
    fprintf(fp, " %d %d %d\n", (int) ubuf(buf[i][11]).i, (int) ubuf(buf[i][12]).i,
            (int) ubuf(buf[i][13]).i);
  }
}

void AtomVecSpherocylinder::pack_vel(double **buf) { pack_vel(buf, 0); }

void AtomVecSpherocylinder::pack_vel(double **buf, int tag_offset)
{
  for (int i = 0; i < atom->nlocal; i++) {
    buf[i][0] = ubuf(tag[i] + tag_offset).d;
    put(put(buf[i] + 1, v[i], 3), omega[i], 3);
  }
}

void AtomVecSpherocylinder::write_vel(FILE *fp, int n, double **buf)
{
  for (int i = 0; i < n; i++) {
    fprintf(fp, "%d", (int) ubuf(buf[i][0]).i);
    for (int k = 1; k < 7; k++) fprintf(fp, " %-1.16e", buf[i][k]);
    fprintf(fp, "\n");
  }
}
