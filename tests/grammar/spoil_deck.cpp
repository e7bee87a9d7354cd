// SPDX-License-Identifier: GPL-2.0-or-later
// One line of a deck with a mistake, as a typing error makes it.
#include <iterator>
#include <sstream>
#include <vector>

#include "draft.h"

namespace grammar {

namespace {

std::string joined(const std::vector<std::string> &words)
{
  std::string line;
  for (const std::string &word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string with_mistake(Random &random, const std::string &line)
{
  std::istringstream in(line);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  const int last = static_cast<int>(words.size()) - 1;
  const int where = random.integer(0, last);
  switch (random.integer(0, 4)) {
    case 0:
    case 1: words.resize(random.integer(1, last + 1)); break;  // broken off
    case 2: words.erase(words.begin() + where); break;
    case 3: words.push_back(words[where]); break;
    default:
      words[where] =
          random.pick({"abc", "-1", "0", "0,5", "1e400", "nan", "all", "NULL", "99999999"});
      // No mistake otherwise.
      if (words.front() == "run" && words[where] == "99999999") words[where] = "1e400";
  }
  return joined(words);
}

}  // namespace

void spoil_deck(Draft &draft)
{
  std::istringstream in(draft.plan.deck);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  std::string &line = lines[draft.random.integer(0, static_cast<int>(lines.size()) - 1)];
  line = with_mistake(draft.random, line);
  draft.plan.deck.clear();
  for (const std::string &whole : lines) draft.plan.deck += whole + "\n";
  draft.plan.spoilt = true;
  draft.plan.twin = Setting::Same;
}

}  // namespace grammar
