// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/written_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace spherocylinder {

namespace {

struct OpenFile {
  FILE *stream;
  std::string name;
  bool told;
};

struct CutFile {
  std::string name, reason;
};

struct Files {
  std::mutex mutex;
  std::vector<OpenFile> open;
  std::vector<CutFile> cut;
  bool screen_told = false;
};

// Never destroyed: files are closed until the very end.
Files &files()
{
  static Files &all = *new Files;
  return all;
}

// A failed write leaves its mark on the stream, not its reason.
std::string likely_reason(const std::string &name)
{
  struct statvfs disk;
  if (statvfs(name.c_str(), &disk) == 0 && disk.f_bavail == 0) return strerror(ENOSPC);
  return "a write to it failed";
}

std::string sentence(const CutFile &file)
{
  return "File " + file.name + " is cut short: " + file.reason +
         " (wanted a disk that takes all of it)";
}

// All is written, and is there.
std::string fault_of(FILE *stream, const std::string &name)
{
  const bool failed_before = ferror(stream);
  if (fflush(stream) != 0) return strerror(errno);
  if (failed_before) return likely_reason(name);
  struct stat file;
  const off_t end = ftello(stream);
  if (fstat(fileno(stream), &file) == 0 && S_ISREG(file.st_mode) && file.st_size < end)
    return "it is " + std::to_string(file.st_size) + " bytes long, " + std::to_string(end) +
           " were written";
  return {};
}

void end_by_cut_file()
{
  for (const OpenFile &file : files().open) fflush(file.stream);
  fflush(stdout);
  const std::string told = next_cut_file();
  if (told.empty()) return;
  fprintf(stderr, "ERROR: %s\n", told.c_str());
  fflush(nullptr);
  _exit(1);
}

}  // namespace

void watch_file(FILE *stream, const char *name, const char *mode)
{
  if (!stream || !strpbrk(mode, "wa+")) return;
  const std::lock_guard<std::mutex> lock(files().mutex);
  files().open.push_back({stream, name, false});
}

int close_watched_file(FILE *stream, int (*close)(FILE *))
{
  Files &all = files();
  OpenFile file{nullptr, {}, false};
  {
    const std::lock_guard<std::mutex> lock(all.mutex);
    const auto found = std::find_if(all.open.begin(), all.open.end(),
                                    [&](const OpenFile &open) { return open.stream == stream; });
    if (found != all.open.end()) {
      file = *found;
      all.open.erase(found);
    }
  }
  if (!file.stream) return close(stream);
  std::string fault = fault_of(stream, file.name);
  errno = 0;
  const int result = close(stream);
  const int number = errno;
  if (fault.empty() && result != 0)
    fault = number ? strerror(number) : "the program that writes it failed";
  if (!fault.empty() && !file.told) {
    const std::lock_guard<std::mutex> lock(all.mutex);
    all.cut.push_back({file.name, fault});
  }
  errno = number;
  return result;
}

std::string next_cut_file()
{
  Files &all = files();
  const std::lock_guard<std::mutex> lock(all.mutex);
  if (!all.cut.empty()) {
    const std::string told = sentence(all.cut.front());
    all.cut.erase(all.cut.begin());
    return told;
  }
  for (OpenFile &file : all.open)
    if (!file.told && ferror(file.stream)) {
      file.told = true;
      return sentence({file.name, likely_reason(file.name)});
    }
  if (!all.screen_told && ferror(stdout)) {
    all.screen_told = true;
    return "The screen's output is cut short: a write to it failed (wanted a disk that takes all of "
           "it)";
  }
  return {};
}

std::string was_cut(const std::string &name)
{
  Files &all = files();
  const std::lock_guard<std::mutex> lock(all.mutex);
  const auto found = std::find_if(all.cut.begin(), all.cut.end(),
                                  [&](const CutFile &file) { return file.name == name; });
  if (found == all.cut.end()) return {};
  const std::string reason = found->reason;
  all.cut.erase(found);
  return reason;
}

void look_at_files_at_exit()
{
  static const int registered = atexit(end_by_cut_file);
  static_cast<void>(registered);
}

}  // namespace spherocylinder
