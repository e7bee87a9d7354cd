// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contacts/contact_law.h"
#include "contacts/history_layout.h"

class PropertyRegistry;

namespace LAMMPS_NS {

class RodKeywords;

// A combination of LIGGGHTS's contact models as a law; who drives it does not know which (stock_law_of.h).
class StockLaw : public ContactLaw {
 public:
  // Reads the words behind the models' names, and has the models ask for their history values. Returns
  // what is wrong with the words, or nothing.
  virtual std::string read_keywords(RodKeywords &keywords, std::vector<char *> words) = 0;
  // A history as long as the stored one, of models whose keywords are not known.
  virtual void set_up_history() = 0;
  virtual void connect(PropertyRegistry &registry, const RodKeywords &keywords) = 0;

  virtual HistoryLayout &layout() = 0;
  virtual bool is(const std::string &kind, const std::string &name) = 0;
  virtual int history_offset(const std::string &name) = 0;
  virtual int64_t hashcode() = 0;
  virtual double stress_strain_exponent() = 0;

  // Where a contact's history has the tangential spring, -1 if it has none.
  int spring() { return is("tangential", "history") ? layout().offset_of("shearx") : -1; }
  bool has_tangential() { return !is("tangential", "off"); }
};

}  // namespace LAMMPS_NS
