// SPDX-License-Identifier: GPL-2.0-or-later
#include "pictures/display.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <X11/Xlib.h>
#include <unistd.h>

#include "core/parallel.h"
#include "io/input_error.h"

namespace spherocylinder {
namespace {

constexpr const char *kRestarted = "SPHEROCYLINDER_RESTARTED_UNDER_XVFB";

bool display_answers()
{
  Display *display = XOpenDisplay(nullptr);
  if (display != nullptr) XCloseDisplay(display);
  return display != nullptr;
}

}  // namespace

bool is_on_path(const std::string &program)
{
  const char *path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

void need_display(char **argv)
{
  // Without a graphics card Mesa draws, by threads of its own: no more of them than ours.
  setenv("LP_NUM_THREADS", std::to_string(thread_count()).c_str(), 0);
  if (display_answers()) return;
  for (const char *program : {"xvfb-run", "Xvfb", "xauth"})
    if (!is_on_path(program))
      throw InputError(std::string("no X display can be reached and the program ") + program +
                       " is not installed, wanted either (Debian packages xvfb and xauth)");
  if (std::getenv(kRestarted) != nullptr)
    throw InputError("no X display can be reached, not even under xvfb-run");
  setenv(kRestarted, "1", 1);

  // -noreset: without it Xvfb starts afresh whenever its last window closes, and a second window
  // may find it gone.
  const std::string server = "-screen 0 1280x1024x24 -noreset";
  // The file itself, since argv[0] need not lead to it.
  std::string self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<char *> arguments;
  std::string words[] = {"xvfb-run", "-a", "-s", server, self};
  for (std::string &word : words) arguments.push_back(word.data());
  for (char **argument = argv + 1; *argument != nullptr; argument++) arguments.push_back(*argument);
  arguments.push_back(nullptr);
  execvp("xvfb-run", arguments.data());
  throw InputError("no X display can be reached and xvfb-run could not be started");
}

}  // namespace spherocylinder
