// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_laws.h"

#include <utility>

#include "contacts/material_checks.h"
#include "contacts/vector_law.h"
#include "force.h"

using namespace LAMMPS_NS;

ContactLaws::ContactLaws(LAMMPS *lmp, std::unique_ptr<StockLaw> models)
    : Pointers(lmp), models_(std::move(models))
{
}

std::string ContactLaws::read_keywords(int nargs, char **args)
{
  const std::vector<char *> others = keywords_.take_from(lmp, nargs, args);
  return models_->read_keywords(keywords_, others);
}

void ContactLaws::connect(int threads)
{
  models_->connect(force->registry, keywords_);
  if (models_->has_tangential()) check_friction(lmp);
  fast_.clear();
  for (int thread = 0; thread < threads; thread++)
    if (std::unique_ptr<ContactLaw> law = vector_law(lmp, *models_, keywords_))
      fast_.push_back(std::move(law));
}
