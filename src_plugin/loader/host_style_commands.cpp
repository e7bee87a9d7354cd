// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_style_rows.h"

namespace spherocylinder {

namespace {

constexpr HostStyle row(HostKind kind, const char *name, Verdict verdict, const char *sentence)
{
  return {kind, name, verdict, sentence};
}

constexpr HostKind kMap = HostKind::Command;
constexpr HostKind kBuiltIn = HostKind::BuiltIn;
constexpr Verdict kRight = Verdict::Right;
constexpr Verdict kDifferent = Verdict::Different;
constexpr Verdict kRefused = Verdict::Refused;

constexpr const char *kNoBonds = "atom_style spherocylinder has no bonds; leave it out";
constexpr const char *kNoMinimiser =
    "rods have no energy minimiser; let them settle with fix nve/spherocylinder and damping";

}  // namespace

std::vector<HostStyle> command_rows()
{
  return {
      row(kMap, "change_box", kDifferent,
          "remap moves the rods' centres; axes and sizes do not change; no tilt"),
      row(kMap, "create_atoms", kDifferent,
          "makes particles without a size, which a run refuses: set ... diameter D length L gives it; "
          "random takes its number for the seed, as with spheres"),
      row(kMap, "create_box", kRight, "no prism region"),
      row(kMap, "delete_atoms", kRight,
          "of overlap: by the distance of centres; of a segment: leaves two fibres"),
      row(kMap, "delete_bonds", kRefused, kNoBonds),
      row(kMap, "displace_atoms", kRight, "rotate turns axes and spins, too"),
      row(kMap, "info", kRight, ""),
      row(kMap, "minimize", kRefused, kNoMinimiser),
      row(kMap, "neigh_modify", kDifferent,
          "every 1, delay 0, check yes and once no are used, with a warning, where others are given; page and "
          "one have no meaning for the rods' own lists"),
      row(kMap, "read_data", kRight, "columns: see atom_style spherocylinder"),
      row(kMap, "read_dump", kRefused,
          "it moves the centres and not the axes; use read_restart or "
          "read_data"),
      row(kMap, "read_restart", kRight,
          "give pair_style and walls again, with surface spherocylinder; a file that is not whole is refused, see "
          "restart_files"),
      row(kMap, "replicate", kRight,
          "the copies' ids go on from the highest one; contacts across a periodic face begin anew; fibres are copied whole"),
      row(kMap, "rotate", kRefused,
          "it turns the centres and not the axes; use displace_atoms rotate"),
      row(kMap, "run", kRight,
          "pre no: while rods, their sizes and masses, and fixes stay as they were; else refused"),
      row(kMap, "run_time", kRight, ""),
      row(kMap, "set", kDifferent,
          "diameter and length are the rod's own, axis and quat turn it, and all that follows from them "
          "is set too; mass, volume and inertia are refused"),
      row(kMap, "velocity", kDifferent,
          "zero angular: the rotation of the centres only, as with spheres; setAngular gives angular "
          "momenta"),
      row(kMap, "write_data", kRight, "without contact histories, as the log says"),
      row(kMap, "write_dump", kRight, "as the dump style it names"),
      row(kMap, "write_restart", kRight,
          "whole or not at all, with a closing mark: see restart_files"),

      row(kBuiltIn, "angle_coeff", kRefused, kNoBonds),
      row(kBuiltIn, "angle_style", kRefused, kNoBonds),
      row(kBuiltIn, "atom_modify", kRight, "map, sort and first"),
      row(kBuiltIn, "atom_style", kRight, "see its table"),
      row(kBuiltIn, "bond_coeff", kRefused, kNoBonds),
      row(kBuiltIn, "bond_style", kRefused, kNoBonds),
      row(kBuiltIn, "boundary", kRight, "see its table"),
      row(kBuiltIn, "box", kRight, "tilt has no use: see box styles"),
      row(kBuiltIn, "clear", kRight, ""),
      row(kBuiltIn, "communicate", kDifferent,
          "vel yes; group is refused, contacts would be missed"),
      row(kBuiltIn, "compute", kRight, "see its table"),
      row(kBuiltIn, "compute_modify", kRight, ""),
      row(kBuiltIn, "dielectric", kRight, "no charge: no effect"),
      row(kBuiltIn, "dihedral_coeff", kRefused, kNoBonds),
      row(kBuiltIn, "dihedral_style", kRefused, kNoBonds),
      row(kBuiltIn, "dimension", kDifferent, "3 only"),
      row(kBuiltIn, "dump", kRight, "see its table"),
      row(kBuiltIn, "dump_modify", kRight, ""),
      row(kBuiltIn, "echo", kRight, ""),
      row(kBuiltIn, "fix", kRight, "see its table"),
      row(kBuiltIn, "fix_modify", kRight, ""),
      row(kBuiltIn, "force_dt_reset", kRight, ""),
      row(kBuiltIn, "group", kRight, "region: of centres"),
      row(kBuiltIn, "hard_particles", kRight, "only silences a warning about Young's modulus"),
      row(kBuiltIn, "if", kRight, ""),
      row(kBuiltIn, "improper_coeff", kRefused, kNoBonds),
      row(kBuiltIn, "improper_style", kRefused, kNoBonds),
      row(kBuiltIn, "include", kRight, ""),
      row(kBuiltIn, "jump", kRight, ""),
      row(kBuiltIn, "kspace_modify", kRefused, "rods have no charge; leave it out"),
      row(kBuiltIn, "kspace_style", kRefused, "rods have no charge; leave it out"),
      row(kBuiltIn, "label", kRight, ""),
      row(kBuiltIn, "lattice", kRight, ""),
      row(kBuiltIn, "log", kRight, ""),
      row(kBuiltIn, "mass", kRefused,
          "a rod's mass comes from its size and density; use set density"),
      row(kBuiltIn, "min_modify", kRefused, kNoMinimiser),
      row(kBuiltIn, "min_style", kRefused, kNoMinimiser),
      row(kBuiltIn, "modify_timing", kRight, ""),
      row(kBuiltIn, "neighbor", kRight,
          "the skin of the bounding spheres' lists; inner lists: see "
          "surface spherocylinder"),
      row(kBuiltIn, "newton", kDifferent, "off only"),
      row(kBuiltIn, "next", kRight, ""),
      row(kBuiltIn, "package", kRight, "Debian's library has no accelerator packages"),
      row(kBuiltIn, "pair_coeff", kRight, "* *"),
      row(kBuiltIn, "pair_modify", kRight, ""),
      row(kBuiltIn, "pair_style", kRight,
          "see its table; given again, contacts begin anew, as with spheres"),
      row(kBuiltIn, "pair_write", kRefused,
          "a granular pair has no function of distance to write; "
          "leave it out"),
      row(kBuiltIn, "partition", kRight, ""),
      row(kBuiltIn, "print", kRight, ""),
      row(kBuiltIn, "processors", kRight, ""),
      row(kBuiltIn, "quit", kRight, ""),
      row(kBuiltIn, "region", kRight, "see its table"),
      row(kBuiltIn, "reset_timestep", kRight, ""),
      row(kBuiltIn, "restart", kRight,
          "as write_restart; within a run also the forces of the step"),
      row(kBuiltIn, "run_style", kDifferent, "verlet only"),
      row(kBuiltIn, "shell", kRight, ""),
      row(kBuiltIn, "soft_particles", kRight, "only silences a warning about Young's modulus"),
      row(kBuiltIn, "special_bonds", kRight, "no bonds: no effect"),
      row(kBuiltIn, "suffix", kRight, "Debian's library has no suffixed styles"),
      row(kBuiltIn, "thermo", kRight, ""),
      row(kBuiltIn, "thermo_log", kRight, ""),
      row(kBuiltIn, "thermo_modify", kRight, ""),
      row(kBuiltIn, "thermo_style", kDifferent,
          "ke as the compute of that name, erotate is refused; LIGGGHTS has no temp, press and pe"),
      row(kBuiltIn, "timestep", kRight, ""),
      row(kBuiltIn, "uncompute", kRight, ""),
      row(kBuiltIn, "undump", kRight, ""),
      row(kBuiltIn, "unfix", kRight, ""),
      row(kBuiltIn, "units", kRight, "see its table"),
      row(kBuiltIn, "variable", kDifferent,
          "atom property r is half the rod's length; functions of groups and regions (ke, angmom, "
          "inertia, omega, gyration) take rods as points at their centres"),
      row(kBuiltIn, "write_restart_on_signal", kRight, ""),
  };
}

}  // namespace spherocylinder
