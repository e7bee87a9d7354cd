// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_styles_page.h"

#include "loader/host_styles.h"

namespace spherocylinder {

namespace {

constexpr const char *kHead = R"(# What of LIGGGHTS works with rods

Every fix, compute, command and model of LIGGGHTS 3.8, and what it does with `atom_style
spherocylinder`.

- **right**: what its manual page says of a particle holds for a rod.
- **different**: it works, and the remark says how it differs from what one knows of spheres.
- **refused**: the program ends with one sentence and an exit code other than 0 where the command is
  read, or at the latest when a run starts.

A simulation with another atom style is not touched by any of this. What this plug-in adds itself is
not listed here but in the [manual](README.md).
)";

constexpr const char *kFoot = R"(
---

This page is printed from the table that the program itself looks into
(`src_plugin/loader/host_style_*.cpp`); a test compares them. To print it anew:

```
cmake --build --preset release --target host_styles_page
build/release/host_styles_page > docs/with_liggghts.md
```
)";

struct Section {
  HostKind kind;
  const char *title;
};

constexpr Section kSections[] = {
    {HostKind::Fix, "Fixes"},
    {HostKind::Compute, "Computes"},
    {HostKind::Command, "Commands"},
    {HostKind::BuiltIn, "Built-in commands"},
    {HostKind::Pair, "Pair styles"},
    {HostKind::AtomStyle, "Atom styles"},
    {HostKind::Units, "Units"},
    {HostKind::Box, "Boxes"},
    {HostKind::Dump, "Dumps"},
    {HostKind::Region, "Regions"},
    {HostKind::Reader, "Formats of read_dump"},
    {HostKind::Insertion, "Keywords of the fixes insert/..."},
    {HostKind::WallPrimitive, "Wall primitives"},
    {HostKind::Surface, "Surface models"},
    {HostKind::Normal, "Normal models"},
    {HostKind::Tangential, "Tangential models"},
    {HostKind::Cohesion, "Cohesion models"},
    {HostKind::Rolling, "Rolling friction models"},
    {HostKind::MeshModule, "Mesh modules"},
    {HostKind::MeshMover, "Mesh movers"},
    {HostKind::Integrate, "Run styles"},
    {HostKind::Minimize, "Minimisers"},
    {HostKind::Molecular, "Molecular styles"},
    {HostKind::CfdCoupling, "CFD data couplings"},
};

const char *word_for(Verdict verdict)
{
  switch (verdict) {
    case Verdict::Right: return "right";
    case Verdict::Different: return "different";
    case Verdict::Refused: return "**refused**";
  }
  return "";
}

std::string section_text(const Section &section)
{
  std::string text = std::string("\n## ") + section.title + "\n\n| name | with rods | remark |\n" +
                     "|---|---|---|\n";
  for (const HostStyle &row : host_styles())
    if (row.kind == section.kind)
      text += std::string("| `") + row.name + "` | " + word_for(row.verdict) + " | " +
              row.sentence + " |\n";
  return text;
}

}  // namespace

std::string host_styles_page()
{
  std::string page = kHead;
  for (const Section &section : kSections) page += section_text(section);
  return page + kFoot;
}

}  // namespace spherocylinder
