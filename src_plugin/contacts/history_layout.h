// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "contact_interface.h"

namespace LAMMPS_NS {

// Hands the history values that contact models ask for on to the pair style or wall that keeps them, and
// knows afterwards which are where.
class HistoryLayout : public LIGGGHTS::IContactHistorySetup {
 public:
  explicit HistoryLayout(LIGGGHTS::IContactHistorySetup &keeper) : keeper_(&keeper) {}

  // Who asked the models keeps their values himself.
  void keep_from_host() { keeper_ = nullptr; }

  int add_history_value(std::string name, std::string changes_sign) override
  {
    names_.push_back(name);
    changes_sign_.push_back(changes_sign == "1");
    return keeper_ ? keeper_->add_history_value(name, changes_sign) : values() - 1;
  }

  // For the contacts of a rod's other end with a wall: room for the same values once more, behind them.
  void add_other_end()
  {
    const std::vector<std::string> names = names_;
    for (const std::string &name : names) keeper_->add_history_value("other_end_" + name, "0");
  }

  // Of one contact.
  int values() const { return static_cast<int>(names_.size()); }
  // Whether a value is the opposite from the other body.
  bool changes_sign(int value) const { return changes_sign_[value]; }
  // Where a contact's history has a value, -1 if it has not.
  int offset_of(const std::string &name) const
  {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }

 private:
  LIGGGHTS::IContactHistorySetup *keeper_;  // null: nobody of LIGGGHTS
  std::vector<std::string> names_;
  std::vector<bool> changes_sign_;
};

}  // namespace LAMMPS_NS
