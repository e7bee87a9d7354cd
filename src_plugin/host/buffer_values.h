// SPDX-License-Identifier: GPL-2.0-or-later
// Values in LIGGGHTS's buffers of doubles: a whole number travels as its bits (AtomVec::ubuf).
#pragma once

#include <cstdint>
#include <cstring>

namespace LAMMPS_NS {

inline double as_sent(double value) { return value; }
inline double as_sent(int value)
{
  const int64_t bits = value;
  double sent;
  memcpy(&sent, &bits, sizeof(sent));
  return sent;
}

inline void receive(double sent, double &value) { value = sent; }
inline void receive(double sent, int &value)
{
  int64_t bits;
  memcpy(&bits, &sent, sizeof(bits));
  value = static_cast<int>(bits);
}

inline int whole_number(double sent)
{
  int value;
  receive(sent, value);
  return value;
}

}  // namespace LAMMPS_NS
