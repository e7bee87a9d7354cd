// SPDX-License-Identifier: GPL-2.0-or-later
// The tables that rod_contacts writes, a row type each. docs/rod_contacts.md says what is in them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/bed_contacts.h"
#include "cli/result_table.h"

namespace spherocylinder {

// With those of fibres if there are any.
Fields<BedContacts> contact_summary_fields(bool with_fibres);

// How many rods have so many contacts.
struct NumberRow {
  std::int64_t step;
  std::size_t contacts, between_rods, with_walls, rods;
};

Fields<NumberRow> number_fields();
std::vector<NumberRow> number_rows(const BedContacts &bed);

struct BinRow {
  std::int64_t step;
  HistogramBin pairs, walls;  // the same bin of both
};

// Side contacts along the rods; the walls' part stays empty.
Fields<BinRow> position_fields();
std::vector<BinRow> position_rows(const BedContacts &bed, const std::vector<Rod> &rods);

// Overlaps or forces, which `what` names, over the mean of their kind.
Fields<BinRow> over_mean_fields(const std::string &what);
std::vector<BinRow> over_mean_rows(std::int64_t step, std::vector<double> pairs,
                                   std::vector<double> walls, std::size_t bins);

// Chains of rods_low to rods_high rods: 2, 3-4, 5-8 ...
struct ChainRow {
  std::int64_t step;
  std::size_t rods_low, rods_high, chains;
};

Fields<ChainRow> chain_fields();
std::vector<ChainRow> chain_rows(const BedContacts &bed);

// A contact between rods, or of a rod at a wall. NaN where there is nothing to say.
struct ContactRow {
  std::int64_t step, id_i;
  double id_j, wall;              // 1 floor, 2 cylinder
  double position_i, position_j;  // signed distance from the centre along the axis (m)
  double gap, sin_gamma;          // m
  double force, chain;            // N; number of the force chain
};

Fields<ContactRow> contact_fields();
std::vector<ContactRow> contact_rows(const BedContacts &bed, const std::vector<Rod> &rods);

}  // namespace spherocylinder
