// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/command_line.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <fmt/format.h>

#include "core/parallel.h"
#include "io/input_error.h"
#include "io/text.h"

namespace spherocylinder {
namespace {

template <class Accepts>
CLI::Validator number_that(Accepts accepts, const std::string &wanted)
{
  const auto check = [accepts, wanted](const std::string &word) {
    const auto number = to_number<double>(word);
    if (number && std::isfinite(*number) && accepts(*number)) return std::string();
    return fmt::format("must be {} (got {})", wanted, shown(word));
  };
  return CLI::Validator(check, "");
}

// A number of threads that cannot be meant is not taken for another.
void check_threads()
{
  const char *wanted = std::getenv("OMP_NUM_THREADS");
  if (wanted && *wanted && !threads_in(wanted))
    throw InputError(fmt::format("OMP_NUM_THREADS must be a whole number from 1 to {} (got {})",
                                 kMostThreads, shown(wanted)));
}

int fail(const CLI::App &app, std::string sentence)
{
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  fmt::print(stderr, "{}: {}\n", app.get_name(), trimmed_end(sentence));
  return kExitBadInput;
}

}  // namespace

void add_input_options(CLI::App &app, InputOptions &options)
{
  app.add_option("DUMP", options.dump, "LIGGGHTS 'dump custom' text file")->required();
  app.add_option("--frame", options.frame, "frame to work on: first, last, all or a time step")
      ->capture_default_str();
}

void add_fibre_options(CLI::App &app, FibreOptions &options)
{
  app.add_option(
         "--fibre-columns", options.columns,
         "FIBRE PLACE: columns of the dump that tell a rod's fibre and its place in the chain, "
         "default f_fibres[1] f_fibres[2] if they are there")
      ->expected(2);
  app.add_option("--meet", options.meet,
                 "diameters that the ends of segments may be apart where they are joined")
      ->check(number_between(0.0, 0.5))
      ->capture_default_str();
}

CLI::Validator finite_number()
{
  return number_that([](double) { return true; }, "a finite number");
}

CLI::Validator positive_number()
{
  return number_that([](double number) { return number > 0.0; }, "a number > 0");
}

CLI::Validator number_between(double low, double high)
{
  return number_that([=](double number) { return number >= low && number <= high; },
                     fmt::format("a number from {} to {}", low, high));
}

int run_tool(CLI::App &app, int argc, char **argv, const std::function<void()> &work)
{
  std::signal(SIGXFSZ, SIG_IGN);  // past the shell's limit: a file that is cut, as on a full disk
  try {
    app.parse(argc, argv);
    check_threads();
    work();
    if (std::fflush(stdout) != 0) throw InputError("standard output: could not be written");
  } catch (const CLI::CallForHelp &) {
    fmt::print("{}", app.help());
  } catch (const CLI::ParseError &error) {
    return fail(app, error.what());
  } catch (const InputError &error) {
    return fail(app, error.what());
  } catch (const std::bad_alloc &) {
    return fail(app, "stopped: there is not enough memory");
  } catch (const std::exception &error) {
    return fail(app, fmt::format("stopped: {}", error.what()));
  }
  return 0;
}

}  // namespace spherocylinder
