// SPDX-License-Identifier: GPL-2.0-or-later
#include "styles/fix_fibres_spherocylinder.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "core/rotation.h"
#include "domain.h"
#include "host/buffer_values.h"
#include "host/rod_error.h"
#include "memory.h"
#include "modify.h"
#include "rods/atom_vec_spherocylinder.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

using S = FibreSegments;

// A line of the section Fibres: as typed, and as written.
constexpr int kTypedValues = 3, kWrittenValues = 11;

}  // namespace

FixFibresSpherocylinder::FixFibresSpherocylinder(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg),
      rods_(rods_of(lmp, "Fix fibres/spherocylinder")),
      segments_(rods_.attached<FibreSegments>())
{
  restart_peratom = 1;
  comm_border = S::kColumns;
  wd_header = wd_section = 1;
  peratom_flag = 1;
  size_peratom_cols = S::kColumns;
  peratom_freq = 1;
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nmax; i++) segments_.clear(i);
  for (const int kind : {0, 1, 2}) atom->add_callback(kind);  // memory, restart, borders
}

// With `clear` the rods go first.
FixFibresSpherocylinder::~FixFibresSpherocylinder()
{
  for (const int kind : {0, 1, 2}) atom->delete_callback(id, kind);
  memory->destroy(array_atom);
  if (dynamic_cast<AtomVecSpherocylinder *>(atom->avec)) segments_.rows = nullptr;
}

int FixFibresSpherocylinder::setmask() { return 0; }

void FixFibresSpherocylinder::init()
{
  bigint mine = 0;
  for (int i = 0; i < atom->nlocal; i++) mine += segments_.is_segment(i);
  MPI_Allreduce(&mine, &segments_all_, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (segments_all_ > 0 && modify->n_fixes_style_strict("joint/spherocylinder") == 0)
    rod_error_all(lmp,
                  "Atom style spherocylinder: " BIGINT_FORMAT
                  " rods are segments of fibres, but no "
                  "fix holds them together (expected fix ID all joint/spherocylinder)",
                  segments_all_);
}

/* ----------------------------------------------------------------------
   rows that travel with their rods
------------------------------------------------------------------------- */

void FixFibresSpherocylinder::share_ends(int i)
{
  if (segments_.shared_ends(i) == 0) return;
  const double *shape = atom->shape[i];
  rods_.set_rod(i, 2.0 * shape[0], 2.0 * shape[2], atom->density[i], segments_.shared_ends(i));
}

// The atom style clears the row of a new rod: LIGGGHTS would do so with all rods when a run begins.
void FixFibresSpherocylinder::grow_arrays(int nmax)
{
  memory->grow(array_atom, nmax, static_cast<int>(S::kColumns), "fibres:segments");
  segments_.rows = array_atom;
  for (int i = atom->nlocal + atom->nghost; i < nmax; i++) segments_.clear(i);
}

void FixFibresSpherocylinder::copy_arrays(int from, int to, int)
{
  std::copy_n(array_atom[from], static_cast<int>(S::kColumns), array_atom[to]);
}

int FixFibresSpherocylinder::pack_exchange(int i, double *buffer)
{
  std::copy_n(array_atom[i], static_cast<int>(S::kColumns), buffer);
  return S::kColumns;
}

int FixFibresSpherocylinder::unpack_exchange(int i, double *buffer)
{
  std::copy_n(buffer, static_cast<int>(S::kColumns), array_atom[i]);
  share_ends(i);
  return S::kColumns;
}

int FixFibresSpherocylinder::pack_border(int n, int *list, double *buffer)
{
  int m = 0;
  for (int k = 0; k < n; k++) m += pack_exchange(list[k], &buffer[m]);
  return m;
}

int FixFibresSpherocylinder::unpack_border(int n, int first, double *buffer)
{
  int m = 0;
  for (int i = first; i < first + n; i++) m += unpack_exchange(i, &buffer[m]);
  return m;
}

int FixFibresSpherocylinder::pack_restart(int i, double *buffer)
{
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

// LIGGGHTS has left each fix's values one after the other, its number of values first.
void FixFibresSpherocylinder::unpack_restart(int i, int nth)
{
  double *values = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; k++) m += static_cast<int>(values[m]);
  unpack_exchange(i, &values[m + 1]);
}

int FixFibresSpherocylinder::size_restart(int) { return maxsize_restart(); }

int FixFibresSpherocylinder::maxsize_restart() { return S::kColumns + 1; }

double FixFibresSpherocylinder::memory_usage()
{
  return sizeof(double) * static_cast<double>(S::kColumns) * atom->nmax;
}

/* ----------------------------------------------------------------------
   data files
     id fibre place                                            as typed
     id fibre place ends q1 q2 q3 q4 bend_x bend_y twist       as written
------------------------------------------------------------------------- */

void FixFibresSpherocylinder::read_data_header(char *line) { lines_ = atol(line); }

bigint FixFibresSpherocylinder::read_data_skip_lines(char *) { return lines_; }

// Numbers as ReadDataSpherocylinder has checked them.
void FixFibresSpherocylinder::read_data_section(char *, int n, char *lines)
{
  std::unordered_map<int, int> rods;
  for (int i = 0; i < atom->nlocal; i++) rods[atom->tag[i]] = i;
  for (int k = 0; k < n; k++) {
    char *next = strchr(lines, '\n');
    if (next) *next = '\0';
    if (char *comment = strchr(lines, '#')) *comment = '\0';
    std::vector<double> values;
    char *end = nullptr;
    for (double value = strtod(lines, &end); end != lines; value = strtod(lines, &end)) {
      values.push_back(value);
      lines = end;
    }
    const auto found = rods.find(static_cast<int>(values.at(0)));
    if (found != rods.end()) {
      const int i = found->second;
      const bool is_typed = values.size() == kTypedValues;
      std::copy_n(values.begin() + 1, 2, array_atom[i]);
      array_atom[i][S::kEnds] = is_typed ? -1.0 : values[3];
      if (!is_typed) {
        set_frame(i, sc::normalized(sc::load_quaternion(&values[4])));
        std::copy_n(values.begin() + 8, 3, array_atom[i] + S::kBendX);
        share_ends(i);
      }
    }
    if (next) lines = next + 1;
  }
}

// The frame says more than the axis, and the same of it.
void FixFibresSpherocylinder::set_frame(int i, const sc::Quaternion &frame)
{
  constexpr double kSameAxis = 1e-5;
  const sc::Vec3 axis = sc::axis_of(sc::load_quaternion(atom->quaternion[i]));
  const double off = sc::norm(sc::axis_of(frame) - axis);
  if (!(off <= kSameAxis))
    rod_error_one(
        lmp,
        "Command read_data: q1 q2 q3 q4 of rod %d in the section Fibres must have the axis "
        "of its line in the section Atoms within %g (got %g)",
        atom->tag[i], kSameAxis, off);
  sc::store(frame, atom->quaternion[i]);
}

void FixFibresSpherocylinder::write_data_header(FILE *file, int)
{
  fprintf(file, BIGINT_FORMAT " %s\n", segments_all_, kHeader);
}

void FixFibresSpherocylinder::write_data_section_size(int, int &rows, int &columns)
{
  rows = 0;
  for (int i = 0; i < atom->nlocal; i++) rows += segments_.is_segment(i);
  columns = kWrittenValues;
}

void FixFibresSpherocylinder::write_data_section_pack(int, double **rows)
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!segments_.is_segment(i)) continue;
    double *row = *rows++;
    row[0] = as_sent(atom->tag[i]);
    row[1] = as_sent(segments_.fibre(i));
    row[2] = as_sent(segments_.place(i));
    row[3] = as_sent(segments_.ends(i));
    std::copy_n(atom->quaternion[i], 4, row + 4);
    std::copy_n(array_atom[i] + S::kBendX, 3, row + 8);
  }
}

