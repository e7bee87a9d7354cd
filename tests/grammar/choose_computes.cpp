// SPDX-License-Identifier: GPL-2.0-or-later
// Computes: those that the judge reads, and any others, shown by thermo.
#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

struct Choice {
  const char *text;
  char shown;  // s: a scalar, v: a vector's first value, a: per atom, A: per atom, first column
};

// clang-format off
const Choice kOrdinary[] = {
    {"ke", 's'}, {"com", 'v'}, {"gyration", 's'}, {"msd", 'v'}, {"ke/atom", 'a'},
    {"property/atom vx", 'a'}, {"property/atom fx omegax tqx", 'A'}, {"pressure thermo_temp", 's'},
    {"stress/atom", 'A'}, {"displace/atom", 'A'}, {"reduce sum vx", 's'}, {"reduce max x", 's'},
    {"property/atom angmomx angmomy", 'A'}, {"property/atom xu yu zu", 'A'},
    {"temp", 's'}, {"erotate/spherocylinder", 's'}};

const Choice kDoubtful[] = {
    {"contact/atom", 'a'}, {"coord/gran", 'a'}, {"coord/atom 0.05", 'a'}, {"rdf 10", 'v'},
    {"cluster/atom 0.02", 'a'}, {"erotate", 's'}, {"erotate/sphere", 's'}, {"temp/sphere", 's'},
    {"pe", 's'}, {"pe/atom", 'a'}, {"property/atom shapex shapez", 'A'},
    {"property/atom quatw quati quatj quatk", 'A'}, {"property/atom radius", 'a'},
    {"property/atom diameter", 'a'}, {"centro/atom 12", 'a'}, {"cna/atom 0.05", 'a'},
    {"heat/flux a b c", 'v'}, {"nonsense", 's'}, {"group/group all", 's'}, {"erotate/asphere", 's'},
    {"erotate/superquadric", 's'}, {"temp/asphere", 's'}, {"pair gran", 's'},
    {"bond/local dist", 's'}, {"voronoi/atom", 'A'}, {"inertia/molecule", 's'}};
// clang-format on

void show(Draft &draft, const std::string &id, const Choice &choice)
{
  draft.compute_text += fmt::format("compute {} all {}\n", id, choice.text);
  switch (choice.shown) {
    case 's': draft.thermo_columns += " c_" + id; break;
    case 'v': draft.thermo_columns += " c_" + id + "[1]"; break;
    default:
      draft.compute_text += fmt::format("compute {0}_sum all reduce sum c_{0}{1}\n", id,
                                        choice.shown == 'A' ? "[1]" : "");
      draft.thermo_columns += fmt::format(" c_{}_sum", id);
  }
}

template <size_t N>
const Choice &pick(Random &random, const Choice (&choices)[N])
{
  return choices[random.integer(0, static_cast<int>(N) - 1)];
}

}  // namespace

void choose_computes(Draft &draft)
{
  Random &random = draft.random;
  draft.thermo_columns = " c_kinetic c_turning c_contacts[2] c_contacts[4] c_contacts[5]";
  for (int k = random.pick({0, 1, 1, 2, 3}); k > 0; k--)
    show(draft, fmt::format("more{}", k), pick(random, kOrdinary));
  if (random.chance(0.08)) show(draft, "doubt", pick(random, kDoubtful));
  draft.plan.local_rows = random.chance(0.3);
  if (draft.plan.local_rows)
    draft.compute_text += "compute rows all pair/gran/local id force delta contactPoint normal\n";
  if (!draft.plan.walls.empty() && random.chance(0.2)) {
    draft.compute_text += "compute wall_rows all wall/gran/local id force delta\n"
                          "compute wall_load all reduce sum c_wall_rows[6]\n";
    draft.thermo_columns += " c_wall_load";
  }
}

}  // namespace grammar
