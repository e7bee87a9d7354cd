// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/output_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/input_error.h"

namespace spherocylinder {
namespace {

namespace fs = std::filesystem;

// Of the whole run, whose files one thread opens: all that were read, and those being written.
std::vector<fs::path> inputs, outputs;

// There or not; no pipe, and none of the names that the system gives to open files.
bool is_ordinary(const fs::path &path)
{
  std::error_code error;
  const std::string name = fs::absolute(path, error).lexically_normal().string();
  if (name.rfind("/dev/", 0) == 0 || name.rfind("/proc/", 0) == 0) return false;
  const fs::file_status status = fs::status(path, error);
  return !fs::exists(status) || fs::is_regular_file(status);
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

std::string part_of_name(const fs::path &path)
{
  fs::path part = path;
  part.replace_filename(path.stem().string() + ".part" + path.extension().string());
  return part;
}

}  // namespace

OutputFile::OutputFile(const std::string &path)
    : path_(path), target_(path), working_path_(path)
{
  if (is_ordinary(path)) {
    if (is_among(inputs, path))
      throw InputError(
          fmt::format("{}: is read by this run, wanted another name for what it writes", path));
    if (is_among(outputs, path))
      throw InputError(fmt::format("{}: is named twice, wanted a file for each output", path));
    if (fs::is_symlink(path)) target_ = fs::weakly_canonical(path);
    working_path_ = part_of_name(target_);
  }
  const bool there_and_closed = fs::exists(path) && !std::ofstream(path, std::ios::app);
  if (there_and_closed || !std::ofstream(working_path_))
    throw InputError(fmt::format("{}: cannot be opened for writing", path));
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
  leave();
  if (working_path_ == path_) return;
  std::error_code error;
  fs::rename(working_path_, target_, error);
  if (error) throw InputError(fmt::format("{}: could not be written: {}", path_, error.message()));
}

void note_input(const std::string &path)
{
  if (is_ordinary(path) && is_among(outputs, path))
    throw InputError(fmt::format("{}: is written by this run, wanted another file to read", path));
  if (std::find(inputs.begin(), inputs.end(), path) == inputs.end()) inputs.emplace_back(path);
}

}  // namespace spherocylinder
