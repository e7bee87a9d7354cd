// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace decks {

// What a test holds LIGGGHTS to: a line of the verification table in tests/README.md.
struct Claim {
  std::string name;
  std::string source;  // of the expected value: closed form, stock LIGGGHTS, independent method
  double tolerance;
};

// Fails the test unless 0 <= error <= the claim's tolerance; prints and records the error.
void expect_holds(const Claim &claim, double error);

}  // namespace decks
