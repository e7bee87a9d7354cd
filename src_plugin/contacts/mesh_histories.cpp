// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/mesh_histories.h"

#include <algorithm>

using namespace LAMMPS_NS;
using spherocylinder::load;
using spherocylinder::store;

namespace {

constexpr int kFixedNumbers = 11;  // of a contact, before its models' values

}  // namespace

int MeshHistories::size(int rod) const
{
  return 1 + static_cast<int>(contacts_[rod].size()) * (kFixedNumbers + values_);
}

int MeshHistories::pack(int rod, double *buffer) const
{
  double *out = buffer;
  *out++ = static_cast<double>(contacts_[rod].size());
  for (const Contact &contact : contacts_[rod]) {
    *out++ = contact.mesh;
    *out++ = contact.place;
    *out++ = contact.triangle_id;
    *out++ = contact.part;
    *out++ = contact.along;
    store(contact.normal, out);
    store(contact.place_in_mesh, out + 3);
    out = std::copy(contact.values.begin(), contact.values.end(), out + 6);
  }
  return static_cast<int>(out - buffer);
}

int MeshHistories::unpack(int rod, const double *buffer)
{
  const double *in = buffer;
  Contacts &contacts = contacts_[rod];
  contacts.resize(static_cast<size_t>(*in++));
  for (Contact &contact : contacts) {
    contact.mesh = static_cast<int>(*in++);
    contact.place = static_cast<int>(*in++);
    contact.triangle_id = static_cast<int>(*in++);
    contact.part = static_cast<int>(*in++);
    contact.along = *in++;
    contact.normal = load(in);
    contact.place_in_mesh = load(in + 3);
    in += 6;
    contact.values.assign(in, in + values_);
    in += values_;
  }
  return static_cast<int>(in - buffer);
}

double MeshHistories::memory_usage() const
{
  double bytes = 0.0;
  for (const Contacts &contacts : contacts_)
    bytes += sizeof(Contacts) + contacts.size() * (sizeof(Contact) + values_ * sizeof(double));
  return bytes;
}
