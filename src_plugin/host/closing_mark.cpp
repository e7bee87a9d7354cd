// SPDX-License-Identifier: GPL-2.0-or-later
#include "host/closing_mark.h"

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>

#include <unistd.h>
#include <zlib.h>

namespace spherocylinder {

namespace {

constexpr char kEnd[] = "end of file\n";
constexpr char kForm[] = "closing bytes %020" PRIu64 " check ";
constexpr size_t kBeforeCheck = 14 + 20 + 7;  // of the last but one line
constexpr size_t kMark = kBeforeCheck + 8 + 1 + sizeof(kEnd) - 1;
constexpr size_t kBlock = 1 << 20;  // read at a time (unit: byte)

struct Close {
  void operator()(FILE *file) const { fclose(file); }
};
using File = std::unique_ptr<FILE, Close>;

std::string reason() { return strerror(errno); }

// Of the first `length` bytes; false if the file has fewer.
bool check_sum(FILE *file, uint64_t length, uLong &sum)
{
  std::vector<Bytef> block(kBlock);
  sum = crc32(0, nullptr, 0);
  rewind(file);
  while (length > 0) {
    const size_t wanted = std::min<uint64_t>(length, kBlock);
    if (fread(block.data(), 1, wanted, file) != wanted) return false;
    sum = crc32(sum, block.data(), static_cast<uInt>(wanted));
    length -= wanted;
  }
  return true;
}

std::string digits(uLong sum)
{
  char text[9];
  snprintf(text, sizeof(text), "%08lx", sum & 0xffffffffUL);
  return text;
}

std::string before_check(uint64_t bytes)
{
  char text[kBeforeCheck + 1];
  snprintf(text, sizeof(text), kForm, bytes);
  return text;
}

uint64_t length_of(FILE *file)
{
  return fseeko(file, 0, SEEK_END) == 0 ? static_cast<uint64_t>(ftello(file)) : 0;
}

}  // namespace

unsigned long check_sum_of(const std::string &text)
{
  return crc32(0, reinterpret_cast<const Bytef *>(text.data()), static_cast<uInt>(text.size()));
}

std::string close_with_mark(const std::string &path, const std::vector<std::string> &lines,
                            std::string &check)
{
  const File file(fopen(path.c_str(), "r+b"));
  if (!file) return reason();
  const uint64_t bytes = length_of(file.get());
  uLong sum;
  if (!check_sum(file.get(), bytes, sum)) return reason();
  std::string text;
  for (const std::string &line : lines) text += line + "\n";
  text += before_check(bytes);
  sum = crc32(sum, reinterpret_cast<const Bytef *>(text.data()), static_cast<uInt>(text.size()));
  check = digits(sum);
  text += check + "\n" + kEnd;
  if (fseeko(file.get(), 0, SEEK_END) != 0 ||
      fwrite(text.data(), 1, text.size(), file.get()) != text.size() || fflush(file.get()) != 0 ||
      fsync(fileno(file.get())) != 0)
    return reason();
  const uint64_t length = length_of(file.get());
  if (length == bytes + text.size()) return {};
  return "it is " + std::to_string(length) + " bytes long";
}

MarkedFile read_marked_file(const std::string &path)
{
  MarkedFile found;
  const File file(fopen(path.c_str(), "rb"));
  if (!file) {
    found.fault = reason();
    return found;
  }
  const uint64_t length = length_of(file.get());
  char mark[kMark + 1] = {};
  if (length >= kMark && fseeko(file.get(), -static_cast<off_t>(kMark), SEEK_END) == 0 &&
      fread(mark, 1, kMark, file.get()) == kMark)
    found.has_mark = strcmp(mark + kBeforeCheck + 8 + 1, kEnd) == 0;
  if (!found.has_mark) {
    found.fault = "it has no closing mark";
    return found;
  }
  found.check.assign(mark + kBeforeCheck, 8);
  const uint64_t checked = length - kMark + kBeforeCheck;
  uLong sum;
  if (!check_sum(file.get(), checked, sum)) {
    found.fault = "it cannot be read to its end";
    return found;
  }
  if (digits(sum) != found.check || mark[kBeforeCheck + 8] != '\n') {
    found.fault = "its check sum is " + digits(sum) + " (wanted " + found.check + ")";
    return found;
  }
  // What the check sum covers is as it was written.
  uint64_t bytes = 0;
  if (sscanf(mark, "closing bytes %" SCNu64, &bytes) != 1 || bytes > length - kMark) {
    found.fault = "its closing mark does not say where it begins";
    return found;
  }
  std::string text(length - kMark - bytes, '\0');
  fseeko(file.get(), static_cast<off_t>(bytes), SEEK_SET);
  if (fread(text.data(), 1, text.size(), file.get()) != text.size()) {
    found.fault = "it cannot be read to its end";
    return found;
  }
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) found.lines.push_back(line);
  return found;
}

}  // namespace spherocylinder
