// SPDX-License-Identifier: GPL-2.0-or-later
// Stands before the C library where LIGGGHTS opens and closes its files, so that none is cut short in
// silence. Calls of other libraries go on as they are.
#include <cstdio>

#include <dlfcn.h>

#include "host/written_files.h"
#include "lammps.h"

#define EXPORT __attribute__((visibility("default")))

namespace {

template <typename Function>
Function next_symbol(const char *name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

// The start of the library that an address is in.
void *library_of(void *address)
{
  Dl_info info;
  return dladdr(address, &info) ? info.dli_fbase : nullptr;
}

bool is_liggghts(void *caller)
{
  static void *const liggghts =
      library_of(dlsym(RTLD_DEFAULT, "_ZN9LAMMPS_NS6LAMMPSC1EiPPcP19ompi_communicator_t"));
  return liggghts && library_of(caller) == liggghts;
}

}  // namespace

extern "C" {

EXPORT FILE *fopen(const char *name, const char *mode)
{
  static const auto original = next_symbol<FILE *(*) (const char *, const char *)>("fopen");
  if (!is_liggghts(__builtin_return_address(0))) return original(name, mode);
  return spherocylinder::open_watched_file(name, mode, original);
}

// By which streams of C++ are opened: VTK's.
EXPORT FILE *fopen64(const char *name, const char *mode)
{
  static const auto original = next_symbol<FILE *(*) (const char *, const char *)>("fopen64");
  FILE *const stream = original(name, mode);
  if (stream) spherocylinder::expect_file(name, mode);
  return stream;
}

EXPORT int fclose(FILE *stream)
{
  static const auto original = next_symbol<int (*)(FILE *)>("fclose");
  return spherocylinder::close_watched_file(stream, original);
}

}  // extern "C"
