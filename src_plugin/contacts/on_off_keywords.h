// SPDX-License-Identifier: GPL-2.0-or-later
// Keywords of a deck that are on or off, as tables: what they are called, what they set, what they are
// without being given.
#pragma once

#include <cstring>

#include "settings.h"

namespace LAMMPS_NS {

template <typename Keywords>
struct OnOffKeyword {
  const char *name;
  bool Keywords::*value;
  bool by_default;
};

// Hands them to LIGGGHTS's reader.
template <typename Keywords>
void register_on_off(Settings &settings, Keywords &keywords)
{
  for (const OnOffKeyword<Keywords> &keyword : Keywords::kOnOff)
    settings.registerOnOff(keyword.name, keywords.*keyword.value, keyword.by_default);
}

template <typename Keywords>
bool is_on_off(const char *word)
{
  for (const OnOffKeyword<Keywords> &keyword : Keywords::kOnOff)
    if (strcmp(word, keyword.name) == 0) return true;
  return false;
}

}  // namespace LAMMPS_NS
