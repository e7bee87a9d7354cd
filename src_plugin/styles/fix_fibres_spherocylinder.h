// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(fibres/spherocylinder, FixFibresSpherocylinder)

#else

#ifndef LMP_FIX_FIBRES_SPHEROCYLINDER_H
#define LMP_FIX_FIBRES_SPHEROCYLINDER_H

#include "core/rotation.h"
#include "fix.h"
#include "rods/fibre_segments.h"

namespace LAMMPS_NS {

class AtomVecSpherocylinder;

// Keeps which rod is which segment of which fibre (rods/fibre_segments.h) with the rods: through memory,
// to ghosts and other ranks, to restart and data files. Made by fix joint/spherocylinder and by
// read_data of a file with a section Fibres, not by a deck.
class FixFibresSpherocylinder : public Fix {
 public:
  static constexpr const char *kId = "fibres";
  static constexpr const char *kStyle = "fibres/spherocylinder";
  static constexpr const char *kHeader = "segments";
  static constexpr const char *kSection = "Fibres";

  FixFibresSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  ~FixFibresSpherocylinder() override;
  int setmask() override;
  void init() override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int from, int to, int) override;
  int pack_border(int n, int *list, double *buffer) override;
  int unpack_border(int n, int first, double *buffer) override;
  int pack_exchange(int i, double *buffer) override;
  int unpack_exchange(int i, double *buffer) override;
  int pack_restart(int i, double *buffer) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  double memory_usage() override;

  void read_data_header(char *line) override;
  bigint read_data_skip_lines(char *keyword) override;
  void read_data_section(char *keyword, int n, char *lines) override;
  void write_data_header(FILE *file, int) override;
  void write_data_section_size(int, int &rows, int &columns) override;
  void write_data_section_pack(int, double **rows) override;
  void write_data_section_keyword(int, FILE *file) override;
  void write_data_section(int, FILE *file, int n, double **rows, int) override;

 private:
  AtomVecSpherocylinder &rods_;
  FibreSegments &segments_;
  bigint lines_ = 0;     // of the section Fibres in the data file that is read
  bigint segments_all_;  // of all ranks, when a run or write_data began

  void share_ends(int i);
  void set_frame(int i, const spherocylinder::Quaternion &frame);
};

// The fix, made if it is not there yet. Also before the simulation box is there.
FixFibresSpherocylinder &fibres_of(LAMMPS *lmp);

// Null without fibres.
FixFibresSpherocylinder *find_fibres(LAMMPS *lmp);

}  // namespace LAMMPS_NS

#endif
#endif
