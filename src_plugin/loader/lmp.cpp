// SPDX-License-Identifier: GPL-2.0-or-later
// lmp: LIGGGHTS from Debian's library with this plug-in loaded before it.
#include <csignal>
#include <cstring>

#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "signal_handling.h"

int main(int argc, char **argv)
{
  // Ctrl-C, mpirun's SIGTERM and SIGUSR1 end a run at a step boundary, as with stock liggghts.
  struct sigaction action;
  memset(&action, 0, sizeof(action));
  action.sa_handler = LAMMPS_NS::SignalHandler::int_handler;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = LAMMPS_NS::SignalHandler::usr1_handler;
  sigaction(SIGUSR1, &action, nullptr);

  MPI_Init(&argc, &argv);
  auto *lammps = new LAMMPS_NS::LAMMPS(argc, argv, MPI_COMM_WORLD);
  lammps->input->file();
  delete lammps;
  MPI_Finalize();
}
