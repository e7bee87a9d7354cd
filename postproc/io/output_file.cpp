// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/input_error.h"

namespace spherocylinder {
namespace {

namespace fs = std::filesystem;

// Of the whole run, whose files one thread opens: all that were read, and those being written.
std::vector<fs::path> inputs, outputs;

// The names that the system gives to files which are open already.
bool is_open_file(const fs::path &path)
{
  std::error_code error;
  const std::string name = fs::absolute(path, error).lexically_normal().string();
  if (name == "/dev/stdout" || name == "/dev/stderr" || name.rfind("/dev/fd/", 0) == 0) return true;
  return name.rfind("/proc/", 0) == 0 && name.find("/fd/") != std::string::npos;
}

// There or not; no pipe, device or folder.
bool is_ordinary(const fs::path &path)
{
  std::error_code error;
  if (is_open_file(path)) return false;
  const fs::file_status status = fs::status(path, error);
  return !fs::exists(status) || fs::is_regular_file(status);
}

// What a link leads to, there or not; other paths as they are.
fs::path end_of_links(fs::path path)
{
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, error)); i++) {
    const fs::path next = fs::read_symlink(path, error);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

// The same file, there or not, under whatever name.
bool are_one(const fs::path &a, const fs::path &b)
{
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(fs::absolute(a, error), error) ==
         fs::weakly_canonical(fs::absolute(b, error), error);
}

bool is_among(const std::vector<fs::path> &files, const fs::path &path)
{
  return std::any_of(files.begin(), files.end(),
                     [&](const fs::path &file) { return are_one(file, path); });
}

// Creates a file of a name of its own beside `target`, with its ending and permissions.
std::string new_file_beside(const fs::path &target, const std::string &path)
{
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const std::string ending = target.extension().string();
  std::string name = (folder / ("." + target.stem().string() + ".XXXXXX" + ending)).string();
  const int file = mkstemps(name.data(), static_cast<int>(ending.size()));
  if (file < 0)
    throw InputError(fmt::format("{}: cannot be opened for writing: in its folder, {}", path,
                                 std::strerror(errno)));
  struct stat old;
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(file, stat(target.c_str(), &old) == 0 ? old.st_mode & 07777 : 0666 & ~mask);
  close(file);
  return name;
}

}  // namespace

OutputFile::OutputFile(const std::string &path) : path_(path), target_(path), working_path_(path)
{
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError(fmt::format("{}: is a folder, wanted a file to write", path));
  if (is_ordinary(path)) {
    if (is_among(inputs, path))
      throw InputError(
          fmt::format("{}: is read by this run, wanted another name for what it writes", path));
    if (is_among(outputs, path))
      throw InputError(fmt::format("{}: is named twice, wanted a file for each output", path));
    target_ = end_of_links(path);
    if (fs::is_symlink(fs::symlink_status(target_, error)))
      throw InputError(
          fmt::format("{}: cannot be opened for writing: links lead in a circle", path));
    if (access(target_.c_str(), F_OK) == 0 && access(target_.c_str(), W_OK) != 0)
      throw InputError(
          fmt::format("{}: cannot be opened for writing: {}", path, std::strerror(errno)));
    working_path_ = new_file_beside(target_, path);
  }
  outputs.emplace_back(path);
}

OutputFile::OutputFile(OutputFile &&other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      working_path_(std::move(other.working_path_)),
      open_(std::exchange(other.open_, false))
{
}

OutputFile::~OutputFile()
{
  if (!open_) return;
  std::error_code ignored;  // nothing more can be done
  if (working_path_ != path_) fs::remove(working_path_, ignored);
  leave();
}

void OutputFile::leave()
{
  open_ = false;
  outputs.erase(std::find(outputs.begin(), outputs.end(), fs::path(path_)));
}

void OutputFile::finish()
{
  if (!open_) return;
  std::error_code error;
  if (working_path_ != path_) fs::rename(working_path_, target_, error);
  if (error) throw InputError(fmt::format("{}: could not be written: {}", path_, error.message()));
  leave();
}

void write_file(const std::string &path, const std::string &text)
{
  OutputFile output(path);
  std::ofstream file(output.working_path());
  file << text;
  file.close();
  if (!file) throw InputError(fmt::format("{}: could not be written to its end", path));
  output.finish();
}

FilesTogether::~FilesTogether()
{
  std::error_code ignored;  // nothing more can be done
  for (const std::string &path : paths_)
    if (is_ordinary(path)) fs::remove(path, ignored);
}

void note_input(const std::string &path)
{
  if (is_ordinary(path) && is_among(outputs, path))
    throw InputError(fmt::format("{}: is written by this run, wanted another file to read", path));
  if (std::find(inputs.begin(), inputs.end(), path) == inputs.end()) inputs.emplace_back(path);
}

}  // namespace spherocylinder
