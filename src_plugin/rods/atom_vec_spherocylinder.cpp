// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/atom_vec_spherocylinder.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "atom.h"
#include "comm.h"
#include "core/mass_properties.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "host/rod_error.h"
#include "memory.h"
#include "modify.h"
#include "rods/rod_fields.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

// Arrays that are full grow by half, at least by this many rods: LIGGGHTS's rows of pointers are
// written for rods to come, too.
constexpr int kGrowBy = 1024;

// LIGGGHTS's arrays are in one piece: of ghosts by the thousand, their rows are worked out rather
// than looked up.
template <typename T>
T *rows_of(T *array)
{
  return array;
}
double *rows_of(double **array) { return array ? array[0] : nullptr; }

// A whole number travels as its bits, as in LIGGGHTS's own styles.
double as_sent(double value) { return value; }
double as_sent(int value)
{
  const int64_t bits = value;
  double sent;
  memcpy(&sent, &bits, sizeof(sent));
  return sent;
}
void receive(double sent, double &value) { value = sent; }
void receive(double sent, int &value)
{
  int64_t bits;
  memcpy(&bits, &sent, sizeof(bits));
  value = static_cast<int>(bits);
}

template <int SENT, typename T>
double *gather(const T *rows, int width, const int *list, int n, double *out)
{
  for (int k = 0; k < n; k++) {
    const T *row = rows + static_cast<size_t>(width) * list[k];
    for (int d = 0; d < SENT; d++) *out++ = as_sent(row[d]);
  }
  return out;
}

template <typename T>
double *gather(const T *rows, const RodField &field, const int *list, int n, double *out)
{
  switch (field.sent) {
    case 1: return gather<1>(rows, field.width, list, n, out);
    case 3: return gather<3>(rows, field.width, list, n, out);
    default: return gather<4>(rows, field.width, list, n, out);
  }
}

template <typename T>
const double *scatter(const double *in, const RodField &field, int first, int n, T *rows)
{
  for (int i = first; i < first + n; i++)
    for (int d = 0; d < field.sent; d++)
      receive(*in++, rows[static_cast<size_t>(field.width) * i + d]);
  return in;
}

void grow_array(Memory &memory, int *&array, int n, int, const char *name)
{
  memory.grow(array, n, name);
}
void grow_array(Memory &memory, double *&array, int n, int, const char *name)
{
  memory.grow(array, n, name);
}
void grow_array(Memory &memory, double **&array, int n, int width, const char *name)
{
  memory.grow(array, n, width, name);
}

// Calls `action(rows, field)` for the fields that travel so, in their order.
template <typename Action>
void for_each_field(Atom &atom, unsigned travel, Action action)
{
  for (const RodField &field : rod_fields())
    if (field.travel & travel)
      std::visit([&](auto array) { action(rows_of(atom.*array), field); }, field.array);
}

double *put(double *buf, const double *values, int n)
{
  memcpy(buf, values, n * sizeof(double));
  return buf + n;
}

// What a ghost's rows gain over its owner's across a periodic boundary: `gain`, for the rods of
// `groups` alone.
void add_gain(double *sent, const double *gain, const int *list, int n, const int *mask, int groups)
{
  for (int k = 0; k < n; k++)
    if (mask[list[k]] & groups)
      for (int d = 0; d < 3; d++) sent[3 * k + d] += gain[d];
}
constexpr int kAllGroups = -1;

}  // namespace

AtomVecSpherocylinder::AtomVecSpherocylinder(LAMMPS *lmp) : AtomVec(lmp), attachments_(lmp)
{
  molecular = 0;
  comm_x_only = 0;  // the orientation travels too
  comm_f_only = 0;
  size_forward = rod_field_size(kForward);
  size_reverse = rod_field_size(kReverse);
  size_border = rod_field_size(kBorder);
  size_velocity = rod_field_size(kForwardVelocity);
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

  for (const RodField &field : rod_fields()) {
    const int rows = field.travel & kReverse ? nmax * comm->nthreads : nmax;
    const std::string name = std::string("atom:") + field.name;
    std::visit(
        [&](auto array) { grow_array(*memory, atom->*array, rows, field.width, name.c_str()); },
        field.array);
  }
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
  bigint bytes = 0;
  for (const RodField &field : rod_fields()) {
    if (!atom->memcheck(field.name)) continue;
    const bigint values =
        static_cast<bigint>(nmax) * field.width * (field.travel & kReverse ? comm->nthreads : 1);
    const bool is_whole_number = std::holds_alternative<RodField::WholeNumbers>(field.array);
    bytes += values * (is_whole_number ? sizeof(int) : sizeof(double));
  }
  return bytes;
}

