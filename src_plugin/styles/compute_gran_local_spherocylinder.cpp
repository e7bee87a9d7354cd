// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/compute_gran_local_spherocylinder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "core/numbers.h"
#include "domain.h"
#include "fix_mesh_surface.h"
#include "force.h"
#include "host/rod_error.h"
#include "memory.h"
#include "modify.h"
#include "styles/fix_wall_gran_spherocylinder.h"
#include "update.h"

using namespace LAMMPS_NS;
using spherocylinder::load;
using spherocylinder::pi;
using spherocylinder::Vec3;

namespace {

constexpr int kNoBody = -1;  // what LIGGGHTS gives as ms_id of a particle in no multisphere body
constexpr int kFirstKeyword = 3;

// Of the circle in which two spheres with their centres at the distance d meet; once its plane has
// passed the centre of the smaller one, that one's greatest circle.
double circle_area(double r1, double r2, double d)
{
  const double smaller = std::min(r1, r2);
  if (d <= 0.0 || d * d <= std::fabs(r1 * r1 - r2 * r2)) return pi * smaller * smaller;
  const double to_plane = 0.5 * (d + (r1 * r1 - r2 * r2) / d);  // from the centre of sphere 1
  return pi * (r1 * r1 - to_plane * to_plane);
}

// Of the circle in which a plane at the distance d from its centre cuts a sphere.
double circle_area(double r, double d) { return pi * (d <= 0.0 ? r * r : r * r - d * d); }

double *put(double *row, const Vec3 &a)
{
  spherocylinder::store(a, row);
  return row + 3;
}

Vec3 along(const Vec3 &a, const Vec3 &normal) { return dot(a, normal) * normal; }

}  // namespace

// LIGGGHTS's constructor refuses keywords it does not know.
ComputeGranLocalSpherocylinder::Keywords::Keywords(int narg, char **arg)
{
  for (int k = 0; k < narg; k++) {
    if (k >= kFirstKeyword && strcmp(arg[k], "normal") == 0)
      normal = true;
    else
      stock.push_back(arg[k]);
  }
}

ComputeGranLocalSpherocylinder::ComputeGranLocalSpherocylinder(LAMMPS *lmp, int &iarg, int narg,
                                                               char **arg)
    : ComputeGranLocalSpherocylinder(lmp, iarg, Keywords(narg, arg))
{
}

ComputeGranLocalSpherocylinder::ComputeGranLocalSpherocylinder(LAMMPS *lmp, int &iarg,
                                                               Keywords keywords)
    : ComputePairGranLocal(lmp, iarg, static_cast<int>(keywords.stock.size()),
                           keywords.stock.data()),
      normal_(keywords.normal)
{
  if (heatflag)
    rod_error_all(lmp,
                  "Compute %s (id %s): heatFlux of single contacts is not available with "
                  "atom_style spherocylinder (expected f_heatFlux of fix heat/gran/conduction)",
                  style, id);
  // Without a keyword of its own LIGGGHTS stores its default columns.
  if (normal_ && static_cast<int>(keywords.stock.size()) == kFirstKeyword)
    posflag = velflag = idflag = fflag = torqueflag = histflag = areaflag = 0;
  timeflag = 1;  // output announces the steps in which it will ask
}

void ComputeGranLocalSpherocylinder::init()
{
  ComputePairGranLocal::init();
  memory->destroy(array);  // the number of columns may have changed with the pair style
  array = array_local = nullptr;
  nmax = size_local_rows = 0;
  collected_step_ = -1;
}

// Also called once by LIGGGHTS when the compute is made: a dump asks for the number of columns.
void ComputeGranLocalSpherocylinder::init_cpgl(bool)
{
  if (wall) {
    register_with_walls();
    nvalues = 6 * (posflag + velflag) +
              3 * (idflag + fflag + fnflag + ftflag + torqueflag + torquenflag + torquetflag) +
              dnum * histflag + areaflag + deltaflag + 3 * cpflag + 2 * msidflag;
  } else {
    ComputePairGranLocal::init_cpgl(false);
  }
  nvalues += normal_ ? 3 : 0;
  size_local_cols = nvalues;
}

// With all walls of the deck (LIGGGHTS's own: with one, of meshes).
void ComputeGranLocalSpherocylinder::register_with_walls()
{
  walls_.clear();
  dnum = 0;
  for (int k = 0; k < modify->nfix; k++) {
    auto *fix = dynamic_cast<FixWallGran *>(modify->fix[k]);
    if (!fix) continue;
    if (fix->compute_wall_gran_local() == this) fix->unregister_compute_wall_local(this);
    int of_host = 0;
    fix->register_compute_wall_local(this, of_host);
    auto *wall_of_rods = dynamic_cast<FixWallGranSpherocylinder *>(fix);
    const int values = wall_of_rods ? wall_of_rods->history_values() : of_host;
    if (histflag && !walls_.empty() && values != dnum)
      rod_error_all(lmp,
                    "Compute %s (id %s): history wants the same number of history values in all "
                    "walls (got %d and, in fix %s, %d)",
                    style, id, dnum, fix->id, values);
    dnum = values;
    if (!fix->is_mesh_wall()) walls_.push_back({fix, nullptr});
    for (int m = 0; fix->is_mesh_wall() && m < fix->n_meshes(); m++)
      walls_.push_back({fix, fix->mesh_list()[m]});
  }
  if (walls_.empty())
    rod_error_all(lmp,
                  "Compute %s (id %s) requires a fix wall/gran, which has to come before the "
                  "compute",
                  style, id);
  if (histflag && dnum == 0)
    rod_error_all(lmp, "Compute %s (id %s): the contact models of the walls have no history", style,
                  id);
  reference_exists = 1;
}

