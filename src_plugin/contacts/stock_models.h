// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contacts/contact_law.h"
#include "core/linear_contact.h"

class PropertyRegistry;

namespace LIGGGHTS {
class IContactHistorySetup;
}

namespace LAMMPS_NS {

class RodKeywords;

// A combination of LIGGGHTS's contact models, of which stock_law.h makes a law; whoever drives it does
// not know which.
class StockModels : public ContactLaw {
 public:
  // Reads the words behind the models' names, and has the models ask for their history values. Returns
  // what is wrong with the words, or nothing.
  virtual std::string read_keywords(RodKeywords &keywords, std::vector<char *> words,
                                    LIGGGHTS::IContactHistorySetup *history) = 0;
  // A history as long as the stored one, of models whose keywords are not known.
  virtual void set_up_history(LIGGGHTS::IContactHistorySetup *history) = 0;
  // `springs`: where the histories keep the tangential spring of end 0 and 1, -1 where they do not.
  virtual void connect(PropertyRegistry &registry, const RodKeywords &keywords,
                       const int (&springs)[2]) = 0;

  virtual bool is(const std::string &kind, const std::string &name) = 0;
  virtual int history_offset(const std::string &name) = 0;
  virtual int64_t hashcode() = 0;
  virtual double stress_strain_exponent() = 0;
  // What VectorLaw can make of it; nothing if it cannot.
  virtual std::optional<spherocylinder::Tangential> in_batches() const = 0;

  bool has_tangential()
  {
    return is("tangential", "no_history") || is("tangential", "history") ||
           is("tangential", "tan_luding");
  }
};

}  // namespace LAMMPS_NS
