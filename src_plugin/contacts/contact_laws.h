// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <vector>

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
  // At the start of a run, for so many threads.
  void connect(int threads);

  StockLaw &models() { return *models_; }
  ContactLaw &chosen() { return fast_.empty() ? static_cast<ContactLaw &>(*models_) : *fast_[0]; }
  // The same law of each thread, where it has one: LIGGGHTS's models serve one at a time.
  ContactLaw &of_thread(int thread) { return thread == 0 ? chosen() : *fast_[thread]; }
  int number() const { return fast_.empty() ? 1 : static_cast<int>(fast_.size()); }
  void begin(const LawStep &step)
  {
    for (int thread = 0; thread < number(); thread++) of_thread(thread).begin(step);
  }
  void end()
  {
    for (int thread = 0; thread < number(); thread++) of_thread(thread).end();
  }
  const RodKeywords &keywords() const { return keywords_; }

 private:
  std::unique_ptr<StockLaw> models_;
  std::vector<std::unique_ptr<ContactLaw>> fast_;  // one a thread, none where the models serve
  RodKeywords keywords_;
};

}  // namespace LAMMPS_NS
