// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_styles.h"

#include <cstring>

#include "loader/host_style_rows.h"

namespace spherocylinder {

const std::vector<HostStyle> &host_styles()
{
  static const std::vector<HostStyle> all = [] {
    std::vector<HostStyle> rows;
    for (const auto &part : {fix_rows(), compute_rows(), command_rows(), other_rows()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

const HostStyle *find_host_style(HostKind kind, const char *name)
{
  for (const HostStyle &row : host_styles())
    if (row.kind == kind && strcmp(row.name, name) == 0) return &row;
  return nullptr;
}

const char *word_for(HostKind kind)
{
  switch (kind) {
    case HostKind::Fix: return "Fix";
    case HostKind::Compute: return "Compute";
    case HostKind::Command:
    case HostKind::BuiltIn: return "Command";
    case HostKind::Pair: return "Pair style";
    case HostKind::AtomStyle: return "Atom style";
    case HostKind::Units: return "Units";
    case HostKind::Box: return "Box";
    case HostKind::Dump: return "Dump style";
    case HostKind::Region: return "Region style";
    case HostKind::Reader: return "Dump format of read_dump";
    case HostKind::Insertion: return "Keyword of fix insert/...";
    case HostKind::WallPrimitive: return "Wall primitive";
    case HostKind::Surface: return "Surface model";
    case HostKind::Normal: return "Normal model";
    case HostKind::Tangential: return "Tangential model";
    case HostKind::Cohesion: return "Cohesion model";
    case HostKind::Rolling: return "Rolling friction model";
    case HostKind::MeshModule: return "Mesh module";
    case HostKind::MeshMover: return "Mesh mover";
    case HostKind::Integrate: return "Run style";
    case HostKind::Minimize: return "Min style";
    case HostKind::Molecular: return "Molecular style";
    case HostKind::CfdCoupling: return "CFD data coupling";
  }
  return "";
}

}  // namespace spherocylinder