void ComputeGranLocalSpherocylinder::pre_delete(bool uncomputeflag)
{
  if (!wall) {
    ComputePairGranLocal::pre_delete(uncomputeflag);
    return;
  }
  if (!uncomputeflag) return;
  for (int k = 0; k < modify->nfix; k++) {
    auto *fix = dynamic_cast<FixWallGran *>(modify->fix[k]);
    if (fix && fix->compute_wall_gran_local() == this) fix->unregister_compute_wall_local(this);
  }
}

void ComputeGranLocalSpherocylinder::compute_local()
{
  invoked_local = update->ntimestep;
  if (!matchstep(update->ntimestep))
    rod_error_all(lmp,
                  "Compute %s (id %s) can be asked for only by output that knows its step in "
                  "advance (got step " BIGINT_FORMAT ")",
                  style, id, update->ntimestep);
  // No contact of a wall in this step: nobody has begun new rows.
  ncount = rows_ = collected_step_ == update->ntimestep ? rows_ : 0;
  size_local_rows = ncount_added_via_pair = rows_;
  array_local = array;
}

double ComputeGranLocalSpherocylinder::memory_usage()
{
  return static_cast<double>(nmax) * nvalues * sizeof(double);
}

void ComputeGranLocalSpherocylinder::begin_rows()
{
  collected_step_ = update->ntimestep;
  rows_ = 0;
}

void ComputeGranLocalSpherocylinder::add_pair_contact(const ContactRow &contact)
{
  const int i = contact.i, j = contact.j;
  if (!(atom->mask[i] & groupbit) || !(atom->mask[j] & groupbit)) return;
  // Of the two ranks, or the two images, that see a pair, one reports it.
  if (j >= atom->nlocal && atom->tag[i] <= atom->tag[j]) return;

  double x_i[3], x_j[3];
  spherocylinder::store(load(atom->x[i]), x_i);
  spherocylinder::store(load(atom->x[j]), x_j);
  domain->remap(x_i);
  domain->remap(x_j);
  // Remapping moves a rod by a period, which is longer than any rod, or not at all.
  const Vec3 moved = load(x_j) - load(x_i) - (load(atom->x[j]) - load(atom->x[i]));
  const bool across = norm(moved) > atom->radius[i];
  add_row(
      {{load(x_i), load(x_j)},
       {load(atom->v[i]), load(atom->v[j])},
       {static_cast<double>(atom->tag[i]), static_cast<double>(atom->tag[j]), across ? 1.0 : 0.0},
       contact.force,
       contact.torque,
       contact.normal,
       contact.point,
       contact.history,
       circle_area(contact.radius_i, contact.radius_j, contact.distance),
       contact.overlap});
}

// Walls have no call at the start of a step: rows begin with the first contact of the step. The
// set-up of a run computes the forces of the last step again, after init().
void ComputeGranLocalSpherocylinder::add_wall_contact(const FixWallGran &wall_fix, int end,
                                                      const ContactRow &contact)
{
  add_row_of_wall({&wall_fix, nullptr}, end, contact);
}

void ComputeGranLocalSpherocylinder::add_mesh_contact(const FixWallGran &wall_fix,
                                                      const MeshSurface &mesh, int triangle_id,
                                                      const ContactRow &contact)
{
  add_row_of_wall({&wall_fix, &mesh.fix()}, triangle_id, contact);
}

void ComputeGranLocalSpherocylinder::add_row_of_wall(const Wall &wall_of_row, int part,
                                                     const ContactRow &contact)
{
  if (collected_step_ != update->ntimestep) begin_rows();
  const int i = contact.i;
  if (!(atom->mask[i] & groupbit)) return;
  const auto is_it = [&](const Wall &known) {
    return known.fix == wall_of_row.fix && known.mesh == wall_of_row.mesh;
  };
  const auto wall_index = std::find_if(walls_.begin(), walls_.end(), is_it) - walls_.begin();
  add_row({{contact.point, load(atom->x[i])},
           {contact.wall_velocity, load(atom->v[i])},
           {static_cast<double>(wall_index), static_cast<double>(part),
            static_cast<double>(atom->tag[i])},
           contact.force,
           contact.torque,
           contact.normal,
           contact.point,
           contact.history,
           circle_area(contact.radius_i, contact.distance),
           contact.overlap});
}

// Columns in LIGGGHTS's order; `normal` after them.
void ComputeGranLocalSpherocylinder::add_row(const Contact &contact)
{
  if (rows_ == nmax) {
    nmax = std::max(2 * nmax, 1024);
    memory->grow(array, nmax, nvalues, "gran/local:array");
  }
  double *out = array[rows_++];
  if (posflag) out = put(put(out, contact.positions[0]), contact.positions[1]);
  if (velflag) out = put(put(out, contact.velocities[0]), contact.velocities[1]);
  if (idflag) out = std::copy_n(contact.ids, 3, out);
  if (fflag) out = put(out, contact.force);
  if (fnflag) out = put(out, along(contact.force, contact.normal));
  if (ftflag) out = put(out, contact.force - along(contact.force, contact.normal));
  if (torqueflag) out = put(out, contact.torque);
  if (torquenflag) out = put(out, along(contact.torque, contact.normal));
  if (torquetflag) out = put(out, contact.torque - along(contact.torque, contact.normal));
  if (histflag) out = std::copy_n(contact.history, dnum, out);
  if (areaflag) *out++ = contact.area;
  if (deltaflag) *out++ = contact.overlap;
  if (cpflag) out = put(out, contact.point);
  if (msidflag) {
    *out++ = kNoBody;
    *out++ = kNoBody;
  }
  if (normal_) put(out, contact.normal);
}
