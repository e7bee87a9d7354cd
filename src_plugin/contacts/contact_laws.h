// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>

#include "contacts/rod_keywords.h"
#include "contacts/stock_law.h"
#include "pointers.h"

namespace LAMMPS_NS {

// The law of a pair style's or a wall's contacts, as the deck gives it: LIGGGHTS's models, their
// keywords, and a faster law in the models' place where there is one.
class ContactLaws : private Pointers {
 public:
  ContactLaws(LAMMPS *lmp, std::unique_ptr<StockLaw> models);

  // The words behind the models' names. Returns what is wrong with them, or nothing.
  std::string read_keywords(int nargs, char **args);
  // At the start of a run.
  void connect();

  StockLaw &models() { return *models_; }
  ContactLaw &chosen() { return fast_ ? *fast_ : static_cast<ContactLaw &>(*models_); }
  const RodKeywords &keywords() const { return keywords_; }

 private:
  std::unique_ptr<StockLaw> models_;
  std::unique_ptr<ContactLaw> fast_;  // null where the models serve
  RodKeywords keywords_;
};

}  // namespace LAMMPS_NS
