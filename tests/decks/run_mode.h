// SPDX-License-Identifier: GPL-2.0-or-later
// Physics that must come out the same on one rank, on two, and across a restart.
#pragma once

#include <gtest/gtest.h>

#include "scene.h"

namespace decks {

class RunMode : public testing::TestWithParam<Mode> {};

inline std::string mode_name(const testing::TestParamInfo<Mode> &info)
{
  return name_of(info.param);
}

}  // namespace decks

#define DECKS_IN_ALL_MODES(Fixture)                                                         \
  INSTANTIATE_TEST_SUITE_P(                                                                 \
      , Fixture,                                                                            \
      testing::Values(decks::Mode::OneRank, decks::Mode::TwoRanks, decks::Mode::Restarted), \
      decks::mode_name)
