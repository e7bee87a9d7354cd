// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstring>

namespace spherocylinder {

// The only LIGGGHTS whose class layouts this plug-in was compiled for.
constexpr const char *kHostVersion = "3.8.0";

// `version` as LIGGGHTS prints it, such as "Version LIGGGHTS-PUBLIC 3.8.0, compiled ...".
inline bool is_supported_host(const char *version)
{
  if (!version) return false;
  const char *found = strstr(version, kHostVersion);
  if (!found) return false;
  // Neither 13.8.0 nor 3.8.01.
  const char before = found == version ? ' ' : found[-1], after = found[strlen(kHostVersion)];
  return !(before >= '0' && before <= '9') && before != '.' && !(after >= '0' && after <= '9') &&
         after != '.';
}

}  // namespace spherocylinder
