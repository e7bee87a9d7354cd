// SPDX-License-Identifier: GPL-2.0-or-later
#include "claim.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace decks {

void expect_holds(const Claim &claim, double error)
{
  // verification_table.sh looks for these lines.
  fmt::print("[ MEASURED ] {} | {} | {:.0e} | {:.1e}\n", claim.name, claim.source, claim.tolerance,
             error);
  testing::Test::RecordProperty(claim.name, fmt::format("{:.3e}", error));
  EXPECT_GE(error, 0.0) << claim.name;  // false for nan
  EXPECT_LE(error, claim.tolerance) << claim.name << " (" << claim.source << ")";
}

}  // namespace decks
