// SPDX-License-Identifier: GPL-2.0-or-later
#include "rods/field_travel.h"

#include <cstring>
#include <type_traits>

#include "domain.h"
#include "host/buffer_values.h"
#include "rods/field_arrays.h"

using namespace LAMMPS_NS;
namespace sc = spherocylinder;

namespace {

// `gain`: of three values, added to each.
template <int SENT, int WIDTH, bool GAINS, typename T>
double *gather(const T *__restrict__ rows, const int *list, int n, const double *gain,
               double *__restrict__ out)
{
  for (int k = 0; k < n; k++) {
    const T *row = rows + static_cast<size_t>(WIDTH) * list[k];
    for (int d = 0; d < SENT; d++) out[d] = as_sent(row[d]);
    if (GAINS)
      for (int d = 0; d < SENT; d++) out[d] += gain[d];
    out += SENT;
  }
  return out;
}

template <typename T>
double *gather(const T *rows, const RodField &field, const int *list, int n, double *out)
{
  if (field.sent != field.width) return gather<1, 3, false>(rows, list, n, nullptr, out);  // shape
  switch (field.sent) {
    case 1: return gather<1, 1, false>(rows, list, n, nullptr, out);
    case 3: return gather<3, 3, false>(rows, list, n, nullptr, out);
    default: return gather<4, 4, false>(rows, list, n, nullptr, out);
  }
}

template <typename T>
const double *scatter(const double *in, const RodField &field, int first, int n, T *rows)
{
  T *row = rows + static_cast<size_t>(field.width) * first;
  if (std::is_same_v<T, double> && field.sent == field.width) {
    memcpy(row, in, sizeof(double) * field.width * n);
    return in + static_cast<size_t>(field.width) * n;
  }
  for (int k = 0; k < n; k++, row += field.width)
    for (int d = 0; d < field.sent; d++) receive(*in++, row[d]);
  return in;
}

template <typename T>
const double *scatter(const double *in, const RodField &field, const std::vector<int> &rods,
                      T *rows)
{
  for (const int i : rods) {
    T *row = rows + static_cast<size_t>(field.width) * i;
    for (int d = 0; d < field.sent; d++) receive(*in++, row[d]);
  }
  return in;
}

bool is_zero(const sc::Vec3 &v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; }

}  // namespace

sc::Vec3 LAMMPS_NS::period_across(const Domain &domain, const int *pbc)
{
  if (!pbc) return sc::kZero;
  return {pbc[0] * domain.xprd + pbc[5] * domain.xy + pbc[4] * domain.xz,
          pbc[1] * domain.yprd + pbc[3] * domain.yz, pbc[2] * domain.zprd};
}

int LAMMPS_NS::pack_rod_fields(Atom &atom, unsigned travel, int n, const int *list,
                               const GhostGain &gain, double *buf)
{
  const bool gains_period = !is_zero(gain.period), gains_box_speed = gain.box_speed_groups != 0;
  double period[3];
  sc::store(gain.period, period);
  double *out = buf;
  for_each_field(atom, travel, [&](auto *rows, const RodField &field) {
    double *const sent = out;
    if (gains_period && (field.travel & kGainsPeriod))
      out = gather<3, 3, true>(rows, list, n, period, sent);
    else
      out = gather(rows, field, list, n, sent);
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

const double *LAMMPS_NS::unpack_rod_fields(Atom &atom, unsigned travel,
                                           const std::vector<int> &rods, const double *buf)
{
  const double *in = buf;
  for_each_field(atom, travel,
                 [&](auto *rows, const RodField &field) { in = scatter(in, field, rods, rows); });
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
