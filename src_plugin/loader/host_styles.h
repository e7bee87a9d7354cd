// SPDX-License-Identifier: GPL-2.0-or-later
// What of LIGGGHTS works with rods. One row for each style, command and keyword that can touch a rod;
// docs/with_liggghts.md is printed from the same rows (host_styles_page.cpp).
#pragma once

#include <vector>

namespace spherocylinder {

enum class HostKind {
  Fix,
  Compute,
  Command,  // of Input's map
  BuiltIn,  // commands that Input executes itself
  Pair,
  AtomStyle,
  Units,
  Box,
  Dump,
  Region,
  Reader,
  Insertion,  // keywords of the fixes insert/...
  WallPrimitive,
  Surface,
  Normal,
  Tangential,
  Cohesion,
  Rolling,
  MeshModule,
  MeshMover,
  Integrate,
  Minimize,
  Molecular,  // bond, angle, dihedral, improper and kspace styles
  CfdCoupling
};

enum class Verdict {
  Right,      // what it does with a rod is what its manual page says of a particle
  Different,  // works, but not as with spheres; the sentence says how
  Refused     // ends with an error; the sentence says why and what to use instead
};

struct HostStyle {
  HostKind kind;
  const char *name;
  Verdict verdict;
  // Refused: "what it cannot do with rods; what to use instead", as the error prints it. Otherwise
  // what differs or is worth knowing, or empty.
  const char *sentence;
  // Of a fix or compute: looks at rods of other ranks by itself, not by the pair style's list.
  bool reads_ghosts = false;
};

// All rows, kind by kind in the order above.
const std::vector<HostStyle> &host_styles();

// The row of that kind and name, null if there is none.
const HostStyle *find_host_style(HostKind kind, const char *name);

// How a deck's writer calls one of that kind: "Fix", "Dump style".
const char *word_for(HostKind kind);

}  // namespace spherocylinder
