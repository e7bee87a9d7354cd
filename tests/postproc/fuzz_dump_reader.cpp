// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer target of the readers of dumps and tables; tests/README.md tells how to run it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "read_dump_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t count)
{
  static const int file = memfd_create("dump", 0);  // the reader opens files by name
  static const std::string path = fmt::format("/proc/self/fd/{}", file);
  if (file < 0 || ftruncate(file, 0) != 0 ||
      pwrite(file, bytes, count, 0) != static_cast<ssize_t>(count))
    std::abort();
  spherocylinder::read_bytes(path);
  return 0;
}
