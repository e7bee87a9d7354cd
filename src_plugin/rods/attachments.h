// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <map>
#include <memory>
#include <typeindex>
#include <typeinfo>

namespace LAMMPS_NS {

class LAMMPS;

// One object of a type for each simulation with rods, made by its LAMMPS when it is first asked for:
// what several styles share, without an owner among them. Gone with the atom style, also after the
// command `clear`.
class Attachments {
 public:
  explicit Attachments(LAMMPS *lmp) : lmp_(lmp) {}

  template <typename T>
  T &of()
  {
    std::shared_ptr<void> &found = objects_[std::type_index(typeid(T))];
    if (!found) found = std::make_shared<T>(lmp_);
    return *static_cast<T *>(found.get());
  }

 private:
  LAMMPS *lmp_;
  std::map<std::type_index, std::shared_ptr<void>> objects_;
};

}  // namespace LAMMPS_NS
