// SPDX-License-Identifier: GPL-2.0-or-later
// Which programs the plug-in lets itself be loaded into.
#include "host/host_version.h"

#include <gtest/gtest.h>

using spherocylinder::is_supported_host;

TEST(HostVersion, AcceptsDebiansLiggghts)
{
  EXPECT_TRUE(is_supported_host(
      "Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32 by buildd, git commit unknown"));
}

TEST(HostVersion, RefusesEverythingElse)
{
  EXPECT_FALSE(is_supported_host(nullptr));
  EXPECT_FALSE(is_supported_host(""));
  EXPECT_FALSE(is_supported_host("Version LIGGGHTS-PUBLIC 3.7.0, compiled 2017"));
  EXPECT_FALSE(is_supported_host("Version LIGGGHTS-PUBLIC 13.8.0, compiled 2030"));
  EXPECT_FALSE(is_supported_host("Version LIGGGHTS-PUBLIC 3.8.01, compiled 2030"));
  EXPECT_FALSE(is_supported_host("Version LIGGGHTS-PUBLIC 3.8.0.1, compiled 2030"));
  EXPECT_FALSE(is_supported_host("LAMMPS (23 Jun 2022 - Update 4)"));
}
