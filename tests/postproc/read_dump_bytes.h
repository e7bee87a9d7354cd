// SPDX-License-Identifier: GPL-2.0-or-later
// What the readers promise of any bytes whatever. Used by the fuzz target and by the unit test that
// replays its corpus.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/dump_reader.h"
#include "io/glued_rods.h"
#include "io/input_error.h"
#include "io/rods.h"
#include "measures/close_pairs.h"
#include "measures/contact_forces.h"
#include "solid/capsule_measures.h"

namespace spherocylinder {

inline void promise(bool kept, const char *what)
{
  if (kept) return;
  std::fprintf(stderr, "broken promise of a reader: %s\n", what);
  std::abort();
}

// Runs `read` on the file. Returns the sentence of its error, or nothing for a good file. Ends the
// program unless that is one printable sentence which names the file, and no other exception comes.
template <class Read>
std::string sentence_of(const std::string &path, Read read)
{
  try {
    read();
  } catch (const InputError &error) {
    const std::string sentence = error.what();
    promise(sentence.find(path) == 0, "the error names the file first");
    for (const char c : sentence) promise(c >= ' ' && c <= '~', "a printable sentence");
    promise(sentence.size() < path.size() + 300, "a sentence, not a flood");
    return sentence;
  }
  return "";
}

inline void need_sound(const Rod &rod)
{
  const Segment &segment = rod.capsule.segment;
  promise(rod.id >= 1 && rod.type >= 1, "id and type from 1");
  promise(rod.capsule.radius > 0.0 && segment.half_length >= 0.0, "real sizes");
  promise(std::isfinite(volume(rod.capsule)), "a finite volume");
  promise(std::isfinite(norm(segment.centre)), "a finite place");
  promise(std::abs(norm(segment.axis) - 1.0) < 1e-12, "unit axes");
}

// All frames of a dump of rods: finite numbers, sound rods, near pairs that can be looked for.
inline std::string read_dump_bytes(const std::string &path)
{
  return sentence_of(path, [&] {
    DumpReader reader(path);
    DumpFrame frame;
    while (reader.next(frame)) {
      promise(frame.values.size() == frame.rows * frame.columns.size(), "as many values as told");
      for (const double value : frame.values) promise(std::isfinite(value), "finite values");
      const std::vector<Rod> rods = rods_of(frame);
      for (const Rod &rod : rods) need_sound(rod);
      for (const double rounding : place_roundings(frame, rods))
        promise(rounding >= 0.0 && std::isfinite(rounding), "a rounding");
      double length = 0.0;
      for (const Rod &rod : rods) length += rod.capsule.aspect_ratio();
      if (length > 1e4) continue;  // takes too long here
      for (const ClosePair &pair : close_pairs(rods, periodicity_of(frame), 1e-3))
        promise(pair.i < pair.j && pair.j < rods.size() && pair.gap < 1e-3, "pairs of rods");
    }
  });
}

// The same of a dump of glued spheres.
inline std::string read_sphere_bytes(const std::string &path)
{
  return sentence_of(path, [&] {
    DumpReader reader(path);
    DumpFrame frame;
    while (reader.next(frame)) {
      for (const GluedRod &glued : glued_rods(frame, {})) {
        need_sound(glued.rod);
        promise(glued.spheres >= 2 && glued.deviation <= GluedRodOptions{}.tolerance, "a rod");
        promise(glued.least_spacing <= glued.largest_spacing, "spacings");
      }
    }
  });
}

// The same of a dump of contact forces beside a dump of the rods 1 to 3 at step 0.
inline std::string read_local_bytes(const std::string &path, LocalKind kind)
{
  return sentence_of(path, [&] {
    DumpFrame rods_frame;
    rods_frame.path = "rods.dump";
    std::vector<Rod> rods;
    for (std::int64_t id = 1; id <= 3; id++)
      rods.push_back({id, 1, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.1}, 0.01}});
    LocalForces forces(path, kind, "id force", "--local-keywords");
    for (const ContactForce &contact : forces.at_step(rods_frame, rods))
      promise(contact.i < 3 && contact.j < 3 && std::isfinite(norm(contact.force)), "a force");
  });
}

// All that a file may be taken for.
inline void read_bytes(const std::string &path)
{
  read_dump_bytes(path);
  read_sphere_bytes(path);
  read_local_bytes(path, LocalKind::Pairs);
  read_local_bytes(path, LocalKind::Walls);
}

}  // namespace spherocylinder