void AtomVecSpherocylinder::copy(int i, int j, int delflag)
{
  if (watcher_) watcher_->places_change();
  for_each_field(*atom, ~kReverse, [&](auto *rows, const RodField &field) {
    std::copy_n(rows + static_cast<size_t>(field.width) * i, field.width,
                rows + static_cast<size_t>(field.width) * j);
  });

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

void AtomVecSpherocylinder::set_rod(int i, double diameter, double total_length, double rod_density)
{
  const bool is_whole = diameter > 0.0 && total_length > 0.0;
  const sc::MassProperties properties =
      is_whole ? sc::mass_properties(diameter, total_length, rod_density) : sc::MassProperties{};
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

// A ghost gains what lies between its owner and it across a periodic boundary; new ghosts of a
// triclinic box in lamda coordinates, where a period is 1.
int AtomVecSpherocylinder::pack(unsigned travel, int n, const int *list, double *buf, int pbc_flag,
                                const int *pbc) const
{
  if (n == 0) return 0;
  double period[3] = {0.0, 0.0, 0.0}, box_speed[3] = {0.0, 0.0, 0.0};
  if (pbc_flag && (travel & kBorder) && domain->triclinic) {
    for (int d = 0; d < 3; d++) period[d] = pbc[d];
  } else if (pbc_flag) {
    period[0] = pbc[0] * domain->xprd + pbc[5] * domain->xy + pbc[4] * domain->xz;
    period[1] = pbc[1] * domain->yprd + pbc[3] * domain->yz;
    period[2] = pbc[2] * domain->zprd;
  }
  const bool remaps = deform_vremap && pbc_flag;
  if (remaps) {
    box_speed[0] = pbc[0] * h_rate[0] + pbc[5] * h_rate[5] + pbc[4] * h_rate[4];
    box_speed[1] = pbc[1] * h_rate[1] + pbc[3] * h_rate[3];
    box_speed[2] = pbc[2] * h_rate[2];
  }

  double *out = buf;
  for_each_field(*atom, travel, [&](auto *rows, const RodField &field) {
    double *const sent = out;
    out = gather(rows, field, list, n, sent);
    if (pbc_flag && (field.travel & kGainsPeriod))
      add_gain(sent, period, list, n, atom->mask, kAllGroups);
    if (remaps && (field.travel & kGainsBoxSpeed))
      add_gain(sent, box_speed, list, n, atom->mask, deform_groupbit);
  });
  return static_cast<int>(out - buf);
}

const double *AtomVecSpherocylinder::unpack(unsigned travel, int n, int first, const double *buf)
{
  const double *in = buf;
  for_each_field(*atom, travel, [&](auto *rows, const RodField &field) {
    in = scatter(in, field, first, n, rows);
  });
  if (travel & (kBorder | kWhole))
    for (int i = first; i < first + n; i++)
      set_rod(i, 2.0 * shape_[i][0], 2.0 * atom->radius[i], atom->density[i]);
  return in;
}

int AtomVecSpherocylinder::pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack(kForward, n, list, buf, pbc_flag, pbc);
}

int AtomVecSpherocylinder::pack_comm_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  return pack(kForward | kForwardVelocity, n, list, buf, pbc_flag, pbc);
}

void AtomVecSpherocylinder::unpack_comm(int n, int first, double *buf)
{
  unpack(kForward, n, first, buf);
}

void AtomVecSpherocylinder::unpack_comm_vel(int n, int first, double *buf)
{
  unpack(kForward | kForwardVelocity, n, first, buf);
}

int AtomVecSpherocylinder::pack_reverse(int n, int first, double *buf)
{
  double *out = buf;
  for_each_field(*atom, kReverse, [&](auto *rows, const RodField &field) {
    for (int k = field.width * first; k < field.width * (first + n); k++) *out++ = rows[k];
  });
  return static_cast<int>(out - buf);
}

void AtomVecSpherocylinder::unpack_reverse(int n, int *list, double *buf)
{
  const double *in = buf;
  for_each_field(*atom, kReverse, [&](auto *rows, const RodField &field) {
    for (int k = 0; k < n; k++)
      for (int d = 0; d < field.width; d++) rows[field.width * list[k] + d] += *in++;
  });
}

int AtomVecSpherocylinder::pack_border(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  const int m = pack(kBorder, n, list, buf, pbc_flag, pbc);
  return m + pack_border_of_fixes(n, list, buf + m);
}

