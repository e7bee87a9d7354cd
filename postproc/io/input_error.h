// SPDX-License-Identifier: GPL-2.0-or-later
// The one error of the post-processors: something the user gave cannot be used. what() is a single
// sentence: where, what, the value seen, the value wanted. The tools print it and exit with code 2.
#pragma once

#include <stdexcept>

namespace spherocylinder {

class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace spherocylinder
