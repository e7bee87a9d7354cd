// SPDX-License-Identifier: GPL-2.0-or-later
// What the command lines of all tools have in common.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "io/fibres.h"

namespace spherocylinder {

constexpr int kExitBadInput = 2;

struct InputOptions {
  std::string dump;
  std::string frame = "last";
};

// Adds DUMP and --frame.
void add_input_options(CLI::App &app, InputOptions &options);

// Adds --fibre-columns and --meet.
void add_fibre_options(CLI::App &app, FibreOptions &options);

// Checks for numbers, to be used with CLI::Option::check.
CLI::Validator finite_number();
CLI::Validator positive_number();
CLI::Validator number_between(double low, double high);

// Parses the command line and runs `work`. Prints a single sentence headed by the tool's name on
// stderr and returns 2 if the options or the input cannot be used; 0 otherwise, also for --help.
int run_tool(CLI::App &app, int argc, char **argv, const std::function<void()> &work);

}  // namespace spherocylinder