int AtomVecSpherocylinder::pack_border_vel(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  const int m = pack(kBorder | kBorderVelocity, n, list, buf, pbc_flag, pbc);
  return m + pack_border_of_fixes(n, list, buf + m);
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

int AtomVecSpherocylinder::size_restart()
{
  const int nlocal = atom->nlocal;
  int n = (1 + rod_field_size(kWhole)) * nlocal;
  for (int iextra = 0; iextra < atom->nextra_restart; iextra++)
    for (int i = 0; i < nlocal; i++) n += modify->fix[atom->extra_restart[iextra]]->size_restart(i);
  return n;
}

int AtomVecSpherocylinder::pack_restart(int i, double *buf)
{
  int m = 1 + pack(kWhole, 1, &i, buf + 1, 0, nullptr);
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
  int m = static_cast<int>(unpack(kWhole, 1, i, buf + 1) - buf);
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
// none may enter a run without (loader/run_checks.h).
void AtomVecSpherocylinder::create_atom(int itype, double *coord)
{
  const int i = new_atom();
  atom->tag[i] = 0;
  atom->type[i] = itype;
  atom->mask[i] = 1;
  atom->image[i] = ((tagint) IMGMAX << IMG2BITS) | ((tagint) IMGMAX << IMGBITS) | IMGMAX;
  put(x_[i], coord, 3);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->v[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->omega[i]);
  sc::store(sc::Vec3{0.0, 0.0, 0.0}, atom->angmom[i]);
  sc::store(sc::Quaternion{1.0, 0.0, 0.0, 0.0}, quaternion_[i]);
  set_rod(i, 0.0, 0.0, 1.0);
  atom->nlocal++;
}

// id type diameter length density x y z ux uy uz, as ReadDataSpherocylinder has checked them
void AtomVecSpherocylinder::data_atom(double *coord, tagint imagetmp, char **values)
{
  create_atom(atoi(values[1]), coord);
  const int i = atom->nlocal - 1;
  atom->tag[i] = atoi(values[0]);
  atom->image[i] = imagetmp;
  set_rod(i, atof(values[2]), atof(values[3]), atof(values[4]));
  const sc::Vec3 axis = {atof(values[8]), atof(values[9]), atof(values[10])};
  sc::store(sc::orientation_of((1.0 / sc::norm(axis)) * axis), quaternion_[i]);
}

// vx vy vz wx wy wz, space frame
void AtomVecSpherocylinder::data_vel(int m, char **values)
{
  for (int d = 0; d < 3; d++) {
    atom->v[m][d] = atof(values[d]);
    atom->omega[m][d] = atof(values[3 + d]);
  }
  const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(quaternion_[m]));
  sc::store(sc::angular_momentum(sc::load(atom->omega[m]), axis, atom->inertia[m][2],
                                 atom->inertia[m][0]),
            atom->angmom[m]);
}

void AtomVecSpherocylinder::pack_data(double **buf) { pack_data(buf, 0); }

void AtomVecSpherocylinder::pack_data(double **buf, int tag_offset)
{
  for (int i = 0; i < atom->nlocal; i++) {
    double *out = buf[i];
    *out++ = ubuf(atom->tag[i] + tag_offset).d;
    *out++ = ubuf(atom->type[i]).d;
    *out++ = 2.0 * shape_[i][0];
    *out++ = 2.0 * atom->radius[i];
    *out++ = atom->density[i];
    out = put(out, x_[i], 3);
    sc::store(sc::axis_of(sc::load_quaternion(quaternion_[i])), out);
    out += 3;
    *out++ = ubuf((atom->image[i] & IMGMASK) - IMGMAX).d;
    *out++ = ubuf((atom->image[i] >> IMGBITS & IMGMASK) - IMGMAX).d;
    *out++ = ubuf((atom->image[i] >> IMG2BITS) - IMGMAX).d;
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
    buf[i][0] = ubuf(atom->tag[i] + tag_offset).d;
    put(put(buf[i] + 1, atom->v[i], 3), atom->omega[i], 3);
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

AtomVecSpherocylinder &LAMMPS_NS::rods_of(LAMMPS *lmp, const char *who)
{
  auto *rods = dynamic_cast<AtomVecSpherocylinder *>(lmp->atom->avec);
  if (!rods)
    rod_error_all(lmp, "%s requires atom_style spherocylinder (got %s)", who,
                  lmp->atom->atom_style);
  return *rods;
}