void FixFibresSpherocylinder::write_data_section_keyword(int, FILE *file)
{
  fprintf(file, "\n%s\n\n", kSection);
}

void FixFibresSpherocylinder::write_data_section(int, FILE *file, int n, double **rows, int)
{
  for (int k = 0; k < n; k++) {
    const double *row = rows[k];
    fprintf(file, "%d %d %d %d", whole_number(row[0]), whole_number(row[1]), whole_number(row[2]),
            whole_number(row[3]));
    for (int value = 4; value < kWrittenValues; value++) fprintf(file, " %-1.16e", row[value]);
    fprintf(file, "\n");
  }
}

/* ---------------------------------------------------------------------- */

FixFibresSpherocylinder *LAMMPS_NS::find_fibres(LAMMPS *lmp)
{
  return dynamic_cast<FixFibresSpherocylinder *>(
      lmp->modify->find_fix_id(FixFibresSpherocylinder::kId));
}

// LIGGGHTS takes no fix before there is a box, but for some; this one knows nothing of it.
FixFibresSpherocylinder &LAMMPS_NS::fibres_of(LAMMPS *lmp)
{
  if (FixFibresSpherocylinder *fibres = find_fibres(lmp)) return *fibres;
  std::string words[] = {FixFibresSpherocylinder::kId, "all", FixFibresSpherocylinder::kStyle};
  char *arg[] = {words[0].data(), words[1].data(), words[2].data()};
  const int box_exist = lmp->domain->box_exist;
  lmp->domain->box_exist = 1;
  lmp->modify->add_fix(3, arg);
  lmp->domain->box_exist = box_exist;
  return *find_fibres(lmp);
}
