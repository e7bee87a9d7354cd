// SPDX-License-Identifier: GPL-2.0-or-later
// Names a private data member of a class that offers no other way in.
//
// C++ does not check access on the arguments of an explicit template instantiation
// ([temp.explicit]/13), so that the member pointer can be handed to a friend function there:
//
//   struct FixMap { using type = std::map<...> *Modify::*; friend type member(FixMap); };
//   template struct ExposeMember<FixMap, &Modify::fix_map>;
//   (modify->*member(FixMap()))->...
#pragma once

namespace spherocylinder {

template <typename Tag, typename Tag::type Member>
struct ExposeMember {
  friend typename Tag::type member(Tag) { return Member; }
};

}  // namespace spherocylinder
