// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/restart_header.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace spherocylinder {

namespace {

// As in LIGGGHTS's write_restart.cpp, which keeps them to itself.
enum Flag {
  kVersion = 0,
  kUnits = 4,
  kStep = 5,
  kRanks = 7,
  kAtomStyle = 22,
  kAtoms = 23,
  kTypes = 24,
  kBonds = 25,
  kAngles = 28,
  kDihedrals = 31,
  kImpropers = 34,
  kFirstDouble = 37,
  kLastFlag = 51
};

constexpr int kLongestWord = 1000;
constexpr int kMostRanks = 10000000;

bool is_string(int flag) { return flag == kVersion || flag == kUnits || flag == kAtomStyle; }

bool is_long(int flag)
{
  return flag == kStep || flag == kAtoms || flag == kBonds || flag == kAngles ||
         flag == kDihedrals || flag == kImpropers;
}

struct Close {
  void operator()(FILE *file) const { fclose(file); }
};

class Reader {
 public:
  explicit Reader(FILE *file) : file_(file) {}

  template <typename T>
  T next()
  {
    T value;
    read(&value, sizeof(T));
    return value;
  }

  std::string word()
  {
    const int length = next<int>();
    if (length < 1 || length > kLongestWord)
      throw std::runtime_error("a word in its header has " + std::to_string(length) + " letters");
    std::string text(length, '\0');
    read(text.data(), length);
    if (text.back() != '\0') throw std::runtime_error("a word in its header does not end");
    text.pop_back();
    return text;
  }

 private:
  void read(void *values, size_t bytes)
  {
    if (fread(values, 1, bytes, file_) != bytes)
      throw std::runtime_error("it ends within its header");
  }

  FILE *file_;
};

// Reads on to the flag that ends the header.
void read(Reader &reader, int64_t length, RestartHeader &header)
{
  int flag = reader.next<int>();
  if (flag != kVersion) throw std::runtime_error("it does not begin as a restart file");
  for (; flag != -1; flag = reader.next<int>()) {
    if (flag < 0 || flag > kLastFlag)
      throw std::runtime_error("its header holds the unknown item " + std::to_string(flag));
    if (is_string(flag)) {
      const std::string word = reader.word();
      if (flag == kAtomStyle) header.atom_style = word;
      if (flag == kAtomStyle && word == "hybrid")
        for (int n = reader.next<int>(); n > 0; n--) reader.word();
    } else if (is_long(flag)) {
      const auto count = reader.next<int64_t>();
      if (count < 0 || (flag == kAtoms && count > INT32_MAX))
        throw std::runtime_error("its header holds the count " + std::to_string(count));
    } else if (flag >= kFirstDouble) {
      reader.next<double>();
    } else {
      const int value = reader.next<int>();
      if (flag == kRanks) header.ranks = value;
      if ((flag == kRanks && (value < 1 || value > kMostRanks)) ||
          (flag == kTypes && (value < 1 || value > length)))
        throw std::runtime_error("its header holds the count " + std::to_string(value));
    }
  }
  if (header.atom_style.empty() || header.ranks == 0)
    throw std::runtime_error("its header has no atom style or no number of processors");
}

}  // namespace

RestartHeader read_restart_header(const std::string &path)
{
  RestartHeader header;
  const std::unique_ptr<FILE, Close> file(fopen(path.c_str(), "rb"));
  if (!file || fseeko(file.get(), 0, SEEK_END) != 0) {
    header.fault = strerror(errno);
    return header;
  }
  const int64_t length = ftello(file.get());
  rewind(file.get());
  Reader reader(file.get());
  try {
    read(reader, length, header);
  } catch (const std::runtime_error &wrong) {
    header.fault = wrong.what();
  }
  return header;
}

}  // namespace spherocylinder
