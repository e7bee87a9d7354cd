// SPDX-License-Identifier: GPL-2.0-or-later
// Contact forces as LIGGGHTS's compute pair/gran/local and wall/gran/local wrote them through `dump
// local`, and the chains that the strong ones form.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/dump_reader.h"
#include "io/rods.h"

namespace spherocylinder {

enum class LocalKind { Pairs, Walls };

struct ContactForce {
  std::uint32_t i, j;  // indices into the rods; at a wall i alone is of meaning
  Vec3 force;          // on i (N)
};

// What the compute writes if its command names no keywords.
constexpr const char *kDefaultLocalKeywords = "pos vel id force torque history contactArea";

class LocalForces {
 public:
  // `keywords`: those of the compute's command, parted by blanks; with them the columns
  // c_ID[1], c_ID[2], ... of the file, any of them in any order, are told apart. `option` names
  // them in messages. Throws InputError if one is unknown or `id` or `force` is not among them.
  LocalForces(const std::string &path, LocalKind kind, const std::string &keywords,
              const std::string &option);

  // Reads on to the step of `rods_frame` and gives the forces of its rods, whose indices are those
  // of `rods`. Throws InputError if there is no such step, if columns of id or force are missing,
  // or if an id is none of the rods'.
  std::vector<ContactForce> at_step(const DumpFrame &rods_frame, const std::vector<Rod> &rods);

 private:
  std::vector<std::size_t> columns_of(std::size_t first, std::size_t count, const char *what) const;
  std::uint32_t rod_of(std::size_t row, std::size_t column,
                       const std::unordered_map<std::int64_t, std::uint32_t> &rods,
                       const DumpFrame &rods_frame) const;

  LocalKind kind_;
  std::string option_;
  DumpReader reader_;
  DumpFrame frame_;
  std::size_t id_, force_;  // number of their first columns in the compute, from 1
};

struct ForceChains {
  double threshold;                         // N; a contact is strong if its force is larger
  std::size_t strong = 0;                   // contacts
  std::vector<std::size_t> sizes;           // rods of each chain, falling, each at least 2
  std::vector<std::uint32_t> chain_of_rod;  // number from 1 by falling size, 0 for none
};

// The strong network of Radjai, Wolf, Jean and Moreau, Phys. Rev. Lett. 80 (1998) 61: contacts that
// carry more than the mean, here more than `factor` times the mean of |force| over the pairs. A
// chain is a set of rods that strong contacts join, directly or through others.
ForceChains force_chains(std::size_t rods, const std::vector<ContactForce> &pairs, double factor);

}  // namespace spherocylinder
