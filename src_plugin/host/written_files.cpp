// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/written_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace spherocylinder {

namespace {

struct OpenFile {
  FILE *stream;
  std::string name;
  std::string hidden;  // where it is written, if beside its place
  bool told;
};

struct CutFile {
  std::string name, reason;
};

struct Files {
  std::mutex mutex;
  std::vector<OpenFile> open;
  std::vector<CutFile> cut;
  std::vector<std::string> expected;
  bool screen_told = false;
};

// Never destroyed: files are closed until the very end.
Files &files()
{
  static Files &all = *new Files;
  return all;
}

// A failed write leaves its mark on the stream, not its reason.
std::string likely_reason(FILE *stream)
{
  struct statvfs disk;
  struct stat file;
  struct rlimit limit;
  if (fstatvfs(fileno(stream), &disk) == 0 && disk.f_blocks > 0 && disk.f_bavail == 0)
    return strerror(ENOSPC);
  if (fstat(fileno(stream), &file) == 0 && getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
      static_cast<rlim_t>(file.st_size) >= limit.rlim_cur)
    return strerror(EFBIG);
  return "a write to it failed";
}

std::string sentence(const CutFile &file)
{
  return "File " + file.name + " is cut short: " + file.reason +
         " (wanted a disk that takes all of it)";
}

// All is written, and is there.
std::string fault_of(FILE *stream)
{
  const bool failed_before = ferror(stream);
  if (fflush(stream) != 0) return strerror(errno);
  if (failed_before) return likely_reason(stream);
  struct stat file;
  const off_t end = ftello(stream);
  if (fstat(fileno(stream), &file) == 0 && S_ISREG(file.st_mode) && file.st_size < end)
    return "it is " + std::to_string(file.st_size) + " bytes long, " + std::to_string(end) +
           " were written";
  return {};
}

thread_local bool they_appear_whole = false;

// Puts a file in its place; why it could not, if so.
std::string appear(const OpenFile &file)
{
  if (file.hidden.empty() || rename(file.hidden.c_str(), file.name.c_str()) == 0) return {};
  return strerror(errno);
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

std::string beside(const std::string &name)
{
  const size_t folder = name.rfind('/') + 1;  // 0 without one
  return name.substr(0, folder) + "." + name.substr(folder) + ".part";
}

bool is_plain_file(const std::string &name)
{
  struct stat file;
  return lstat(name.c_str(), &file) != 0 || S_ISREG(file.st_mode);
}

FILE *open_watched_file(const char *name, const char *mode,
                        FILE *(*open)(const char *, const char *) )
{
  if (!strpbrk(mode, "wa+")) return open(name, mode);
  std::string hidden;
  if (they_appear_whole && mode[0] == 'w' && is_plain_file(name)) hidden = beside(name);
  FILE *const stream = open(hidden.empty() ? name : hidden.c_str(), mode);
  if (!stream) return stream;
  const std::lock_guard<std::mutex> lock(files().mutex);
  files().open.push_back({stream, name, hidden, false});
  return stream;
}

void expect_file(const char *name, const char *mode)
{
  if (!they_appear_whole || !strpbrk(mode, "wa+")) return;
  const std::lock_guard<std::mutex> lock(files().mutex);
  files().expected.push_back(name);
}

FilesAppearWhole::FilesAppearWhole(bool they_do) : before_(they_appear_whole)
{
  they_appear_whole = they_do;
}

FilesAppearWhole::~FilesAppearWhole()
{
  they_appear_whole = before_;
  const std::lock_guard<std::mutex> lock(files().mutex);
  for (OpenFile &file : files().open) {
    const std::string fault = appear(file);
    if (!fault.empty()) files().cut.push_back({file.name, fault});
    file.hidden.clear();
  }
  struct stat file;
  for (const std::string &name : files().expected)
    if (stat(name.c_str(), &file) != 0) files().cut.push_back({name, strerror(ENOSPC)});
  files().expected.clear();
}

int close_watched_file(FILE *stream, int (*close)(FILE *))
{
  Files &all = files();
  OpenFile file{nullptr, {}, {}, false};
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
  std::string fault = fault_of(stream);
  errno = 0;
  const int result = close(stream);
  const int number = errno;
  if (fault.empty() && result != 0) fault = strerror(number);
  if (fault.empty())
    fault = appear(file);
  else if (!file.hidden.empty())
    remove(file.hidden.c_str());
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
      return sentence({file.name, likely_reason(file.stream)});
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
