// SPDX-License-Identifier: GPL-2.0-or-later
// Commands between two runs, with what each does to the rods.
#pragma once

#include <functional>
#include <string>

#include "draft.h"

namespace grammar {

class Pause {
 public:
  Pause(Draft &draft, Run &run) : draft_(draft), random_(draft.random), run_(run) {}

  void choose();
  void restart();

 private:
  using Has = std::function<bool(const Rod &)>;

  Draft &draft_;
  Random &random_;
  Run &run_;

  void add(const std::string &text) { run_.before += text; }
  // The rods that `has` tells are changed.
  void change(const Has &has, const std::function<void(Rod &)> &what);
  bool driven_or_held() const;
  // A new group by type, region or id, and which rods it has; in half of the cases `all`.
  std::string name_some(Has &has);
  std::string name_some_or_all(Has &has);
  void forget_ids();

  void delete_some();
  void delete_group(const std::string &compress);
  void displace();
  void rotate(const std::string &group, const Has &has);
  void set_velocity();
  void set_something();
  void change_box();
  void renumber_steps();
  void through_data_file();
  void exclude();
  void do_something_seldom();
  void do_little();
};

}  // namespace grammar
