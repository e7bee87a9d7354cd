// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "pair_gran.h"

namespace LAMMPS_NS {

// Where a pair's contact history keeps a value, -1 if it does not: the stock models do not all tell.
inline int history_value(PairGran &pair, const std::string &name)
{
  struct Access : PairGran {  // names PairGran's protected list
    static const std::vector<HistoryArg> &values(PairGran &of)
    {
      return of.*(&Access::history_arg);
    }
  };
  const auto &values = Access::values(pair);
  for (size_t k = 0; k < values.size(); k++)
    if (values[k].name == name) return static_cast<int>(k);
  return -1;
}

}  // namespace LAMMPS_NS
