// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/material_checks.h"

#include "atom.h"
#include "force.h"
#include "host/rod_error.h"
#include "lammps.h"
#include "property_registry.h"
#include "update.h"

using namespace LAMMPS_NS;

void LAMMPS_NS::check_types_have_properties(LAMMPS *lmp, int highest)
{
  const Atom *atom = lmp->atom;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    if (atom->type[i] > highest)
      rod_error_one(lmp,
                    "Pair gran: rod %d has atom type %d at step " BIGINT_FORMAT
                    ", but materials were "
                    "set up for types up to %d, the highest in use when LIGGGHTS last did so "
                    "(expected run without pre no after a command that changes types)",
                    atom->tag[i], atom->type[i], lmp->update->ntimestep, highest);
}

void LAMMPS_NS::check_friction(LAMMPS *lmp)
{
  PropertyRegistry &registry = lmp->force->registry;
  double **friction = nullptr;
  registry.connect("coeffFrict", friction, "surface spherocylinder");
  for (int i = 1; friction && i <= registry.max_type(); i++)
    for (int j = 1; j <= registry.max_type(); j++)
      if (!(friction[i][j] >= 0.0))
        rod_error_all(
            lmp,
            "Surface spherocylinder: coefficientFriction must be >= 0 (got %g for atom types "
            "%d and %d)",
            friction[i][j], i, j);
}
