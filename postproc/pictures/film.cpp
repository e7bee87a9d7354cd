// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/film.h"

#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/input_error.h"
#include "io/output_file.h"
#include "pictures/display.h"

namespace spherocylinder {
namespace {

std::string ending_of(const std::string &path) { return std::filesystem::path(path).extension(); }

// Exit code of the program; -1 if it could not be run to its end.
int run_program(std::vector<std::string> words)
{
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace

CLI::Validator film_name()
{
  const auto check = [](const std::string &path) {
    if (ending_of(path) == ".mp4" || ending_of(path) == ".webm") return std::string();
    return fmt::format("must end in .mp4 or .webm (got '{}')", path);
  };
  return CLI::Validator(check, "");
}

void write_film(const std::string &path, const std::string &picture, double rate)
{
  std::filesystem::path pattern(picture);
  pattern.replace_filename(pattern.stem().string() + "_%04d" + pattern.extension().string());
  if (!is_on_path("ffmpeg")) {
    fmt::print(stderr,
               "rod_render: {}: not made, since ffmpeg is not installed; its pictures are {}\n",
               path, pattern.string());
    return;
  }
  OutputFile output(path);
  // yuv420p, which all players know, halves the colours' resolution: the size must be even.
  const std::string codec = ending_of(path) == ".mp4" ? "libx264" : "libvpx-vp9";
  const int code =
      run_program({"ffmpeg", "-y", "-loglevel", "error", "-framerate", fmt::format("{:g}", rate),
                   "-i", pattern.string(), "-c:v", codec, "-crf", "20", "-b:v", "0", "-pix_fmt",
                   "yuv420p", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", output.working_path()});
  if (code != 0)
    throw InputError(fmt::format("{}: ffmpeg ended with exit code {}, wanted 0", path, code));
  output.finish();
}

}  // namespace spherocylinder
