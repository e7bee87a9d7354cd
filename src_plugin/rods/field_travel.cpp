// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/field_travel.h"

#include "host/buffer_values.h"
#include "rods/field_arrays.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

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

bool is_zero(const sc::Vec3 &v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }

}  // namespace

int LAMMPS_NS::pack_rod_fields(Atom &atom, unsigned travel, int n, const int *list,
                               const GhostGain &gain, double *buf)
{
  const bool gains_period = !is_zero(gain.period), gains_box_speed = gain.box_speed_groups != 0;
  double *out = buf;
  for_each_field(atom, travel, [&](auto *rows, const RodField &field) {
    double *const sent = out;
    out = gather(rows, field, list, n, sent);
    if (gains_period && (field.travel & kGainsPeriod))
      for (int k = 0; k < n; k++) sc::add_to(&sent[3 * k], gain.period);
    if (gains_box_speed && (field.travel & kGainsBoxSpeed))
      for (int k = 0; k < n; k++)
        if (atom.mask[list[k]] & gain.box_speed_groups) sc::add_to(&sent[3 * k], gain.box_speed);
  });
  return static_cast<int>(out - buf);
}

const double *LAMMPS_NS::unpack_rod_fields(Atom &atom, unsigned travel, int n, int first,
                                           const double *buf)
{
  const double *in = buf;
  for_each_field(atom, travel, [&](auto *rows, const RodField &field) {
    in = scatter(in, field, first, n, rows);
  });
  return in;
}

int LAMMPS_NS::pack_sums(Atom &atom, int n, int first, double *buf)
{
  double *out = buf;
  for_each_field(atom, kReverse, [&](auto *rows, const RodField &field) {
    for (int k = field.width * first; k < field.width * (first + n); k++) *out++ = rows[k];
  });
  return static_cast<int>(out - buf);
}

void LAMMPS_NS::add_sums(Atom &atom, int n, const int *list, const double *buf)
{
  const double *in = buf;
  for_each_field(atom, kReverse, [&](auto *rows, const RodField &field) {
    for (int k = 0; k < n; k++)
      for (int d = 0; d < field.width; d++) rows[field.width * list[k] + d] += *in++;
  });
}
